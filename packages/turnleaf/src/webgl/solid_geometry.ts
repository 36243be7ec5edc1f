/** Builds the indexed triangles of solid parts, and keeps their arrays for later changes. */

import { BufferAttribute, BufferGeometry, DynamicDrawUsage } from "three";

/** Arrays of a solid part's points, in the order that they were added. */
export class SolidGeometry {
  readonly geometry: BufferGeometry = new BufferGeometry();
  readonly positions: Float32Array;
  readonly normals: Float32Array;
  readonly uv: Float32Array;
  readonly grainAt: Float32Array;
  /** Fractions of sky and of key light that reach the point. */
  readonly open: Float32Array;
  readonly #index: Uint16Array;
  #points = 0;
  #corners = 0;

  constructor(points: number, triangles: number) {
    this.positions = new Float32Array(3 * points);
    this.normals = new Float32Array(3 * points);
    this.uv = new Float32Array(2 * points);
    this.grainAt = new Float32Array(2 * points);
    this.open = new Float32Array(2 * points).fill(1);
    this.#index = new Uint16Array(3 * triangles);
    for (const [name, array, size] of [
      ["position", this.positions, 3],
      ["normal", this.normals, 3],
      ["uv", this.uv, 2],
      ["grainAt", this.grainAt, 2],
      ["open", this.open, 2],
    ] as const) {
      this.geometry.setAttribute(name, new BufferAttribute(array, size).setUsage(DynamicDrawUsage));
    }
    this.geometry.setIndex(new BufferAttribute(this.#index, 1));
  }

  /** Reserves points. Returns the index of the first one. */
  reserve(count: number): number {
    const first = this.#points;
    this.#points += count;
    return first;
  }

  triangle(a: number, b: number, c: number): void {
    this.#index[this.#corners++] = a;
    this.#index[this.#corners++] = b;
    this.#index[this.#corners++] = c;
  }

  /** Adds the square of four corners in order. */
  square(a: number, b: number, c: number, d: number): void {
    this.triangle(a, b, c);
    this.triangle(a, c, d);
  }

  /** Adds a grid of points that run row by row; `flip` turns it over. */
  grid(first: number, columns: number, rows: number, flip = false): void {
    for (let row = 0; row + 1 < rows; row++) {
      for (let column = 0; column + 1 < columns; column++) {
        const a = first + row * columns + column;
        if (flip) this.square(a, a + columns, a + columns + 1, a + 1);
        else this.square(a, a + 1, a + columns + 1, a + columns);
      }
    }
  }

  place(point: number, x: number, y: number, z: number): void {
    this.positions[3 * point] = x;
    this.positions[3 * point + 1] = y;
    this.positions[3 * point + 2] = z;
  }

  face(point: number, nx: number, ny: number, nz: number): void {
    this.normals[3 * point] = nx;
    this.normals[3 * point + 1] = ny;
    this.normals[3 * point + 2] = nz;
  }

  /** Uploads the changed arrays to the GPU. */
  touch(...names: ("position" | "normal" | "uv" | "grainAt" | "open")[]): void {
    for (const name of names) this.geometry.getAttribute(name).needsUpdate = true;
  }
}
