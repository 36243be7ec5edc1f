/** A peeled leaf: the part that still lies flat, and the part that is folded over it. */

import { Side } from "../engine/phases.ts";
import { lookOf } from "../themes.ts";
import { pageBox } from "./canvas_layout.ts";
import { addStops, type Brush, type Stops } from "./draw_book.ts";
import type { DrawnPage } from "./drawn_page.ts";
import { beyond, type FoldLine, foldLineOf, mirrored, type Point, partOf } from "./fold_line.ts";
import type { PeeledSurface } from "./peeled_book.ts";

/** How strongly the ink of the other side shows through where a leaf is folded over. */
const showThrough = 0.06;

/** A peeled leaf in the pen's own space, y down from the head. */
interface PeeledLeaf {
  readonly page: readonly Point[];
  readonly line: FoldLine;
  /** The lifted part of the leaf, where it lay. */
  readonly lifted: readonly Point[];
  /** How far the folded part reaches from the fold, metres. */
  readonly reach: number;
  /** Height above the table: 0 when it lies on either side, 1 half-way. */
  readonly height: number;
}

/**
 * Draws the part of a leaf that still lies on its side, and the shade on the
 * page that it uncovers.
 */
export function drawFlat(brush: Brush, leaf: PeeledSurface, drawn: DrawnPage): void {
  const { pen } = brush;
  const folded = foldOf(brush, leaf);
  if (folded === null) {
    drawn.draw(brush);
    return;
  }
  const { line, reach, page } = folded;
  const height = folded.height * brush.shape.shadows;
  pen.save();
  trace(pen, partOf(page, line, 1));
  pen.clip();
  across(brush, line, Math.min(0.8 * reach, 0.4 * brush.shape.width), [
    [0, -0.5 * height],
    [0.2, -0.26 * height],
    [0.55, -0.09 * height],
    [1, 0],
  ]);
  pen.restore();
  pen.save();
  trace(pen, partOf(page, line, -1));
  pen.clip();
  drawn.draw(brush);
  pen.restore();
}

/**
 * Draws the part of a leaf that is folded over: its other side, rounded toward
 * the fold, over its own shadow.
 *
 * @param drawn the page on that side, drawn as it lies once the leaf is turned
 * @param behind the page on the side that it lay with, whose ink shows through; null for none
 */
export function drawFolded(
  brush: Brush,
  leaf: PeeledSurface,
  drawn: DrawnPage,
  behind: DrawnPage | null,
): void {
  const folded = foldOf(brush, leaf);
  if (folded === null) return;
  const { pen, unit, shape } = brush;
  const { line, lifted, reach, height } = folded;
  const outline = lifted.map((point) => mirrored(line, point));
  pen.save();
  pen.shadowColor = `rgb(29 21 14 / ${0.42 * height * shape.shadows})`;
  pen.shadowBlur = 0.13 * height * shape.width * unit;
  pen.shadowOffsetY = 0.025 * height * shape.width * unit;
  pen.fillStyle = lookOf(shape).paper;
  trace(pen, outline);
  pen.fill();
  pen.restore();
  pen.save();
  trace(pen, outline);
  pen.clip();
  pen.save();
  mirrorIn(pen, line);
  // Drawn first: the ink on this side covers it except for a trace.
  pen.save();
  pen.scale(-1, 1);
  drawn.draw(brush);
  pen.restore();
  if (behind) {
    // So faint, its pixels need no smoothing, which would take half of the time.
    pen.imageSmoothingEnabled = false;
    pen.globalAlpha = showThrough * height;
    behind.draw(brush);
  }
  pen.restore();
  if (lookOf(shape).isDark) {
    // On dark paper no shadow is seen: its cut edges catch light, as far as they are in the air.
    pen.strokeStyle = `rgb(255 253 246 / ${0.4 * height})`;
    pen.lineWidth = 2 / unit;
    trace(pen, outline);
    pen.stroke();
  }
  across(brush, line, -reach, roundness(height * shape.shadows));
  pen.restore();
}

/** Returns the light on the folded part, from the fold to its far end. */
function roundness(height: number): Stops {
  return [
    [0, -0.42 * height],
    [0.03, -0.24 * height],
    [0.1, -0.06 * height],
    [0.16, 0.1 * height],
    [0.24, 0.42 * height],
    [0.4, 0.08 * height],
    [0.55, -0.02 * height],
    [1, -0.16 * height],
  ];
}

function foldOf({ shape }: Brush, { side, rest, held }: PeeledSurface): PeeledLeaf | null {
  const down = ([x, y]: Point): Point => [x, shape.height - y];
  const line = foldLineOf(down(rest), down(held));
  if (line === null) return null;
  const sign = side === Side.right ? 1 : -1;
  const [left, top, right, bottom] = pageBox(shape, sign);
  const page: Point[] = [
    [left, top],
    [right, top],
    [right, bottom],
    [left, bottom],
  ];
  const lifted = partOf(page, line, 1);
  const reach = Math.max(0, ...lifted.map((point) => beyond(line, point)));
  const way = Math.hypot(rest[0] - held[0], rest[1] - held[1]) / (2 * Math.abs(rest[0]));
  const height = Math.min(1, 1.5 * Math.sin(Math.PI * Math.min(way, 1)));
  return { page, line, lifted, reach, height };
}

/**
 * Fills the clipped area with a gradient from a fold line, `far` metres beyond it;
 * negative on the other side.
 */
function across({ pen, shape }: Brush, { at, normal }: FoldLine, far: number, stops: Stops): void {
  const [[x, y], [nx, ny]] = [at, normal];
  pen.save();
  pen.transform(nx, ny, -ny, nx, x, y);
  const gradient = pen.createLinearGradient(0, 0, far, 0);
  addStops(gradient, shape, stops);
  pen.fillStyle = gradient;
  const size = 3 * (shape.width + shape.height);
  pen.fillRect(0, -size, far, 2 * size);
  pen.restore();
}

/** Mirrors everything drawn from here on in a fold line. */
function mirrorIn(pen: CanvasRenderingContext2D, { at, normal }: FoldLine): void {
  const [nx, ny] = normal;
  const off = 2 * (at[0] * nx + at[1] * ny);
  pen.transform(1 - 2 * nx * nx, -2 * nx * ny, -2 * nx * ny, 1 - 2 * ny * ny, off * nx, off * ny);
}

function trace(pen: CanvasRenderingContext2D, outline: readonly Point[]): void {
  pen.beginPath();
  for (const [x, y] of outline) pen.lineTo(x, y);
  pen.closePath();
}
