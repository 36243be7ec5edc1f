/** What the text needs of the book under it: where its pages are seen, and when that changes. */

import type { PageBox, PageSize } from "../sources/page_source.ts";

/** A place on the screen, CSS pixels from the book's upper left corner. */
export interface Point {
  readonly x: number;
  readonly y: number;
}

/** A book of which two pages may lie open. */
export interface PageView {
  /** The pages (from 1) that lie open, in the order in which they are read. */
  readonly openPages: readonly number[];
  /** The part of its leaf that a page of some size covers, shares from the upper left corner. */
  placeOf(page: number, size: PageSize): PageBox;
  /** Where a place on a page (shares of its leaf from the upper left) is seen; null where it is not, or moves. */
  project(page: number, x: number, y: number): Point | null;
  /** Calls `listener` when the book has come to rest in another view, and when it leaves it, with whether it rests. */
  onView(listener: (rests: boolean) => void): () => void;
}
