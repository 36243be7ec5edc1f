/** Where a flat book lies on its canvas. Pure arithmetic. */

import type { Face } from "../book/faces.ts";
import { caseSizes } from "../draw/case_shape.ts";
import type { BookPose, BookShape } from "../draw/pose.ts";

/** From book space to the canvas: CSS pixels a metre, and where the spine's head is, CSS pixels. */
export interface Layout {
  readonly scale: number;
  readonly x: number;
  readonly y: number;
}

/** How far the leaves under the uppermost one stand out beside it and below, as shares of their thickness. */
export const stackShare = 0.3;
export const stackDrop = 0.18;

/** Free room at either side of an open and of a closed book, and above and below, shares of the canvas. */
const openMargin = { sides: 0.04, ends: 0.07 };
const closedMargin = { sides: 0.1, ends: 0.09 };

/** How far a book is shut over its right-hand side, and over its left, 0 to 1. */
export function shutness({ frontBoard, backBoard }: BookPose): [right: number, left: number] {
  return [ease(1 - frontBoard / Math.PI), ease(backBoard / Math.PI)];
}

/** Fits a book to a canvas of CSS pixels: the open spread, the closed book in the middle, or between the two. */
export function layOut(shape: BookShape, pose: BookPose, width: number, height: number): Layout {
  const rim = shape.cover === "hard" ? caseSizes.rim : 0;
  const depth = stackShare * shape.thickness;
  const reach = shape.width + rim + depth;
  const [right, left] = shutness(pose);
  const open = fit(-reach, reach, openMargin);
  const spine = 0.5 * depth;
  const shutRight = fit(-spine, reach, closedMargin);
  const shutLeft = fit(-reach, spine, closedMargin);
  const mix = (of: (layout: Layout) => number): number =>
    of(open) + right * (of(shutRight) - of(open)) + left * (of(shutLeft) - of(open));
  return { scale: mix(({ scale }) => scale), x: mix(({ x }) => x), y: mix(({ y }) => y) };

  function fit(from: number, to: number, margin: typeof openMargin): Layout {
    const tall = shape.height + 2 * rim + depth;
    const scale = Math.min(
      (width * (1 - 2 * margin.sides)) / (to - from),
      (height * (1 - 2 * margin.ends)) / tall,
    );
    return {
      scale,
      x: width / 2 - (scale * (from + to)) / 2,
      y: height / 2 - scale * (tall / 2 - rim),
    };
  }
}

function ease(t: number): number {
  const c = Math.min(Math.max(t, 0), 1);
  return c * c * (3 - 2 * c);
}

/** A rectangle: metres, y down from the head. */
export type Box = readonly [left: number, top: number, right: number, bottom: number];

/** The pages of one side. */
export function pageBox({ width, height }: BookShape, sign: 1 | -1): Box {
  return sign === 1 ? [0, 0, width, height] : [-width, 0, 0, height];
}

/** A board of the case that lies on one side. */
export function boardBox({ width, height }: BookShape, sign: 1 | -1): Box {
  const { rim } = caseSizes;
  return sign === 1 ? [0, -rim, width + rim, height + rim] : [-width - rim, -rim, 0, height + rim];
}

/** Where a face's picture is when its part lies flat. */
export function panelOf(shape: BookShape, face: Face): Box {
  if (face === "frontOutside") return boardBox(shape, 1);
  if (face === "backOutside") return boardBox(shape, -1);
  return pageBox(shape, face === "right" || face === "backInside" ? 1 : -1);
}
