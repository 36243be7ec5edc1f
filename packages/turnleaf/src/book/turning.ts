/**
 * The book's state: where it lies open, which leaf or board is in flight, and
 * the turns still to come. Every change is a command to the engine; nothing
 * here knows of pointers, screens or clocks.
 */

import { Cover, type EngineBook, isResting, Phase, Side } from "../engine/engine.ts";
import { type Binding, isBoard, leafCount, paperOnLeft, waypoints } from "./spreads.ts";

/** A leaf or a board between two spreads. */
export interface Flight {
  readonly part: "leaf" | Cover;
  /** The spread seen when it lies on the right, and on the left. */
  readonly low: number;
  readonly high: number;
  /** The spread where it was taken up. */
  readonly from: number;
  /** The side it was last sent to. */
  to: Side;
}

/** What happens to the book, in the order it happens. */
export interface TurningEvents {
  /** A leaf or a board leaves its side. */
  started(flight: Flight): void;
  /** It came to rest; `from` equals `to` where it fell back. */
  landed(from: number, to: number): void;
}

/** Turns that wait behind the one in flight, at most: a held key must stop soon after its release. */
const mostWaiting = 3;

/** Shortest a turn is hurried to, seconds. */
const shortestTurn = 0.25;

/** Where the book lies open and how it gets elsewhere. */
export class Turning {
  /** Length of a whole turn in seconds. */
  seconds = 0.8;

  readonly #engine: EngineBook;
  readonly #binding: Binding;
  readonly #events: TurningEvents;
  #spread = 0;
  #flight: Flight | null = null;
  /** Spreads still to reach, one turn each. */
  #plan: number[] = [];
  /** Whether a hand has hold of the flight: until it lets go, or a command takes the leaf from it. */
  #held = false;
  #promised: { spread: number; resolve: (landed: boolean) => void }[] = [];

  constructor(engine: EngineBook, binding: Binding, events: TurningEvents) {
    this.#engine = engine;
    this.#binding = binding;
    this.#events = events;
  }

  /** The spread that lies open, or from which the flight began. */
  get spread(): number {
    return this.#spread;
  }

  /** The leaf or board in flight, or null at rest. */
  get flight(): Flight | null {
    return this.#flight;
  }

  /** The spread where the book will lie when all that is asked for is done. */
  get destination(): number {
    return this.#plan.at(-1) ?? this.#landing() ?? this.#spread;
  }

  /** Opens the book at a spread at once, without a turn. */
  lay(spread: number): void {
    this.#plan = [];
    this.#flight = null;
    this.#held = false;
    this.#settle(spread);
    this.#keepPromises();
  }

  /** Stops where it is, for good: what was promised resolves to false, and the engine is told nothing more. */
  close(): void {
    this.#plan = [];
    this.#flight = null;
    this.#held = false;
    const promised = this.#promised;
    this.#promised = [];
    for (const { resolve } of promised) resolve(false);
  }

  /** Turns to a spread; resolves to whether the book came to rest there. */
  goTo(spread: number): Promise<boolean> {
    const from = this.#sendToward(spread);
    this.#plan = waypoints(this.#binding, from, spread);
    return this.#promise(spread);
  }

