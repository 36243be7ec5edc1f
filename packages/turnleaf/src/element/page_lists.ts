/** The lists of an element that name pages of its book, and follow these when they lie elsewhere. */

import type { DogEar } from "../book/dog_ears.ts";
import { pagesNamed } from "../book/layout.ts";
import { readStocks } from "../book/leaf_stocks.ts";
import { type LayoutLists, movedLayout, movedPages, type PageMove } from "../book/moved_lists.ts";
import type { PageFold } from "../book/page_folds.ts";
import { cleanDogEars, cleanFolds } from "./fold_lists.ts";
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

/** Returns those of lists by which the book is laid out. */
export function layoutLists({ shifts, hardPages, stocks }: PageLists): LayoutLists {
  return { shifts, hardPages, stocks };
}

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

/**
 * Returns what lists say of some pages (from 1), each named by its place among these, from 1. Of a
 * range that goes on beyond them it is these pages alone.
 *
 * @param pageCount of the book
 */
export function listsAmong(
  lists: PageLists,
  pages: readonly number[],
  pageCount: number,
): PageLists {
  const among = (list: string): string =>
    pagesNamed(list, pageCount)
      .filter((page) => pages.includes(page))
      .join(",");
  const stocks = readStocks(lists.stocks).entries.flatMap(([stock, list]) => {
    const named = among(list);
    return named === "" ? [] : [`${stock} ${named}`];
  });
  const place: PageMove = (index) => {
    const at = pages.indexOf(index + 1);
    return at < 0 ? null : at;
  };
  const own = { ...lists, hardPages: among(lists.hardPages), stocks: stocks.join(", ") };
  return movedLists(own, place, pageCount);
}

/** Returns lists that say what two say. */
export function joinedLists(one: PageLists, other: PageLists): PageLists {
  return {
    ...one,
    bookmarks: cleanPages([...one.bookmarks, ...other.bookmarks]),
    dogEars: cleanDogEars([...one.dogEars, ...other.dogEars]),
    folds: cleanFolds([...one.folds, ...other.folds]),
    shifts: cleanPages([...one.shifts, ...other.shifts]),
    hardPages: [one.hardPages, other.hardPages].filter(Boolean).join(","),
    stocks: [one.stocks, other.stocks].filter(Boolean).join(", "),
  };
}
