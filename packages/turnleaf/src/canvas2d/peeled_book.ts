/**
 * A bound book whose leaves are peeled rather than bent: the engine for
 * browsers where WebAssembly is unavailable. It has the same interface, so that
 * waiting turns, promises and events are those of any book.
 */

import { inWay, nextTo, outermost, withPickedUp } from "../book/leaf_order.ts";
import type { BookEngine, BookSize } from "../engine/book_engine.ts";
import { areFinite, clamp, isGrab, turnSeconds, whole, wholeTicks } from "../engine/numbers.ts";
import { type Cover, Phase, Side } from "../engine/phases.ts";
import type { Pile, Surface } from "../engine/shapes.ts";
import { stackFraction } from "./canvas_layout.ts";
import { beyond, foldLineOf, mirrored, type Point } from "./fold_line.ts";
import { Peel } from "./peel.ts";
import { Swing } from "./swing.ts";

/** Points along a row and along the spine of the surface by which a pointer finds a peeled leaf. */
const columns = 13;
const rows = 13;

/** Height above the table at which a leaf in flight is found, metres: above every pile. */
const flatHeight = 0.03;

/** Height of the folded part's arch, as a fraction of a page's width. */
const archFraction = 0.6;

/** Maximum of leaves in flight at once. */
const mostPeels = 12;

/** The surface of a leaf in flight for pointers, and its fold for drawing. */
export interface PeeledSurface extends Surface {
  /** The side that it was picked up from. */
  readonly side: Side;
  /** Where the held point rests, and where it is. */
  readonly rest: Point;
  readonly held: Point;
  /** Its number: a leaf picked up later lies on the earlier ones. */
  readonly id: number;
}

/** One bound book of flat leaves. */
export class PeeledBook implements BookEngine {
  readonly tick: number = 1 / 120;
  readonly columns: Float32Array = Float32Array.from(
    { length: columns },
    (_, k) => k / (columns - 1),
  );
  readonly #size: BookSize;
  readonly #boards = [new Swing(), new Swing()];
  /** From the left to the right. */
  #peels: Peel[] = [];
  #read = 0;
  #count = 0;
  #version = 0;

  constructor(size: BookSize) {
    this.#size = size;
  }

  another(size: BookSize): BookEngine {
    return new PeeledBook(size);
  }

  destroy(): void {
    this.#peels = [];
  }

  // All paper is peeled alike.
  setStock(): boolean {
    return true;
  }

  setLeafStock(): boolean {
    return true;
  }

  setBinding(): boolean {
    return true;
  }

  setWind(): boolean {
    return true;
  }

  setAssist(): void {}

  setScale(): boolean {
    return true;
  }

  // No surface can be overridden.
  overrideSurface(): null {
    return null;
  }

  lay(read: number): void {
    this.#peels = [];
    this.#read = whole(read, this.#size.leaves);
  }

