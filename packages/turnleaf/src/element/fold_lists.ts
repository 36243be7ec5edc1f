/** Lists of folded corners and of folds, as pages and storage give them. */

import { type DogEar, dogEarSize } from "../book/dog_ears.ts";
import type { PageFold, PagePlace } from "../book/page_folds.ts";
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

/**
 * Returns the valid ones of a list of folds: of the same line the last, in the order of the
 * list, at most 500.
 */
export function cleanFolds(value: unknown): readonly PageFold[] {
  if (!Array.isArray(value)) return [];
  const folds = new Map<string, PageFold>();
  for (const one of value.slice(0, 10_000) as (Partial<PageFold> | null | undefined)[]) {
    const { page, angle } = one ?? {};
    const [from, to] = [one?.from, one?.to].map(placeOf);
    const isAngle = typeof angle === "number" && Math.abs(angle) <= 180;
    if (!isPage(page) || !isAngle || from === null || to === null) continue;
    if (from.x === to.x && from.y === to.y) continue;
    const line = [page, from.x, from.y, to.x, to.y].join();
    folds.delete(line);
    if (angle !== 0) folds.set(line, { page, from, to, angle });
  }
  return [...folds.values()].slice(0, mostListed);
}

/** Returns a value that is a place on a page as one; null if it is none. */
export function placeOf(value: Partial<PagePlace> | null | undefined): PagePlace | null {
  const { x, y } = value ?? {};
  return isPart(x) && isPart(y) ? { x, y } : null;
}

const isPart = (value: unknown): value is number =>
  typeof value === "number" && value >= 0 && value <= 1;
