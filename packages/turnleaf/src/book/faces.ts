/** Which page is printed on which face of what is drawn. */

import { type Binding, leafCount, leftPage, rightPage } from "./spreads.ts";

/** The faces of the drawn book that carry a page, but for those of leaves in flight. */
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

/** Whether a face is one of a cover board. */
export function isBoardFace(face: Face): boolean {
  return face.startsWith("front") || face.startsWith("back");
}

/** What lies between two spreads: a leaf, or a sheaf that flies as one. */
export interface Between {
  /** The spread seen when it lies on the right, and on the left. */
  readonly low: number;
  readonly high: number;
}

/**
 * The page (from 1) on each face while what is in flight is between the spreads
 * `low` and `high`, or at rest where the two are the same.
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
    frontOutside: board ? rightPage(binding, 0) : null,
    frontInside: board ? leftPage(binding, 1) : null,
    backInside: board ? rightPage(binding, last - 1) : null,
    backOutside: board ? leftPage(binding, last) : null,
  };
}

/** The face on which a page (from 1) is seen while the book rests at a spread; null where it does not lie open. */
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

/** The pages on both sides of a leaf in flight; a sheaf shows its first and its last. */
export function facesOfLeaf(
  binding: Binding,
  { low, high }: Between,
): { recto: number | null; verso: number | null } {
  return { recto: rightPage(binding, low), verso: leftPage(binding, high) };
}

/** Pages to have ready, most urgent first. */
export interface PagesWanted {
  readonly pages: readonly number[];
  /** How many of the first are seen now, and how many of those lie open rather than fly. */
  readonly inSight: number;
  readonly lyingOpen: number;
}

/**
 * The pages to have ready at a spread where some leaves are in flight, told
 * from the left to the right: what is seen, then what `to` shows, where the book
 * will come to rest, what the next turns in either direction would show, and
 * the boards' outsides.
 */
export function pagesWanted(
  binding: Binding,
  spread: number,
  flights: readonly Between[],
  to: number,
): PagesWanted {
  const last = leafCount(binding);
  const low = flights[0]?.low ?? spread;
  const high = flights.at(-1)?.high ?? spread;
  const faces = [rightPage(binding, high), leftPage(binding, low)];
  const boards = facesBetween(binding, low, high);
  if (low === 0) faces.push(boards.frontInside);
  if (high === last) faces.push(boards.backInside);
  const lyingOpen = existing(faces);
  // Of the leaves in flight those first that will be seen longest.
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
