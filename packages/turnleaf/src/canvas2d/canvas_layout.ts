/** Where a flat book lies on its canvas. Pure arithmetic. */

import type { Face } from "../book/faces.ts";
import type { BookPose, BookShape } from "../stage/book_pose.ts";
import type { CanvasFraction, Sight } from "../stage/zoom.ts";

/**
 * From book space to the canvas: CSS pixels per metre, and the position of the
 * spine's end at the upper left.
 */
export interface Layout {
  readonly scale: number;
  readonly x: number;
  readonly y: number;
}

/**
 * How far the leaves under the uppermost one stick out beside it and below, as
 * a fraction of their thickness.
 */
export const stackFraction = 0.3;
export const stackDrop = 0.18;

/** Returns how far a book is closed over its right-hand side, and over its left, 0 to 1. */
export function shutness({ frontBoard, backBoard }: BookPose): [right: number, left: number] {
  return [ease(1 - frontBoard / Math.PI), ease(backBoard / Math.PI)];
}

/**
 * Fits a book to a canvas in CSS pixels: the open spread, the closed book in
 * the middle, or between the two.
 */
export function layOut(shape: BookShape, pose: BookPose, width: number, height: number): Layout {
  const { alone, quarterTurned, rim, margin } = shape;
  const out = stackFraction * shape.thickness;
  const drop = stackDrop * shape.thickness;
  const reach = shape.width + rim + out;
  // The sliver beyond the spine of a page that stands alone is in the margin.
  const spine = alone === 0 ? 0.5 * out : 0;
  const onRight = fit(-spine, reach);
  const onLeft = fit(-reach, spine);
  const [right, left] = shape.fromAbove ? [0, 0] : shutness(pose);
  const open = alone === 0 ? fit(-reach, reach) : alone === 1 ? onRight : onLeft;
  const mix = (of: (layout: Layout) => number): number =>
    of(open) + right * (of(onRight) - of(open)) + left * (of(onLeft) - of(open));
  return { scale: mix(({ scale }) => scale), x: mix(({ x }) => x), y: mix(({ y }) => y) };

  function fit(from: number, to: number): Layout {
    const [head, foot] = [-rim, shape.height + rim + drop];
    const [room, length] = quarterTurned ? [height, width] : [width, height];
    const scale = Math.min(
      (room * (1 - 2 * margin)) / (to - from),
      (length * (1 - 2 * margin)) / (foot - head),
    );
    const across = room / 2 - (scale * (from + to)) / 2;
    const along = length / 2 - (scale * (head + foot)) / 2;
    // Turned by a quarter, the foot of the spine is at the left and its head at the right.
    const start = length - along - scale * shape.height;
    return quarterTurned ? { scale, x: start, y: across } : { scale, x: across, y: along };
  }
}

/** Returns the picture of a whole flat book, which zoom magnifies. */
export function sightOf(shape: BookShape, pose: BookPose, width: number, height: number): Sight {
  const layout = layOut(shape, pose, width, height);
  const seen = (x: number, y: number): CanvasFraction => {
    const [right, down] = shape.quarterTurned ? [y, x] : [x, shape.height - y];
    return [(layout.x + layout.scale * right) / width, (layout.y + layout.scale * down) / height];
  };
  const point = ([x, y]: CanvasFraction): CanvasFraction => {
    const right = (x * width - layout.x) / layout.scale;
    const down = (y * height - layout.y) / layout.scale;
    return shape.quarterTurned ? [down, right] : [right, shape.height - down];
  };
  const [right, left] = shutness(pose);
  const { alone, rim } = shape;
  const reach = shape.width + rim;
  const from = alone === 1 ? 0 : (right - 1) * reach;
  const to = alone === -1 ? 0 : (1 - left) * reach;
  const corners = [seen(from, 0), seen(to, shape.height)];
  const [xs, ys] = [0, 1].map((k) => corners.map((corner) => corner[k]));
  return {
    seen,
    point,
    book: [Math.min(...xs), Math.min(...ys), Math.max(...xs), Math.max(...ys)],
  };
}

/**
 * Magnifies a layout about a place of its canvas, in fractions, and moves that
 * place to the middle.
 */
export function magnified(
  { scale, x, y }: Layout,
  level: number,
  middle: CanvasFraction,
  width: number,
  height: number,
): Layout {
  return {
    scale: scale * level,
    x: (x - middle[0] * width) * level + width / 2,
    y: (y - middle[1] * height) * level + height / 2,
  };
}

/**
 * Moves and scales a layout by less than a pixel of the screen, so that a page is a whole number of
 * these wide, and begins with one.
 *
 * @param ratio pixels of the screen for each CSS pixel
 */
export function onPixels(shape: BookShape, { scale, x, y }: Layout, ratio: number): Layout {
  const across = (shape.quarterTurned ? shape.height : shape.width) * ratio;
  return {
    scale: Math.max(Math.round(scale * across), 1) / across,
    x: Math.round(x * ratio) / ratio,
    y: Math.round(y * ratio) / ratio,
  };
}

function ease(t: number): number {
  const c = Math.min(Math.max(t, 0), 1);
  return c * c * (3 - 2 * c);
}

/** A rectangle: metres, y down from the head. */
export type Box = readonly [left: number, top: number, right: number, bottom: number];

/** Returns the box of the pages of one side. */
export function pageBox({ width, height }: BookShape, sign: 1 | -1): Box {
  return sign === 1 ? [0, 0, width, height] : [-width, 0, 0, height];
}

/** Returns the box of a board of the case that lies on one side. */
export function boardBox({ width, height, rim }: BookShape, sign: 1 | -1): Box {
  return sign === 1 ? [0, -rim, width + rim, height + rim] : [-width - rim, -rim, 0, height + rim];
}

/** Returns where a face's picture is when its part lies flat. */
export function panelOf(shape: BookShape, face: Face): Box {
  if (face === "frontOutside") return boardBox(shape, 1);
  if (face === "backOutside") return boardBox(shape, -1);
  return pageBox(shape, face === "right" || face === "backInside" ? 1 : -1);
}

/** Transforms a pen so that a square of side 1 covers a box. */
export function stretchTo(
  pen: CanvasRenderingContext2D,
  [left, top, right, bottom]: Box,
  quarterTurned: boolean,
): void {
  if (quarterTurned) pen.transform(0, top - bottom, right - left, 0, left, bottom);
  else pen.transform(right - left, 0, 0, bottom - top, left, top);
}
