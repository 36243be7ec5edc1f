/**
 * The fold of an endpaper: if no leaf lies on a side, its pastedown continues
 * over the hinge into the gutter.
 */

import { type BufferGeometry, Mesh } from "three";
import { caseSizes } from "../stage/case_sizes.ts";
import type { CaseShape } from "./case_shape.ts";
import { type LightFractions, lightBetween } from "./light.ts";
import type { PileShape } from "./pile_shape.ts";
import { SolidGeometry } from "./solid_geometry.ts";
import type { SolidMaterial } from "./solid_material.ts";

const steps = 9;
/** Width of the fold as a fraction of a page's. */
const foldFraction = 0.07;
const noLid = [0, 0, 0] as const;

/** The fold on one side. */
export class EndpaperMesh {
  readonly mesh: Mesh<BufferGeometry, SolidMaterial>;
  readonly #sign: 1 | -1;
  readonly #height: number;
  readonly #solid = new SolidGeometry(2 * steps, 2 * (steps - 1));
  readonly #line = new Float32Array(2 * steps);
  readonly #light: LightFractions = { left: 0, right: 0, sky: 1, key: 1 };

  /** @param sign -1 on the left, by the front board; 1 on the right, by the back board */
  constructor(material: SolidMaterial, sign: 1 | -1, height: number) {
    this.#sign = sign;
    this.#height = height;
    this.#solid.reserve(2 * steps);
    this.#solid.grid(0, steps, 2, sign === -1);
    this.mesh = new Mesh(this.#solid.geometry, material);
    this.mesh.frustumCulled = false;
  }

  /** Follows the case, and computes the light between the piles. */
  shape(shape: CaseShape, left: PileShape, right: PileShape): void {
    const front = this.#sign === -1;
    const hinge = front ? shape.frontHinge : shape.backHinge;
    const corner = front ? shape.d : shape.c;
    const solid = this.#solid;
    const piles = [left.obstacles, right.obstacles];
    const block = front ? right : left;
    // A board that stands pulls the fold a little way onto the page.
    const onto = 0.6 * Math.sin(front ? shape.frontAngle : shape.backAngle);
    const root = [0, -caseSizes.sink].map((empty, k) =>
      block.present
        ? block.curves[k] + onto * (block.curves[10 + k] - block.curves[k]) + empty
        : empty,
    );
    for (let i = 0; i < steps; i++) {
      // From beneath the uppermost page's root to a little way up the board.
      const t = (1.3 * i) / (steps - 1) - 0.3;
      for (const k of [0, 1] as const) {
        const end = corner[k] + (hinge[k] - corner[k]) * 1.2;
        this.#line[2 * i + k] = root[k] + (end - root[k]) * t;
      }
    }
    for (let i = 0; i < steps; i++) {
      const [before, after] = [2 * Math.max(0, i - 1), 2 * Math.min(steps - 1, i + 1)];
      const dx = this.#line[after] - this.#line[before];
      const dz = this.#line[after + 1] - this.#line[before + 1];
      const length = Math.hypot(dx, dz) || 1;
      // The side that faces up where the fold lies flat.
      const nx = (-this.#sign * dz) / length;
      const nz = (this.#sign * dx) / length;
      const x = this.#line[2 * i] + 0.00008 * nx;
      const z = this.#line[2 * i + 1] + 0.00008 * nz;
      lightBetween(x, z, Math.atan2(nx, nz), piles, noLid, this.#light);
      for (const end of [0, 1]) {
        const point = end * steps + i;
        solid.place(point, x, end * this.#height, z);
        solid.face(point, nx, 0, nz);
        // The picture's last strip before the hinge, mirrored: patterns continue unbroken.
        const beyond = (foldFraction * (steps - 1 - i)) / (steps - 1);
        solid.uv[2 * point] = front ? 1 - beyond : beyond;
        solid.uv[2 * point + 1] = 1 - end;
        solid.open[2 * point] = this.#light.sky;
        solid.open[2 * point + 1] = this.#light.key;
      }
    }
    solid.touch("position", "normal", "uv", "open");
  }

  dispose(): void {
    this.mesh.geometry.dispose();
  }
}
