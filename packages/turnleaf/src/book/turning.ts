/**
 * The book's state: where it lies open, what is in flight, and the turns still
 * to come. Every change is a command to the engine; nothing here depends on
 * pointers, screens or clocks.
 */

import type { BookEngine } from "../engine/book_engine.ts";
import { Cover, isResting, Phase, Side, sideOf } from "../engine/phases.ts";
import { type Between, landingOrder, outermost, uppermost, withPickedUp } from "./leaf_order.ts";
import { type Binding, isBoard, leafCount, paperOnLeft, waypoints } from "./spreads.ts";

/** What happens to a book's leaves, as the element's `state` says it. */
export type BookState = "resting" | "lifting" | "dragged" | "turning";

/** A leaf or a board between two spreads. */
export interface Flight extends Between {
  readonly part: "leaf" | Cover;
  /** The engine's number of the flight; 0 for a board. */
  readonly id: number;
  /** The spread where it was picked up. */
  readonly from: number;
  /** The side it was last sent to. */
  to: Side;
  /** u and v of where a pointer first grabbed it. */
  grip?: readonly [u: number, v: number];
}

/** The events of a book, in the order they happen. */
export interface TurningEvents {
  /** A leaf or a board has left its side. */
  started(flight: Flight): void;
  /** It has come to rest on a side. */
  landed(flight: Flight): void;
  /**
   * The book is at rest: nothing is in flight and nothing waits to begin.
   * `from` is where it rested before; it equals `to` if every leaf fell back.
   */
  rested(from: number, to: number): void;
}

/** Maximum of leaves in flight at once. */
const mostFlights = 12;

/** Maximum of a reader's turns that wait to begin: a held key must stop soon after its release. */
const mostWaiting = 3;

/**
 * Minimum time between two leaves that follow each other, in seconds and as a
 * fraction of a turn.
 */
const leastApart = 0.07;
const fractionApart = 0.09;

/** Minimum length of a turn in seconds. */
const shortestTurn = 0.25;

/** A promise that resolves to true or false when the book comes to rest. */
interface PendingPromise {
  readonly isKeptAt: (spread: number) => boolean;
  readonly resolve: (kept: boolean) => void;
}

/** Holds where the book lies open and turns it elsewhere. */
export class Turning {
  /** Length of a whole turn in seconds. */
  seconds = 0.8;

  readonly #engine: BookEngine;
  readonly #binding: Binding;
  readonly #events: TurningEvents;
  #spread = 0;
  /** The spread where the book last rested, and whether it has left that rest. */
  #restedAt = 0;
  #hasLeft = false;
  /** Leaves of paper from the left to the right, or one board by itself. */
  #flights: Flight[] = [];
  /**
   * Spreads still to reach, one turn each, and whether a reader's turns ask for
   * them rather than a command.
   */
  #plan: number[] = [];
  #isReaders = false;
  /** Time since a leaf was picked up, in seconds. */
  #sincePickUp = Number.POSITIVE_INFINITY;
  /** The flight that each pointer holds, until it releases it or a command takes it over. */
  readonly #held = new Map<number, Flight>();
  #promised: PendingPromise[] = [];
  /** Rises when everything in flight is put down at once, which voids whatever was under way. */
  #era = 0;

  constructor(engine: BookEngine, binding: Binding, events: TurningEvents) {
    this.#engine = engine;
    this.#binding = binding;
    this.#events = events;
  }

  /** The spread that lies open, leaves in flight aside. */
  get spread(): number {
    return this.#spread;
  }

  /** What is in flight: leaves from the left to the right, or one board. */
  get flights(): readonly Flight[] {
    return this.#flights;
  }

