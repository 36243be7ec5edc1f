/** Lists of folded corners, as pages and storage give them. */

import { type DogEar, dogEarSize } from "../book/dog_ears.ts";
import { isPage } from "./page_numbers.ts";

const mostListed = 500;

/**
 * Returns the valid ones of a list of folded corners: at most one a page, the last, in the order
 * of the pages, at most 500.
 */
export function cleanDogEars(value: unknown): readonly DogEar[] {
  if (!Array.isArray(value)) return [];
  const ears = new Map<number, DogEar>();
  for (const one of value.slice(0, 10_000) as (Partial<DogEar> | null | undefined)[]) {
    const { page, corner, size } = one ?? {};
    if (!isPage(page) || (corner !== "head" && corner !== "foot")) continue;
    ears.set(page, { page, corner, size: dogEarSize(size) });
  }
  return [...ears.values()].sort((a, b) => a.page - b.page).slice(0, mostListed);
}

/** Returns folded corners with one, as is usual, for each of some pages that has none. */
export function withDogEars(ears: readonly DogEar[], pages: readonly number[]): readonly DogEar[] {
  const folded = new Map(ears.map((ear) => [ear.page, ear]));
  const usual = pages.map((page) => ({ page, corner: "head", size: dogEarSize(undefined) }));
  return cleanDogEars([...usual.filter(({ page }) => !folded.has(page)), ...ears]);
}
