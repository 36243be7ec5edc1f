/** The zoom of a double tap: to the tapped page, and back. */

import { pagesAt } from "../book/spreads.ts";
import type { Place } from "../stage/book_stage.ts";
import type { Viewer } from "../viewer/viewer.ts";
import type { InputTarget } from "./target.ts";

/** Fraction of the canvas that the page's width is to fill. */
const filled = 0.94;

/** Minimum and maximum level of a double tap. */
const least = 2;
const most = 4;

/** A requested zoom: the level, and which point comes where. */
interface RequestedZoom {
  readonly level: number;
  readonly from: Place;
  readonly to: Place;
}

/**
 * Returns the zoom for a double tap at a place: the page there, or its column of text if it has several,
 * across the whole canvas; for a zoomed book, all of it.
 *
 * @param width of the canvas, CSS pixels
 * @param columnAt as `InputTarget` has it
 */
export function pageZoom(
  viewer: Viewer,
  at: Place,
  width: number,
  columnAt: InputTarget["columnAt"],
): RequestedZoom {
  const whole = { level: 1, from: at, to: at };
  if (viewer.zoomLevel > 1) return whole;
  const pages = pagesAt(viewer.binding, viewer.turning.spread).flatMap((page) => {
    const [left, right] = [viewer.project(page, 0, 0.5), viewer.project(page, 1, 0.5)];
    if (!left || !right) return [];
    const [across, head, foot] = [
      right.x - left.x,
      viewer.project(page, 0, 0),
      viewer.project(page, 0, 1),
    ];
    const down = head && foot ? (at.y - head.y) / (foot.y - head.y) : 0.5;
    const place = { x: (at.x - left.x) / across, y: down };
    const isOn = place.x >= 0 && place.x <= 1;
    const { from, to } = (isOn && columnAt(page, place)) || { from: 0, to: 1 };
    return [{ middle: left.x + ((from + to) / 2) * across, across: (to - from) * across }];
  });
  const [page] = pages.sort((a, b) => Math.abs(a.middle - at.x) - Math.abs(b.middle - at.x));
  if (page === undefined) return { ...whole, level: least };
  const level = Math.min(Math.max((filled * width) / page.across, least), most);
  // If the page is wider than the canvas, the tapped point stays in sight.
  const fits = level * page.across <= width;
  const from = fits ? { x: page.middle, y: at.y } : at;
  return { level, from, to: fits ? { x: width / 2, y: at.y } : at };
}
