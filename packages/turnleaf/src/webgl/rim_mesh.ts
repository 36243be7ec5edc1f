/** The edges of a thick leaf in flight: head, fore-edge and foot of a leaf of board or card. */

import { type BufferGeometry, Mesh } from "three";
import type { Surface } from "../engine/shapes.ts";
import { SolidGeometry } from "./solid_geometry.ts";
import type { SolidMaterial } from "./solid_material.ts";

/** The rim of a leaf. */
export class RimMesh {
  readonly mesh: Mesh<BufferGeometry, SolidMaterial>;
  #solid = new SolidGeometry(0, 0);
  #points = 0;

  constructor(material: SolidMaterial) {
    this.mesh = new Mesh(this.#solid.geometry, material);
    this.mesh.frustumCulled = false;
  }

  /** Follows the leaf; a thin one has no rim. */
  shape(leaf: Surface): void {
    const thickness = leaf.thickness ?? 0;
    this.mesh.visible = thickness > 0;
    if (thickness === 0) return;
    const { positions, normals, columns, rows } = leaf;
    const around = edgeOf(columns, rows);
    this.#allot(around.length);
    const solid = this.#solid;
    for (const [k, point] of around.entries()) {
      const [before, after] = [
        around[Math.max(k - 1, 0)],
        around[Math.min(k + 1, around.length - 1)],
      ];
      const at = 3 * point;
      const [nx, ny, nz] = [normals[at], normals[at + 1], normals[at + 2]];
      const way = [0, 1, 2].map(
        (axis) => positions[3 * after + axis] - positions[3 * before + axis],
      );
      // Out of the leaf: across the edge and the leaf's normal.
      const out = [way[1] * nz - way[2] * ny, way[2] * nx - way[0] * nz, way[0] * ny - way[1] * nx];
      const length = Math.hypot(...out) || 1;
      for (const side of [0, 1]) {
        const off = (side - 0.5) * thickness;
        const to = 2 * k + side;
        solid.place(
          to,
          positions[at] + nx * off,
          positions[at + 1] + ny * off,
          positions[at + 2] + nz * off,
        );
        solid.face(to, out[0] / length, out[1] / length, out[2] / length);
        solid.open[2 * to] = 0.95;
        solid.open[2 * to + 1] = 0.85;
      }
    }
    solid.touch("position", "normal", "open");
  }

  dispose(): void {
    this.mesh.geometry.dispose();
  }

  #allot(points: number): void {
    if (points === this.#points) return;
    this.#points = points;
    this.mesh.geometry.dispose();
    const solid = new SolidGeometry(2 * points, 2 * (points - 1));
    solid.reserve(2 * points);
    solid.grid(0, 2, points, true);
    this.#solid = solid;
    this.mesh.geometry = solid.geometry;
  }
}

/**
 * Returns the points of a leaf's free edges, from the spine at the foot around
 * to the spine at the head.
 */
function edgeOf(columns: number, rows: number): number[] {
  const points: number[] = [];
  for (let column = 0; column < columns; column++) points.push(column);
  for (let row = 1; row < rows; row++) points.push(row * columns + columns - 1);
  for (let column = columns - 2; column >= 0; column--) points.push((rows - 1) * columns + column);
  return points;
}
