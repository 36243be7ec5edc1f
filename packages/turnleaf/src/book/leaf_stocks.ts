/** Which leaves of a book are of a stock of their own: card covers, boards, plates. */

import { type LeafStockName, leafStockNames } from "../engine/shapes.ts";
import { presetStocks } from "../stocks.ts";
import { pagesNamed } from "./layout.ts";
import { type Binding, isBoard, leafOf, paperLeaves } from "./spreads.ts";

/** Leaves of paper (from `first` to before `end`, boards of a cover not counted) of one stock. */
export interface StockRun {
  readonly first: number;
  readonly end: number;
  readonly stock: LeafStockName;
}

/** Maximum of entries read from a list of stocks. */
const mostEntries = 1000;

/** Pages of a stock, as a list of pages. */
type Entry = readonly [stock: LeafStockName, pages: string];

/**
 * Reads a list of stocks and their pages (from 1), such as "card 1-2, coated 17-24, 30".
 * Numbers without a stock are of the stock before them.
 *
 * Invalid entries are ignored; `errors` has a sentence on each.
 */
export function readStocks(list: string): { readonly entries: Entry[]; readonly errors: string[] } {
  const entries: Entry[] = [];
  const errors: string[] = [];
  let stock: LeafStockName | undefined;
  for (const part of list.split(",", mostEntries)) {
    if (part.trim() === "") continue;
    const [, name, pages] = /^([a-z-]*)\s*(\d+(?:\s*-\s*\d+)?)$/i.exec(part.trim()) ?? [];
    if (name) stock = leafStockNames.find((known) => known === name);
    if (pages !== undefined && stock !== undefined) entries.push([stock, pages]);
    else {
      const known = leafStockNames.join(", ");
      errors.push(
        `${JSON.stringify(part.trim())} is not a stock (${known}) and its pages, such as "card 1-2"; it is ignored.`,
      );
    }
  }
  return { entries, errors };
}

/**
 * Returns the leaves of a binding that are not of the book's own stock, from the first to
 * the last: a soft cover's are card, those of `hard-pages` board, others as `list` says
 * (see `readStocks`). A leaf whose two pages are of different stocks is of the one named
 * last. The boards of a hard cover are boards.
 */
export function stockRuns(binding: Binding, list: string): StockRun[] {
  const stocks = new Map<number, LeafStockName>();
  if (binding.softCover) for (const k of [0, binding.leaves - 1]) stocks.set(k, "card");
  for (const k of binding.hardLeaves) stocks.set(k, "board");
  for (const [stock, pages] of readStocks(list).entries) {
    for (const page of pagesNamed(pages, binding.pageCount)) {
      stocks.set(leafOf(binding, page), stock);
    }
  }
  const before = binding.hardCover ? 1 : 0;
  const runs: { first: number; end: number; stock: LeafStockName }[] = [];
  for (const [k, stock] of [...stocks].sort(([a], [b]) => a - b)) {
    if (isBoard(binding, k)) continue;
    const leaf = k - before;
    const last = runs.at(-1);
    if (last?.end === leaf && last.stock === stock) last.end++;
    else runs.push({ first: leaf, end: leaf + 1, stock });
  }
  return runs;
}

/** Thickness at which a leaf of paper counts in the book's, metres: it is thinner. One of board counts as it is. */
const paperThickness = 0.0004;

/** Maximum of a book's thickness, metres. */
const thickest = 0.024;

/**
 * Returns the thickness of a book, metres: thicker than its paper would be, so
 * that progress through it is visible, but bounded.
 */
export function bookThickness(binding: Binding, runs: readonly StockRun[]): number {
  let sum = paperThickness * paperLeaves(binding);
  for (const { first, end, stock } of runs) {
    if (stock === "board") sum += (end - first) * (presetStocks.board.caliper - paperThickness);
  }
  return thickest * (1 - Math.exp(-sum / thickest));
}
