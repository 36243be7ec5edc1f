/**
 * The way of a drag, from a place on the canvas to the engine's commands, in
 * the order in which it happens: what lies under the pointer, which leaf it
 * takes, where it holds it, and where the leaf goes when it is released.
 * `Input` makes drags of pointer events; `Turning` gives their commands to the
 * engine, and says which flight a grab holds.
 */

import type { Flight, Turning } from "../book/turning.ts";
import type { BookEngine } from "../engine/book_engine.ts";
import { maxGrabs, Side } from "../engine/phases.ts";
import { pileHeight, type Ray } from "../engine/shapes.ts";
import { type Hit, pickPile, pickSurface } from "../picking/pick.ts";
import { handAt } from "../picking/reach.ts";
import type { BookShape } from "../stage/book_pose.ts";
import type { BookStage, Place } from "../stage/book_stage.ts";
import type { CornerPeek } from "./corner_peek.ts";

/** What a pointer can grab. */
export interface DragHit extends Hit {
  /** The flight there, or the side whose uppermost leaf it is. */
  readonly on: Flight | Side;
}

/** What drags need of a bound book. */
export interface DragContext {
  readonly engine: BookEngine;
  readonly stage: BookStage;
  readonly turning: Turning;
  readonly peek: CornerPeek;
  readonly shape: Pick<BookShape, "width" | "height" | "alone" | "quarterTurned">;
  /** Called when something moves. */
  readonly moved: () => void;
}

/** Maximum of drags at once: the last grab lifts corners. */
export const maxDrags: number = maxGrabs - 1;

/** How much nearer than a page behind it a leaf in flight counts, metres: it is preferred. */
const preference = 0.001;

/**
 * Minimum distance from the spine at which a leaf is held, as a fraction of its
 * width: closer, it could not be turned.
 */
const nearestHeld = 0.3;

/**
 * Up to this u a leaf counts as held far from its edge; and how far beyond the
 * spine it is then carried over, as a fraction of its width.
 */
const farFromEdge = 0.65;
const beyondSpine = 0.12;

/**
 * Distance from the spine at which a leaf counts as carried over if nothing
 * beyond the spine is visible, as a fraction of its width.
 */
const nearSpine = 0.35;

/** The drags on one bound book. */
export class Drags {
  readonly #book: DragContext;
  /** By the number of their grab. */
  readonly #drags = new Map<number, Drag>();
  #closed = false;

  constructor(book: DragContext) {
    this.#book = book;
  }

  /** Returns what a pointer at a place on the canvas (CSS pixels) can grab, or null. */
  pick(x: number, y: number): DragHit | null {
    if (this.#closed) return null;
    const { engine, stage, turning, peek } = this.#book;
    const ray = stage.rayAt(x, y);
    let best = this.#pickPage(ray);
    const { leaves } = turning;
    for (const flight of turning.flights) {
      // A board in flight can be grabbed anywhere, wherever its page is seen.
      if (flight.part !== "leaf") return best && { ...best, on: flight };
      const hit = pickSurface(ray, engine.surface(leaves.indexOf(flight)), engine.columns);
      if (hit && (best === null || hit.distance < best.distance + preference)) {
        best = { ...hit, on: flight };
      }
    }
    // Beside a lifted corner a pointer grabs that leaf, not the one under it.
    return best && peek.flight && best.on === peek.side ? { ...best, on: peek.flight } : best;
  }

  #pickPage(ray: Ray): DragHit | null {
    const { engine, turning, shape } = this.#book;
    let best: DragHit | null = null;
    for (const side of [Side.right, Side.left]) {
      if (!turning.hasLeaf(side)) continue;
      const sign = side === Side.right ? 1 : -1;
      const hit = pickPile(ray, engine.pile(side), sign, engine.columns, shape.height);
      if (hit && (best === null || hit.distance < best.distance)) best = { ...hit, on: side };
    }
    return best;
  }

  /** Returns whether a hit is on a leaf in flight, rather than on one with only its corner lifted. */
  isFlying({ on }: DragHit): boolean {
    return typeof on !== "number" && on !== this.#book.peek.flight;
  }

