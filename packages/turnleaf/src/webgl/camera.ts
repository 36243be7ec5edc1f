/**
 * Where the camera stands so that the book fills the canvas. Pure arithmetic,
 * no three.js.
 *
 * An upright leaf is seen above the head of the book, so the picture holds the
 * space in which leaves swing, whether one does or not: the book stays where it
 * is when a leaf is grabbed, and nothing of the leaf is cut off. The headroom
 * that takes depends on the eye alone: the steeper it looks and the longer its
 * lens, the less (docs/decisions/0016-the-book-stands-still.md).
 */

import type { BookShape } from "../stage/book_pose.ts";
import { type CanvasFraction, overheadAt, type Sight } from "../stage/zoom.ts";

/** Vertical field of view, degrees. */
export const fieldOfView = 12;

/** The camera's place and its three axes in book space. */
export interface View {
  position: [number, number, number];
  right: [number, number, number];
  up: [number, number, number];
  /** Out of the picture, toward the reader. */
  back: [number, number, number];
  /** From the camera to the middle of the book, metres. */
  distance: number;
}

/** Margins between the book and the canvas, as fractions of the canvas. */
export interface Margins {
  sides: number;
  top: number;
  bottom: number;
}

/** Place across the picture, along it, and distance from the origin: the result of a fit. */
type Fit = [across: number, along: number, distance: number];

/**
 * Degrees above the table from which an open book, one page of it, and a closed
 * book are seen, for pages half as high again as they are wide, or higher.
 * Wider leaves rise farther above the head and are seen from steeper above, so
 * that they do so by no larger fraction of the page's height.
 */
const openElevation = 78;
const aloneElevation = 82;
const closedElevation = 66;
const usualHeight = 1.5;
/** A closed book is seen from a little beside its spine, degrees. */
const closedAzimuth = 9;

const radians = Math.PI / 180;

/** Half the height that the camera sees at a distance of 1. */
export const halfSeen: number = Math.tan(0.5 * fieldOfView * radians);

/** Around an open book, around one page of it, and around a closed one. */
const openMargins: Margins = { sides: 0.035, top: 0.012, bottom: 0.05 };
const aloneMargins: Margins = { sides: 0.012, top: 0.012, bottom: 0.03 };
const closedMargins: Margins = { sides: 0.12, top: 0.1, bottom: 0.1 };

/** Width visible beyond the spine beside a page that stands alone, as a fraction of its width. */
const sliver = 0.03;

/**
 * Half axes of the ellipse in which the outer edge of a leaf swings about the
 * spine, as fractions of the leaf's width; a leaf stretched upright by a
 * pointer comes within one hundredth of the upper. And how far beyond the foot
 * the edge of a wide leaf hangs that is led by its head, likewise.
 */
const swing = { across: 0.97, up: 0.96, dip: 0.07 };

/** The properties of a pose that the camera depends on. */
export interface Framing {
  /** 0 open, 1 closed over the right pile. */
  closedRight: number;
  /** 0 open, 1 closed over the left pile. */
  closedLeft: number;
  /** Middle of the open book across the spine, metres. */
  middle: number;
  /** x, z of the outer edges of the boards, which stay in the picture as they swing. */
  boardEdges: number[];
  /** x, z of the outer corners of an open fold-out; empty if there is none. */
  flapEdge: number[];
}

/**
 * Returns the view that frames the book, a continuous function of the framing.
 *
 * @param overhead 0 from where a reader sits, 1 from right over the book
 */
export function frameBook(
  shape: BookShape,
  framing: Framing,
  aspect: number,
  rim: number,
  overhead = 0,
): View {
  const { fromAbove } = shape;
  const right = fromAbove ? 0 : ease(framing.closedRight);
  const left = fromAbove ? 0 : ease(framing.closedLeft);
  const steep = fromAbove ? 1 : overhead;
  const closed = Math.min(1, right + left);
  const { alone } = shape;
  const opened = elevationOf(shape);
  const elevationOfReader = opened + (closedElevation - opened) * closed;
  const elevation = elevationOfReader + (90 - elevationOfReader) * steep;
  const azimuth = closedAzimuth * (left - right) * (1 - steep);
  const axes = axesOf(elevation * radians, azimuth * radians, shape.quarterTurned);
  const open =
    alone === 0
      ? fitPoints(openPoints(shape, framing, rim), axes, aspect, openMargins)
      : fitPoints(alonePoints(shape, framing, alone), axes, aspect, aloneMargins);
  const fit: Fit = [...open];
  for (const [fraction, sign] of [
    [right, 1],
    [left, -1],
  ]) {
    if (fraction <= 0) continue;
    const shut = fitPoints(closedPoints(shape, framing, sign, rim), axes, aspect, closedMargins);
    for (let k = 0; k < 3; k++) fit[k] += (shut[k] - open[k]) * fraction;
  }
  return viewOf(fit, axes);
}

