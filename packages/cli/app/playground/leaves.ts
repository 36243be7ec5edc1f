/** The two leaves: at the same moment, held at the same place. */

import {
  type CreaseState,
  type LeafFigures,
  type LeafSide,
  type LeafTurn,
  LooseLeaf,
} from "turnleaf/models";
import { type DrawnCrease, isSameLine } from "./creases.ts";
import { type AnyLeaf, ReplayLeaf } from "./replay_leaf.ts";
import type { Settings } from "./settings.ts";
import { isCreasable, isReplayed, leafOptions, type Variant } from "./variants.ts";

/** Both pictures show the same moment: neither leaf is ever more than this ahead, seconds. */
const tick = 1 / 120;

/** Interval of the checks for motion, seconds of the leaves' time. */
const lookEvery = 0.25;

/** A motion of less than this since then counts as rest, metres. */
const leastMove = 2e-5;

/** Some models creep for ever; after so long without a grab they count as at rest, seconds. */
const longest = 20;

/** How fast creases are folded, radians a second: a page in two within half a second, as in a book. */
const foldingRate = 2 * Math.PI;

/** Weight of the previous cost in its moving average. */
const memory = 0.97;

/** One of the two. */
export class BenchLeaf {
  readonly leaf: AnyLeaf;
  #milliseconds = 0;
  #steps = 0;
  #before = new Float32Array(0);
  /** The leaf, if it can be creased. */
  readonly creasable: LooseLeaf | null;

  constructor(leaf: AnyLeaf, variant: Variant) {
    this.leaf = leaf;
    this.creasable = isCreasable(variant) && leaf instanceof LooseLeaf ? leaf : null;
  }

