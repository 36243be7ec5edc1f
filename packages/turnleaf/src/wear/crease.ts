/** The fold of a peeled leaf, drawn as the line that it is. */

import type { Vec3 } from "../engine/shapes.ts";

/** How far the folded part is drawn over the rest, metres: what is nearer than a tenth of that is lifted off the page with it. */
const apart = 5e-4;

/** How far light takes the fold for round: sine of its edge's tilt. */
const round = 0.75;

/**
 * Draws the points of a peeled leaf that are nearest to its fold on the fold: it
 * is a clean line then, where it would else be as ragged as the mesh. What is
 * folded over is lifted clear of the rest.
 *
 * @param points of the leaf over a flat table, x, y, z, row by row from the foot
 * @param columns u of each column
 * @param width,height of the leaf, metres; the width negative where it lay on the left
 * @returns by the number of each point about the fold its normal there, on the recto's side
 */
export function crease(
  points: Float32Array,
  columns: Float32Array,
  width: number,
  height: number,
): Map<number, Vec3> {
  const across = columns.length;
  const rows = points.length / (3 * across);
  const flat = (at: number): [x: number, y: number] => [
    columns[at % across] * width,
    (Math.floor(at / across) / (rows - 1)) * height,
  ];
  // Of all points the one that is folded over farthest says best where the fold is.
  let [most, nx, ny, fold] = [1e-6, 0, 0, 0];
  for (let at = 0; at < across * rows; at++) {
    const [x, y] = flat(at);
    const [dx, dy] = [x - points[3 * at], y - points[3 * at + 1]];
    const way = Math.hypot(dx, dy);
    if (way <= most) continue;
    [most, nx, ny] = [way, dx / way, dy / way];
    fold = nx * (x - dx / 2) + ny * (y - dy / 2);
  }
  const normals = new Map<number, Vec3>();
  if (fold === 0 && nx === 0) return normals;
  // What is folded over shows its verso; of a leaf that lay on the left, its recto.
  const seen = width < 0 ? 1 : -1;
  const up = (Math.abs(ny) * height) / (rows - 1);
  for (let at = 0; at < across * rows; at++) {
    const [x, y] = flat(at);
    const column = at % across;
    const next = columns[Math.min(column + 1, across - 1)] - columns[Math.max(column - 1, 0)];
    const beyond = nx * x + ny * y - fold;
    // Half of the longest way over an edge of the mesh, along the fold's normal.
    const near = 0.55 * (Math.abs(nx * width) * (column % (across - 1) ? 0.5 * next : next) + up);
    if (Math.abs(beyond) < near && column > 0) {
      normals.set(at, [seen * round * nx, seen * round * ny, seen * Math.sqrt(1 - round * round)]);
      points[3 * at] = x - beyond * nx;
      points[3 * at + 1] = y - beyond * ny;
      points[3 * at + 2] = 0.5 * apart;
    } else if (beyond > 0) {
      points[3 * at + 2] += apart;
      if (beyond < 3 * near) normals.set(at, [0, 0, seen]);
    }
  }
  return normals;
}
