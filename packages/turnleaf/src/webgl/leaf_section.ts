/**
 * Cuts a leaf in flight with one plane for each row of a resting page, to find
 * the part of the leaf between that row and the light.
 *
 * The planes run across the spine. For the sky they are upright; for the key
 * light they lean toward the head as the light does, so that the shadow of a
 * raised leaf falls toward the foot.
 */

import type { Surface } from "../engine/shapes.ts";

/** The leaf's sections with a page's rows, reused from frame to frame. */
export class LeafSection {
  readonly rows: number;
  /** Numbers in use in each row of `points`. */
  readonly counts: Uint16Array;
  readonly #capacity: number;
  readonly #points: Float32Array;
  readonly #views: Float32Array[];
  readonly #height: number;

  /** @param height of the page, metres */
  constructor(rows: number, height: number) {
    this.rows = rows;
    this.#height = height;
    this.#capacity = 128;
    this.counts = new Uint16Array(rows);
    this.#points = new Float32Array(rows * this.#capacity);
    this.#views = Array.from({ length: rows }, (_, row) =>
      this.#points.subarray(row * this.#capacity, (row + 1) * this.#capacity),
    );
  }

  /** Returns x, z of the points in a row; the first `counts[row]` numbers are in use. */
  row(row: number): Float32Array {
    return this.#views[row];
  }

  /** Forgets the leaf. */
  clear(): void {
    this.counts.fill(0);
  }

  /**
   * Cuts the leaf.
   *
   * @param sign -1 mirrors x
   * @param slope how far the planes lean toward the head for each metre above
   * `base`
   * @param stride tests every so many columns; divides columns - 1
   */
  cut(leaf: Surface, sign: 1 | -1, slope: number, base: number, stride: number): void {
    const { positions, columns, rows } = leaf;
    this.clear();
    for (let column = 0; column < columns; column += stride) {
      for (let row = 0; row + 1 < rows; row++) {
        const a = 3 * (row * columns + column);
        this.#edge(positions, a, a + 3 * columns, sign, slope, base);
      }
    }
    // The foot and head edges bound the section where they cross a plane.
    for (const row of [0, rows - 1]) {
      for (let column = 0; column + stride < columns; column += stride) {
        const a = 3 * (row * columns + column);
        this.#edge(positions, a, a + 3 * stride, sign, slope, base);
      }
    }
  }

  /** Adds every plane's crossing of the leaf's edge from point a to point b. */
  #edge(p: Float32Array, a: number, b: number, sign: number, slope: number, base: number): void {
    const scale = (this.rows - 1) / this.#height;
    const ya = (p[a + 1] - slope * (p[a + 2] - base)) * scale;
    const yb = (p[b + 1] - slope * (p[b + 2] - base)) * scale;
    const slack = 1e-3;
    const first = Math.max(0, Math.ceil(Math.min(ya, yb) - slack));
    const last = Math.min(this.rows - 1, Math.floor(Math.max(ya, yb) + slack));
    for (let row = first; row <= last; row++) {
      const count = this.counts[row];
      if (count + 2 > this.#capacity) continue;
      const t = yb === ya ? 0 : Math.min(1, Math.max(0, (row - ya) / (yb - ya)));
      const at = row * this.#capacity + count;
      this.#points[at] = sign * (p[a] + (p[b] - p[a]) * t);
      this.#points[at + 1] = p[a + 2] + (p[b + 2] - p[a + 2]) * t;
      this.counts[row] = count + 2;
    }
  }
}