  /** Microseconds of a recent step; NaN before the first. */
  get cost(): number {
    return (1000 * this.#milliseconds) / this.#steps;
  }

  /** Advances and measures its cost. */
  advance(seconds: number): void {
    const start = performance.now();
    this.leaf.advance(seconds);
    this.#milliseconds += performance.now() - start;
    this.#steps += seconds / this.leaf.timeStep;
  }

  /** Reduces the weight of old measurements. */
  forget(): void {
    this.#milliseconds *= memory;
    this.#steps *= memory;
  }

  /** Returns whether no node has moved since the last call. */
  isAsBefore(): boolean {
    this.leaf.update();
    const { positions } = this.leaf.nodes();
    const [before, now] = [this.#before, positions.slice()];
    this.#before = now;
    return before.length === now.length && now.every((x, k) => Math.abs(x - before[k]) < leastMove);
  }

  /** The side on which its fore-edge is. */
  get side(): LeafSide {
    const { columns, positions } = this.leaf.nodes();
    return positions[3 * (columns - 1)] < 0 ? "left" : "right";
  }

  get figures(): LeafFigures {
    return this.leaf.measure();
  }
}

/** Both leaves. */
export class TwoLeaves {
  readonly pair: readonly [BenchLeaf, BenchLeaf];
  /** Seconds of their time. */
  time = 0;
  #held: readonly [x: number, y: number, z: number] | null = null;
  #isStill = true;
  /** Creases of those that can be creased, and the angle at which each rests now, radians. */
  #creases: readonly DrawnCrease[] = [];
  #rests: number[] = [];
  #idle = 0;
  #sinceLook = 0;

  private constructor(pair: readonly [BenchLeaf, BenchLeaf]) {
    this.pair = pair;
  }

  /**
   * Makes two leaves, flat and at rest on a side.
   *
   * @throws Error if the settings are invalid
   */
  static async create(settings: Settings, side: LeafSide): Promise<TwoLeaves> {
    const made = await Promise.allSettled(
      [settings.left, settings.right].map((variant): Promise<AnyLeaf> => {
        const options = { ...leafOptions(variant, settings), side };
        return isReplayed(variant) ? ReplayLeaf.create(options) : LooseLeaf.create(options);
      }),
    );
    const leaves = made.flatMap((one) => (one.status === "fulfilled" ? [one.value] : []));
    const [left, right] = leaves;
    if (left && right) {
      const pair = [
        new BenchLeaf(left, settings.left),
        new BenchLeaf(right, settings.right),
      ] as const;
      return new TwoLeaves(pair);
    }
    for (const leaf of leaves) leaf.destroy();
    throw made.find((one) => one.status === "rejected")?.reason;
  }

  /** Whether nothing moves, so that nothing needs to be drawn. */
  get isStill(): boolean {
    return this.#isStill;
  }

  /** Starts the same turn of both, from the side on which the first lies. */
  play(by: LeafTurn, seconds: number): void {
    const from = this.pair[0].side;
    this.#held = null;
    for (const { leaf } of this.pair) leaf.play(by, from, seconds);
    this.#wake();
  }

  /** Grabs both at the same place. */
  grab(u: number, v: number): void {
    for (const { leaf } of this.pair) leaf.grab(u, v);
    this.#wake();
  }

  /** Pulls both to the same place, metres. */
  hold(x: number, y: number, z: number): void {
    this.#held = [x, y, z];
    for (const { leaf } of this.pair) leaf.hold(x, y, z);
    this.#wake();
  }

  /** The place of the grab; null if there is none. */
  get held(): readonly [x: number, y: number, z: number] | null {
    return this.#held;
  }

  /** Releases both. */
  release(): void {
    this.#held = null;
    for (const { leaf } of this.pair) leaf.release();
    this.#wake();
  }

  /** Whether any of the two can be creased. */
  get areCreasable(): boolean {
    return this.pair.some(({ creasable }) => creasable !== null);
  }

  /**
   * Creases what can be, in place of the creases there were. New creases are folded from flat to
   * their angles, others from where they rest.
   *
   * @returns whether they lie on other lines than before
   * @throws Error if a sheet cannot be creased so; both are then as they were
   */
  crease(creases: readonly DrawnCrease[]): boolean {
    const before = this.#creases;
    const isSame =
      creases.length === before.length && creases.every((one, k) => isSameLine(one, before[k]));
    const old = this.creaseStates();
    // A hand may have turned them since.
    const rests = creases.map((one) => {
      const at = before.findIndex((other) => isSameLine(one, other));
      return old[at]?.rest ?? this.#rests[at] ?? 0;
    });
    if (!isSame) {
      const lines = creases.map(({ through: [a, b, c, d] }, k) => ({
        through: [a / 100, b / 100, c / 100, d / 100] as const,
        rest: rests[k],
      }));
      for (const { creasable } of this.pair) creasable?.crease(lines);
    }
    this.#rests = rests;
    this.#creases = creases;
    if (this.areCreasable) this.#wake();
    return !isSame;
  }

  /** Returns the creases of the first leaf that can be creased, as they are now. */
  creaseStates(): (CreaseState | null)[] {
    const leaf = this.pair.find(({ creasable }) => creasable !== null)?.creasable;
    return leaf ? this.#creases.map((_, k) => leaf.creaseState(k)) : [];
  }

  /**
   * Advances both by seconds of their time, in ticks, within the budget in
   * milliseconds, but by at least one tick.
   *
   * @returns the time by which they advanced, seconds
   */
  advance(seconds: number, budget: number): number {
    const start = performance.now();
    const count = Math.max(1, Math.round(seconds / tick));
    let done = 0;
    while (done < count && (done === 0 || performance.now() - start < budget)) {
      this.#fold();
      for (const one of this.pair) one.advance(tick);
      done++;
    }
    for (const one of this.pair) one.forget();
    this.#passed(done * tick);
    return done * tick;
  }

  destroy(): void {
    for (const { leaf } of this.pair) leaf.destroy();
  }

  /** Folds on for a tick. */
  #fold(): void {
    for (const [k, { angle }] of this.#creases.entries()) {
      const way = (angle * Math.PI) / 180 - this.#rests[k];
      if (way === 0) continue;
      const most = foldingRate * tick;
      this.#rests[k] += Math.min(Math.max(way, -most), most);
      for (const { creasable } of this.pair) creasable?.press(k, this.#rests[k]);
    }
  }

  /** Whether a crease is still being folded. */
  get #isFolding(): boolean {
    const isOpen = ({ angle }: DrawnCrease, k: number) =>
      (angle * Math.PI) / 180 !== this.#rests[k];
    return this.areCreasable && this.#creases.some(isOpen);
  }

  #wake(): void {
    this.#isStill = false;
    this.#idle = 0;
    this.#sinceLook = 0;
  }

  #passed(seconds: number): void {
    this.time += seconds;
    this.#idle += seconds;
    this.#sinceLook += seconds;
    if (this.#sinceLook < lookEvery) return;
    this.#sinceLook = 0;
    // Each is checked, so that each remembers where it was.
    const asBefore = this.pair.map((one) => one.isAsBefore()).every(Boolean);
    const isLed = this.#isFolding || this.pair.some(({ leaf }) => leaf.playing);
    this.#isStill = !isLed && (asBefore || this.#idle > longest);
  }
}
