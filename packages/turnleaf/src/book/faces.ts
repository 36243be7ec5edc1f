/** Maps pages to the faces of the drawn book. */

import { type Between, outermost } from "./leaf_order.ts";
import { type Binding, leafCount, leftPage, rightPage } from "./spreads.ts";

/** The faces of the drawn book that carry a page, except those of leaves in flight. */
export const faceNames = [
  "left",
  "right",
  "frontOutside",
  "frontInside",
  "backOutside",
  "backInside",
] as const;

/** A face of the drawn book. */
export type Face = (typeof faceNames)[number];

/** Returns whether a face belongs to a cover board. */
export function isBoardFace(face: Face): boolean {
  return face.startsWith("front") || face.startsWith("back");
}

/**
 * Returns the page (from 1) on each face while the leaves in flight are between
 * the spreads `low` and `high`. At rest the two are equal.
 */
export function facesBetween(
  binding: Binding,
  { low, high }: Between,
): Record<Face, number | null> {
  const last = leafCount(binding);
  const board = binding.hardCover;
  return {
    left: leftPage(binding, low),
    right: rightPage(binding, high),
    frontOutside: board ? rightPage(binding, 0) : null,
    frontInside: board ? leftPage(binding, 1) : null,
    backInside: board ? rightPage(binding, last - 1) : null,
    backOutside: board ? leftPage(binding, last) : null,
  };
}

/**
 * Returns the face that shows a page (from 1) while the book rests at a spread,
 * or null if the page does not lie open.
 */
export function faceOf(binding: Binding, spread: number, page: number): Face | null {
  const last = leafCount(binding);
  const { hardCover } = binding;
  if (page === rightPage(binding, spread)) {
    if (hardCover && spread === 0) return "frontOutside";
    return hardCover && spread === last - 1 ? "backInside" : "right";
  }
  if (page !== leftPage(binding, spread)) return null;
  if (hardCover && spread === last) return "backOutside";
  return hardCover && spread === 1 ? "frontInside" : "left";
}

/**
 * Returns the pages on both sides of a leaf in flight; for a sheaf, its first
 * and its last page.
 */
export function facesOfLeaf(
  binding: Binding,
  { low, high }: Between,
): { recto: number | null; verso: number | null } {
  return { recto: rightPage(binding, low), verso: leftPage(binding, high) };
}

/** Pages to have ready, most urgent first. */
export interface PagesWanted {
  readonly pages: readonly number[];
  /** How many of the first are visible now, and how many of those lie open rather than fly. */
  readonly inSight: number;
  readonly lyingOpen: number;
}

/**
 * Returns the pages to have ready at a spread while some leaves are in flight,
 * given from left to right. First come the visible pages, then those of the
 * spread `to` where the book will come to rest, then those that the next turns
 * in either direction would show, and last the outsides of the boards.
 */
export function pagesWanted(
  binding: Binding,
  spread: number,
  flights: readonly Between[],
  to: number,
): PagesWanted {
  const last = leafCount(binding);
  const outside = outermost(flights, spread);
  const { low, high } = outside;
  const faces = [rightPage(binding, high), leftPage(binding, low)];
  const boards = facesBetween(binding, outside);
  if (low === 0) faces.push(boards.frontInside);
  if (high === last) faces.push(boards.backInside);
  const lyingOpen = existing(faces);
  // Leaves in flight that stay visible longest come first.
  const toGo = (flight: Between): number =>
    Math.min(Math.abs(flight.low - to), Math.abs(flight.high - to));
  for (const flight of [...flights].sort((a, b) => toGo(a) - toGo(b))) {
    const { recto, verso } = facesOfLeaf(binding, flight);
    faces.push(verso, recto);
  }
  const inSight = existing(faces);
  // The next turn, the one back, and the one after the next.
  const nexts = binding.reversed ? [low - 1, high + 1, low - 2] : [high + 1, low - 1, high + 2];
  for (const s of [to, ...nexts]) {
    faces.push(leftPage(binding, s), rightPage(binding, s));
  }
  if (low <= 1) faces.push(boards.frontOutside, boards.frontInside);
  if (high >= last - 1) faces.push(boards.backInside, boards.backOutside);
  return { pages: existing(faces), inSight: inSight.length, lyingOpen: lyingOpen.length };
}

function existing(pages: readonly (number | null)[]): number[] {
  return [...new Set(pages)].filter((page): page is number => page !== null);
}
