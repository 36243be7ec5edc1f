/** What lists of pages name once the pages lie elsewhere. */

import { type LayoutOptions, rangesIn } from "./layout.ts";
import { readStocks } from "./leaf_stocks.ts";

/** Returns where a page (from 0) lies after a change of the pages; null if it lies nowhere. */
export type PageMove = (index: number) => number | null;

/** The options of a layout that name pages. */
export type LayoutLists = Pick<LayoutOptions, "shifts" | "hardPages" | "stocks">;

/** Returns the numbers (from 1) that pages have now, without those of pages that lie nowhere. */
export function movedPages(pages: readonly number[], move: PageMove): number[] {
  return pages.flatMap((page) => {
    const index = move(page - 1);
    return index === null ? [] : [index + 1];
  });
}

/**
 * Returns a list such as "1-2,9" of the same pages. A range goes on to the same page, also over
 * pages that have come into it; one that reached beyond the last page still does.
 *
 * @param pageCount of the book before
 */
export function movedRanges(list: string, move: PageMove, pageCount: number): string {
  return rangesIn(list)
    .flatMap(([from, to]) => movedRange(from, to, move, pageCount) ?? [])
    .join(",");
}

/** Returns options of a layout that name the same pages; the ranges as `movedRanges` does. */
export function movedLayout<Options extends LayoutLists>(
  options: Options,
  move: PageMove,
  pageCount: number,
): Options {
  const { shifts, hardPages, stocks } = options;
  const movedStocks = readStocks(stocks).entries.flatMap(([stock, pages]) => {
    const moved = movedRanges(pages, move, pageCount);
    return moved === "" ? [] : [`${stock} ${moved}`];
  });
  return {
    ...options,
    shifts: movedPages(shifts, move),
    hardPages: movedRanges(hardPages, move, pageCount),
    stocks: movedStocks.join(", "),
  };
}

function movedRange(from: number, to: number, move: PageMove, pageCount: number): string | null {
  if (from > pageCount) return rangeText(from, to);
  let [first, last] = [Number.POSITIVE_INFINITY, 0];
  for (let page = from; page <= Math.min(to, pageCount); page++) {
    const index = move(page - 1);
    if (index === null) continue;
    first = Math.min(first, index + 1);
    last = Math.max(last, index + 1);
  }
  const isOpen = to > pageCount;
  if (last === 0) return isOpen ? rangeText(from, to) : null;
  return rangeText(first, isOpen ? Math.max(last, to) : last);
}

const rangeText = (from: number, to: number): string => (from === to ? `${from}` : `${from}-${to}`);
