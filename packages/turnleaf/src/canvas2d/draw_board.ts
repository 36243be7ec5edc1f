/**
 * A cover board that does not lie open: it swings about the spine, or lies
 * closed over the leaves.
 */

import type { PagePicture } from "../sources/page_source.ts";
import type { FaceDetail } from "../stage/book_stage.ts";
import { lookOf } from "../themes.ts";
import { stretchTo } from "./canvas_layout.ts";
import { type Brush, drawDetail, fillBetween, fillCloth, type Stops } from "./draw_book.ts";

/** How much larger the fore-edge of an upright board looks, because it is nearer to the eye. */
const nearness = 0.16;

/** Width in device pixels of the slices in which a picture is drawn on a board seen at an angle. */
const sliceWidth = 3;

/** The hinge's groove and the rounded fore-edge of a board seen from outside. */
const groove: Stops = [
  [0, -0.5],
  [0.014, 0.1],
  [0.03, -0.1],
  [0.046, -0.42],
  [0.062, -0.06],
  [0.075, 0.12],
  [0.1, 0],
  [0.97, 0],
  [1, -0.3],
];

/**
 * The visible side of a board: the cover's cloth, the paper pasted on its
 * inside, or a side of a leaf of board.
 */
export type BoardSide = "outside" | "inside" | "leaf";

/** A board as it is seen. */
export interface SeenBoard {
  readonly side: BoardSide;
  /** Radians from lying on the right. */
  readonly angle: number;
  readonly picture: PagePicture | null;
  /** A detail on the same side, visible where the board lies flat. */
  readonly detail: FaceDetail | null;
}

/** A place on a board, across it from the hinge (0) to its edge (1) and along it in metres from the head. */
type BoardToCanvas = (u: number, y: number) => [x: number, y: number];

/** Draws a board and its shadow. */
export function drawBoard(brush: Brush, board: SeenBoard): void {
  const { pen, shape, unit } = brush;
  const { angle, side } = board;
  const rim = side === "leaf" ? 0 : shape.rim;
  const [cos, sin] = [Math.cos(angle), Math.sin(angle)];
  const [width, height] = [shape.width + rim, shape.height];
  const at: BoardToCanvas = (u, y) => [
    cos * u * width,
    height / 2 + (y - height / 2) * (1 + nearness * sin * u),
  ];
  pen.save();
  pen.beginPath();
  for (const [u, y] of [
    [0, -rim],
    [1, -rim],
    [1, height + rim],
    [0, height + rim],
  ]) {
    pen.lineTo(...at(u, y));
  }
  pen.save();
  pen.shadowColor = "rgb(29 21 14 / 0.45)";
  pen.shadowBlur = (0.02 + 0.16 * sin) * width * unit;
  pen.shadowOffsetY = (0.006 + 0.04 * sin) * width * unit;
  if (side === "leaf") {
    pen.fillStyle = lookOf(shape).paper;
    pen.fill();
  } else fillCloth(pen, shape, () => pen.fill());
  pen.restore();
  pen.clip();
  drawPicture(brush, board, rim, at);
  const edge = cos * width;
  const all = [Math.min(0, edge), -height, Math.max(0, edge), 2 * height] as const;
  const across = [0, 0, edge, 0] as const;
  if (side === "outside") fillBetween(brush, across, groove, all);
  const turnedAway: Stops = [
    [0, -0.2 * sin],
    [1, -0.5 * sin],
  ];
  fillBetween(brush, across, turnedAway, all);
  pen.restore();
}

/** Draws the picture on a board, in slices if it is seen at an angle. */
function drawPicture(
  { pen, shape, unit }: Brush,
  { angle, side, picture, detail }: SeenBoard,
  rim: number,
  at: BoardToCanvas,
): void {
  if (!picture || picture.width === 0) return;
  const { width: w, height: h } = picture;
  // The outside picture covers the board; the inside one leaves a rim of cloth.
  const inset = side === "inside" ? rim : 0;
  const fraction = 1 - inset / (shape.width + rim);
  const isFlat = Math.sin(angle) < 0.01;
  const count = isFlat ? 1 : Math.ceil((Math.abs(at(1, 0)[0]) * unit) / sliceWidth) + 1;
  for (let k = 0; k < count; k++) {
    const [u0, u1] = [k / count, (k + 1) / count];
    const [x0, top] = at(u0 * fraction, inset - rim);
    const [x1] = at(u1 * fraction, 0);
    const [, bottom] = at(u0 * fraction, shape.height + rim - inset);
    const from = angle < Math.PI / 2 ? u0 : 1 - u1;
    const start = Math.min(x0, x1);
    // Slightly wider, so that the ground does not show between two slices.
    const end = start + Math.abs(x1 - x0) + (isFlat ? 0 : 1 / unit);
    const part: [number, number, number, number] = shape.quarterTurned
      ? [0, from * h, w, h / count]
      : [from * w, 0, w / count, h];
    pen.save();
    stretchTo(pen, [start, top, end, bottom], shape.quarterTurned);
    pen.drawImage(picture, ...part, 0, 0, 1, 1);
    if (isFlat) drawDetail(pen, detail);
    pen.restore();
  }
}