/**
 * Returns the degrees above the table from which an open book, or a page of it
 * that stands alone, is seen.
 */
function elevationOf({ width, height, alone }: BookShape): number {
  const upright = alone === 0 ? openElevation : aloneElevation;
  const wide = Math.min(height / width / usualHeight, 1);
  return Math.atan(Math.tan(upright * radians) / wide) / radians;
}

/** Returns the picture of the whole book that zoom `level` magnifies. */
export function sightOf(
  shape: BookShape,
  framing: Framing,
  aspect: number,
  rim: number,
  level: number,
): Sight {
  const view = frameBook(shape, framing, aspect, rim, overheadAt(level));
  const { position, right, up, back } = view;
  const plane = shape.thickness / 2;
  const seen = (x: number, y: number): CanvasFraction => {
    const away = [x - position[0], y - position[1], plane - position[2]];
    const reach = -2 * halfSeen * along(back, away, 0);
    return [0.5 + along(right, away, 0) / (reach * aspect), 0.5 - along(up, away, 0) / reach];
  };
  const point = ([x, y]: CanvasFraction): CanvasFraction => {
    const [across, rise] = [(2 * x - 1) * halfSeen * aspect, (1 - 2 * y) * halfSeen];
    const way = (k: number): number => across * right[k] + rise * up[k] - back[k];
    const t = (plane - position[2]) / way(2);
    return [position[0] + t * way(0), position[1] + t * way(1)];
  };
  const places = sidesOf(shape, framing, rim).flatMap((x) =>
    [-rim, shape.height + rim].map((y) => seen(x, y)),
  );
  const [xs, ys] = [0, 1].map((k) => places.map((place) => place[k]));
  return {
    seen,
    point,
    book: [Math.min(...xs), Math.min(...ys), Math.max(...xs), Math.max(...ys)],
  };
}

/** Returns x of the book's outline at either side, metres: open, closed, or between the two. */
function sidesOf({ width, thickness, alone }: BookShape, framing: Framing, rim: number): number[] {
  if (alone !== 0) return [-sliver * alone * width, alone * width];
  const reach = width + rim + thickness / 2;
  const { closedRight, closedLeft, middle } = framing;
  return [middle - (1 - ease(closedRight)) * reach, middle + (1 - ease(closedLeft)) * reach];
}

/**
 * Returns the three axes in book space of a camera `elevation` above the table
 * that is turned `azimuth` about the vertical, radians.
 *
 * @param quarterTurned whether the camera stands where the book's right side is
 * near
 */
export function axesOf(
  elevation: number,
  azimuth: number,
  quarterTurned = false,
): Pick<View, "right" | "up" | "back"> {
  const [ce, se, ca, sa] = [
    Math.cos(elevation),
    Math.sin(elevation),
    Math.cos(azimuth),
    Math.sin(azimuth),
  ];
  const turned = (x: number, y: number, z: number): [number, number, number] =>
    quarterTurned ? [-y, x, z] : [x, y, z];
  return {
    right: turned(ca, sa, 0),
    up: turned(-sa * se, ca * se, ce),
    back: turned(sa * ce, -ca * ce, se),
  };
}

/**
 * Returns the nearest camera with these axes whose picture holds every point
 * within the margins. Each bound is linear in the camera's position, so the
 * result is exact.
 *
 * @param points x, y, z of each
 */
