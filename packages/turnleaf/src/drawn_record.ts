/** What is drawn of a leaf in the engine's memory: the record that `wasm/src/drawn.rs` writes. */

import type { PaperMesh } from "./paper_mesh.ts";

/** Numbers of a record, and where the thickness of the paper is among them. */
const numbers = 12;
const caliperAt = 6;

/**
 * A record as it is read. Its views are of the engine's memory, which moves when it grows; they are made
 * when they are asked for, as a leaf that does not move is read in each frame too.
 */
export class DrawnRecord {
  /** The memory that its views are of. */
  readonly buffer: ArrayBufferLike;
  readonly #numbers: Uint32Array;

  /** @param at its address; 0 is read as a leaf without points */
  constructor({ buffer }: WebAssembly.Memory, at: number) {
    this.buffer = buffer;
    // Copied, as the engine writes the next record over it.
    this.#numbers =
      at === 0 ? new Uint32Array(numbers) : new Uint32Array(buffer, at, numbers).slice();
  }

  /** Points along a row. */
  get columns(): number {
    return this.#numbers[0];
  }

  /** Points along the spine. */
  get rows(): number {
    return this.#numbers[1];
  }

  /** The address of its points, which no other leaf has meanwhile. */
  get address(): number {
    return this.#numbers[2];
  }

  /** x, y, z of each point in metres: 3 * columns * rows. */
  get positions(): Float32Array {
    return this.#floats(2, 3);
  }

  /** Unit normal of each point, likewise. */
  get normals(): Float32Array {
    return this.#floats(3, 3);
  }

  /** Rises whenever positions change. */
  get version(): number {
    return this.#numbers[4];
  }

  /** Changes whenever the mesh does. */
  get topology(): number {
    return this.#numbers[5];
  }

  /** Thickness of the paper, metres. */
  get caliper(): number {
    return new Float32Array(this.#numbers.buffer)[caliperAt];
  }

  /** Number of triangles of the mesh; 0 of a plain grid. */
  get triangles(): number {
    return this.#numbers[7];
  }

  /** Returns a copy of the mesh, if the points are no plain grid. */
  mesh(): PaperMesh | undefined {
    const { triangles } = this;
    if (triangles === 0) return undefined;
    const [corners, parts, tears] = this.#numbers.subarray(9);
    return {
      places: this.#floats(8, 2).slice(),
      triangles: new Uint32Array(this.buffer, corners, 3 * triangles).slice(),
      parts: new Uint16Array(this.buffer, parts, triangles).slice(),
      ...(tears > 0 && { tears: this.#floats(11, 3).slice() }),
    };
  }

  /** A view of so many floats for each point, at the address that a number of the record is. */
  #floats(number: number, each: number): Float32Array {
    return new Float32Array(this.buffer, this.#numbers[number], each * this.columns * this.rows);
  }
}