  /** The spreads left and right of everything in flight. */
  get outermost(): Between {
    return outermost(this.#flights, this.#spread);
  }

  /** What is drawn by itself, from left to right: all in flight, and creased leaves that lie uppermost. */
  get drawn(): readonly Between[] {
    const { creases } = this.#engine;
    if (!creases) return this.#flights;
    const { low, high } = this.outermost;
    const left = creases.lies(Side.left) ? [{ low: low - 1, high: low }] : [];
    const right = creases.lies(Side.right) ? [{ low: high, high: high + 1 }] : [];
    return [...left, ...this.#flights, ...right];
  }

  /** The spreads left and right of everything that is drawn by itself. */
  get under(): Between {
    return outermost(this.drawn, this.#spread);
  }

  /** What has a surface of the engine, in its order: all that is drawn by itself but boards. */
  get leaves(): readonly Between[] {
    return this.drawn.filter((one) => !("part" in one) || one.part === "leaf");
  }

  /** The spread where the book last rested. */
  get restedAt(): number {
    return this.#restedAt;
  }

  /** The spread where the book will lie when all requests are done. */
  get destination(): number {
    return this.#plan.at(-1) ?? this.#landing;
  }

  /** Whether a step would do anything. */
  get moving(): boolean {
    return this.#flights.length > 0 || this.#plan.length > 0;
  }

  /** Whether a step would do something though nothing turns: folds of an uncovered leaf open. */
  get isSettling(): boolean {
    const { creases, isAsleep } = this.#engine;
    return !this.moving && creases !== undefined && !isAsleep;
  }

  /** Opens the book at a spread at once, without a turn. */
  lay(spread: number): void {
    this.#putDown();
    this.#spread = this.#restedAt = spread;
    this.#hasLeft = false;
    this.#engine.lay(paperOnLeft(this.#binding, spread));
    // Without boards nothing presses the pages flat.
    const { hardCover } = this.#binding;
    const last = leafCount(this.#binding);
    this.#engine.layBoard(Cover.front, spread > 0 || !hardCover ? Side.left : Side.right);
    this.#engine.layBoard(Cover.back, spread === last && hardCover ? Side.left : Side.right);
    this.#engine.update();
    keepPromises(this.#takePromises(), spread);
  }

  /** Stops for good: every promise resolves to false, and the engine is not called again. */
  close(): void {
    this.#putDown();
    for (const { resolve } of this.#takePromises()) resolve(false);
  }

  /** Turns to a spread. Resolves, once the book is at rest, to whether it lies there. */
  goTo(spread: number): Promise<boolean> {
    this.#head(spread);
    return this.#promise((at) => at === spread);
  }

  /**
   * Turns one leaf forward (1) or back (-1) from where the book will lie when
   * all earlier requests are done. Every call counts: waiting turns become a
   * jump if they are many. A held leaf is the one that is turned.
   *
   * Resolves, once the book is at rest, to whether it lies there or farther on
   * in that direction; at once to false at the end of the book.
   */
  turn(by: 1 | -1): Promise<boolean> {
    const held = this.#heldLast;
    if (held !== undefined) return this.#turnHeld(held, by);
    const spread = this.#next(by);
    if (spread === null) return Promise.resolve(false);
    this.#head(spread);
    return this.#promise((at) => (at - spread) * by >= 0);
  }

  /**
   * Turns one leaf forward (1) or back (-1) for a reader's key, click, flick or
   * wheel. What the reader sees counts: against the leaves in flight, the last
   * one picked up goes back, and a jump is cancelled. Few turns wait, so that a
   * held key stops soon after its release.
   *
   * Resolves as `turn` does, and at once to false if too many turns wait.
   *
   * @param isTap whether the reader asks by a press of its own, as of a key that is not held: each
   * counts, however many wait, as several may come within one late frame
   */
  press(by: 1 | -1, isTap = false): Promise<boolean> {
    const held = this.#heldLast;
    if (held !== undefined) return this.#turnHeld(held, by);
    if (!this.#isReaders && this.#plansAgainst(by)) this.#plan = [];
    const back = this.#nextBack(by);
    if (this.#plansAgainst(by)) this.#plan.pop();
    else if (back !== undefined && this.#plan.length === 0) this.#play(back, sideTo(by));
    else {
      const spread = this.#next(by);
      const isFull = !isTap && this.#plan.length >= mostWaiting;
      if (spread === null || isFull) return Promise.resolve(false);
      this.#plan.push(spread);
      this.#isReaders = true;
    }
    const { destination } = this;
    return this.#promise((at) => (at - destination) * by >= 0);
  }

  /** Returns the spread to which `turn` would turn, or null at the end of the book. */
  turned(by: 1 | -1): number | null {
    const held = this.#heldLast;
    if (held !== undefined) return by === 1 ? held.high : held.low;
    return this.#next(by);
  }

  /** Returns whether a leaf or board lies on a side, besides everything in flight. */
  hasLeaf(side: Side): boolean {
    const { low, high } = uppermost(side, this.#flights, this.#spread);
    return low >= this.#binding.first && high <= this.#binding.last;
  }

  /**
   * Picks up the leaf or board on top of `side`. Returns null if there is none
   * or it has to wait.
   */
  pickUp(side: Side): Flight | null {
    const { low, high } = uppermost(side, this.#flights, this.#spread);
    if (!this.hasLeaf(side) || !this.#mayFly(low)) return null;
    this.#plan = [];
    return this.#take(side, low, high);
  }

  /**
   * Grabs a flight at (u, v) of its surface. Planned turns are cancelled, and a
   * leaf held by another pointer is released: one leaf is held at a time.
   */
  grab(flight: Flight, grab: number, u: number, v: number): void {
    if (!this.#flights.includes(flight)) return;
    this.#plan = [];
    for (const [other, held] of this.#held) if (held !== flight) this.#held.delete(other);
    this.#held.set(grab, flight);
    if (flight.part !== "leaf") return;
    flight.grip ??= [u, v];
    this.#engine.grab(flight.id, grab, u, v);
    this.#follow();
  }

  /** Pulls a grab to a place in book space (metres). */
  hold(grab: number, x: number, y: number, z: number): void {
    // A leaf that a command took over, and one picked up since, do not follow this grab.
    const flight = this.#held.get(grab);
    if (flight?.part === "leaf") this.#engine.hold(flight.id, grab, x, y, z);
    else if (flight) this.#engine.holdBoard(flight.part, Math.atan2(Math.max(z, 0), x));
  }

  /** Returns whether a grab holds something. */
  holds(grab: number): boolean {
    return this.#held.has(grab);
  }

  /** Returns the flight that a grab holds; undefined if it holds none. */
  heldBy(grab: number): Flight | undefined {
    return this.#held.get(grab);
  }

  /** Whether a pointer holds a leaf or a board. */
  get hasHeld(): boolean {
    return this.#held.size > 0;
  }

  /** Whether every moving leaf is held and no turn waits. */
  get isHeld(): boolean {
    const held = [...this.#held.values()];
    return this.#plan.length === 0 && this.#flights.every((flight) => held.includes(flight));
  }

  /** Releases a grab. */
  release(grab: number): void {
    const flight = this.#held.get(grab);
    this.#held.delete(grab);
    if (flight === undefined || !this.#flights.includes(flight)) return;
    if (flight.part === "leaf") this.#engine.release(flight.id, grab);
    else if (![...this.#held.values()].includes(flight)) this.#engine.releaseBoard(flight.part);
    this.#follow();
  }

  /**
   * Steps a frame by whole ticks, or by as many of them as the engine allows a frame. Returns
   * whether anything still moves or waits.
   */
  step(ticks: number): boolean {
    const { tick } = this.#engine;
    this.#engine.beginFrame();
    let left = ticks;
    do {
      this.#pickUpNext();
      const wait = Math.ceil((this.#apart - this.#sincePickUp) / tick);
      const now = this.#plan.length > 0 && wait > 0 ? Math.min(left, wait) : left;
      const stepped = this.#advance(now);
      this.#sincePickUp += stepped * tick;
      left = stepped < now ? 0 : left - now;
    } while (left > 0 && this.moving);
    this.#dropReached();
    if (!this.moving) this.#rest();
    return this.moving;
  }

  /** The spread where the book will lie when everything in flight has landed. */
  get #landing(): number {
    const back = this.#flights.find(({ to }) => to === Side.right);
    return back?.low ?? this.outermost.high;
  }

  get #apart(): number {
    return Math.max(leastApart, fractionApart * this.seconds);
  }

  /** Returns whether leaf `low` may fly beside the leaves in flight: a board flies alone. */
  #mayFly(low: number): boolean {
    const { length } = this.#flights;
    if (length === 0) return true;
    return length < mostFlights && this.#flights[0].part === "leaf" && !isBoard(this.#binding, low);
  }

  /** Returns whether the waiting turns go against a turn `by`. */
  #plansAgainst(by: 1 | -1): boolean {
    return this.#plan.length > 0 && (this.destination - this.#landing) * by < 0;
  }

  /** Returns the flight that a turn `by` sends back: the last one sent the other way. */
  #nextBack(by: 1 | -1): Flight | undefined {
    return by === 1
      ? this.#flights.find(({ to }) => to === Side.right)
      : this.#flights.findLast(({ to }) => to === Side.left);
  }

  /** The flight grabbed last, if one is held. */
  get #heldLast(): Flight | undefined {
    return [...this.#held.values()].at(-1);
  }

  /**
   * Returns the spread one leaf forward (1) or back (-1) from the destination,
   * or null at the end of the book.
   */
  #next(by: 1 | -1): number | null {
    const spread = this.destination + by;
    return spread < this.#binding.first || spread > this.#binding.last ? null : spread;
  }

  /**
   * Sends the leaves in flight to where they lie at a spread, and plans the
   * rest of the way there.
   */
  #head(spread: number): void {
    this.#plan = [];
    const held = [...this.#held.values()];
    for (const flight of this.#flights) {
      const { low, high } = flight;
      const to = spread >= high ? Side.left : spread <= low ? Side.right : flight.to;
      // A leaf already on its way there keeps its pace.
      if (flight.to !== to || held.includes(flight)) this.#play(flight, to);
    }
    this.#plan = waypoints(this.#binding, this.#landing, spread);
    this.#isReaders = false;
  }

  /** Takes a leaf or board over from the grab that holds it, and turns it. */
  #turnHeld(held: Flight, by: 1 | -1): Promise<boolean> {
    this.#plan = [];
    this.#play(held, sideTo(by));
    const { destination } = this;
    return this.#promise((at) => (at - destination) * by >= 0);
  }

  /** Drops planned turns that are already done. */
  #dropReached(): void {
    while (this.#plan.length > 0 && this.#plan[0] === this.#landing) this.#plan.shift();
  }

  /** Begins the next waiting turn, if it may begin yet. */
  #pickUpNext(): void {
    this.#dropReached();
    if (this.#plan.length === 0 || this.#sincePickUp < this.#apart) return;
    const [from, to] = [this.#landing, this.#plan[0]];
    const side = from < to ? Side.right : Side.left;
    const [low, high] = from < to ? [from, to] : [to, from];
    // A leaf on its way to the side that the next one leaves must land there first.
    if (!this.#mayFly(low) || this.#flights.some((flight) => flight.to === side)) return;
    this.#plan.shift();
    const flight = this.#take(side, low, high);
    if (flight !== null) this.#play(flight, flight.to);
  }

  /**
   * Picks up what lies between two spreads. Returns null if that is impossible,
   * or if a listener put it down again.
   */
  #take(side: Side, low: number, high: number): Flight | null {
    const board = high - low === 1 && isBoard(this.#binding, low);
    const part = board ? (low === 0 ? Cover.front : Cover.back) : "leaf";
    const read = (s: number): number => paperOnLeft(this.#binding, s);
    const id = board ? 0 : this.#engine.pickUp(side, read(low), read(high));
    if (!board && id === 0) {
      this.#plan = [];
      return null;
    }
    const [from, to] = side === Side.right ? [low, Side.left] : [high, Side.right];
    const flight: Flight = { part, id, low, high, from, to };
    this.#flights = withPickedUp(side, this.#flights, flight);
    this.#sincePickUp = 0;
    this.#hasLeft = true;
    this.#events.started(flight);
    return this.#flights.includes(flight) ? flight : null;
  }

  #play(flight: Flight, to: Side): void {
    for (const [grab, held] of this.#held) if (held === flight) this.#held.delete(grab);
    flight.to = to;
    if (flight.part === "leaf") {
      this.#engine.play(flight.id, to, Math.max(this.seconds, shortestTurn));
      this.#follow();
    } else {
      // Other turns wait for the board to land, so it turns faster.
      const seconds = this.seconds / (this.#plan.length > 0 ? 2 : 1);
      this.#engine.playBoard(flight.part, to, Math.max(seconds, shortestTurn));
    }
  }

  /** Updates the side that each flight is bound for: a released or sent leaf takes others along. */
  #follow(): void {
    for (const flight of this.#flights) flight.to = sideOf(this.#phase(flight)) ?? flight.to;
  }

  #phase({ part, id }: Flight): Phase {
    return part === "leaf" ? this.#engine.phase(id) : this.#engine.stepBoard(part, 0);
  }

  /** Steps what flies. Returns by how many ticks. */
  #advance(ticks: number): number {
    const [first] = this.#flights;
    const isBoard = first !== undefined && first.part !== "leaf";
    if (isBoard) this.#engine.stepBoard(first.part, ticks);
    // Folds of what was uncovered open meanwhile.
    const isStepped = first?.part === "leaf" || this.#engine.creases !== undefined;
    const done = isStepped ? this.#engine.stepFrame(ticks) : ticks;
    const stepped = isBoard ? ticks : done;
    if (first === undefined) return stepped;
    const hasLanded = (flight: Flight): boolean => {
      const phase = this.#phase(flight);
      return flight.part === "leaf" ? phase === Phase.over : isResting(phase);
    };
    const landed = this.#flights.filter(hasLanded);
    // The pile tells where a landed leaf went.
    const read = landed.length > 0 ? this.#engine.read : 0;
    for (const flight of landed) {
      if (flight.part !== "leaf") continue;
      flight.to = paperOnLeft(this.#binding, flight.high) <= read ? Side.left : Side.right;
    }
    this.#follow();
    this.#flights = this.#flights.filter((flight) => !landed.includes(flight));
    this.#land(landed);
    return stepped;
  }

  /** Reports what has come to rest. */
  #land(landed: readonly Flight[]): void {
    const era = this.#era;
    for (const flight of landingOrder(landed)) {
      const to = flight.to === Side.left ? flight.high : flight.low;
      if (to !== flight.from) this.#spread = to;
      for (const [grab, held] of this.#held) if (held === flight) this.#held.delete(grab);
      this.#events.landed(flight);
      // A listener may have laid the book elsewhere or taken it away.
      if (era !== this.#era) return;
    }
  }

  /** Reports the rest if something had moved, then resolves the promises. */
  #rest(): void {
    const at = this.#spread;
    // What a listener requests belongs to the rest after this one.
    const promised = this.#takePromises();
    if (this.#hasLeft) {
      const from = this.#restedAt;
      this.#restedAt = at;
      this.#hasLeft = false;
      this.#events.rested(from, at);
    }
    keepPromises(promised, at);
  }

  #putDown(): void {
    this.#era++;
    this.#plan = [];
    this.#flights = [];
    this.#held.clear();
    this.#sincePickUp = Number.POSITIVE_INFINITY;
  }

  #promise(isKeptAt: PendingPromise["isKeptAt"]): Promise<boolean> {
    const promised = new Promise<boolean>((resolve) => this.#promised.push({ isKeptAt, resolve }));
    // Also for a turn that was cancelled before it began.
    if (!this.moving) this.#rest();
    return promised;
  }

  #takePromises(): readonly PendingPromise[] {
    const promised = this.#promised;
    this.#promised = [];
    return promised;
  }
}

function keepPromises(promised: readonly PendingPromise[], at: number): void {
  for (const { isKeptAt, resolve } of promised) resolve(isKeptAt(at));
}

/** Returns the side that a turn `by` goes to. */
function sideTo(by: 1 | -1): Side {
  return by === 1 ? Side.left : Side.right;
}
