/** The outlines of the parts of leaves between creases: straight edges, as shadows need them. */

import type { CreasedMesh } from "../creased_mesh.ts";
import type { Surface } from "../engine/shapes.ts";

/** The edges of an outline, at most: a page without two corners has six. */
export const mostEdges = 6;

/** An edge of a part: the points from one corner to the next. */
export interface OutlineEdge {
  readonly points: readonly number[];
  /** The part that it is creased to there; -1 where paper ends. */
  readonly beyond: number;
  /** How far within these points paper ends on average, metres: where it is torn. */
  readonly inset: number;
}

/** The outline of a part that lies in one piece. */
export interface PartOutline {
  readonly part: number;
  readonly edges: readonly OutlineEdge[];
}

/** How far from straight an edge may be, over the length of its part. */
const crooked = 0.02;

/** Mean of how far in paper is ragged where it is torn from the spine, metres, as `raggedness` in the shader has it. */
const ragged = 0.00085;

const ofMeshes = new WeakMap<CreasedMesh, readonly PartOutline[]>();
const ofGrids = new Map<string, readonly PartOutline[]>();

/** Returns the outlines of a leaf's parts; those of a leaf that is not creased, from its grid. */
export function outlinesOf({ creased, columns, rows }: Surface): readonly PartOutline[] {
  const grid = `${columns} ${rows}`;
  let outlines = creased ? ofMeshes.get(creased) : ofGrids.get(grid);
  if (outlines === undefined) {
    outlines = creased ? traced(creased) : [gridOutline(columns, rows)];
    if (creased) ofMeshes.set(creased, outlines);
    else ofGrids.set(grid, outlines);
  }
  return outlines;
}

function gridOutline(columns: number, rows: number): PartOutline {
  const row = [...Array(columns).keys()];
  const column = [...Array(rows).keys()];
  const last = columns * (rows - 1);
  const edges = [
    row,
    column.map((k) => columns * k + columns - 1),
    row.map((k) => last + k).reverse(),
    column.map((k) => columns * k).reverse(),
  ];
  return {
    part: 0,
    edges: edges.map((points, k) => ({ points, beyond: -1, inset: k === 3 ? ragged : 0 })),
  };
}

/** Traces the rims of a mesh's parts. */
function traced(mesh: CreasedMesh): PartOutline[] {
  const { triangles, parts } = mesh;
  const key = (a: number, b: number) => a * 0x10000 + b;
  /** The part to the left of each edge of a triangle. */
  const left = new Map<number, number>();
  const around = (triangle: number): readonly (readonly [number, number])[] => {
    const [a, b, c] = triangles.subarray(3 * triangle, 3 * triangle + 3);
    return [
      [a, b],
      [b, c],
      [c, a],
    ];
  };
  for (let k = 0; k < parts.length; k++) {
    for (const [a, b] of around(k)) left.set(key(a, b), parts[k]);
  }
  const next = new Map<number, Map<number, number>>();
  for (let k = 0; k < parts.length; k++) {
    for (const [a, b] of around(k)) {
      if (left.get(key(b, a)) === parts[k]) continue;
      const rim = next.get(parts[k]) ?? new Map<number, number>();
      next.set(parts[k], rim.set(a, b));
    }
  }
  const found: PartOutline[] = [];
  for (const [part, rim] of next) {
    while (rim.size > 0) {
      const loop: number[] = [];
      let [at] = rim.keys();
      for (let to = rim.get(at); to !== undefined; to = rim.get(at)) {
        loop.push(at);
        rim.delete(at);
        at = to;
      }
      const corners = cornersOf(mesh, loop);
      if (corners.length < 3) continue;
      const edges = corners.map((from, k): OutlineEdge => {
        const points = [...loop.slice(from), ...loop];
        points.length =
          ((corners[(k + 1) % corners.length] - from + loop.length) % loop.length) + 1;
        const middle = points.length >> 1;
        const beyond = left.get(key(points[middle], points[middle - 1])) ?? -1;
        return { points, beyond, inset: beyond < 0 ? insetOf(mesh, points) : 0 };
      });
      found.push({ part, edges });
    }
  }
  return found;
}

/** Returns the places in a closed chain of points that are the corners of its outline. */
function cornersOf({ places }: CreasedMesh, loop: readonly number[]): readonly number[] {
  const of = (k: number) => [places[2 * loop[k]], places[2 * loop[k] + 1]] as const;
  /** Twice the area of the triangle of three of them. */
  const turn = (i: number, j: number, k: number): number => {
    const [[ax, ay], [bx, by], [cx, cy]] = [of(i), of(j), of(k)];
    return (bx - ax) * (cy - ay) - (by - ay) * (cx - ax);
  };
  const between = (i: number, k: number) => Math.hypot(of(k)[0] - of(i)[0], of(k)[1] - of(i)[1]);
  const all = [...loop.keys()];
  const farthest = (from: number) =>
    all.reduce((best, k) => (between(from, k) > between(from, best) ? k : best), from);
  const [one, other] = [farthest(0), farthest(farthest(0))].sort((a, b) => a - b);
  // Ramer, Douglas and Peucker's: what is far from straight between two corners has one more.
  const inside = (from: number, to: number, off: number): number[] => {
    let [best, far] = [from, 0];
    for (let k = from + 1; k < to; k++) {
      const here = k % loop.length;
      const away = Math.abs(turn(from, here, to % loop.length)) / between(from, to % loop.length);
      if (away > far) [best, far] = [k, away];
    }
    return far > off ? [...inside(from, best, off), best, ...inside(best, to, off)] : [];
  };
  for (let off = crooked * between(one, other); ; off *= 1.5) {
    let corners = [
      one,
      ...inside(one, other, off),
      other,
      ...inside(other, one + loop.length, off).map((k) => k % loop.length),
    ];
    // Round a hollow one goes straight on.
    corners = corners.filter((at, k) => {
      const [before, after] = [corners.at(k - 1), corners[(k + 1) % corners.length]];
      return turn(before as number, at, after) > 0;
    });
    if (corners.length <= mostEdges) return corners;
  }
}

/** Returns how far within its points an edge that is torn ends, metres. */
function insetOf({ places, tears }: CreasedMesh, points: readonly number[]): number {
  if (points.every((point) => places[2 * point] === 0)) return ragged;
  if (tears === undefined) return 0;
  return points.reduce((sum, point) => sum - Math.min(0, tears[3 * point]), 0) / points.length;
}