  /** Turns one leaf on (1) or back (-1); resolves to whether the book came to rest there. */
  turn(by: 1 | -1): Promise<boolean> {
    const last = leafCount(this.#binding);
    const spread = Math.min(Math.max(this.destination + by, 0), last);
    const flight = this.#flight;
    if (flight !== null && (this.#held || this.#opposes(by))) {
      // The same leaf goes there, though it may stand for many.
      this.#plan = [];
      this.#play(flight, by === 1 ? Side.left : Side.right);
    } else if (spread !== this.destination && this.#plan.length < mostWaiting) {
      this.#plan.push(spread);
    }
    return this.#promise(this.destination);
  }

  /** A hand takes up the leaf or board on top of `side`; false where there is none. */
  lift(side: Side): boolean {
    if (this.#flight !== null) return false;
    const to = this.#spread + (side === Side.right ? 1 : -1);
    if (to < 0 || to > leafCount(this.#binding)) return false;
    this.#plan = [];
    return this.#take(to) !== null;
  }

  /** The hand holds the leaf in flight at (u, v) of its surface. What was planned is off. */
  grab(u: number, v: number): void {
    this.#plan = [];
    this.#held = this.#flight !== null;
    if (this.#flight?.part === "leaf") this.#engine.grab(u, v);
  }

  /** The hand pulls to a place in book space (metres). */
  hold(x: number, y: number, z: number): void {
    // What a command took from the hand, and what was taken up since, is not its own.
    if (!this.#held) return;
    const part = this.#flight?.part;
    if (part === "leaf") this.#engine.hold(x, y, z);
    else if (part !== undefined) this.#engine.holdBoard(part, Math.atan2(Math.max(z, 0), x));
  }

  /** The hand lets go. */
  release(): void {
    const flight = this.#flight;
    if (flight === null || !this.#held) return;
    this.#held = false;
    if (flight.part === "leaf") this.#engine.release();
    else this.#engine.releaseBoard(flight.part);
    const phase = this.#advance(flight, 0);
    // A board that was not moved yet rests where it was.
    if (phase === Phase.fallingLeft || phase === Phase.restingLeft) flight.to = Side.left;
    if (phase === Phase.fallingRight || phase === Phase.restingRight) flight.to = Side.right;
  }

  /** Steps by whole ticks; answers whether anything still moves or waits. */
  step(ticks: number): boolean {
    this.#start();
    const flight = this.#flight;
    if (flight === null) return false;
    const phase = this.#advance(flight, ticks);
    if (isResting(phase)) {
      this.#land(phase === Phase.restingLeft ? flight.high : flight.low);
      this.#start();
    }
    return this.#flight !== null;
  }

  /** Whether a step would do anything. */
  get moving(): boolean {
    return this.#flight !== null || this.#plan.length > 0;
  }

  #advance({ part }: Flight, ticks: number): Phase {
    return part === "leaf" ? this.#engine.step(ticks) : this.#engine.stepBoard(part, ticks);
  }

  #landing(): number | null {
    const flight = this.#flight;
    if (flight === null) return null;
    return flight.to === Side.left ? flight.high : flight.low;
  }

  /** Whether a turn `by` goes against the one in flight, with nothing else waiting. */
  #opposes(by: 1 | -1): boolean {
    if (this.#flight === null || this.#plan.length > 0) return false;
    return this.#flight.to === (by === 1 ? Side.right : Side.left);
  }

  /** Sends what is in flight to its side nearer `spread`; answers the spread that gives. */
  #sendToward(spread: number): number {
    const flight = this.#flight;
    if (flight === null) return this.#spread;
    const to = spread >= flight.high ? Side.left : spread <= flight.low ? Side.right : flight.to;
    this.#play(flight, to);
    return to === Side.left ? flight.high : flight.low;
  }

  #start(): void {
    if (this.#flight !== null) {
      // Others wait: hurry what is in flight.
      if (this.#plan.length > 0) this.#play(this.#flight, this.#flight.to);
      return;
    }
    const next = this.#plan.shift();
    if (next === undefined || next === this.#spread) return;
    const flight = this.#take(next);
    if (flight !== null) this.#play(flight, flight.to);
  }

  /** Takes up the leaf between here and the spread `to`; null where whoever heard of it put it down again. */
  #take(to: number): Flight | null {
    const from = this.#spread;
    const [low, high] = from < to ? [from, to] : [to, from];
    const single = high - low === 1 && isBoard(this.#binding, low);
    const part = single ? (low === 0 ? Cover.front : Cover.back) : "leaf";
    const flight: Flight = { part, low, high, from, to: from < to ? Side.left : Side.right };
    this.#flight = flight;
    if (part === "leaf") {
      const side = from < to ? Side.right : Side.left;
      const read = (s: number) => paperOnLeft(this.#binding, s);
      this.#engine.lift(side, read(low), read(high));
    }
    this.#events.started(flight);
    return this.#flight === flight ? flight : null;
  }

  #play(flight: Flight, to: Side): void {
    flight.to = to;
    this.#held = false;
    const seconds = Math.max(this.seconds / (1 + this.#plan.length), shortestTurn);
    if (flight.part === "leaf") this.#engine.play(flight.to, seconds);
    else this.#engine.playBoard(flight.part, flight.to, seconds);
  }

  #land(spread: number): void {
    const from = this.#flight?.from ?? this.#spread;
    this.#flight = null;
    this.#held = false;
    this.#settle(spread);
    this.#events.landed(from, spread);
    if (this.#plan.length === 0) this.#keepPromises();
  }

  #settle(spread: number): void {
    const last = leafCount(this.#binding);
    this.#spread = spread;
    this.#engine.lay(paperOnLeft(this.#binding, spread));
    if (this.#binding.hardCover) {
      this.#engine.layBoard(Cover.front, spread > 0 ? Side.left : Side.right);
      this.#engine.layBoard(Cover.back, spread === last ? Side.left : Side.right);
    }
    this.#engine.update();
  }

  #promise(spread: number): Promise<boolean> {
    const promised = new Promise<boolean>((resolve) => this.#promised.push({ spread, resolve }));
    // Also a turn that was asked for and called off before it began.
    if (!this.moving) this.#keepPromises();
    return promised;
  }

  #keepPromises(): void {
    const promised = this.#promised;
    this.#promised = [];
    for (const { spread, resolve } of promised) resolve(spread === this.#spread);
  }
}
