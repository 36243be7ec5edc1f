/** Lifts a corner a little under a hovering pointer, to show that it can be grabbed. */

import { uppermost } from "../book/leaf_order.ts";
import { type Binding, isBoard } from "../book/spreads.ts";
import type { Flight, Turning } from "../book/turning.ts";
import { maxGrabs, Side } from "../engine/phases.ts";
import type { BookShape } from "../stage/book_pose.ts";

/** The grab that lifts a corner: the last one, which no pointer uses. */
const grab: number = maxGrabs - 1;

/**
 * How far the corner is lifted: fractions of the leaf's width toward the spine,
 * toward its middle, and up.
 */
const inward = 0.1;
const along = 0.07;
const up = 0.13;

/** Time constant of the lift, in seconds: two thirds of the way. */
const liftTime = 0.09;

/** The lifted corner of one bound book, if there is one. */
export class CornerPeek {
  readonly #turning: Turning;
  readonly #binding: Binding;
  readonly #shape: Pick<BookShape, "width" | "height">;
  readonly #started: (flight: Flight) => void;
  #flight: Flight | null = null;
  #lifting = false;
  #side: Side = Side.right;
  #v = 0;
  #z = 0;
  /** The fraction of its way that the corner is lifted. */
  #fraction = 0;

  /** @param started called when a leaf whose corner was only lifted is turned from then on */
  constructor(
    turning: Turning,
    binding: Binding,
    shape: Pick<BookShape, "width" | "height">,
    started: (flight: Flight) => void,
  ) {
    this.#turning = turning;
    this.#binding = binding;
    this.#shape = shape;
    this.#started = started;
  }

  /** Whether the flight that begins belongs to a corner, not to a turn. */
  get isLifting(): boolean {
    return this.#lifting;
  }

  /** The leaf whose corner is lifted or falls back, if nothing else is in flight. */
  get flight(): Flight | null {
    const { flights } = this.#turning;
    return flights.length === 1 && flights[0] === this.#flight ? this.#flight : null;
  }

  /** The side where that leaf belongs. */
  get side(): Side {
    return this.#side;
  }

  /** Whether a corner is held up. */
  get isHeld(): boolean {
    return this.#turning.holds(grab);
  }

  /**
   * Lifts the corner of the uppermost leaf on a side, unless something is in
   * flight. Returns whether it does.
   *
   * @param v of a place nearest to that corner
   *
   * @param z of that corner as it lies, metres
   */
  begin(side: Side, v: number, z: number): boolean {
    if (this.#turning.moving) return false;
    const { spread } = this.#turning;
    if (isBoard(this.#binding, uppermost(side, [], spread).low)) return false;
    this.#lifting = true;
    const flight = this.#turning.pickUp(side);
    this.#lifting = false;
    if (flight === null) return false;
    [this.#flight, this.#side, this.#v, this.#z] = [flight, side, v < 0.5 ? 0 : 1, z];
    this.#fraction = 0;
    this.#turning.grab(flight, grab, 1, this.#v);
    this.#pull();
    return true;
  }

  /** Advances the lift. */
  step(seconds: number): void {
    if (!this.isHeld || this.#fraction === 1) return;
    this.#fraction += (1 - this.#fraction) * (1 - Math.exp(-seconds / liftTime));
    if (this.#fraction > 0.995) this.#fraction = 1;
    this.#pull();
  }

  /** Lets the corner fall. */
  end(): void {
    this.#turning.release(grab);
  }

  /** Makes the peek a turn if it is of this flight. */
  becomeTurn(flight: Flight): void {
    if (flight !== this.flight) return;
    this.#flight = null;
    this.#started(flight);
  }

  #pull(): void {
    const { width, height } = this.#shape;
    const way = this.#fraction * width;
    const x = width - inward * way;
    const y = this.#v * height + (this.#v === 0 ? along : -along) * way;
    this.#turning.hold(grab, this.#side === Side.right ? x : -x, y, this.#z + up * way);
  }
}
