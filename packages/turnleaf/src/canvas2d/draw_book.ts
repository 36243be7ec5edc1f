/**
 * The resting parts of a flat book: its shadow, the case, the piles of leaves
 * and their uppermost pages.
 */

import { pileHeight } from "../engine/shapes.ts";
import type { PagePicture } from "../sources/page_source.ts";
import type { BookPose, BookShape } from "../stage/book_pose.ts";
import type { FaceDetail } from "../stage/book_stage.ts";
import { caseSizes } from "../stage/case_sizes.ts";
import { stapleColour, stapleLegs, staples } from "../stage/staples.ts";
import { lookOf } from "../themes.ts";
import {
  type Box,
  boardBox,
  pageBox,
  stackDrop,
  stackFraction,
  stretchTo,
} from "./canvas_layout.ts";

/** What a book is drawn with. */
export interface Brush {
  /** Draws in metres, y down from the head. */
  readonly pen: CanvasRenderingContext2D;
  readonly shape: BookShape;
  /** Canvas pixels per metre. */
  readonly unit: number;
  /** From metres to canvas pixels. */
  readonly toCanvas: DOMMatrix;
}

/** Stops of a gradient: position from 0 to 1, then the opacity of light, or less than 0 of shade. */
export type Stops = readonly (readonly [at: number, tone: number])[];

/** How much of the light on paper dark paper gives back. */
const darkLight = 0.3;

/** Returns the colour of a tone, as `Stops` have it: warm, as on paper lit by other paper, which dark paper does not light. */
function toneOf(shape: BookShape, tone: number): string {
  const { isDark } = lookOf(shape);
  if (tone > 0) return `rgb(255 253 246 / ${isDark ? darkLight * tone : tone})`;
  return `rgb(${isDark ? "0 0 0" : "58 40 22"} / ${Math.abs(tone)})`;
}

/** Gives a gradient its colours. */
export function addStops(gradient: CanvasGradient, shape: BookShape, stops: Stops): void {
  for (const [at, tone] of stops) gradient.addColorStop(at, toneOf(shape, tone));
}

/**
 * The rise of the pages from the gutter: the left page faces away from the
 * light, the right one toward it. Beyond the inner margin no shade takes from the print.
 */
const leftGutter: Stops = [
  [0, -0.5],
  [0.012, -0.36],
  [0.05, -0.18],
  [0.09, -0.08],
  [0.13, -0.035],
  [0.2, -0.01],
  [0.3, 0],
  [0.8, 0],
  [1, -0.035],
];
const rightGutter: Stops = [
  [0, -0.46],
  [0.01, -0.3],
  [0.035, -0.13],
  [0.08, -0.045],
  [0.15, -0.012],
  [0.26, 0],
  [0.75, 0],
  [0.9, -0.012],
  [1, -0.05],
];

/** Fills a box with a gradient from one place to another. */
export function fillBetween(
  { pen, shape }: Pick<Brush, "pen" | "shape">,
  [x0, y0, x1, y1]: Box,
  stops: Stops,
  [left, top, right, bottom]: Box,
): void {
  const gradient = pen.createLinearGradient(x0, y0, x1, y1);
  addStops(gradient, shape, stops);
  pen.fillStyle = gradient;
  pen.fillRect(left, top, right - left, bottom - top);
}

/** Draws a page that lies on one side, in the light that falls on it. */
export function drawPage(
  { pen, shape }: Brush,
  sign: 1 | -1,
  picture: PagePicture | null,
  detail: FaceDetail | null = null,
): void {
  const box = pageBox(shape, sign);
  const { width, height } = shape;
  if (picture && picture.width > 0) {
    pen.save();
    pen.imageSmoothingQuality = "high";
    stretchTo(pen, box, shape.quarterTurned);
    drawPicture(pen, picture);
    drawDetail(pen, detail);
    pen.restore();
  } else {
    pen.fillStyle = lookOf(shape).paper;
    pen.fillRect(box[0], 0, width, height);
  }
  fillBetween({ pen, shape }, [0, 0, sign * width, 0], sign === 1 ? rightGutter : leftGutter, box);
}