export function fitPoints(
  points: readonly number[],
  axes: Pick<View, "right" | "up" | "back">,
  aspect: number,
  margins: Margins,
): Fit {
  const across = halfSeen * aspect * (1 - 2 * margins.sides);
  const above = halfSeen * (1 - 2 * margins.top);
  const below = halfSeen * (1 - 2 * margins.bottom);
  // A camera at distance d sees a point within the bound `slope` where
  // |place - centre| <= slope * (d - height), height being along `back`.
  const bounds = [-Infinity, -Infinity, -Infinity, -Infinity];
  for (let k = 0; k < points.length; k += 3) {
    const x = along(axes.right, points, k);
    const y = along(axes.up, points, k);
    const height = along(axes.back, points, k);
    bounds[0] = Math.max(bounds[0], x + across * height);
    bounds[1] = Math.max(bounds[1], -x + across * height);
    bounds[2] = Math.max(bounds[2], y + above * height);
    bounds[3] = Math.max(bounds[3], -y + below * height);
  }
  const distance = Math.max(
    (bounds[0] + bounds[1]) / (2 * across),
    (bounds[2] + bounds[3]) / (above + below),
  );
  return [
    (bounds[0] - bounds[1]) / 2,
    // Spare space above and below is divided as the margins are.
    (bounds[2] - above * distance + (below * distance - bounds[3])) / 2,
    distance,
  ];
}

function viewOf(fit: Fit, axes: Pick<View, "right" | "up" | "back">): View {
  const place = (k: number): number =>
    axes.right[k] * fit[0] + axes.up[k] * fit[1] + axes.back[k] * fit[2];
  return { position: [place(0), place(1), place(2)], ...axes, distance: fit[2] };
}

/** Adds the corners of the open book, and where a leaf swings. */
function openPoints(shape: BookShape, framing: Framing, rim: number): number[] {
  const { width, height, thickness } = shape;
  const reach = width + rim + thickness / 2;
  const points: number[] = [];
  for (const x of [framing.middle - reach, framing.middle + reach]) {
    for (const y of [-rim, height + rim]) points.push(x, y, 0, x, y, thickness / 2);
  }
  addSwing(points, shape, () => true);
  addBoards(points, shape, framing, rim);
  return points;
}

/**
 * Adds the corners of one page and a sliver beyond the spine, and where its
 * leaf swings until it is upright.
 */
function alonePoints(shape: BookShape, framing: Framing, sign: number): number[] {
  const { width, height, thickness } = shape;
  const points: number[] = [];
  // Pages rise out of a thick book's gutter first, and reach less far.
  const reach = width - 0.35 * thickness;
  for (const x of [-sliver * sign * width, sign * reach]) {
    for (const y of [0, height]) points.push(x, y, 0, x, y, thickness);
  }
  addSwing(points, shape, (x) => x * sign > 0 && Math.abs(x) < reach);
  addEdges(points, shape, framing.flapEdge, 0);
  return points;
}

/** Adds where the outer corners of a leaf swing. */
function addSwing(
  points: number[],
  { width, height }: BookShape,
  isSeen: (x: number) => boolean,
): void {
  // Leaves no wider than typical ones stay within the margin.
  const wide = Math.min(Math.max((width / height - 0.7) / 0.3, 0), 1);
  const foot = -swing.dip * wide * width;
  for (let k = 1; k < 12; k++) {
    const angle = (k * Math.PI) / 12;
    const x = swing.across * width * Math.cos(angle);
    const z = swing.up * width * Math.sin(angle);
    if (!isSeen(x)) continue;
    points.push(x, height, z, x, foot, z);
  }
}

function closedPoints(shape: BookShape, framing: Framing, sign: number, rim: number): number[] {
  const points: number[] = [];
  for (const x of [-rim, shape.width + rim]) {
    for (const y of [-rim, shape.height + rim]) {
      for (const z of [0, shape.thickness + rim]) points.push(sign * x, y, z);
    }
  }
  addBoards(points, shape, framing, rim);
  return points;
}

function addBoards(points: number[], shape: BookShape, framing: Framing, rim: number): void {
  addEdges(points, shape, framing.boardEdges, rim);
  addEdges(points, shape, framing.flapEdge, 0);
}

/** Adds the ends of edges along the spine, given by their x and z. */
function addEdges(points: number[], shape: BookShape, edges: number[], rim: number): void {
  for (let k = 0; k < edges.length; k += 2) {
    for (const y of [-rim, shape.height + rim]) points.push(edges[k], y, edges[k + 1]);
  }
}

function along(axis: readonly number[], points: readonly number[], k: number): number {
  return axis[0] * points[k] + axis[1] * points[k + 1] + axis[2] * points[k + 2];
}

function ease(t: number): number {
  const c = Math.min(1, Math.max(0, t));
  return c * c * (3 - 2 * c);
}
