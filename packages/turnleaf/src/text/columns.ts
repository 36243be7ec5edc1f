/** Finds the columns in which a page's text is set. */

import type { PageSize, TextRun } from "../sources/page_source.ts";

/** Fraction of the width of all text up to which a column is one of several: two with a gutter take less than half each. */
const widest = 0.6;

/** Pieces of lines of a page at which columns are looked for, and the fraction of them that stand in a column. */
const mostLooked = 64;
const leastPart = 1 / 8;

/** Where something begins and ends across a page, in the unit of its runs. */
interface Extent {
  readonly from: number;
  readonly to: number;
}

/** A piece of a line that no gap as wide as a letter is high divides. */
interface LinePiece extends Extent {
  readonly top: number;
  readonly bottom: number;
}

/**
 * Returns where the column of text at a place begins and ends, as fractions of the page's width; null if
 * the text there is in one column.
 *
 * @param at fractions of the page from its upper left corner
 */
export function columnAt(
  runs: readonly TextRun[],
  size: PageSize,
  at: { readonly x: number; readonly y: number },
): Extent | null {
  const pieces = piecesOf(runs);
  const [x, y] = [at.x * size.width, at.y * size.height];
  const far = (piece: LinePiece): number =>
    Math.hypot(outside(x, piece.from, piece.to), outside(y, piece.top, piece.bottom));
  const [nearest] = [...pieces].sort((a, b) => far(a) - far(b));
  return nearest === undefined ? null : columnOf(nearest, pieces, size);
}

/**
 * Returns where the columns of a page's text begin and end, from left to right, as fractions of its width;
 * none if it is in one.
 */
export function columnsOf(runs: readonly TextRun[], size: PageSize): readonly Extent[] {
  const pieces = piecesOf(runs);
  const every = Math.ceil(pieces.length / mostLooked);
  const looked = pieces.filter((_, k) => k % every === 0);
  /** Columns that were found, each with those that overlap it. */
  const groups: Extent[][] = [];
  for (const piece of looked) {
    const column = columnOf(piece, pieces, size);
    if (!column) continue;
    const group = groups.find(([first]) => first && overlap(first, column) > 0);
    if (group) group.push(column);
    else groups.push([column]);
  }
  const columns = groups
    .filter(({ length }) => length >= leastPart * looked.length)
    .map((group) => group.sort((a, b) => width(a) - width(b))[group.length >> 1] as Extent);
  return columns.length > 1 ? columns.sort((a, b) => a.from - b.from) : [];
}

/** Returns the column in which a piece of a line stands; null if it is the only one there. */
function columnOf(nearest: LinePiece, pieces: readonly LinePiece[], size: PageSize): Extent | null {
  const along = pieces.filter((piece) => overlap(piece, nearest) > 0);
  // Headings and last lines are wider and narrower than most.
  const column = along.sort((a, b) => width(a) - width(b))[along.length >> 1] as LinePiece;
  const from = Math.min(...pieces.map((piece) => piece.from));
  const to = Math.max(...pieces.map((piece) => piece.to));
  if (width(column) > widest * (to - from)) return null;
  return { from: column.from / size.width, to: column.to / size.width };
}

/** Joins level runs that stand beside each other on one line. */
function piecesOf(runs: readonly TextRun[]): LinePiece[] {
  const pieces: LinePiece[] = [];
  const sorted = runs
    .filter(({ angle, vertical, text }) => angle === 0 && !vertical && text.trim() !== "")
    .sort((a, b) => a.y - b.y || a.x - b.x);
  for (const { x, y, width, height } of sorted) {
    const index = pieces.findLastIndex(
      (piece) =>
        Math.min(piece.bottom, y + height) - Math.max(piece.top, y) > height / 2 &&
        outside(x, piece.from, piece.to) < height &&
        x >= piece.from,
    );
    const before = pieces[index];
    if (before) pieces[index] = { ...before, to: Math.max(before.to, x + width) };
    else pieces.push({ from: x, to: x + width, top: y, bottom: y + height });
  }
  return pieces;
}

const width = ({ from, to }: Extent): number => to - from;

const overlap = (a: Extent, b: Extent): number => Math.min(a.to, b.to) - Math.max(a.from, b.from);

/** Returns how far a number lies outside a range. */
const outside = (at: number, from: number, to: number): number => Math.max(from - at, at - to, 0);
