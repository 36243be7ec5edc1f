/** One leaf peeled from a side: held, turned by a command, or falling. */

import { Phase, Side } from "../engine/phases.ts";
import { type Point, withinReach } from "./fold_line.ts";

/** Time in seconds in which a released leaf would cross from side to side. */
const fallSeconds = 0.5;

/** Minimum duration in seconds: a leaf that is nearly there is still seen to move. */
const shortestWay = 0.15;

/** How far ahead a leaf's motion is extrapolated at its release, seconds: a flick turns it. */
const lookAhead = 0.15;

/** Time in seconds over which a leaf's speed is measured. */
export const speedTime = 0.05;

/**
 * Height of a played leaf's path, as a fraction of the page's height. The corner is lifted at once and
 * comes down as it goes over, by this power of the way that is left: folded over far, what it is lifted
 * by is what the other corner reaches beyond the page, which stays in a book's margin, 0.03 of the
 * page, for pages of up to 2 to 3.
 */
const archFraction = 0.2;
const archDescent = 3;

/** A path from where the leaf was to a side. */
interface PeelPath {
  readonly from: Point;
  readonly to: Side;
  readonly seconds: number;
  readonly arch: number;
  /**
   * Whether it is a fall: a released leaf already moves, a leaf turned by
   * command starts at rest.
   */
  readonly isFall: boolean;
  time: number;
}

/** A page's size, metres. */
export interface PageSize {
  readonly width: number;
  readonly height: number;
}

/** A leaf off its pile. */
export class Peel {
  readonly id: number;
  /** The side that it was picked up from. */
  readonly side: Side;
  /** Leaves of paper on the left when it lies on the right, and when it lies on the left. */
  readonly low: number;
  readonly high: number;
  readonly #size: PageSize;
  /** Where the held point rests on its side. */
  #rest: Point;
  /** Where the held point is now. */
  #held: Point;
  #way: PeelPath | null = null;
  /** By the grab's number: from the pointer to the held point, once it has been pulled. */
  readonly #grabs = new Map<number, Point | null>();
  /** Whether nothing has moved it since it was picked up. */
  #isFresh = true;
  #speed = 0;
  /** Where the held point was at the last step, and for how many seconds it has stayed there. */
  #last: Point;
  #stillFor = 0;

  constructor(id: number, side: Side, low: number, high: number, size: PageSize) {
    this.id = id;
    this.side = side;
    this.low = low;
    this.high = high;
    this.#size = size;
    // The lower corner, until a grab moves it elsewhere.
    this.#rest = this.#held = [this.#sign * size.width, 0];
    this.#last = this.#rest;
  }

  /** Where the held point rests, and where it is. */
  get fold(): { readonly rest: Point; readonly held: Point } {
    return { rest: this.#rest, held: this.#held };
  }

  /** The side for which it is bound; null while it is held. */
  get goal(): Side | null {
    return this.#way?.to ?? null;
  }

  /** Whether it has arrived there. */
  get isThere(): boolean {
    return this.#way !== null && this.#way.time >= this.#way.seconds;
  }

  get phase(): Phase {
    const way = this.#way;
    if (way === null) return Phase.held;
    if (way.isFall) return way.to === Side.left ? Phase.fallingLeft : Phase.fallingRight;
    return way.to === Side.left ? Phase.playingLeft : Phase.playingRight;
  }

  /** Whether it is held and has lain still for as long as its speed is measured. */
  get isAsleep(): boolean {
    return this.#way === null && !this.#hasMoved && this.#stillFor >= speedTime;
  }

  /** Whether the held point has moved since the last step. */
  get #hasMoved(): boolean {
    return this.#held[0] !== this.#last[0] || this.#held[1] !== this.#last[1];
  }

  /** Grabs the leaf at (u, v). */
  grab(grab: number, u: number, v: number): void {
    if (this.#isFresh) {
      const { width, height } = this.#size;
      this.#rest = this.#held = [this.#sign * u * width, v * height];
      this.#last = this.#rest;
      this.#grabs.set(grab, [0, 0]);
    } else if (!this.#grabs.has(grab)) this.#grabs.set(grab, null);
    this.#isFresh = false;
    this.#way = null;
  }

  /** Pulls a grab to a place. */
  pull(grab: number, x: number, y: number): void {
    const offset = this.#grabs.get(grab);
    if (offset === undefined) return;
    // A leaf caught in flight follows the pointer from where it was caught.
    const [dx, dy] = offset ?? [this.#held[0] - x, this.#held[1] - y];
    if (offset === null) this.#grabs.set(grab, [dx, dy]);
    this.#held = withinReach(this.#rest, [x + dx, y + dy], this.#size.height);
  }

  /**
   * Releases a grab, or every grab: with none left, the leaf falls to the side
   * that its swing takes it.
   */
  release(grab?: number): void {
    if (grab === undefined) this.#grabs.clear();
    else this.#grabs.delete(grab);
    if (this.#grabs.size > 0) return;
    const landing = this.#held[0] + lookAhead * this.#speed;
    this.send(landing < 0 ? Side.left : Side.right, fallSeconds, true);
  }

  /** Sends it to a side, `seconds` for a whole turn. */
  send(to: Side, seconds: number, isFall: boolean): void {
    this.#grabs.clear();
    this.#isFresh = false;
    const goal = this.#place(to);
    // A point held at the spine does not move across.
    const across = 2 * Math.abs(this.#rest[0]);
    const fraction = across > 0 ? Math.abs(goal[0] - this.#held[0]) / across : 1;
    const upward = this.#rest[1] < this.#size.height / 2 ? 1 : -1;
    this.#way = {
      from: this.#held,
      to,
      seconds: Math.max(seconds * fraction, shortestWay),
      arch: isFall ? 0 : upward * archFraction * fraction * this.#size.height,
      isFall,
      time: 0,
    };
  }

  /** Advances by a time in seconds. */
  step(seconds: number): void {
    const way = this.#way;
    if (way !== null) {
      way.time = Math.min(way.time + seconds, way.seconds);
      this.#held = this.#on(way);
    }
    if (seconds <= 0) return;
    this.#stillFor = this.#hasMoved ? 0 : this.#stillFor + seconds;
    const now = (this.#held[0] - this.#last[0]) / seconds;
    this.#speed += (now - this.#speed) * (1 - Math.exp(-seconds / speedTime));
    this.#last = this.#held;
  }

  #on({ from, to, seconds, arch, isFall, time }: PeelPath): Point {
    const goal = this.#place(to);
    const t = time / seconds;
    if (t >= 1) return goal;
    const fraction = isFall ? 1 - (1 - t) ** 3 : t * t * (3 - 2 * t);
    const lift = arch * Math.sin(Math.PI * fraction) * (1 - fraction) ** archDescent;
    const x = from[0] + (goal[0] - from[0]) * fraction;
    const y = from[1] + (goal[1] - from[1]) * fraction + lift;
    return withinReach(this.#rest, [x, y], this.#size.height);
  }

  #place(side: Side): Point {
    return side === this.side ? this.#rest : [-this.#rest[0], this.#rest[1]];
  }

  get #sign(): 1 | -1 {
    return this.side === Side.right ? 1 : -1;
  }
}