  /**
   * Grabs what `pick` found, in flight or at rest. Returns the drag, or null if
   * that cannot be picked up or a listener took the book away.
   *
   * @param pull how far the pointer has moved since, CSS pixels
   */
  grab(found: DragHit, pull: Place = { x: 0, y: 0 }): Drag | null {
    const number = this.#freeGrab;
    if (this.#closed || number === undefined) return null;
    const { turning, peek } = this.#book;
    const { on, u, v } = this.#pulled(found, pull);
    const flight = typeof on === "number" ? turning.pickUp(on) : on;
    if (flight === null) {
      peek.end();
      return null;
    }
    const drag = new Drag(this.#book, number, Math.min(Math.max(u, nearestHeld), 1), () =>
      this.#drags.delete(number),
    );
    turning.grab(flight, number, drag.u, Math.min(Math.max(v, 0), 1));
    this.#drags.set(number, drag);
    // The lifted corner falls back, unless it is of this leaf, which is turned from now on.
    peek.end();
    peek.becomeTurn(flight);
    return this.#closed ? null : drag;
  }

  get #freeGrab(): number | undefined {
    return Array.from({ length: maxDrags }, (_, k) => k).find((k) => !this.#drags.has(k));
  }

  /**
   * Returns what a pull from a hit moves. If a page stands alone, a pull away
   * from its spine, from the page or from beside the spine, brings the previous
   * page back.
   */
  #pulled(hit: DragHit, { x, y }: Place): DragHit {
    const { alone, quarterTurned } = this.#book.shape;
    const isOutward = (quarterTurned ? y : x) * alone > 0;
    if (!isOutward || typeof hit.on !== "number") return hit;
    return { ...hit, on: alone === 1 ? Side.left : Side.right, u: 1 };
  }

  /** Carries held leaves along when the camera has moved. */
  follow(): void {
    for (const drag of this.#drags.values()) drag.follow();
  }

  /** Ends every drag: its pointer moves nothing any more. */
  close(): void {
    this.#closed = true;
    for (const drag of [...this.#drags.values()]) drag.end();
  }
}

/** A leaf or board that one pointer holds, until it is released. */
export class Drag {
  /** u of the held point. */
  readonly u: number;
  readonly #book: DragContext;
  readonly #grab: number;
  readonly #ended: () => void;
  #isOver = false;
  /** The pointer's place on the canvas, CSS pixels. */
  #at: Place = { x: 0, y: 0 };
  /** The held point's distance from the spine, metres. */
  #across = 0;

  /** @param ended called when it is over */
  constructor(book: DragContext, grab: number, u: number, ended: () => void) {
    this.u = u;
    this.#book = book;
    this.#grab = grab;
    this.#ended = ended;
  }

  /** Moves the pointer to a place on the canvas, CSS pixels. */
  move(x: number, y: number): void {
    if (this.#isOver) return;
    this.#at = { x, y };
    this.follow();
    this.#book.moved();
  }

  /** Pulls the held point to where the pointer is in space: on an arch over the spine. */
  follow(): void {
    const { engine, stage, turning, shape } = this.#book;
    const ray = stage.rayAt(this.#at.x, this.#at.y);
    const place = handAt(ray, this.u * shape.width, (x) => floorUnder(engine, x));
    this.#across = place[0];
    turning.hold(this.#grab, ...place);
  }

  /** Releases it: the leaf falls to the side that its swing takes it, or to where it was carried. */
  release(): void {
    if (this.#isOver) return;
    const { turning, moved } = this.#book;
    const way = turning.holds(this.#grab) ? this.#carried : 0;
    if (way !== 0) void turning.press(way);
    turning.release(this.#grab);
    this.end();
    moved();
  }

  /**
   * The side, 1 left or -1 right, to which the pointer has carried a leaf that
   * would fall back if released at rest: one held far from the edge, because
   * most of it still hangs over the other side; or one of a page that stands
   * alone, which a pointer on the screen can carry no farther than upright. 0
   * if the engine decides.
   */
  get #carried(): 1 | 0 | -1 {
    const { alone, width } = this.#book.shape;
    const fraction = this.#across / width;
    if (alone) return fraction * alone < nearSpine ? alone : 0;
    if (this.u >= farFromEdge || Math.abs(fraction) < beyondSpine) return 0;
    return fraction < 0 ? 1 : -1;
  }

  /** Ends it without a release: the book is closed, or bound anew. */
  end(): void {
    this.#isOver = true;
    this.#ended();
  }
}

/**
 * Returns the height of the pages under x, metres: at the fore-edge, because a
 * leaf is held near its edge.
 */
function floorUnder(engine: BookEngine, x: number): number {
  return pileHeight(engine.pile(x >= 0 ? Side.right : Side.left));
}
