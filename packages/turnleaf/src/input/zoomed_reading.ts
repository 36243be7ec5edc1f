/** Reads on in a zoomed book: down the page, then at the head of the next. */

import { pagesAt } from "../book/spreads.ts";
import type { Place } from "../stage/book_stage.ts";
import type { Viewer } from "../viewer/viewer.ts";

/** How far one step goes, as a fraction of the height in sight: lines at the edge are seen again, as where browsers scroll. */
const step = 0.875;

/** How far beyond the edge of what is in sight a page may reach and count as seen, CSS pixels. */
const tolerance = 1;

/** A view to which a zoomed book is to move: the point that comes to another. */
export interface NextView {
  readonly from: Place;
  readonly to: Place;
}

/**
 * Returns where a zoomed book moves as its reader goes on (1) or back (-1): along the page that is in the
 * middle, then to the head, or foot, of the next one beside it; null if a leaf has to be turned for that.
 *
 * @param width,height of what is in sight, CSS pixels
 */
export function nextView(
  viewer: Viewer,
  by: 1 | -1,
  width: number,
  height: number,
): NextView | null {
  const pages = pagesAt(viewer.binding, viewer.turning.spread);
  const here = pages.reduce<number | null>((best, page) => {
    const isNearer = best === null || farFrom(viewer, page, width) < farFrom(viewer, best, width);
    return isNearer ? page : best;
  }, null);
  if (here === null) return null;
  const edge = viewer.project(here, 0, by === 1 ? 1 : 0);
  const left = edge === null ? 0 : by * (edge.y - (by === 1 ? height : 0));
  const middle = { x: width / 2, y: height / 2 };
  if (left > tolerance) {
    const far = by * Math.min(step * height, left);
    return { from: middle, to: { x: middle.x, y: middle.y - far } };
  }
  const next = pages[pages.indexOf(here) + by];
  return next === undefined
    ? null
    : viewOf(viewer, next, by, viewer.project(here, 0, 0)?.x, height);
}

/**
 * Returns the view of a page's head, for a reader who goes on (1), or of its foot (-1).
 *
 * @param x where its left edge comes; by default it stays
 */
export function viewOf(
  viewer: Viewer,
  page: number,
  by: 1 | -1,
  x: number | undefined,
  height: number,
): NextView | null {
  const from = viewer.project(page, 0, by === 1 ? 0 : 1);
  return from && { from, to: { x: x ?? from.x, y: by === 1 ? 0 : height } };
}

/** Returns how far a page is from the middle, across. */
function farFrom(viewer: Viewer, page: number, width: number): number {
  const [left, right] = [viewer.project(page, 0, 0.5), viewer.project(page, 1, 0.5)];
  if (!left || !right) return Number.POSITIVE_INFINITY;
  return Math.max(left.x - width / 2, width / 2 - right.x);
}
