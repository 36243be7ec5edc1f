/**
 * Folds pages, each in a moment that is seen where its page lies open. Loaded when the first is
 * folded, with an engine whose leaves can be creased.
 */

import { creasesOf, type Fold } from "../book/creases.ts";
import { leafOf, paperOnLeft } from "../book/spreads.ts";
import { Side } from "../engine/phases.ts";
import type { Crease } from "../engine/shapes.ts";
import { CornerPress } from "./corner_press.ts";
import type { Drag } from "./drag.ts";
import type { Rebinder } from "./rebinder.ts";

/** Length of the moment in which a page is folded, seconds. */
const foldSeconds = 0.5;

/** A leaf that is being folded: the rest of its creases goes from one angle to another. */
interface Motion {
  readonly leaf: number;
  readonly from: readonly number[];
  readonly to: readonly number[];
  readonly done: () => void;
  /** What holds the corner down, if a pointer does. */
  readonly drag: Drag | null;
  /** The fraction of its time that is over. */
  part: number;
}

/** The folded pages of one viewer's book. */
export class Folds {
  readonly #rebinder: Rebinder;
  readonly #begun: () => void;
  #folds: readonly Fold[] = [];
  /** What was opened before the reader's eyes, by pages of a book of so many. */
  #opened: readonly Fold[] = [];
  #pageCount: number;
  #motion: Motion | null = null;
  /** The last call of `fold`. */
  #last: Promise<unknown> = Promise.resolve();
  /** What waits for the book to be bound by an engine whose leaves can be creased. */
  #waiting: (() => void)[] = [];

  /**
   * @param rebinder of a book that is bound, or will be as soon as it rests, by an engine whose
   * leaves can be creased
   * @param begun called once what is seen of a fold begins: frames are needed then
   */
  constructor(rebinder: Rebinder, begun: () => void) {
    this.#rebinder = rebinder;
    this.#begun = begun;
    this.#pageCount = rebinder.bound.binding.pageCount;
    rebinder.targets.cornerAt = CornerPress.at;
  }

  /**
   * Folds pages, in place of what was folded before, which is opened. Resolves, once that is
   * done, to the folds that there are: those of a leaf that cannot be folded so stay as they were.
   * Null once the viewer is closed.
   *
   * @param isSeen whether a leaf that lies open is seen to be folded, and what is opened keeps
   * its line
   */
  fold(folds: readonly Fold[], isSeen: boolean): Promise<readonly Fold[] | null> {
    const fold = (): Promise<readonly Fold[] | null> => this.#fold(folds, isSeen);
    // One after another: each begins from what the one before it leaves.
    const folded = this.#last.then(fold, fold);
    this.#last = folded;
    return folded;
  }

