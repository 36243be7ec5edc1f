/**
 * What the text layer needs of the book under it: where its pages are seen, and
 * when that changes.
 */

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
  /**
   * Returns the part of its leaf that a page of some size covers, as fractions
   * from the upper left corner.
   */
  placeOf(page: number, size: PageSize): PageBox;
  /**
   * Returns where a place on a page (in fractions of its leaf from the upper
   * left) is seen; null if it is not visible, or moves.
   */
  project(page: number, x: number, y: number): Point | null;
  /**
   * Calls `listener` with whether the book rests, when it has come to rest in
   * another view and when it leaves it.
   */
  onView(listener: (rests: boolean) => void): () => void;
}