/** Draws a picture over the square of side 1: pixel by pixel, if it is as large as that on the canvas. */
function drawPicture(pen: CanvasRenderingContext2D, picture: PagePicture): void {
  const square = pen.getTransform();
  const { a: width, b, c, d: height, e: left, f: top } = square;
  const isUpright = Math.max(Math.abs(b), Math.abs(c)) < 0.01;
  // Heights are rounded down where pictures are drawn.
  const isAsLarge =
    Math.abs(picture.width - width) < 0.01 && Math.abs(picture.height - height) <= 1;
  if (!isUpright || !isAsLarge) {
    pen.drawImage(picture, 0, 0, 1, 1);
    return;
  }
  pen.setTransform(1, 0, 0, 1, Math.round(left), Math.round(top));
  pen.drawImage(picture, 0, 0);
  pen.setTransform(square);
}

/** Draws a detail over its picture, which fills the square of side 1. */
export function drawDetail(pen: CanvasRenderingContext2D, detail: FaceDetail | null): void {
  if (detail === null) return;
  const { x, y, width, height } = detail.box;
  pen.drawImage(detail.picture, x, y, width, height);
}

/** Draws the edges of the leaves under a side's uppermost page, `thickness` metres of them. */
export function drawStack({ pen, shape, unit }: Brush, sign: 1 | -1, thickness: number): void {
  const [out, down] = [stackFraction * thickness, stackDrop * thickness];
  const { edges } = lookOf(shape);
  const layers = Math.min(Math.ceil((out * unit) / 1.4), 24);
  const { width, height } = shape;
  for (let k = layers; k > 0; k--) {
    const [dx, dy] = [(out * k) / layers, (down * k) / layers];
    // Irregular, as leaves are: even bands would beat with the pixels.
    const tone = 0.5 + 0.5 * Math.sin(k * 12.9898);
    pen.fillStyle = edges;
    pen.fillRect(sign === 1 ? 0 : -width - dx, dy, width + dx, height);
    pen.fillStyle = toneOf(shape, -0.12 * tone - 0.005 * k);
    pen.fillRect(sign === 1 ? 0 : -width - dx, dy, width + dx, height);
  }
  if (layers > 0) {
    const edge = sign * (width + out);
    const box: Box =
      sign === 1 ? [width, 0, edge, height + down] : [edge, 0, -width, height + down];
    fillBetween(
      { pen, shape },
      [sign * width, 0, edge, 0],
      [
        [0, 0],
        [1, -0.22],
      ],
      box,
    );
  }
}

/** Draws the staples in the fold: wire that is light where it faces the light, and dark beside that. */
export function drawStaples({ pen, shape }: Brush): void {
  const { wire } = staples;
  for (const [from, to] of stapleLegs(shape.height)) {
    const box: Box = [-wire / 2, from, wire / 2, to];
    pen.fillStyle = stapleColour;
    pen.fillRect(box[0], from, wire, to - from);
    const round: Stops = [
      [0, 0.2],
      [0.4, 0.85],
      [1, -0.6],
    ];
    fillBetween({ pen, shape }, [box[0], 0, box[2], 0], round, box);
  }
}

/**
 * Draws everything under the leaves: the shadow on the table, the boards that
 * lie on it and the spine between.
 */
