/**
 * The classic peel of a flat leaf. The held point of the leaf rests at one
 * place and is pulled to another; the leaf folds along the line half-way
 * between the two, and the part beyond that line is mirrored in it. Lengths
 * in metres, x across the spine, y along it; the spine lies at x = 0 from y = 0
 * to `height`.
 */

/** A place on the table. */
export type Point = readonly [x: number, y: number];

/** The line along which a leaf is folded. */
export interface FoldLine {
  /** A point on it. */
  readonly at: Point;
  /** Unit vector across it, toward where the lifted part came from. */
  readonly normal: Point;
}

/**
 * Iterations that bring a place into both circles: the remaining error is less
 * than a hair's breadth.
 */
const rounds = 8;

/**
 * Returns the place nearest to `to` to which a point resting at `rest` can be
 * pulled without tearing the leaf from its spine: no farther from either end of
 * the spine than it rests.
 */
export function withinReach(rest: Point, to: Point, height: number): Point {
  let [x, y] = to;
  for (let round = 0; round < rounds; round++) {
    for (const end of [0, height]) {
      const reach = Math.hypot(rest[0], rest[1] - end);
      const apart = Math.hypot(x, y - end);
      if (apart <= reach) continue;
      x *= reach / apart;
      y = end + ((y - end) * reach) / apart;
    }
  }
  return [x, y];
}

/**
 * Returns the fold line of a leaf held at a place, where `rest` is the resting
 * place of the held point; null while it rests.
 */
export function foldLineOf(rest: Point, held: Point): FoldLine | null {
  const [dx, dy] = [rest[0] - held[0], rest[1] - held[1]];
  const apart = Math.hypot(dx, dy);
  if (apart < 1e-6) return null;
  return {
    at: [(rest[0] + held[0]) / 2, (rest[1] + held[1]) / 2],
    normal: [dx / apart, dy / apart],
  };
}

/** Returns how far a point is beyond a fold line, on the lifted side; negative on the other. */
export function beyond({ at, normal }: FoldLine, [x, y]: Point): number {
  return (x - at[0]) * normal[0] + (y - at[1]) * normal[1];
}

/** Returns a point mirrored in a fold line. */
export function mirrored(line: FoldLine, point: Point): Point {
  const twice = 2 * beyond(line, point);
  return [point[0] - twice * line.normal[0], point[1] - twice * line.normal[1]];
}

/** Returns the part of a convex polygon that is beyond a fold line (1), or before it (-1). */
export function partOf(polygon: readonly Point[], line: FoldLine, side: 1 | -1): Point[] {
  const part: Point[] = [];
  for (const [k, here] of polygon.entries()) {
    const next = polygon[(k + 1) % polygon.length];
    const [a, b] = [side * beyond(line, here), side * beyond(line, next)];
    if (a >= 0) part.push(here);
    if (a * b < 0) {
      const fraction = a / (a - b);
      part.push([
        here[0] + (next[0] - here[0]) * fraction,
        here[1] + (next[1] - here[1]) * fraction,
      ]);
    }
  }
  return part;
}
