/** A corner that lifts a little under a pointer which hovers there, to say that it can be taken. */

import { type Binding, isBoard } from "../book/spreads.ts";
import type { Flight, Turning } from "../book/turning.ts";
import { maxGrabs, Side } from "../engine/phases.ts";
import type { BookShape } from "../stage/book_pose.ts";
import type { DragHit } from "./drag_state.ts";

/** The hand that lifts a corner: the last, which no pointer stands for. */
const hand: number = maxGrabs - 1;

/** Where the corner is lifted to: shares of the leaf's width toward the spine, toward its middle, and up. */
const inward = 0.1;
const along = 0.07;
const up = 0.13;

/** Time in seconds in which it is lifted two thirds of that way. */
const liftTime = 0.09;

/** The corner of one bound book that is lifted, if one is. */
export class CornerPeek {
  readonly #turning: Turning;
  readonly #binding: Binding;
  readonly #shape: Pick<BookShape, "width" | "height">;
  #flight: Flight | null = null;
  #lifting = false;
  #side: Side = Side.right;
  #v = 0;
  #z = 0;
  /** How much of its way it is lifted. */
  #share = 0;

  constructor(turning: Turning, binding: Binding, shape: Pick<BookShape, "width" | "height">) {
    this.#turning = turning;
    this.#binding = binding;
    this.#shape = shape;
  }

  /** Whether the flight that begins is a corner's, and no turn. */
  get isLifting(): boolean {
    return this.#lifting;
  }

  /** The leaf whose corner is lifted or falls back, where nothing else is in flight. */
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
    return this.#turning.holds(hand);
  }

  /**
   * Lifts the corner of a resting leaf nearest to a place on it; not while
   * anything is in flight. Answers whether it does.
   *
   * @param z of that corner as it lies, metres
   */
  begin({ on, v }: DragHit, z: number): boolean {
    if (typeof on !== "number" || this.#turning.moving) return false;
    const { spread } = this.#turning;
    if (isBoard(this.#binding, on === Side.right ? spread : spread - 1)) return false;
    this.#lifting = true;
    const flight = this.#turning.lift(on);
    this.#lifting = false;
    if (flight === null) return false;
    [this.#flight, this.#side, this.#v, this.#z] = [flight, on, v < 0.5 ? 0 : 1, z];
    this.#share = 0;
    this.#turning.grab(flight, hand, 1, this.#v);
    this.#pull();
    return true;
  }

  /** Lifts it on. */
  step(seconds: number): void {
    if (!this.isHeld || this.#share === 1) return;
    this.#share += (1 - this.#share) * (1 - Math.exp(-seconds / liftTime));
    if (this.#share > 0.995) this.#share = 1;
    this.#pull();
  }

  /** Lets the corner fall. */
  end(): void {
    this.#turning.release(hand);
  }

  /** The flight is a turn from now on: answers it once, where it is the one whose corner was lifted. */
  take(flight: Flight): Flight | null {
    if (flight !== this.flight) return null;
    this.#flight = null;
    return flight;
  }

  #pull(): void {
    const { width, height } = this.#shape;
    const way = this.#share * width;
    const x = width - inward * way;
    const y = this.#v * height + (this.#v === 0 ? along : -along) * way;
    this.#turning.hold(hand, this.#side === Side.right ? x : -x, y, this.#z + up * way);
  }
}