  pickUp(side: Side, low: number, high: number): number {
    const outside = outermost(this.#peels, this.#read);
    const isNext = side === Side.right ? low === outside.high : high === outside.low;
    if (!isNext || high <= low || this.#peels.length >= mostPeels) return 0;
    const peel = new Peel(++this.#count, side, low, high, this.#size);
    this.#peels = withPickedUp(side, this.#peels, peel);
    if (side === Side.left) this.#read = low;
    return peel.id;
  }

  grab(id: number, grab: number, u: number, v: number): void {
    if (!isGrab(grab, u, v)) return;
    // One leaf is held at a time: the other falls.
    for (const other of this.#peels) if (other.id !== id) this.#releasePeel(other);
    this.#find(id)?.grab(grab, clamp(u, 0, 1), clamp(v, 0, 1));
  }

  hold(id: number, grab: number, x: number, y: number): void {
    if (isGrab(grab, x, y)) this.#find(id)?.pull(grab, x, y);
  }

  release(id: number, grab: number): void {
    const peel = this.#find(id);
    if (peel) this.#releasePeel(peel, grab);
  }

  play(id: number, side: Side, seconds: number): void {
    const peel = this.#find(id);
    if (peel === undefined) return;
    peel.send(side, turnSeconds(seconds), false);
    this.#takeAlong(peel, side, turnSeconds(seconds));
  }

  /** Nothing is counted here: to step a flat leaf is hardly any work. */
  beginFrame(): void {}

  stepFrame(ticks: number): number {
    const whole = wholeTicks(ticks, this.tick);
    const seconds = whole * this.tick;
    for (const peel of this.#peels) peel.step(seconds);
    // A leaf joins its pile once nothing flies between the two.
    for (const side of [Side.left, Side.right]) {
      for (;;) {
        const peel = nextTo(side, this.#peels);
        if (peel?.goal !== side || !peel.isThere) break;
        if (side === Side.left) this.#read = peel.high;
        this.#peels = this.#peels.filter((other) => other !== peel);
      }
    }
    return whole;
  }

  get isAsleep(): boolean {
    return [...this.#peels, ...this.#boards].every(({ isAsleep }) => isAsleep);
  }

  phase(id: number): Phase {
    return this.#find(id)?.phase ?? Phase.over;
  }

  get read(): number {
    return this.#read;
  }

  get flights(): number {
    return this.#peels.length;
  }

  update(): void {
    this.#version++;
  }

  surface(index: number): PeeledSurface {
    const { id, side, fold } = this.#peels[index];
    const { width, height } = this.#size;
    const line = foldLineOf(fold.rest, fold.held);
    const sign = side === Side.right ? 1 : -1;
    const positions = new Float32Array(3 * columns * rows);
    for (let k = 0; k < columns * rows; k++) {
      const u = this.columns[k % columns];
      const v = Math.floor(k / columns) / (rows - 1);
      const flat: Point = [sign * u * width, v * height];
      const isFolded = line !== null && beyond(line, flat) > 0;
      const [x, y] = isFolded ? mirrored(line, flat) : flat;
      const arch = isFolded ? 0.001 + archFraction * Math.sqrt(Math.max(width ** 2 - x * x, 0)) : 0;
      positions.set([x, y, flatHeight + arch], 3 * k);
    }
    const normals = new Float32Array(0);
    return { columns, rows, positions, normals, version: this.#version, id, side, ...fold };
  }

  pile(side: Side): Pile {
    const { width, leaves, thickness } = this.#size;
    const { high } = outermost(this.#peels, this.#read);
    const lying = side === Side.left ? this.#read : leaves - high;
    const [sign, z] = [side === Side.left ? -1 : 1, (thickness * lying) / Math.max(leaves, 1)];
    const curve = (reach: number, z: number) =>
      [...this.columns].flatMap((u) => [sign * u * reach, z]);
    // The edges of the leaves are visible beside the uppermost one: a grab of them takes that one.
    const curves = Float32Array.from([...curve(width, z), ...curve(width + stackFraction * z, 0)]);
    return { columns, layers: 2, curves };
  }

  holdBoard(cover: Cover, angle: number): void {
    if (areFinite([angle])) this.#boards[cover].hold(angle);
  }

  releaseBoard(cover: Cover): void {
    this.#boards[cover].release();
  }

  playBoard(cover: Cover, side: Side, seconds: number): void {
    this.#boards[cover].send(side, turnSeconds(seconds));
  }

  layBoard(cover: Cover, side: Side): void {
    this.#boards[cover].lay(side);
  }

  stepBoard(cover: Cover, ticks: number): Phase {
    this.#boards[cover].step(wholeTicks(ticks, this.tick) * this.tick);
    return this.#boards[cover].phase;
  }

  boardAngle(cover: Cover): number {
    return this.#boards[cover].angle;
  }

  /** Releases a grab of a leaf, or every grab. */
  #releasePeel(peel: Peel, grab?: number): void {
    if (peel.phase !== Phase.held) return;
    peel.release(grab);
    if (peel.goal !== null) this.#takeAlong(peel, peel.goal, null);
  }

  /**
   * Sends the leaves in the way of a leaf along with it: no leaf may lie on one
   * that it lies under.
   */
  #takeAlong(peel: Peel, side: Side, seconds: number | null): void {
    for (const other of inWay(side, this.#peels, peel)) {
      if (other.goal !== side) other.send(side, seconds ?? 0.5, seconds === null);
    }
  }

  #find(id: number): Peel | undefined {
    return this.#peels.find((peel) => peel.id === id);
  }
}
