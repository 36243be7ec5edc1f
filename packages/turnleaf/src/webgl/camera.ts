/**
 * Where the camera stands so that the book fills the canvas. Pure arithmetic,
 * no three.js.
 *
 * An open book fills its place but for a margin, and the camera is as far away as
 * it must be for a leaf that stands upright to stay within that margin: the
 * farther it is, the less larger what is nearer to it appears. So the book stays
 * as large and where it is when a leaf is grabbed, and nothing of the leaf is cut off
 * (docs/decisions/0016-the-book-stands-still.md).
 */

import type { BookShape } from "../stage/book_pose.ts";
import { type CanvasFraction, overheadAt, type Sight } from "../stage/zoom.ts";

/** The camera's place and its three axes in book space. */
export interface View {
  position: [number, number, number];
  right: [number, number, number];
  up: [number, number, number];
  /** Out of the picture, toward the reader. */
  back: [number, number, number];
  /** From the camera to the middle of the book, metres. */
  distance: number;
  /** Half the height that the camera sees at a distance of 1. */
  lens: number;
}

/** Points that are to be seen, and how far from the edges of the canvas. */
export interface FittedPoints {
  /** x, y, z of each. */
  readonly points: readonly number[];
  /** Fraction of the canvas that stays free at each edge. */
  readonly margin: number;
}

type Axes = Pick<View, "right" | "up" | "back">;

/** Place across the picture, along it, and distance from the origin: the result of a fit. */
type Fit = [across: number, along: number, distance: number];

/**
 * How far the camera leans from right above to a closed book in boards, and to
 * the side of its spine, degrees: enough to see that it has a spine.
 */
const closedTilt = 12;
const closedAzimuth = 6;

const radians = Math.PI / 180;

/**
 * Half the height seen at a distance of 1: at most that of a field of view of 12
 * degrees, as wider lenses make pages that lie at different heights differ in
 * size; and at least a tenth of it, as the precision of depth has an end.
 */
export const widestLens: number = Math.tan(6 * radians);
const longestLens = widestLens / 10;

/** Returns the vertical field of view of a lens, degrees. */
export function fieldOfView(lens: number): number {
  return (2 * Math.atan(lens)) / radians;
}

/** Width visible beyond the spine beside a page that stands alone, as a fraction of its width. */
const sliver = 0.03;

/**
 * Half axes of the ellipse in which the outer edge of a leaf swings about the
 * spine, as fractions of the leaf's width; a leaf stretched upright by a
 * pointer comes within one hundredth of the upper. And how far beyond the foot
 * the edge of a wide leaf hangs that is led by its head, likewise.
 */
const swing = { across: 0.97, up: 0.96, dip: 0.07 };

/**
 * How far a leaf that is led by its corner swings aslant beyond the head or foot of one that
 * swings evenly, as a fraction of the height of the picture: a usual leaf, and one as wide as high.
 */
const aslant = { usual: 0.01, wide: 0.0225 };

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

/** Of an open book that lies still. */
export const openFraming: Framing = {
  closedRight: 0,
  closedLeft: 0,
  middle: 0,
  boardEdges: [],
  flapEdge: [],
};

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
  const { alone, fromAbove, margin } = shape;
  const right = fromAbove ? 0 : ease(framing.closedRight);
  const left = fromAbove ? 0 : ease(framing.closedLeft);
  const closed = Math.min(1, right + left);
  const tilt = fromAbove ? 0 : shape.tilt;
  const leans = !fromAbove && shape.cover === "hard";
  const leaning = (1 - overhead) * (tilt + (leans ? (closedTilt - tilt) * closed : 0));
  const azimuth = (1 - overhead) * (leans ? closedAzimuth * (left - right) : 0);
  const axes = axesOf((90 - leaning) * radians, azimuth * radians, shape.quarterTurned);
  const lens = lensOf(shape, aspect, rim);
  const fitted = (points: number[], swings: boolean, hasBoards: boolean): Fit => {
    addEdges(points, shape, framing.flapEdge, 0);
    const moving: number[] = [];
    if (swings) addSwing(moving, shape, dipOf(shape));
    if (hasBoards) addEdges(moving, shape, framing.boardEdges, rim);
    const groups = [
      { points, margin },
      { points: moving, margin: 0 },
    ];
    return fitPoints(groups, axes, aspect, lens);
  };
  // Seen from right above, the lens is such that a leaf stays in the picture.
  const swings = tilt * (1 - overhead) > 0;
  const open =
    alone === 0
      ? fitted(openPoints(shape, framing, rim), swings, true)
      : fitted(alonePoints(shape, alone), swings, false);
  const fit: Fit = [...open];
  for (const [fraction, sign] of [
    [right, 1],
    [left, -1],
  ]) {
    if (fraction <= 0) continue;
    const shut = fitted(closedPoints(shape, sign, rim), false, true);
    for (let k = 0; k < 3; k++) fit[k] += (shut[k] - open[k]) * fraction;
  }
  return viewOf(fit, axes, lens);
}

