/** The lists of an element that name pages of its book, and follow these when they lie elsewhere. */

import type { DogEar } from "../book/dog_ears.ts";
import { pagesNamed } from "../book/layout.ts";
import { readStocks } from "../book/leaf_stocks.ts";
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

/** Returns the numbers (from 1) of indices (from 0). */
export function numbersOf(indices: readonly (number | null)[]): (number | null)[] {
  return indices.map((index) => (index === null ? null : index + 1));
}

/** What lists say of single pages: of each, its place (from 0) among them. */
export interface PageNotes {
  readonly bookmarks: readonly number[];
  readonly shifts: readonly number[];
  readonly hardPages: readonly number[];
  /** In the order of the list. */
  readonly stocks: readonly (readonly [stock: string, place: number])[];
}

/** Returns what lists say of some pages (from 1) of a book of `pageCount`. */
export function notesOf(lists: PageLists, pages: readonly number[], pageCount: number): PageNotes {
  const among = (list: readonly number[]): number[] =>
    [...pages.keys()].filter((place) => list.includes(pages[place]));
  return {
    bookmarks: among(lists.bookmarks),
    shifts: among(lists.shifts),
    hardPages: among(pagesNamed(lists.hardPages, pageCount)),
    stocks: readStocks(lists.stocks).entries.flatMap(([stock, named]) =>
      among(pagesNamed(named, pageCount)).map((place) => [stock, place] as const),
    ),
  };
}

/**
 * Returns lists that say of pages what notes say.
 *
 * @param pages the number (from 1) of each page of the notes; null for one that is not there
 */
export function withNotes(
  lists: PageLists,
  notes: PageNotes,
  pages: readonly (number | null)[],
): PageLists {
  const at = (places: readonly number[]): number[] => places.flatMap((place) => pages[place] ?? []);
  const stocks = notes.stocks.flatMap(([stock, place]) => at([place]).map((p) => `${stock} ${p}`));
  return {
    ...lists,
    bookmarks: cleanPages([...lists.bookmarks, ...at(notes.bookmarks)]),
    shifts: cleanPages([...lists.shifts, ...at(notes.shifts)]),
    hardPages: [lists.hardPages, ...at(notes.hardPages)].filter(Boolean).join(","),
    stocks: [lists.stocks, ...stocks].filter(Boolean).join(", "),
  };
}
