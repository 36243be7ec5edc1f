/** The outlines of the parts of leaves between creases: straight edges, as shadows need them. */

import type { PaperMesh } from "../paper_mesh.ts";
import { mostPaperEdges, type Surface } from "./shapes.ts";

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

/** What an edge that is not straight may take from its part's area, or add to it. */
const crooked = 0.01;

/**
 * Mean of how far in paper is ragged where it is torn from the spine, metres, as `raggedness` in the shader of
 * `webgl/paper_material.ts` has it. Across a page its edge wanders as far to either side of the tear, less than
 * `BEYOND` of the engine's `models/sheet/torn.rs`, by which either piece is drawn beyond that.
 */
export const meanTornDepth = 0.00085;

const ofMeshes = new WeakMap<PaperMesh, readonly PartOutline[]>();
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
    edges: edges.map((points, k) => ({ points, beyond: -1, inset: k === 3 ? meanTornDepth : 0 })),
  };
}

/** Traces the rims of a mesh's parts. */
function traced(mesh: PaperMesh): PartOutline[] {
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

/**
 * Returns the places in a closed chain of points that are the corners of its outline: those that
 * change its area least go one after the other (Visvalingam and Whyatt 1993), hollows first.
 */
function cornersOf({ places }: PaperMesh, loop: readonly number[]): readonly number[] {
  const corners = [...loop.keys()];
  const [u, v] = [0, 1].map((axis) => (k: number) => places[2 * loop[k] + axis]);
  /** Twice the area of the triangle of three places. */
  const area = (i: number, j: number, k: number): number =>
    (u(j) - u(i)) * (v(k) - v(i)) - (v(j) - v(i)) * (u(k) - u(i));
  const whole = corners.reduce((sum, k) => sum + area(0, k, (k + 1) % loop.length), 0);
  while (corners.length > 2) {
    const areas = corners.map((at, k) =>
      area(corners.at(k - 1) as number, at, corners[(k + 1) % corners.length]),
    );
    const least = Math.min(...areas);
    if (least > crooked * whole && corners.length <= mostPaperEdges) break;
    corners.splice(areas.indexOf(least), 1);
  }
  return corners;
}

/** Returns how far within its points an edge that is torn ends, metres. */
function insetOf({ places, tears }: PaperMesh, points: readonly number[]): number {
  if (points.every((point) => places[2 * point] === 0)) return meanTornDepth;
  if (tears === undefined) return 0;
  return points.reduce((sum, point) => sum - Math.min(0, tears[3 * point]), 0) / points.length;
}
