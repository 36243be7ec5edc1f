/** The mesh of a crumpled sheet: flat facets, each with a part of its own, so that light breaks at their edges. */

import type { CreasedMesh } from "./shapes.ts";

/**
 * Returns the mesh of a sheet that the engine draws as facets: its nodes, one point between two of
 * them, and one in the middle of each cell, from which four facets reach to the cell's sides.
 *
 * @param columns points along a row, an odd number
 * @param rows points along the spine, an odd number
 */
export function facetsOf(columns: number, rows: number): CreasedMesh {
  const places = new Float32Array(2 * columns * rows);
  for (let point = 0; point < columns * rows; point++) {
    places[2 * point] = (point % columns) / (columns - 1);
    places[2 * point + 1] = Math.floor(point / columns) / (rows - 1);
  }
  const triangles: number[] = [];
  const parts: number[] = [];
  // Around the middle of a cell, as u to v does; each side is two edges.
  const around = [0, 1, 2, 2 + columns, 2 + 2 * columns, 1 + 2 * columns, 2 * columns, columns];
  for (let row = 0; row + 2 < rows; row += 2) {
    for (let column = 0; column + 2 < columns; column += 2) {
      const foot = row * columns + column;
      for (const [k, from] of around.entries()) {
        triangles.push(foot + 1 + columns, foot + from, foot + around[(k + 1) % around.length]);
        parts.push(parts.length >> 1);
      }
    }
  }
  return {
    places,
    triangles: Uint32Array.from(triangles),
    // Part 0 is what is not folded over, which no facet is.
    parts: Uint16Array.from(parts, (part) => part + 1),
  };
}