/**
 * Returns the lens through which a leaf that swings stays in the picture of a book
 * that fills it but for its margin, seen from right above: the widest there is.
 */
function lensOf(shape: BookShape, aspect: number, rim: number): number {
  const { margin, alone } = shape;
  const { right, up, back } = axesOf(90 * radians, 0, shape.quarterTurned);
  const lying = alone === 0 ? openPoints(shape, openFraming, rim) : alonePoints(shape, alone);
  const swinging: number[] = [];
  addSwing(swinging, shape, 0);
  const [x0, x1] = extentOf(lying, right);
  const [y0, y1] = extentOf(lying, up);
  const [, top] = extentOf(lying, back);
  // Half the height that is seen at the height of the pages.
  const seen = Math.max(y1 - y0, (x1 - x0) / aspect) / (2 - 4 * margin);
  const hanging = aslant.usual + (aslant.wide - aslant.usual) * widenessOf(shape);
  let lens = widestLens;
  for (let k = 0; k < swinging.length; k += 3) {
    const x = Math.abs(along(right, swinging, k) - (x0 + x1) / 2);
    const y = Math.abs(along(up, swinging, k) - (y0 + y1) / 2) + 2 * hanging * seen;
    // What is nearer by a height sees so much less of the plane for each unit of the lens.
    const height = swinging[k + 2] - top;
    if (height > 0) lens = Math.min(lens, (seen - Math.max(y, x / aspect)) / height);
  }
  return Math.max(lens, longestLens);
}

