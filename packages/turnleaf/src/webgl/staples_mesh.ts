/** The staples in the fold of a set of sheets: round wire, the lower half of which is in the paper. */

import { type BufferGeometry, Mesh } from "three";
import { stapleLegs, staples } from "../stage/staples.ts";
import type { PileShape } from "./pile_shape.ts";
import { SolidGeometry } from "./solid_geometry.ts";
import type { SolidMaterial } from "./solid_material.ts";

/** Points around the upper half of the wire. */
const around = 7;

/** Two staples, of two legs each. */
export class StaplesMesh {
  readonly mesh: Mesh<BufferGeometry, SolidMaterial>;
  readonly #solid: SolidGeometry;

  /** @param height of the pages, metres */
  constructor(material: SolidMaterial, height: number) {
    const legs = stapleLegs(height);
    const solid = new SolidGeometry(2 * around * legs.length, 2 * (around - 1) * legs.length);
    const radius = staples.wire / 2;
    for (const [from, to] of legs) {
      const first = solid.reserve(2 * around);
      for (let k = 0; k < around; k++) {
        const angle = (Math.PI * k) / (around - 1);
        const [x, z] = [-Math.cos(angle), Math.sin(angle)];
        for (const [row, y] of [from, to].entries()) {
          const point = first + row * around + k;
          solid.place(point, radius * x, y, radius * z);
          solid.face(point, x, 0, z);
        }
      }
      solid.grid(first, around, 2);
    }
    this.#solid = solid;
    this.mesh = new Mesh(solid.geometry, material);
    this.mesh.frustumCulled = false;
    this.mesh.visible = false;
  }

  /**
   * Lays them into the fold between the piles of both sides, or beside that of one.
   *
   * @param width of a page, metres
   */
  lie(piles: readonly PileShape[], width: number): void {
    const beside = piles
      .filter(({ present }) => present)
      .map((pile) => pile.pointAt(staples.wire / 2 / width)[1]);
    this.mesh.position.z = Math.max(...beside);
  }

  dispose(): void {
    this.#solid.geometry.dispose();
  }
}
