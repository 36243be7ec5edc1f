/** What `<turnleaf-book>` tells its page. */

import type { Edge, Layout } from "../book/spreads.ts";

/** Where a turn leads, in page numbers from 1: the first page seen before and after. */
export interface TurnDetail {
  readonly from: number;
  readonly to: number;
  readonly direction: "forward" | "backward";
}

/** The events of `<turnleaf-book>` by name. */
export interface TurnleafEventMap {
  /** The book is open and can be turned. */
  load: CustomEvent<{ pageCount: number; title: string }>;
  /** A leaf leaves its side, by hand or by command. */
  turnstart: CustomEvent<TurnDetail>;
  /** The book came to rest at another spread. */
  pagechange: CustomEvent<TurnDetail>;
  /** The book is bound at another edge, or shows two pages rather than one, or one rather than two. */
  layoutchange: CustomEvent<{ layout: Layout; binding: Edge }>;
  /** Pages were added, taken out or replaced. */
  pageschange: CustomEvent<{ pageCount: number }>;
  /** The book is seen from nearer or farther; `zoom` as the property is. */
  zoomchange: CustomEvent<{ zoom: number }>;
  /** Other pages are bookmarked. */
  bookmarkchange: CustomEvent<{ bookmarks: readonly number[] }>;
  /** The slide-show begins or ends. */
  playchange: CustomEvent<{ playing: boolean }>;
  /** The book could not be opened; the sentence says why. */
  error: CustomEvent<{ message: string }>;
}