function extentOf(points: readonly number[], axis: readonly number[]): [number, number] {
  const places = [];
  for (let k = 0; k < points.length; k += 3) places.push(along(axis, points, k));
  return [Math.min(...places), Math.max(...places)];
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
  const { position, right, up, back, lens } = view;
  const plane = shape.thickness / 2;
  const seen = (x: number, y: number): CanvasFraction => {
    const away = [x - position[0], y - position[1], plane - position[2]];
    const reach = -2 * lens * along(back, away, 0);
    return [0.5 + along(right, away, 0) / (reach * aspect), 0.5 - along(up, away, 0) / reach];
  };
  const point = ([x, y]: CanvasFraction): CanvasFraction => {
    const [across, rise] = [(2 * x - 1) * lens * aspect, (1 - 2 * y) * lens];
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
 * within its margin. Each bound is linear in the camera's position, so the
 * result is exact.
 *
 * @param lens half the height seen at a distance of 1
 */
export function fitPoints(
  groups: readonly FittedPoints[],
  axes: Axes,
  aspect: number,
  lens: number,
): Fit {
  const across = boundsOf(groups, axes.right, axes.back, lens * aspect);
  const above = boundsOf(groups, axes.up, axes.back, lens);
  const distance = Math.max(nearest(across), nearest(above));
  return [middleAt(across, distance), middleAt(above, distance), distance];
}

/**
 * Bounds of a camera at distance d whose picture holds points along an axis: its
 * middle is from `low - slope * d` to `slope * d + high`.
 */
interface Bounds {
  readonly slope: number;
  readonly low: number;
  readonly high: number;
}

/** Returns the bounds of each group along an axis, `half` of which is seen at a distance of 1. */
function boundsOf(
  groups: readonly FittedPoints[],
  axis: readonly number[],
  back: readonly number[],
  half: number,
): Bounds[] {
  return groups.map(({ points, margin }) => {
    const slope = half * (1 - 2 * margin);
    let [low, high] = [-Infinity, Infinity];
    for (let k = 0; k < points.length; k += 3) {
      const place = along(axis, points, k);
      const height = slope * along(back, points, k);
      low = Math.max(low, place + height);
      high = Math.min(high, place - height);
    }
    return { slope, low, high };
  });
}

/** Returns the distance from which on there is a middle within all bounds. */
function nearest(bounds: readonly Bounds[]): number {
  const apart = bounds.flatMap(({ slope, low }) =>
    bounds.map((other) => (low - other.high) / (slope + other.slope)),
  );
  return Math.max(...apart);
}

/** Returns the middle between the bounds at a distance. */
function middleAt(bounds: readonly Bounds[], distance: number): number {
  const low = Math.max(...bounds.map(({ slope, low }) => low - slope * distance));
  const high = Math.min(...bounds.map(({ slope, high }) => slope * distance + high));
  return (low + high) / 2;
}

function viewOf(fit: Fit, axes: Axes, lens: number): View {
  const place = (k: number): number =>
    axes.right[k] * fit[0] + axes.up[k] * fit[1] + axes.back[k] * fit[2];
  return { position: [place(0), place(1), place(2)], ...axes, distance: fit[2], lens };
}

/** Returns the corners of the open book. */
function openPoints(
  { width, height, thickness }: BookShape,
  framing: Framing,
  rim: number,
): number[] {
  const reach = width + rim + thickness / 2;
  const points: number[] = [];
  for (const x of [framing.middle - reach, framing.middle + reach]) {
    for (const y of [-rim, height + rim]) points.push(x, y, 0, x, y, thickness / 2);
  }
  return points;
}

/** Returns the corners of one page and of its board; a sliver beyond its spine is in the margin. */
function alonePoints({ width, height, thickness, rim }: BookShape, sign: number): number[] {
  const points: number[] = [];
  for (const x of [0, sign * (width + rim)]) {
    for (const y of [-rim, height + rim]) points.push(x, y, 0, x, y, thickness);
  }
  return points;
}

/** Returns how far beyond the foot a leaf hangs that is led by its head, metres: nothing for usual ones. */
function dipOf(shape: BookShape): number {
  return swing.dip * shape.width * widenessOf(shape);
}

/** Returns 0 for usual leaves, to 1 for those that are as wide as high, or wider. */
function widenessOf({ width, height }: BookShape): number {
  return Math.min(Math.max((width / height - 0.7) / 0.3, 0), 1);
}

/**
 * Adds where the outer corners of a leaf swing: over a page that stands alone, until they are
 * upright.
 *
 * @param dip how far beyond the foot they hang, metres
 */
function addSwing(
  points: number[],
  { width, height, thickness, alone }: BookShape,
  dip: number,
): void {
  // Pages rise out of a thick book's gutter first, and reach less far.
  const reach = alone === 0 ? Number.POSITIVE_INFINITY : width - 0.35 * thickness;
  for (let k = 1; k < 12; k++) {
    const angle = (k * Math.PI) / 12;
    const x = swing.across * width * Math.cos(angle);
    const z = swing.up * width * Math.sin(angle);
    if (x * alone < 0 || Math.abs(x) > reach) continue;
    points.push(x, height, z, x, -dip, z);
  }
}

function closedPoints(shape: BookShape, sign: number, rim: number): number[] {
  const points: number[] = [];
  for (const x of [-rim, shape.width + rim]) {
    for (const y of [-rim, shape.height + rim]) {
      for (const z of [0, shape.thickness + rim]) points.push(sign * x, y, z);
    }
  }
  return points;
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
