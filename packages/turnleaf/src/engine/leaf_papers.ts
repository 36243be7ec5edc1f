/** The paper of leaves that lies on other paper, as it shades what is under it. */

import { foldedParts, hingesIn, isShut, normalOf } from "./hinges.ts";
import { outlinesOf, type PartOutline } from "./part_outlines.ts";
import { type LeafPapers, type Paper, paperNumbers, type Surface } from "./shapes.ts";

/** The height, metres, above which what is not carried shades nothing beyond its own leaf. */
const reach = 0.02;

/** Of what shades at any height. */
const boundless = 1e3;

/** More parts than these have no outlines that matter: a ball of paper. */
const mostParts = 12;

/** What surfaces that may lie on paper have as `papers`. */
export const leafPapers: LeafPapers = { foldedParts, flapsOn, flapsOf, papersOf };

/**
 * Returns what is folded over onto the parts of a leaf, on one of its sides: each shades the part
 * that it is creased to, but for one that stands open: bent, it would shade itself.
 *
 * @param sign 1 for the recto, -1 for the verso
 */
function flapsOn(leaf: Surface, sign: 1 | -1): readonly Paper[] {
  const { creased, positions } = leaf;
  if (!creased || isBall(leaf)) return [];
  return hingesIn(creased).flatMap((hinge) => {
    const { part, parent, sides } = hinge;
    if (!isShut(hinge, creased, positions)) return [];
    return outlinesOf(leaf).flatMap((outline) => {
      if (outline.part !== part) return [];
      // Beside the crease: farther off a bent leaf is on either side of what it is folded to.
      let rise = 0;
      for (const [own, parents] of sides) {
        const normal = normalOf(creased, positions, parents);
        for (let corner = 0; corner < 3; corner++) {
          const [a, b] = [own, parents].map((k) => 3 * creased.triangles[3 * k + corner]);
          for (let axis = 0; axis < 3; axis++) {
            rise += (positions[a + axis] - positions[b + axis]) * normal[axis];
          }
        }
      }
      return rise * sign > 0 ? [paperOf(positions, outline, boundless, parent)] : [];
    });
  });
}

/** Returns what is folded over of a leaf, as it shades other leaves close under it. */
function flapsOf(leaf: Surface): readonly Paper[] {
  const folded = foldedParts(leaf);
  if (folded.length === 0) return [];
  return outlinesOf(leaf)
    .filter(({ part }) => folded.includes(part))
    .map((outline) => paperOf(leaf.positions, outline, reach, -1));
}

/**
 * Returns the parts of a loose sheet, as they shade what is under it.
 *
 * @param lies if true, it shades only what it lies on, or nearly so
 */
function papersOf(sheet: Surface, lies = false): readonly Paper[] {
  const to = lies ? reach : boundless;
  if (isBall(sheet)) return [paperOf(...boxOf(sheet), to, -1)];
  return outlinesOf(sheet).map((outline) => paperOf(sheet.positions, outline, to, -1));
}

function isBall({ creased }: Surface): boolean {
  return creased?.parts.some((part) => part > mostParts) ?? false;
}

/** Returns the rectangle about what is crumpled, along its first row, at its middle height. */
function boxOf({ positions, columns }: Surface): [Float32Array, PartOutline] {
  const [x, y] = [0, 1].map((axis) => positions[3 * columns - 3 + axis] - positions[axis]);
  const length = Math.hypot(x, y) || 1;
  const axes = [
    [x / length, y / length],
    [-y / length, x / length],
  ] as const;
  const [low, high] = [boundless, -boundless].map((far) => axes.map(() => far));
  let z = 0;
  for (let at = 0; at < positions.length; at += 3) {
    for (const [k, [dx, dy]] of axes.entries()) {
      const out = dx * positions[at] + dy * positions[at + 1];
      low[k] = Math.min(low[k], out);
      high[k] = Math.max(high[k], out);
    }
    z += (3 * positions[at + 2]) / positions.length;
  }
  // Six corners, about as far out as it is wide.
  const corners = [0, 1, 2, 3, 4, 5].flatMap((k) => {
    const angle = (k * Math.PI) / 3;
    const [a, b] = [Math.cos(angle), Math.sin(angle)].map(
      (out, axis) => (low[axis] + high[axis] + 1.1 * out * (high[axis] - low[axis])) / 2,
    );
    return [a * axes[0][0] + b * axes[1][0], a * axes[0][1] + b * axes[1][1], z];
  });
  const edges = [0, 1, 2, 3, 4, 5].map((k) => ({ points: [k, (k + 1) % 6], beyond: -1, inset: 0 }));
  return [Float32Array.from(corners), { part: 0, edges }];
}

