/**
 * Measurements of a sheet over a flat table: grids of points, x, y, z of each,
 * row by row from the foot.
 */

import { columnAt } from "../engine/shapes.ts";

/** Returns where a sheet has the place (u, v) of the leaf. */
export function placeOn(
  points: Float32Array,
  columns: number,
  rows: number,
  u: number,
  v: number,
): [x: number, y: number, z: number] {
  const [across, up] = [columnAt(u, columns), v * (rows - 1)];
  const column = Math.min(Math.floor(across), columns - 2);
  const row = Math.min(Math.floor(up), rows - 2);
  const [s, t] = [across - column, up - row];
  const at = 3 * (row * columns + column);
  const above = at + 3 * columns;
  const along = (k: number): number => {
    const low = points[at + k] + s * (points[at + 3 + k] - points[at + k]);
    const high = points[above + k] + s * (points[above + 3 + k] - points[above + k]);
    return low + t * (high - low);
  };
  return [along(0), along(1), along(2)];
}

/** Returns how far the fore-edge has turned on the whole, from 0 on the right to 1 on the left. */
export function fractionTurned(points: Float32Array, columns: number, rows: number): number {
  let sum = 0;
  for (let row = 1; row <= rows; row++) {
    const edge = 3 * (row * columns - 1);
    sum += Math.atan2(Math.max(points[edge + 2], 0), points[edge]);
  }
  return sum / (rows * Math.PI);
}

/** Heights of the fore-edge, as fractions of the width, between which a leaf is about to land. */
const down = [0.01, 0.12] as const;

/** Returns how far a leaf has landed: 1 flat on a side, 0 from a few centimetres above it on. */
export function lying(points: Float32Array, columns: number, rows: number, width: number): number {
  let highest = 0;
  for (let row = 1; row <= rows; row++) {
    highest = Math.max(highest, points[3 * (row * columns - 1) + 2]);
  }
  const t = Math.min(Math.max((highest / width - down[0]) / (down[1] - down[0]), 0), 1);
  return 1 - t * t * (3 - 2 * t);
}
