/** The fold of a peeled leaf, drawn as the line that it is. */

import type { Vec3 } from "../engine/shapes.ts";

/**
 * Distance of the folded part above the rest as drawn, metres: points closer
 * than a tenth of it are raised off the page with it.
 */
const apart = 5e-4;

/** How round the fold is lit: sine of its edge's tilt. */
const round = 0.75;

/**
 * Moves the points of a peeled leaf that are nearest to its fold onto the fold,
 * so that it is a clean line rather than as ragged as the mesh. The folded part
 * is raised above the rest.
 *
 * @param points of the leaf over a flat table, x, y, z, row by row from the
 * foot
 * @param columns u of each column
 * @param width,height of the leaf, metres; the width is negative if it lay on
 * the left
 * @returns the normal of each point at the fold by its number, on the recto's
 * side
 */
export function cleanFold(
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
  // The point that is folded over farthest locates the fold best.
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
  // The folded part shows its verso; of a leaf that lay on the left, its recto.
  const seen = width < 0 ? 1 : -1;
  for (let at = 0; at < across * rows; at++) {
    const [x, y] = flat(at);
    const column = at % across;
    const next = columns[Math.min(column + 1, across - 1)] - columns[Math.max(column - 1, 0)];
    const beyond = nx * x + ny * y - fold;
    const isForeEdge = column === across - 1;
    const isFootOrHead = at < across || at >= across * (rows - 1);
    // Half of the longest way over an edge of the mesh, along the fold's
    // normal. Points on the outline move to the fold along it, or the fold
    // would end in a notch or a spike.
    const wide = Math.abs(nx * width) * (isForeEdge ? next : 0.5 * next);
    const tall = (Math.abs(ny) * height) / (rows - 1);
    const near = 0.55 * (wide + tall);
    const reach = 0.55 * ((isForeEdge ? 0 : wide) + (isFootOrHead ? 0 : tall));
    if (Math.abs(beyond) < reach && column > 0) {
      normals.set(at, [seen * round * nx, seen * round * ny, seen * Math.sqrt(1 - round * round)]);
      points[3 * at] = isForeEdge ? x : x - beyond * (isFootOrHead ? 1 / nx : nx);
      points[3 * at + 1] = isFootOrHead ? y : y - beyond * (isForeEdge ? 1 / ny : ny);
      points[3 * at + 2] = 0.5 * apart;
    } else if (beyond > 0) {
      points[3 * at + 2] += apart;
      if (beyond < 3 * near) normals.set(at, [0, 0, seen]);
    }
  }
  return normals;
}
