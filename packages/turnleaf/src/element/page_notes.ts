/** What the lists of an element say of single pages: kept while these are out of the book. */

import { pagesNamed } from "../book/layout.ts";
import { readStocks } from "../book/leaf_stocks.ts";
import { cleanDogEars, cleanFolds } from "./fold_lists.ts";
import type { PageLists } from "./page_lists.ts";
import { cleanPages } from "./page_numbers.ts";

/** Returns the numbers (from 1) of indices (from 0). */
export function numbersOf(indices: readonly (number | null)[]): (number | null)[] {
  return indices.map((index) => (index === null ? null : index + 1));
}

/** What lists say of single pages: of each, its place (from 0) among them. */
export interface PageNotes {
  readonly bookmarks: readonly number[];
  readonly shifts: readonly number[];
  readonly hardPages: readonly number[];
  /** Folded corners and folds, in the order of the lists; the page of each is its place, from 1. */
  readonly dogEars: PageLists["dogEars"];
  readonly folds: PageLists["folds"];
  /** In the order of the list. */
  readonly stocks: readonly (readonly [stock: string, place: number])[];
}

/** Returns what lists say of some pages (from 1) of a book of `pageCount`. */
export function notesOf(lists: PageLists, pages: readonly number[], pageCount: number): PageNotes {
  const among = (list: readonly number[]): number[] =>
    [...pages.keys()].filter((place) => list.includes(pages[place]));
  const follow = <Of extends { readonly page: number }>(list: readonly Of[]): Of[] =>
    list.flatMap((one) => {
      const place = pages.indexOf(one.page);
      return place < 0 ? [] : [{ ...one, page: place + 1 }];
    });
  return {
    bookmarks: among(lists.bookmarks),
    dogEars: follow(lists.dogEars),
    folds: follow(lists.folds),
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
  const follow = <Of extends { readonly page: number }>(list: readonly Of[]): Of[] =>
    list.flatMap((one) => at([one.page - 1]).map((page) => ({ ...one, page })));
  const stocks = notes.stocks.flatMap(([stock, place]) => at([place]).map((p) => `${stock} ${p}`));
  return {
    ...lists,
    bookmarks: cleanPages([...lists.bookmarks, ...at(notes.bookmarks)]),
    dogEars: cleanDogEars([...lists.dogEars, ...follow(notes.dogEars)]),
    folds: cleanFolds([...lists.folds, ...follow(notes.folds)]),
    shifts: cleanPages([...lists.shifts, ...at(notes.shifts)]),
    hardPages: [lists.hardPages, ...at(notes.hardPages)].filter(Boolean).join(","),
    stocks: [lists.stocks, ...stocks].filter(Boolean).join(", "),
  };
}