/** @param onto the part of its leaf that it shades; -1 for any */
function paperOf(positions: Float32Array, { edges }: PartOutline, to: number, onto: number): Paper {
  const at = (point: number) => positions.subarray(3 * point, 3 * point + 3);
  const corners = edges.map(({ points }) => at(points[0]));
  const normal = [0, 0, 0];
  const middle = [0, 0, 0];
  for (const [k, a] of corners.entries()) {
    const b = corners[(k + 1) % corners.length];
    for (let axis = 0; axis < 3; axis++) {
      const [i, j] = [(axis + 1) % 3, (axis + 2) % 3];
      normal[axis] += (a[i] - b[i]) * (a[j] + b[j]);
      middle[axis] += a[axis] / corners.length;
    }
  }
  // Newell's normal turns with the second of the pair: it looks up here.
  const long = Math.hypot(...normal) * (normal[2] < 0 ? -1 : 1) || 1;
  const plane = normal.map((n) => n / long);
  const off = dot(plane, middle);
  const rise = Math.max(plane[2], 1e-3);
  /** How far above the plane a point is, straight up. */
  const over = (p: ArrayLike<number>) => (dot(plane, p) - off) / rise;
  const data = new Float32Array(paperNumbers);
  data.set([...plane.slice(0, 2), rise, off]);
  let wide = Number.POSITIVE_INFINITY;
  for (const [k, { points, beyond, inset }] of edges.entries()) {
    const [a, b] = [corners[k], corners[(k + 1) % corners.length]];
    const along = [0, 1, 2].map((axis) => b[axis] - a[axis]);
    const length = Math.hypot(...along) || 1;
    const to = 4 * (2 + 3 * k);
    const inward = across(
      along.map((x) => x / length),
      middle.map((m, axis) => m - a[axis]),
    );
    const within = dot(inward, a) + inset;
    // Two thirds of its height is the mean of a parabola through both ends.
    let bow = 0;
    for (const p of points) bow += (1.5 * (dot(inward, at(p)) - dot(inward, a))) / points.length;
    wide = Math.min(wide, dot(inward, middle) - within);
    // Of a crease its own leaf sees no edge.
    if (onto >= 0 && beyond === onto) data[to + 3] = -boundless;
    else data.set([...inward, within], to);
    data.set(
      along.map((x) => x / length ** 2),
      to + 4,
    );
    data[to + 7] = dot(along, a) / length ** 2;
    const [p, m, q] = [over(a), over(at(points[points.length >> 1])), over(b)];
    // A parabola through what is over the plane at its ends and its middle.
    const bend = points.length > 2 ? 2 * (p + q - 2 * m) : 0;
    data.set([p, q - p - bend, bend, 4 * bow], to + 8);
  }
  const all = edges.flatMap(({ points }) => points.map(at));
  // What is bent far from its plane, or if only what lies shades, stands, shades nothing in it.
  const bent = all.reduce((most, p) => Math.max(most, Math.abs(over(p))), 0) / Math.max(wide, 1e-4);
  const steep = to > reach ? 0 : (1 - plane[2]) / (1 - Math.SQRT1_2);
  const flat = (1 - smooth(4 * bent - 0.6)) * (1 - smooth(steep));
  data.set([onto < 0 ? -1 - flat : onto, to, Math.max(wide, 1e-4), edges.length], 4);
  const extreme = (axis: number, pick: typeof Math.max) => pick(...all.map((p) => p[axis]));
  return {
    data,
    low: [extreme(0, Math.min), extreme(1, Math.min)],
    high: [extreme(0, Math.max), extreme(1, Math.max)],
    top: extreme(2, Math.max),
  };
}

function smooth(x: number): number {
  const t = Math.min(Math.max(x, 0), 1);
  return t * t * (3 - 2 * t);
}

const dot = (a: ArrayLike<number>, b: ArrayLike<number>): number =>
  a[0] * b[0] + a[1] * b[1] + a[2] * b[2];

/** Returns the direction of what is left of a way across another of unit length. */
function across(along: readonly number[], way: readonly number[]): readonly number[] {
  const part = dot(along, way);
  const rest = way.map((x, axis) => x - part * along[axis]);
  const length = Math.hypot(...rest) || 1;
  return rest.map((x) => x / length);
}
