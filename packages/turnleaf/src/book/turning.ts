/**
 * The book's state: where it lies open, what is in flight, and the turns still
 * to come. Every change is a command to the engine; nothing here knows of
 * pointers, screens or clocks.
 */

import type { BookEngine } from "../engine/book_engine.ts";
import { Cover, isResting, Phase, Side, sideOf } from "../engine/phases.ts";
import { type Binding, isBoard, leafCount, paperOnLeft, waypoints } from "./spreads.ts";

/** A leaf or a board between two spreads. */
export interface Flight {
  readonly part: "leaf" | Cover;
  /** The engine's number of it; 0 for a board. */
  readonly id: number;
  /** The spread seen when it lies on the right, and on the left. */
  readonly low: number;
  readonly high: number;
  /** The spread where it was taken up. */
  readonly from: number;
  /** The side it was last sent to. */
  to: Side;
  /** u and v of where a hand first took hold of it. */
  grip?: readonly [u: number, v: number];
}

/** What happens to the book, in the order it happens. */
export interface TurningEvents {
  /** A leaf or a board leaves its side. */
  started(flight: Flight): void;
  /** It came to rest on a side. */
  landed(flight: Flight): void;
  /**
   * The book is at rest: nothing is in flight and nothing waits to begin. `from` is where it
   * rested before, and equals `to` where everything fell back.
   */
  rested(from: number, to: number): void;
}

/** Leaves in flight at once, at most. */
const mostFlights = 12;

/** Turns of a reader's that wait to begin, at most: a held key must stop soon after its release. */
const mostWaiting = 3;

/** Time between two leaves that follow each other, seconds and as a share of a turn. */
const leastApart = 0.07;
const shareApart = 0.09;

/** Shortest a turn is, seconds. */
const shortestTurn = 0.25;

/** A promise that is kept or broken when the book comes to rest. */
interface Promised {
  readonly isKeptAt: (spread: number) => boolean;
  readonly resolve: (kept: boolean) => void;
}

/** Where the book lies open and how it gets elsewhere. */
export class Turning {
  /** Length of a whole turn in seconds. */
  seconds = 0.8;

  readonly #engine: BookEngine;
  readonly #binding: Binding;
  readonly #events: TurningEvents;
  #spread = 0;
  /** The spread where the book rested last, and whether it has left that rest. */
  #restedAt = 0;
  #hasLeft = false;
  /** Leaves of paper from the left to the right, or one board by itself. */
  #flights: Flight[] = [];
  /** Spreads still to reach, one turn each, and whether a reader's own turns ask for them, not a command. */
  #plan: number[] = [];
  #isReaders = false;
  /** Time since a leaf was taken up, seconds. */
  #sinceLift = Number.POSITIVE_INFINITY;
  /** What each hand has hold of: until it lets go, or a command takes it from it. */
  readonly #held = new Map<number, Flight>();
  #promised: Promised[] = [];
  /** Rises when everything in flight is put down at once: what was under way is void. */
  #era = 0;

  constructor(engine: BookEngine, binding: Binding, events: TurningEvents) {
    this.#engine = engine;
    this.#binding = binding;
    this.#events = events;
  }

  /** The spread that lies open, but for what is in flight. */
  get spread(): number {
    return this.#spread;
  }

  /** What is in flight: leaves from the left to the right, or one board. */
  get flights(): readonly Flight[] {
    return this.#flights;
  }

  /** The spread where the book rested last. */
  get restedAt(): number {
    return this.#restedAt;
  }

  /** The spread where the book will lie when all that is asked for is done. */
  get destination(): number {
    return this.#plan.at(-1) ?? this.#landing;
  }

  /** Whether a step would do anything. */
  get moving(): boolean {
    return this.#flights.length > 0 || this.#plan.length > 0;
  }

