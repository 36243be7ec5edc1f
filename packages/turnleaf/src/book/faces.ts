/** Which page is printed on which face of what is drawn. */

import { type Binding, leafCount, leftPage, rightPage } from "./spreads.ts";

/** The faces of the drawn book that carry a page. */
export const faceNames = [
  "left",
  "right",
  "recto",
  "verso",
  "frontOutside",
  "frontInside",
  "backOutside",
  "backInside",
] as const;

/** A face of the drawn book. */
export type Face = (typeof faceNames)[number];

/** Whether a face is one of a cover board. */
export function isBoardFace(face: Face): boolean {
  return face.startsWith("front") || face.startsWith("back");
}

/**
 * The page (from 1) on each face while a leaf or board is between the spreads
 * `low` and `high`, or at rest where the two are the same. A leaf that stands
 * for a whole sheaf carries the page seen first and the page seen last.
 */
export function facesBetween(
  binding: Binding,
  low: number,
  high: number,
): Record<Face, number | null> {
  const last = leafCount(binding);
  const board = binding.hardCover;
  return {
    left: leftPage(binding, low),
    right: rightPage(binding, high),
    recto: rightPage(binding, low),
    verso: leftPage(binding, high),
    frontOutside: board ? rightPage(binding, 0) : null,
    frontInside: board ? leftPage(binding, 1) : null,
    backInside: board ? rightPage(binding, last - 1) : null,
    backOutside: board ? leftPage(binding, last) : null,
  };
}

/** Pages to have ready, most urgent first. */
export interface PagesWanted {
  readonly pages: readonly number[];
  /** How many of the first are seen now. */
  readonly inSight: number;
}

/**
 * The pages to have ready between two spreads: what is seen, then what the next
 * turns in either direction would show, then the boards' outsides.
 */
export function pagesWanted(binding: Binding, low: number, high: number): PagesWanted {
  const seen = facesBetween(binding, low, high);
  const faces = [seen.right, seen.left, seen.recto, seen.verso];
  if (low === 0) faces.push(seen.frontInside);
  if (high === leafCount(binding)) faces.push(seen.backInside);
  const inSight = existing(faces);
  for (const s of [high + 1, low - 1, high + 2]) {
    faces.push(leftPage(binding, s), rightPage(binding, s));
  }
  if (low <= 1) faces.push(seen.frontOutside, seen.frontInside);
  if (high >= leafCount(binding) - 1) faces.push(seen.backInside, seen.backOutside);
  return { pages: existing(faces), inSight: inSight.length };
}

function existing(pages: readonly (number | null)[]): number[] {
  return [...new Set(pages)].filter((page): page is number => page !== null);
}
