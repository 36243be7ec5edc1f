/** The edges of the resting leaves of one side: fore-edge, head and foot. */

import { type BufferGeometry, Mesh } from "three";
import type { PileShape } from "./pile_shape.ts";
import { SolidGeometry } from "./solid_geometry.ts";
import type { SolidMaterial } from "./solid_material.ts";

/** The pile of one side. Its points at the uppermost layer are the resting page's own. */
export class PileMesh {
  readonly mesh: Mesh<BufferGeometry, SolidMaterial>;
  readonly #height: number;
  readonly #thickness: number;
  readonly #sign: 1 | -1;
  #solid = new SolidGeometry(0, 0);
  #columns = 0;
  #layers = 0;

  /** @param thickness of all leaves of the book, metres */
  constructor(material: SolidMaterial, sign: 1 | -1, height: number, thickness: number) {
    this.#sign = sign;
    this.#height = height;
    this.#thickness = Math.max(thickness, 1e-5);
    this.mesh = new Mesh(this.#solid.geometry, material);
    this.mesh.frustumCulled = false;
  }

  /** Follows the pile. */
  shape(pile: PileShape): void {
    this.#allot(pile);
    const { columns, layers, curves } = pile;
    const solid = this.#solid;
    const edge = 2 * columns * layers;
    for (let layer = 0; layer < layers; layer++) {
      for (let column = 0; column < columns; column++) {
        const from = 2 * (layer * columns + column);
        const [x, z] = [curves[from], curves[from + 1]];
        for (const end of [0, 1]) {
          const point = end * columns * layers + layer * columns + column;
          solid.place(point, x, end * this.#height, z);
          // The bands run along the leaves: the texture's y goes through the thickness.
          solid.grainAt[2 * point] = 3 * x;
          solid.grainAt[2 * point + 1] = this.#band(pile, layer);
          // Less light reaches points near the board and in the gutter.
          const high = layers > 1 ? 1 - layer / (layers - 1) : 1;
          const gutter = Math.min(1, Math.abs(x) / (0.6 * this.#thickness));
          solid.open[2 * point] = (0.62 + 0.38 * high) * (0.55 + 0.45 * gutter);
        }
      }
      this.#foreEdge(pile, layer, edge + 2 * layer);
    }
    solid.touch("position", "normal", "grainAt", "open");
  }

  dispose(): void {
    this.mesh.geometry.dispose();
  }

  #foreEdge(pile: PileShape, layer: number, point: number): void {
    const { columns, layers, curves } = pile;
    const solid = this.#solid;
    const end = (k: number): number =>
      2 * (columns * Math.min(layers - 1, Math.max(0, k)) + columns - 1);
    const [above, below] = [end(layer - 1), end(layer + 1)];
    const dx = this.#sign * (curves[below] - curves[above]);
    const dz = curves[above + 1] - curves[below + 1];
    // Each leaf's own edge faces outward, however far the edges lean as a whole.
    const length = Math.hypot(0.35 * dx, dz) || 1;
    const high = layers > 1 ? 1 - layer / (layers - 1) : 1;
    for (const k of [0, 1]) {
      solid.place(point + k, curves[end(layer)], k * this.#height, curves[end(layer) + 1]);
      solid.face(point + k, (this.#sign * dz) / length, 0, (0.35 * dx) / length);
      solid.grainAt[2 * (point + k)] = 3 * k * this.#height;
      solid.grainAt[2 * (point + k) + 1] = this.#band(pile, layer);
      solid.open[2 * (point + k)] = 0.72 + 0.28 * high;
    }
  }

  /** Returns where a layer lies in the whole book, 0 to 1, so that bands stay as leaves go over. */
  #band(pile: PileShape, layer: number): number {
    const { columns, layers } = pile;
    const height = (k: number): number => pile.curves[2 * (columns * k + columns - 1) + 1];
    const fraction = (height(layer) - height(layers - 1)) / this.#thickness;
    return this.#sign === 1 ? fraction : 1 - fraction;
  }

  #allot(pile: PileShape): void {
    const { columns, layers } = pile;
    if (columns === this.#columns && layers === this.#layers) return;
    this.#columns = columns;
    this.#layers = layers;
    this.mesh.geometry.dispose();
    const points = 2 * columns * layers + 2 * layers;
    const triangles = 4 * (columns - 1) * (layers - 1) + 2 * (layers - 1);
    const solid = new SolidGeometry(points, triangles);
    const flip = this.#sign === 1;
    for (const end of [0, 1]) {
      const first = solid.reserve(columns * layers);
      for (let k = first; k < first + columns * layers; k++) solid.face(k, 0, 2 * end - 1, 0);
      solid.grid(first, columns, layers, flip === (end === 0));
    }
    const first = solid.reserve(2 * layers);
    solid.grid(first, 2, layers, flip);
    this.#solid = solid;
    this.mesh.geometry = solid.geometry;
  }
}
