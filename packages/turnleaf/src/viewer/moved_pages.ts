/** The pages of a book after a change, as its viewer binds them. */

import type { Fold } from "../book/creases.ts";
import type { LayoutLists } from "../book/moved_lists.ts";
import type { NewIndex } from "../sources/page_source.ts";

/** Pages that lie elsewhere now, and what names them. */
export interface MovedPages {
  readonly moved: NewIndex;
  /** The options of the layout that name pages, by their numbers of now. */
  readonly lists: LayoutLists;
  /** The folds of pages, likewise. */
  readonly folds: readonly Fold[];
}

/** What a book is after pages were taken out. */
export interface TakenPages extends MovedPages {
  /** The number of the sheet with the pages that are out, by which `SheetCommands.remove` knows it. */
  readonly id: number;
}
