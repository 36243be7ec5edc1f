/** Which pages face each other, as indexes from 0 as page-flip counts them. */

/** The pages of a book that are in sight together, from the first spread to the last. */
export function spreadsOf(count: number, hasCover: boolean, isPortrait: boolean): number[][] {
  const spreads: number[][] = [];
  let page = 0;
  if (hasCover && count > 0) spreads.push([page++]);
  while (page < count) {
    const isPair = !isPortrait && page < count - 1;
    spreads.push(isPair ? [page, page + 1] : [page]);
    page += isPair ? 2 : 1;
  }
  return spreads;
}

/** Returns the index of the spread with a page, or -1. */
export function spreadWith(spreads: readonly number[][], page: number): number {
  return spreads.findIndex((pages) => pages.includes(page));
}

/** Returns the side on which a page lies in two-page spreads: the last one alone is the back. */
export function sideOf(spreads: readonly number[][], page: number): "left" | "right" {
  const [first, second] = spreads[spreadWith(spreads, page)] ?? [];
  if (second !== undefined) return page === first ? "left" : "right";
  return page === spreads.at(-1)?.[0] ? "left" : "right";
}

/**
 * Returns the pages of board: those that say so, and in two-page spreads those that
 * stand alone, as page-flip makes them.
 *
 * @param isHard whether each page says so
 */
export function hardPages(isHard: readonly boolean[], hasCover: boolean): ReadonlySet<number> {
  const alone = spreadsOf(isHard.length, hasCover, false)
    .filter((pages) => pages.length === 1)
    .map(([page]) => page);
  return new Set(isHard.flatMap((hard, page) => (hard || alone.includes(page) ? [page] : [])));
}

/** Returns pages as the element has them in `hard-pages`: from 1. */
export const numbersOf = (pages: ReadonlySet<number>): string =>
  [...pages].map((page) => page + 1).join();
