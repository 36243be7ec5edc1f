/** Folds of pages, as creases of the leaves. */

import type { Crease } from "../engine/shapes.ts";
import { type DogEar, foldedDegrees } from "./dog_ears.ts";
import type { PageFold, PagePlace } from "./page_folds.ts";
import { type Binding, isBoard, leafOf, paperOnLeft, rightPage } from "./spreads.ts";

/** A fold of a page: a corner, or along any line; folded, or opened again, which leaves a line. */
export type Fold = (DogEar | PageFold) & { readonly isOpened?: boolean };

/**
 * Part of its angle at which a fold rests that was opened again. Smoothed by a finger, a corner
 * is as far from flat as it was from folded shut.
 */
const openedPart = (180 - foldedDegrees) / foldedDegrees;

/**
 * Returns the creases of folds, by their leaves of paper, counted from 0 at the front. A page
 * that is not of paper, or not of this book, has none; a corner and a line have one: the last.
 *
 * @param shape a page's width and height, in one unit
 */
export function creasesOf(
  folds: readonly Fold[],
  binding: Binding,
  shape: { readonly width: number; readonly height: number },
): Map<number, Crease[]> {
  const creases = new Map<number, Map<string, Crease>>();
  for (const fold of folds) {
    // Beyond the last page leaves of a book from right to left carry others.
    if (fold.page > binding.pageCount) continue;
    const leaf = leafOf(binding, fold.page);
    if (isBoard(binding, leaf)) continue;
    const isRecto = rightPage(binding, leaf) === fold.page;
    const isCorner = "corner" in fold;
    const through = isCorner ? throughCorner(fold, shape) : throughPage(fold, binding, isRecto);
    const degrees = (isCorner ? foldedDegrees : fold.angle) * (fold.isOpened ? openedPart : 1);
    const rest = ((isRecto ? degrees : -degrees) / 180) * Math.PI;
    const paper = paperOnLeft(binding, leaf);
    const own = creases.get(paper) ?? new Map<string, Crease>();
    own.set(isCorner ? fold.corner : through.join(), { through, rest });
    creases.set(paper, own);
  }
  return new Map([...creases].map(([leaf, own]) => [leaf, [...own.values()]]));
}

/** Returns two places on the crease of a corner: it meets both edges at 45 degrees. */
function throughCorner(
  { corner, size }: DogEar,
  { width, height }: { readonly width: number; readonly height: number },
): Crease["through"] {
  const up = Math.min((size * width) / height, 0.5);
  return corner === "foot" ? [1 - size, 0, 1, up] : [1 - size, 1, 1, 1 - up];
}

/** Returns two places on the crease of a fold: from the spine outward, and from the foot to the head. */
function throughPage(
  { from, to }: PageFold,
  binding: Binding,
  isRecto: boolean,
): Crease["through"] {
  const place = (at: PagePlace) => placeOnLeaf(at, binding.quarterTurned, isRecto);
  return [...place(from), ...place(to)];
}

/** Returns u and v on a leaf of a place on one of its pages. */
export function placeOnLeaf(
  { x, y }: PagePlace,
  quarterTurned: boolean,
  isRecto: boolean,
): [u: number, v: number] {
  const [across, down] = quarterTurned ? [y, 1 - x] : [x, y];
  return [isRecto ? across : 1 - across, 1 - down];
}
