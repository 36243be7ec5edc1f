/**
 * The resting pages of one side as they are drawn: the engine's pile, squared
 * up under a closing board.
 */

import { columnAt, columnPlace, type Pile } from "../engine/shapes.ts";
import { type CaseShape, lidHeight } from "./case_shape.ts";

/** The light tests every so many columns of a page as obstacles. */
export const obstacleStride = 4;

/** A side's curves as drawn, kept so that nothing is computed while they stand still. */
export class PileShape {
  readonly sign: 1 | -1;
  columns = 0;
  layers = 0;
  present = false;
  /** x, z of each point as drawn, layer by layer from the top. */
  curves: Float32Array = new Float32Array(0);
  /** The uppermost page mirrored to the right: x, z, normal's x and z. */
  x: Float32Array = new Float32Array(0);
  z: Float32Array = new Float32Array(0);
  nx: Float32Array = new Float32Array(0);
  nz: Float32Array = new Float32Array(0);
  /** Every few points of the uppermost page, x, z in book space; empty if no page lies there. */
  obstacles: Float32Array = new Float32Array(0);
  /** The same mirrored. */
  mirrored: Float32Array = new Float32Array(0);
  #raw = new Float32Array(0);
  #closed = 0;
  #obstacleStore = new Float32Array(0);
  #mirroredStore = new Float32Array(0);
  static readonly #none = new Float32Array(0);

  constructor(sign: 1 | -1) {
    this.sign = sign;
  }

  /** Reads a pile. Returns whether anything moved. */
  update(pile: Pile | null, shape: CaseShape, boards: boolean): boolean {
    if (pile === null) {
      const moved = this.present;
      this.present = false;
      this.obstacles = this.mirrored = PileShape.#none;
      return moved;
    }
    const closed = this.sign === 1 ? shape.closedRight : shape.closedLeft;
    if (this.present && closed === this.#closed && !this.#differs(pile)) return false;
    this.#allot(pile);
    this.#raw.set(pile.curves);
    this.#closed = closed;
    this.present = true;
    this.curves.set(pile.curves);
    if (closed > 0 && boards) this.#square(closed, shape);
    this.#followTop();
    return true;
  }

  /** Height of the uppermost page at its fore-edge, metres; 0 if no page lies there. */
  get top(): number {
    return this.present ? this.z[this.columns - 1] : 0;
  }

  /** Returns x and z of the uppermost page at u, 0 at the spine to 1 at the fore-edge, metres. */
  pointAt(u: number): [x: number, z: number] {
    const { columns, sign, x, z } = this;
    const k = Math.min(Math.floor(columnAt(u, columns)), columns - 2);
    const [from, to] = [columnPlace(k, columns), columnPlace(k + 1, columns)];
    const t = (u - from) / (to - from);
    return [sign * (x[k] + (x[k + 1] - x[k]) * t), z[k] + (z[k + 1] - z[k]) * t];
  }

  #differs(pile: Pile): boolean {
    const { curves } = pile;
    if (curves.length !== this.#raw.length) return true;
    for (let k = 0; k < curves.length; k++) if (curves[k] !== this.#raw[k]) return true;
    return false;
  }

  #allot(pile: Pile): void {
    if (this.columns === pile.columns && this.layers === pile.layers) {
      this.obstacles = this.#obstacleStore;
      this.mirrored = this.#mirroredStore;
      return;
    }
    this.columns = pile.columns;
    this.layers = pile.layers;
    const count = pile.columns;
    this.curves = new Float32Array(2 * count * pile.layers);
    this.#raw = new Float32Array(this.curves.length);
    this.x = new Float32Array(count);
    this.z = new Float32Array(count);
    this.nx = new Float32Array(count);
    this.nz = new Float32Array(count);
    const obstacles = 2 * (Math.floor((count - 1) / obstacleStride) + 1);
    this.obstacles = this.#obstacleStore = new Float32Array(obstacles);
    this.mirrored = this.#mirroredStore = new Float32Array(obstacles);
  }

  /**
   * Makes a pile follow its spine as a board closes: the pages' roots stand up
   * with the spine, and the pile is square when the book is closed. The pages
   * are also kept under the board that closes over them.
   */
  #square(closed: number, shape: CaseShape): void {
    const { curves, columns, layers, sign } = this;
    const [foot, head] = sign === 1 ? [shape.c, shape.d] : [shape.d, shape.c];
    for (let layer = 0; layer < layers; layer++) {
      const first = 2 * columns * layer;
      const up = layers > 1 ? 1 - layer / (layers - 1) : 0;
      // Slightly within the cloth that bends around them.
      const inset = sign * 0.0012 * Math.min(1, 4 * closed);
      const shift = foot[0] + (head[0] - foot[0]) * up + inset - curves[first];
      const root = Math.max(0, head[1]) * up;
      let highest = 1e-9;
      for (let k = 1; k < 2 * columns; k += 2) highest = Math.max(highest, curves[first + k]);
      for (let k = 0; k < 2 * columns; k += 2) {
        curves[first + k] += shift;
        curves[first + k + 1] += root * (1 - curves[first + k + 1] / highest);
      }
    }
    for (let column = 0; column < columns; column++) {
      const top = 2 * column;
      const lid = Math.max(0, lidHeight(shape, sign, curves[top]) - 0.0002);
      const press = curves[top + 1] > lid ? lid / curves[top + 1] : 1;
      for (let layer = 0; layer < layers; layer++) curves[2 * columns * layer + top + 1] *= press;
    }
  }

  #followTop(): void {
    const { columns, sign, curves, x, z, nx, nz } = this;
    for (let i = 0; i < columns; i++) {
      x[i] = sign * curves[2 * i];
      z[i] = curves[2 * i + 1];
    }
    for (let i = 0; i < columns; i++) {
      const a = Math.max(0, i - 1);
      const b = Math.min(columns - 1, i + 1);
      const dx = x[b] - x[a];
      const dz = z[b] - z[a];
      const length = Math.hypot(dx, dz) || 1;
      nx[i] = -dz / length;
      nz[i] = dx / length;
    }
    for (let k = 0, i = 0; k < this.obstacles.length; k += 2, i += obstacleStride) {
      this.obstacles[k] = sign * x[i];
      this.mirrored[k] = -sign * x[i];
      this.obstacles[k + 1] = this.mirrored[k + 1] = z[i];
    }
  }
}