  /** Opens the book at a spread at once, without a turn. */
  lay(spread: number): void {
    this.#putDown();
    this.#spread = this.#restedAt = spread;
    this.#hasLeft = false;
    this.#engine.lay(paperOnLeft(this.#binding, spread));
    // Where there are no boards, none presses the pages flat.
    const { hardCover } = this.#binding;
    const last = leafCount(this.#binding);
    this.#engine.layBoard(Cover.front, spread > 0 || !hardCover ? Side.left : Side.right);
    this.#engine.layBoard(Cover.back, spread === last && hardCover ? Side.left : Side.right);
    this.#engine.update();
    keepPromises(this.#takePromises(), spread);
  }

  /** Stops where it is, for good: every promise resolves to false, and the engine is not called again. */
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
   * Turns one leaf on (1) or back (-1) from where the book will lie when all that was asked for
   * before is done. Every call counts: what waits becomes a jump where it is many leaves. A leaf
   * in hand is the one that is turned.
   *
   * Resolves, once the book is at rest, to whether it lies there or farther on that way; at once
   * to false at the book's end.
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
   * A reader turns one leaf on (1) or back (-1), by a key, a click, a flick or the wheel. What a
   * reader sees counts: against the leaves in flight, the one taken up last goes back, and a jump
   * is called off; and few turns wait, so that a held key stops soon after its release.
   *
   * Resolves as `turn` does, and at once to false where too many wait.
   */
  press(by: 1 | -1): Promise<boolean> {
    const held = this.#heldLast;
    if (held !== undefined) return this.#turnHeld(held, by);
    if (!this.#isReaders && this.#plansAgainst(by)) this.#plan = [];
    const back = this.#nextBack(by);
    if (this.#plansAgainst(by)) this.#plan.pop();
    else if (back !== undefined && this.#plan.length === 0) this.#play(back, sideTo(by));
    else {
      const spread = this.#next(by);
      if (spread === null || this.#plan.length >= mostWaiting) return Promise.resolve(false);
      this.#plan.push(spread);
      this.#isReaders = true;
    }
    const { destination } = this;
    return this.#promise((at) => (at - destination) * by >= 0);
  }

  /** The spread to which `turn` would turn; null at the book's end. */
  turned(by: 1 | -1): number | null {
    const held = this.#heldLast;
    if (held !== undefined) return by === 1 ? held.high : held.low;
    return this.#next(by);
  }

  /** A hand takes up the leaf or board on top of `side`; null where there is none, or where it has to wait. */
  lift(side: Side): Flight | null {
    const [low, high] =
      side === Side.right
        ? [this.#rightEnd, this.#rightEnd + 1]
        : [this.#leftEnd - 1, this.#leftEnd];
    const { first, last } = this.#binding;
    if (low < first || high > last || !this.#mayFly(low)) return null;
    this.#plan = [];
    return this.#take(side, low, high);
  }

  /**
   * A hand holds a flight at (u, v) of its surface. What was planned is off, and
   * a leaf that another hand held is let go: one is in hand at a time.
   */
  grab(flight: Flight, hand: number, u: number, v: number): void {
    if (!this.#flights.includes(flight)) return;
    this.#plan = [];
    for (const [other, held] of this.#held) if (held !== flight) this.#held.delete(other);
    this.#held.set(hand, flight);
    if (flight.part !== "leaf") return;
    flight.grip ??= [u, v];
    this.#engine.grab(flight.id, hand, u, v);
    this.#follow();
  }

  /** A hand pulls to a place in book space (metres). */
  hold(hand: number, x: number, y: number, z: number): void {
    // What a command took from the hand, and what was taken up since, is not its own.
    const flight = this.#held.get(hand);
    if (flight?.part === "leaf") this.#engine.hold(flight.id, hand, x, y, z);
    else if (flight) this.#engine.holdBoard(flight.part, Math.atan2(Math.max(z, 0), x));
  }

  /** Whether a hand has hold of something. */
  holds(hand: number): boolean {
    return this.#held.has(hand);
  }

  /** Whether all that moves is in hand, and nothing else is to come. */
  get inHand(): boolean {
    const held = [...this.#held.values()];
    return this.#plan.length === 0 && this.#flights.every((flight) => held.includes(flight));
  }

  /** A hand lets go. */
  release(hand: number): void {
    const flight = this.#held.get(hand);
    this.#held.delete(hand);
    if (flight === undefined || !this.#flights.includes(flight)) return;
    if (flight.part === "leaf") this.#engine.release(flight.id, hand);
    else if (![...this.#held.values()].includes(flight)) this.#engine.releaseBoard(flight.part);
    this.#follow();
  }

  /** Steps by whole ticks. Returns whether anything still moves or waits. */
  step(ticks: number): boolean {
    const { tick } = this.#engine;
    let left = ticks;
    do {
      this.#liftNext();
      const wait = Math.ceil((this.#apart - this.#sinceLift) / tick);
      const now = this.#plan.length > 0 && wait > 0 ? Math.min(left, wait) : left;
      this.#advance(now);
      this.#sinceLift += now * tick;
      left -= now;
    } while (left > 0 && this.moving);
    this.#dropReached();
    if (!this.moving) this.#rest();
    return this.moving;
  }

  /** Where the book will lie when all that is in flight has landed. */
  get #landing(): number {
    const back = this.#flights.find(({ to }) => to === Side.right);
    return back?.low ?? this.#rightEnd;
  }

  /** The spreads left and right of all that is in flight. */
  get #leftEnd(): number {
    return this.#flights[0]?.low ?? this.#spread;
  }

  get #rightEnd(): number {
    return this.#flights.at(-1)?.high ?? this.#spread;
  }

  get #apart(): number {
    return Math.max(leastApart, shareApart * this.seconds);
  }

  /** Whether leaf `low` may fly beside what is in flight: a board flies alone. */
  #mayFly(low: number): boolean {
    const { length } = this.#flights;
    if (length === 0) return true;
    return length < mostFlights && this.#flights[0].part === "leaf" && !isBoard(this.#binding, low);
  }

  /** Whether what waits to begin goes against a turn `by`. */
  #plansAgainst(by: 1 | -1): boolean {
    return this.#plan.length > 0 && (this.destination - this.#landing) * by < 0;
  }

  /** The flight that a turn `by` sends back: the last that was sent the other way. */
  #nextBack(by: 1 | -1): Flight | undefined {
    return by === 1
      ? this.#flights.find(({ to }) => to === Side.right)
      : this.#flights.findLast(({ to }) => to === Side.left);
  }

  /** What was taken in hand last, where something is in hand. */
  get #heldLast(): Flight | undefined {
    return [...this.#held.values()].at(-1);
  }

  /** The spread one leaf on (1) or back (-1) from the destination; null at the book's end. */
  #next(by: 1 | -1): number | null {
    const spread = this.destination + by;
    return spread < this.#binding.first || spread > this.#binding.last ? null : spread;
  }

  /** Sends what is in flight to where it lies at a spread, and plans the rest of the way there. */
  #head(spread: number): void {
    this.#plan = [];
    const held = [...this.#held.values()];
    for (const flight of this.#flights) {
      const { low, high } = flight;
      const to = spread >= high ? Side.left : spread <= low ? Side.right : flight.to;
      // What is on its way there keeps its pace.
      if (flight.to !== to || held.includes(flight)) this.#play(flight, to);
    }
    this.#plan = waypoints(this.#binding, this.#landing, spread);
    this.#isReaders = false;
  }

  /** Takes a leaf or board from the hand that holds it, and turns it. */
  #turnHeld(held: Flight, by: 1 | -1): Promise<boolean> {
    this.#plan = [];
    this.#play(held, sideTo(by));
    const { destination } = this;
    return this.#promise((at) => (at - destination) * by >= 0);
  }

  /** Drops from the plan what has come about by itself. */
  #dropReached(): void {
    while (this.#plan.length > 0 && this.#plan[0] === this.#landing) this.#plan.shift();
  }

  /** Begins the next turn that waits, if it may begin yet. */
  #liftNext(): void {
    this.#dropReached();
    if (this.#plan.length === 0 || this.#sinceLift < this.#apart) return;
    const [from, to] = [this.#landing, this.#plan[0]];
    const side = from < to ? Side.right : Side.left;
    const [low, high] = from < to ? [from, to] : [to, from];
    // A leaf on its way to the side from which the next one comes must arrive there first.
    if (!this.#mayFly(low) || this.#flights.some((flight) => flight.to === side)) return;
    this.#plan.shift();
    const flight = this.#take(side, low, high);
    if (flight !== null) this.#play(flight, flight.to);
  }

  /** Takes up what is between two spreads; null where it cannot be, or where whoever heard of it put it down again. */
  #take(side: Side, low: number, high: number): Flight | null {
    const board = high - low === 1 && isBoard(this.#binding, low);
    const part = board ? (low === 0 ? Cover.front : Cover.back) : "leaf";
    const read = (s: number): number => paperOnLeft(this.#binding, s);
    const id = board ? 0 : this.#engine.lift(side, read(low), read(high));
    if (!board && id === 0) {
      this.#plan = [];
      return null;
    }
    const [from, to] = side === Side.right ? [low, Side.left] : [high, Side.right];
    const flight: Flight = { part, id, low, high, from, to };
    if (side === Side.right) this.#flights.push(flight);
    else this.#flights.unshift(flight);
    this.#sinceLift = 0;
    this.#hasLeft = true;
    this.#events.started(flight);
    return this.#flights.includes(flight) ? flight : null;
  }

  #play(flight: Flight, to: Side): void {
    for (const [hand, held] of this.#held) if (held === flight) this.#held.delete(hand);
    flight.to = to;
    if (flight.part === "leaf") {
      this.#engine.play(flight.id, to, Math.max(this.seconds, shortestTurn));
      this.#follow();
    } else {
      // Others wait until it lies: it is swung faster.
      const seconds = this.seconds / (this.#plan.length > 0 ? 2 : 1);
      this.#engine.playBoard(flight.part, to, Math.max(seconds, shortestTurn));
    }
  }

  /** Learns where each flight is bound for: one that lets go or is sent takes others along. */
  #follow(): void {
    for (const flight of this.#flights) flight.to = sideOf(this.#phase(flight)) ?? flight.to;
  }

  #phase({ part, id }: Flight): Phase {
    return part === "leaf" ? this.#engine.phase(id) : this.#engine.stepBoard(part, 0);
  }

  #advance(ticks: number): void {
    const [first] = this.#flights;
    if (first === undefined) return;
    if (first.part === "leaf") this.#engine.step(ticks);
    else this.#engine.stepBoard(first.part, ticks);
    const hasLanded = (flight: Flight): boolean => {
      const phase = this.#phase(flight);
      return flight.part === "leaf" ? phase === Phase.over : isResting(phase);
    };
    const landed = this.#flights.filter(hasLanded);
    // Of a leaf that is over, the pile knows where it went.
    const read = landed.length > 0 ? this.#engine.read : 0;
    for (const flight of landed) {
      if (flight.part !== "leaf") continue;
      flight.to = paperOnLeft(this.#binding, flight.high) <= read ? Side.left : Side.right;
    }
    this.#follow();
    this.#flights = this.#flights.filter((flight) => !landed.includes(flight));
    this.#land(landed);
  }

  /** Tells of what came to rest, on either side from the pile on. */
  #land(landed: readonly Flight[]): void {
    const left = landed.filter(({ to }) => to === Side.left);
    const right = landed.filter(({ to }) => to === Side.right).reverse();
    const era = this.#era;
    for (const flight of [...left, ...right]) {
      const to = flight.to === Side.left ? flight.high : flight.low;
      if (to !== flight.from) this.#spread = to;
      for (const [hand, held] of this.#held) if (held === flight) this.#held.delete(hand);
      this.#events.landed(flight);
      // Whoever heard of it may have laid the book elsewhere, or taken it away.
      if (era !== this.#era) return;
    }
  }

  /** Nothing moves and nothing waits: says so where something did, then keeps the promises. */
  #rest(): void {
    const at = this.#spread;
    // What a listener asks for is promised for the rest after this one.
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
    this.#sinceLift = Number.POSITIVE_INFINITY;
  }

  #promise(isKeptAt: Promised["isKeptAt"]): Promise<boolean> {
    const promised = new Promise<boolean>((resolve) => this.#promised.push({ isKeptAt, resolve }));
    // Also a turn that was asked for and called off before it began.
    if (!this.moving) this.#rest();
    return promised;
  }

  #takePromises(): readonly Promised[] {
    const promised = this.#promised;
    this.#promised = [];
    return promised;
  }
}

function keepPromises(promised: readonly Promised[], at: number): void {
  for (const { isKeptAt, resolve } of promised) resolve(isKeptAt(at));
}

/** The side that a turn `by` goes to. */
function sideTo(by: 1 | -1): Side {
  return by === 1 ? Side.left : Side.right;
}