export function drawCase({ pen, shape, unit }: Brush, pose: BookPose): void {
  const { thickness, height, width, rim } = shape;
  const isHard = shape.cover === "hard";
  const rise = (side: "left" | "right"): number => thicknessOf(pose, side);
  const drop = stackDrop * Math.max(rise("left"), rise("right"));
  const sides: Box[] = [];
  for (const sign of [-1, 1] as const) {
    const side = sign === 1 ? "right" : "left";
    const lies = sign === 1 ? pose.backBoard <= 0 : pose.frontBoard >= Math.PI;
    if (isHard ? !lies : !pose[side]) continue;
    const out = stackFraction * rise(side);
    const [left, top, right, bottom] = isHard ? boardBox(shape, sign) : pageBox(shape, sign);
    sides.push([
      left - (sign === -1 ? out : 0),
      top,
      right + (sign === 1 ? out : 0),
      bottom + drop,
    ]);
  }
  const joint = isHard ? 0.5 * stackFraction * thickness : 0;
  const whole: Box = [
    Math.min(-joint, ...sides.map(([left]) => left)),
    -rim,
    Math.max(joint, ...sides.map(([, , right]) => right)),
    height + rim + drop,
  ];
  drawShadow(pen, whole, width * unit);
  if (isHard) fillCloth(pen, shape, () => fillRounded(pen, whole, caseSizes.corner));
  else {
    pen.fillStyle = lookOf(shape).paper;
    fillRounded(pen, whole, caseSizes.corner);
  }
  if (!isHard) return;
  for (const box of sides) drawCloth({ pen, shape, unit }, box);
}

/**
 * Draws the shadow of a box on the table. Browsers blur that of a rectangle by a formula, several
 * times as fast as that of any path, so its rounded corners are left out. The rectangle itself is
 * beyond the canvas.
 *
 * @param size width of a page, canvas pixels
 */
function drawShadow(
  pen: CanvasRenderingContext2D,
  [left, top, right, bottom]: Box,
  size: number,
): void {
  pen.save();
  // Offsets and blurs of shadows are in canvas pixels.
  const { a, b, c, d, e, f } = pen.getTransform();
  const away = pen.canvas.width + 3 * size;
  pen.setTransform(a, b, c, d, e - away, f);
  pen.fillStyle = "black";
  for (const [blur, lower, opacity] of [
    [0.22, 0.05, 0.32],
    [0.05, 0.014, 0.4],
    [0.012, 0.003, 0.5],
  ]) {
    pen.shadowColor = `rgb(29 21 14 / ${opacity})`;
    pen.shadowBlur = blur * size;
    pen.shadowOffsetX = away;
    pen.shadowOffsetY = lower * size;
    pen.fillRect(left, top, right - left, bottom - top);
  }
  pen.restore();
}

/** Fills with a book's cloth what `fill` fills: darker by night. */
export function fillCloth(pen: CanvasRenderingContext2D, shape: BookShape, fill: () => void): void {
  pen.fillStyle = shape.cloth;
  fill();
  const { cloth } = lookOf(shape);
  if (cloth === 1) return;
  // What is multiplied in linear light is brighter on the screen.
  pen.fillStyle = `rgb(0 0 0 / ${1 - cloth ** (1 / 2.2)})`;
  fill();
}

/** Draws light and edges on a lying board. */
function drawCloth({ pen, shape, unit }: Omit<Brush, "toCanvas">, box: Box): void {
  const [left, top, right, bottom] = box;
  fillBetween(
    { pen, shape },
    [left, top, right, bottom],
    [
      [0, 0.1],
      [1, -0.25],
    ],
    box,
  );
  pen.strokeStyle = toneOf(shape, -0.5);
  pen.lineWidth = 1 / unit;
  pen.strokeRect(left, top, right - left, bottom - top);
}

/** Returns the thickness of the leaves that lie on a side, metres. */
export function thicknessOf(pose: BookPose, side: "left" | "right"): number {
  const pile = pose[side];
  return pile ? pileHeight(pile) : 0;
}

/** Fills a box with rounded corners. */
function fillRounded(pen: CanvasRenderingContext2D, box: Box, radius: number): void {
  const [left, top, right, bottom] = box;
  pen.beginPath();
  pen.roundRect(left, top, right - left, bottom - top, radius);
  pen.fill();
}
