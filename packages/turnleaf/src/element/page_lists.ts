/** The lists of an element that name pages of its book, and follow these when they lie elsewhere. */

import type { DogEar } from "../book/dog_ears.ts";
import { type LayoutLists, movedLayout, movedPages, type PageMove } from "../book/moved_lists.ts";
import type { PageFold } from "../book/page_folds.ts";
import { cleanDogEars } from "./fold_lists.ts";
import { cleanPages } from "./page_numbers.ts";

/** All lists, as they name the pages of the open book. Each is replaced, never changed. */
export interface PageLists extends LayoutLists {
  readonly bookmarks: readonly number[];
  readonly dogEars: readonly DogEar[];
  readonly folds: readonly PageFold[];
}

/** The lists of a book without any. */
export const emptyLists: PageLists = {
  bookmarks: [],
  dogEars: [],
  folds: [],
  shifts: [],
  hardPages: "",
  stocks: "",
};

/**
 * Returns lists of the same pages.
 *
 * @param pageCount of the book before
 */
export function movedLists(lists: PageLists, move: PageMove, pageCount: number): PageLists {
  const follow = <Of extends { readonly page: number }>(list: readonly Of[]): Of[] =>
    list.flatMap((one) => movedPages([one.page], move).map((page) => ({ ...one, page })));
  return {
    ...movedLayout(lists, move, pageCount),
    bookmarks: cleanPages(movedPages(lists.bookmarks, move)),
    dogEars: cleanDogEars(follow(lists.dogEars)),
    folds: follow(lists.folds),
  };
}
