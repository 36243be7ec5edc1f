/** Reads on in a zoomed book: down the page or a column of it, then at the head of the next. */

import { pagesAt } from "../book/spreads.ts";
import type { Place } from "../stage/book_stage.ts";
import type { Column, InputTarget } from "./target.ts";

/** How far one step goes, as a fraction of the height in sight: lines at the edge are seen again, as where browsers scroll. */
const step = 0.875;

/** How far beyond the edge of what is in sight a page may reach and count as seen, CSS pixels. */
const tolerance = 1;

/** A view to which a zoomed book is to move: the point that comes to another. */
export interface NextView {
  readonly from: Place;
  readonly to: Place;
}

/** A book, and how much of it is in sight, CSS pixels. */
export interface ZoomedBook extends Pick<InputTarget, "viewer" | "columnsOf"> {
  readonly width: number;
  readonly height: number;
}

/** A page, and the column of it that is read; null where it is read in its full width. */
export interface ReadColumn {
  readonly page: number;
  readonly columns: readonly Column[];
  /** Its index among `columns`; -1 without columns. */
  readonly index: number;
}

/** Returns the page in the middle and the column of it that is read; null if no page is in sight. */
export function columnInSight(book: ZoomedBook): ReadColumn | null {
  const { viewer, width } = book;
  const pages = pagesAt(viewer.binding, viewer.turning.spread);
  const page = pages.reduce<number | null>((best, page) => {
    const isNearer = best === null || farFrom(book, page) < farFrom(book, best);
    return isNearer ? page : best;
  }, null);
  if (page === null) return null;
  const columns = columnsInSight(book, page);
  const away = columns.map(({ from, to }) => {
    const middle = viewer.project(page, (from + to) / 2, 0.5);
    return middle ? Math.abs(middle.x - width / 2) : Number.POSITIVE_INFINITY;
  });
  return { page, columns, index: away.indexOf(Math.min(...away)) };
}

/** Returns the columns of a page if it is wider than what is in sight, and each of them is not. */
function columnsInSight({ viewer, columnsOf, width }: ZoomedBook, page: number): readonly Column[] {
  const [left, right] = [viewer.project(page, 0, 0.5), viewer.project(page, 1, 0.5)];
  const across = left && right ? right.x - left.x : 0;
  const columns = across > width + tolerance ? columnsOf(page) : [];
  return columns.every(({ from, to }) => (to - from) * across <= width) ? columns : [];
}

/**
 * Returns where a zoomed book moves as its reader goes on (1) or back (-1): along the column or the page that
 * is in the middle, then to the head, or foot, of the next one that is open; null if a leaf has to be turned
 * for that.
 */
export function nextView(book: ZoomedBook, here: ReadColumn, by: 1 | -1): NextView | null {
  const { viewer, width, height } = book;
  const edge = viewer.project(here.page, 0, by === 1 ? 1 : 0);
  const left = edge === null ? 0 : by * (edge.y - (by === 1 ? height : 0));
  const middle = { x: width / 2, y: height / 2 };
  if (left > tolerance) {
    const far = by * Math.min(step * height, left);
    return { from: middle, to: { x: middle.x, y: middle.y - far } };
  }
  const column = here.columns[here.index + by];
  if (column) return viewOfColumn(book, here.page, column, by);
  const pages = pagesAt(viewer.binding, viewer.turning.spread);
  const next = pages[pages.indexOf(here.page) + by];
  return next === undefined
    ? null
    : viewOf(book, next, here, by, viewer.project(here.page, 0, 0)?.x);
}

/**
 * Returns the view of a page's head, for a reader who goes on (1), or of its foot (-1): of its first column,
 * or its last, if it is read in columns.
 *
 * @param before what was read before: a page of which no text is known yet is taken to have the same columns
 * @param x where the left edge of a page without columns comes; by default it stays
 */
export function viewOf(
  book: ZoomedBook,
  page: number,
  before: ReadColumn | null,
  by: 1 | -1,
  x: number | undefined,
): NextView | null {
  const own = columnsInSight(book, page);
  const columns = own.length > 0 ? own : (before?.columns ?? []);
  const column = columns.at(by === 1 ? 0 : -1);
  if (column) return viewOfColumn(book, page, column, by);
  const from = book.viewer.project(page, 0, by === 1 ? 0 : 1);
  return from && { from, to: { x: x ?? from.x, y: by === 1 ? 0 : book.height } };
}

/** Returns the view of the head (1) or the foot (-1) of a column, which comes into the middle. */
function viewOfColumn(
  { viewer, width, height }: ZoomedBook,
  page: number,
  { from, to }: Column,
  by: 1 | -1,
): NextView | null {
  const place = viewer.project(page, (from + to) / 2, by === 1 ? 0 : 1);
  return place && { from: place, to: { x: width / 2, y: by === 1 ? 0 : height } };
}

/** Returns how far a page is from the middle, across. */
function farFrom({ viewer, width }: ZoomedBook, page: number): number {
  const [left, right] = [viewer.project(page, 0, 0.5), viewer.project(page, 1, 0.5)];
  if (!left || !right) return Number.POSITIVE_INFINITY;
  return Math.max(left.x - width / 2, width / 2 - right.x);
}