  async #fold(folds: readonly Fold[], isSeen: boolean): Promise<readonly Fold[] | null> {
    if (!this.#rebinder.bound.engine.creases) {
      await new Promise<void>((bound) => this.#waiting.push(bound));
    }
    if (!this.#rebinder.bound.engine.creases) return null;
    const before = this.#creases();
    const foldsBefore = this.#folds;
    const opened = foldsBefore.filter((old) => !folds.some((fold) => isSameFold(fold, old)));
    const lines = this.#opened.filter((old) => !opened.some(({ page }) => page === old.page));
    this.#opened = isSeen ? [...lines, ...opened.map((one) => ({ ...one, isOpened: true }))] : [];
    this.#folds = folds;
    const after = this.#creases();
    const leaves = new Set([...before.keys(), ...after.keys()]);
    const results = [...leaves].map(async (leaf) => {
      const own = before.get(leaf) ?? [];
      if (await this.#foldLeaf(leaf, own, after.get(leaf) ?? [], isSeen)) return;
      // The lines of what was opened may be in the way.
      this.#opened = this.#opened.filter((fold) => this.#leafOf(fold) !== leaf);
      const without = this.#creases().get(leaf) ?? [];
      if (await this.#foldLeaf(leaf, own, without, isSeen)) return;
      const ofOthers = this.#folds.filter((fold) => this.#leafOf(fold) !== leaf);
      const asBefore = foldsBefore.filter((fold) => this.#leafOf(fold) === leaf);
      this.#folds = [...ofOthers, ...asBefore];
    });
    await Promise.all(results);
    return this.#folds;
  }

  /** Takes over the folds of pages that lie elsewhere once the book is bound anew. */
  keep(folds: readonly Fold[]): void {
    this.#folds = folds;
  }

  /** Call it when the book was bound anew: creases its leaves. */
  bound(): void {
    this.#end();
    const { engine, binding } = this.#rebinder.bound;
    // The pages have other numbers.
    if (binding.pageCount !== this.#pageCount) this.#opened = [];
    this.#pageCount = binding.pageCount;
    for (const [leaf, creases] of this.#creases()) engine.creases?.crease(leaf, creases);
    if (engine.creases) this.#stopWaiting();
  }

  /** Ends the moment in which a page is folded, and what waits. */
  close(): void {
    this.#end();
    this.#stopWaiting();
  }

  /** Advances the moment in which a page is folded. Returns whether it goes on. */
  step(seconds: number): boolean {
    const motion = this.#motion;
    if (motion === null) return false;
    if (motion.part === 1) {
      if (!this.#isFalling) this.#end();
      return this.#motion !== null;
    }
    // Where frames are late it may have come to rest in between.
    if (motion.drag === null) this.#pickUp(motion.leaf);
    motion.part = Math.min(motion.part + seconds / foldSeconds, 1);
    const eased = motion.part * motion.part * (3 - 2 * motion.part);
    for (const [crease, from] of motion.from.entries()) {
      const rest = from + (motion.to[crease] - from) * eased;
      this.#rebinder.bound.engine.creases?.press(motion.leaf, crease, rest);
    }
    motion.drag?.press(eased);
    // Released, it falls back first: the next fold of it begins where it lies.
    if (motion.part === 1 && motion.drag !== null) this.#end();
    return this.#motion !== null;
  }

  /** Whether one leaf is in flight, and no pointer holds it. */
  get #isFalling(): boolean {
    const { turning } = this.#rebinder.bound;
    return turning.flights.length === 1 && !turning.hasHeld;
  }

  #stopWaiting(): void {
    for (const done of this.#waiting.splice(0)) done();
  }

  #leafOf({ page }: Fold): number {
    const { binding } = this.#rebinder.bound;
    return paperOnLeft(binding, leafOf(binding, page));
  }

  #creases(): Map<number, Crease[]> {
    const { binding, shape } = this.#rebinder.bound;
    return creasesOf([...this.#opened, ...this.#folds], binding, shape);
  }

  async #foldLeaf(
    leaf: number,
    before: readonly Crease[],
    after: readonly Crease[],
    isSeen: boolean,
  ): Promise<boolean> {
    if (before.map(key).join() === after.map(key).join()) return true;
    const drag = this.#pressOn(leaf);
    const canBeSeen = isSeen && this.#motion === null && this.#foldsUp(leaf, [...before, ...after]);
    const isFolded = canBeSeen && (drag !== null || this.#pickUp(leaf));
    if (!isFolded) return this.#crease(leaf, after);
    // What is to be opened keeps its crease until it is.
    const opened = before.filter((old) => !after.some((one) => line(one) === line(old)));
    const lines = [...after, ...opened];
    const restBefore = (one: Crease): number =>
      before.find((old) => line(old) === line(one))?.rest ?? 0;
    const from = lines.map(restBefore);
    const to = [...after.map(({ rest }) => rest), ...opened.map(() => 0)];
    const creased = lines.map((one, k) => ({ ...one, rest: from[k] }));
    if (!this.#crease(leaf, creased)) return this.#crease(leaf, after);
    await new Promise<void>((done) => {
      this.#motion = { leaf, from, to, done, drag, part: 0 };
      this.#begun();
    });
    // Nothing pressed it where its page was left meanwhile.
    const isPressed = opened.length === 0 && this.#isDrawn(leaf);
    return isPressed || this.#crease(leaf, after);
  }

  /** Creases a leaf of the book as it is bound now. Returns whether it can be. */
  #crease(leaf: number, creases: readonly Crease[]): boolean {
    return this.#rebinder.bound.engine.creases?.crease(leaf, creases) ?? false;
  }

  /** Returns whether a leaf is in flight or lies uppermost in the book. */
  #isDrawn(leaf: number): boolean {
    const { binding, turning } = this.#rebinder.bound;
    const paper = (spread: number): number => paperOnLeft(binding, spread);
    const flies = turning.flights.some((one) => paper(one.low) <= leaf && leaf < paper(one.high));
    return flies || this.#sideOf(leaf) !== null;
  }

  /** Returns the drag that presses a corner of a leaf, if one does. */
  #pressOn(leaf: number): Drag | null {
    const { drags, binding } = this.#rebinder.bound;
    const page = drags.pressed?.pressing ?? null;
    const isOn = page !== null && paperOnLeft(binding, leafOf(binding, page)) === leaf;
    return isOn ? drags.pressed : null;
  }

  /** Returns whether a leaf is folded up along creases where it lies: under it there is no room. */
  #foldsUp(leaf: number, creases: readonly Crease[]): boolean {
    const isOnLeft = leaf < paperOnLeft(this.#rebinder.bound.binding, this.#spread);
    return creases.every(({ rest }) => (isOnLeft ? rest <= 0 : rest >= 0));
  }

  get #spread(): number {
    return this.#rebinder.bound.turning.spread;
  }

  /** Picks up a leaf that lies uppermost in the book at rest. Returns whether it does. */
  #pickUp(leaf: number): boolean {
    const side = this.#sideOf(leaf);
    return side !== null && this.#rebinder.bound.pickUpToFold(side);
  }

  /** Returns the side where a leaf lies uppermost in the book at rest; null if it does not. */
  #sideOf(leaf: number): Side | null {
    const { binding, turning } = this.#rebinder.bound;
    if (turning.moving) return null;
    const onLeft = paperOnLeft(binding, turning.spread);
    if (leaf === onLeft && turning.hasLeaf(Side.right)) return Side.right;
    return leaf === onLeft - 1 && turning.hasLeaf(Side.left) ? Side.left : null;
  }

  #end(): void {
    const motion = this.#motion;
    this.#motion = null;
    motion?.done();
  }
}

const isSameFold = (a: Fold, b: Fold): boolean => JSON.stringify(a) === JSON.stringify(b);
const line = ({ through }: Crease): string => through.join();
const key = (crease: Crease): string => `${line(crease)} ${crease.rest}`;
