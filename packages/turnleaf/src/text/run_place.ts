/** Lays boxes of a page onto the screen. */

import type { PageBox } from "../sources/page_source.ts";
import type { Point } from "./page_view.ts";

/** Returns where a place of a page, in the unit of its size, is seen. */
export type Project = (x: number, y: number) => Point | null;

/** Maximum distance of a piece from the page that curves under it, CSS pixels. */
const mostApart = 0.75;

/** A box that may be turned about its upper left corner, clockwise by radians. */
export interface TurnedBox extends PageBox {
  readonly angle?: number;
}

/** Returns where a place of a box, in fractions of it, is seen. */
export function placeIn(box: TurnedBox, project: Project): (u: number, v: number) => Point | null {
  const { angle = 0, x, y, width, height } = box;
  const [cos, sin] = [Math.cos(angle), Math.sin(angle)];
  return (u, v) =>
    project(x + u * width * cos - v * height * sin, y + u * width * sin + v * height * cos);
}

/**
 * Returns the CSS matrix that lays an element of `width` by `height` CSS pixels
 * with its origin in its upper left corner over a part of a box; null if that
 * is not visible.
 *
 * @param from,to the part along the box, as fractions of its width
 */
export function matrixOf(
  place: (u: number, v: number) => Point | null,
  from: number,
  to: number,
  width: number,
  height: number,
): string | null {
  const [origin, right, below] = [place(from, 0), place(to, 0), place(from, 1)];
  if (!origin || !right || !below || !(width > 0 && height > 0)) return null;
  const parts = [
    (right.x - origin.x) / width,
    (right.y - origin.y) / width,
    (below.x - origin.x) / height,
    (below.y - origin.y) / height,
    origin.x,
    origin.y,
  ];
  return `matrix(${parts.map((part) => Number(part.toFixed(5))).join()})`;
}

/**
 * Returns whether a flat piece from one fraction of a box to another lies on
 * the page, which may curve under it.
 */
export function isFlat(
  place: (u: number, v: number) => Point | null,
  from: number,
  to: number,
): boolean {
  const corners = [place(from, 0), place(to, 0), place(from, 1), place(to, 1)];
  const middle = place((from + to) / 2, 0.5);
  const [a, b, c, d] = corners;
  if (!a || !b || !c || !d || !middle) return true;
  const apart = (x: number, y: number): boolean => Math.hypot(x, y) > mostApart;
  return !(
    apart(b.x + c.x - a.x - d.x, b.y + c.y - a.y - d.y) ||
    apart(middle.x - (b.x + c.x) / 2, middle.y - (b.y + c.y) / 2)
  );
}

/**
 * Lays an element over a part of a box, at its apparent size, so that its edges
 * are as thin and its corners as round as anywhere. An invisible one is hidden.
 *
 * @param from,to the part along the box, as fractions of its width
 */
export function layOver(
  element: HTMLElement,
  place: (u: number, v: number) => Point | null,
  from = 0,
  to = 1,
): void {
  const [origin, right, below] = [place(from, 0), place(to, 0), place(from, 1)];
  const length = (end: Point | null): number =>
    origin && end ? Math.hypot(end.x - origin.x, end.y - origin.y) : 0;
  const [width, height] = [length(right), length(below)];
  const transform = matrixOf(place, from, to, width, height);
  element.hidden = transform === null;
  if (transform === null) return;
  Object.assign(element.style, { transform, width: `${width}px`, height: `${height}px` });
}
