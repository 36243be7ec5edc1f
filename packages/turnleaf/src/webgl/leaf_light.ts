/**
 * The light on one side of a leaf in flight, between a pile and the next leaf.
 *
 * It is computed at some rows and columns and interpolated between them: many
 * leaves fly at once, and light changes slowly over a sheet.
 */

import type { Surface } from "../engine/shapes.ts";
import { compassToRadians, gapsOfRow } from "./light.ts";

/** The light is computed at every so many rows and columns. */
const rowStep = 3;
const columnStep = 2;

/** Every so many of those columns are tested as obstacles. */
const obstacleStep = 2;

const noPoints = new Float32Array(0);

/** Computes the gaps of a leaf's sides; its buffers are reused. */
export class LeafLight {
  readonly #columns: Blend;
  readonly #rows: Blend;
  /** One row mirrored to the right: x, z, normal's x and z, and its gaps. */
  readonly #x: Float32Array;
  readonly #z: Float32Array;
  readonly #nx: Float32Array;
  readonly #nz: Float32Array;
  readonly #gaps: Float32Array;
  /** The computed gaps, as angles in book space. */
  readonly #found: Float32Array;
  /** x, z of points of the next leaf's row. */
  readonly #next: Float32Array;

  /** @param columns,rows of the leaf's mesh */
  constructor(columns: number, rows: number) {
    this.#columns = new Blend(columns, columnStep);
    this.#rows = new Blend(rows, rowStep);
    const count = this.#columns.places.length;
    this.#x = new Float32Array(count);
    this.#z = new Float32Array(count);
    this.#nx = new Float32Array(count);
    this.#nz = new Float32Array(count);
    this.#gaps = new Float32Array(2 * count);
    this.#next = new Float32Array(2 * Math.ceil(count / obstacleStep));
    this.#found = new Float32Array(2 * count * this.#rows.places.length);
  }

  /**
   * Writes the gap through which each point of a leaf sees the sky.
   *
   * @param sign 1 for the recto, -1 for the verso
   * @param pile x, z of the pile that this side faces, mirrored as if the leaf
   * lay on the right
   * @param next the leaf in flight that this side faces
   * @param out left and right end for each point, radians
   */
  write(
    leaf: Surface,
    sign: 1 | -1,
    pile: Float32Array,
    next: Surface | undefined,
    out: Float32Array,
  ): void {
    const count = this.#columns.places.length;
    let at = 0;
    for (const row of this.#rows.places) {
      this.#read(leaf, row, sign);
      const over = next ? this.#readNext(next, row, sign) : noPoints;
      gapsOfRow(this.#x, this.#z, this.#nx, this.#nz, count, obstacleStep, pile, over, this.#gaps);
      for (let i = 0; i < count; i++, at += 2) {
        const left = compassToRadians(this.#gaps[2 * i]);
        const right = compassToRadians(this.#gaps[2 * i + 1]);
        this.#found[at] = sign === 1 ? left : -right;
        this.#found[at + 1] = sign === 1 ? right : -left;
      }
    }
    this.#spread(out);
  }

  #read({ positions, normals, columns }: Surface, row: number, sign: 1 | -1): void {
    const { places } = this.#columns;
    for (let i = 0; i < places.length; i++) {
      const at = 3 * (row * columns + places[i]);
      this.#x[i] = sign * positions[at];
      this.#z[i] = positions[at + 2];
      // The verso's normal is the recto's reversed, then mirrored.
      this.#nx[i] = normals[at];
      this.#nz[i] = sign * normals[at + 2];
    }
  }

  /** Reads every few points of a row of the next leaf. */
  #readNext(next: Surface, row: number, sign: 1 | -1): Float32Array {
    const { places } = this.#columns;
    for (let k = 0, to = 0; k < places.length; k += obstacleStep, to += 2) {
      const at = 3 * (row * next.columns + places[k]);
      this.#next[to] = sign * next.positions[at];
      this.#next[to + 1] = next.positions[at + 2];
    }
    return this.#next;
  }

  /** Interpolates the computed gaps to every point. */
  #spread(out: Float32Array): void {
    const [columns, rows, found] = [this.#columns, this.#rows, this.#found];
    const stride = 2 * columns.places.length;
    let to = 0;
    for (let row = 0; row < rows.count; row++) {
      const below = stride * rows.first[row];
      const s = rows.fraction[row];
      for (let column = 0; column < columns.count; column++) {
        const a = below + 2 * columns.first[column];
        const t = columns.fraction[column];
        for (let end = a; end < a + 2; end++) {
          const low = found[end] + (found[end + 2] - found[end]) * t;
          const high = found[end + stride] + (found[end + stride + 2] - found[end + stride]) * t;
          out[to++] = low + (high - low) * s;
        }
      }
    }
  }
}

/** Samples of many places, and between which two of them each place lies. */
class Blend {
  readonly count: number;
  readonly places: readonly number[];
  /** For each place, the sample before it, and its distance from there to the next. */
  readonly first: Uint16Array;
  readonly fraction: Float32Array;

  constructor(count: number, step: number) {
    this.count = count;
    const places: number[] = [];
    for (let place = 0; place < count - 1; place += step) places.push(place);
    places.push(count - 1);
    this.places = places;
    this.first = new Uint16Array(count);
    this.fraction = new Float32Array(count);
    for (let place = 0; place < count; place++) {
      const first = Math.min(Math.floor(place / step), places.length - 2);
      const [low, high] = [places[first], places[first + 1]];
      this.first[place] = first;
      this.fraction[place] = (place - low) / (high - low);
    }
  }
}
