/** Grabs on the book: what a pointer can grab, and where it pulls it. */

import type { Flight, Turning } from "../book/turning.ts";
import type { BookEngine } from "../engine/book_engine.ts";
import { Side } from "../engine/phases.ts";
import type { Pile, Ray } from "../engine/shapes.ts";
import { type Hit, pickPile, pickSurface } from "../picking/pick.ts";
import { handAt } from "../picking/reach.ts";
import type { BookStage } from "../stage/book_stage.ts";

/** What a pointer can grab. */
export interface DragHit extends Hit {
  /** The flight there, or the side whose uppermost leaf it is. */
  readonly on: Flight | Side;
}

/** What dragging needs of the book. */
export interface DragContext {
  readonly engine: BookEngine;
  readonly stage: BookStage;
  readonly turning: Turning;
  /** A page's size, metres. */
  readonly width: number;
  readonly height: number;
  /** The side whose pages alone are visible, 1 right or -1 left; 0 if both are. */
  readonly alone: 1 | 0 | -1;
  /** Returns whether a leaf or board lies on a side, besides everything in flight. */
  hasLeaf(side: Side): boolean;
}

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

/** A pointer that holds something. */
interface HeldPointer {
  /** Its position on the canvas, CSS pixels. */
  x: number;
  y: number;
  /** u of the point that it holds. */
  readonly u: number;
  /** Its position across the spine, metres. */
  across: number;
}

/** The grabs on one book. */
export class DragState {
  readonly #book: DragContext;
  /** Each pointer that holds something. */
  readonly #pointers = new Map<number, HeldPointer>();

  constructor(book: DragContext) {
    this.#book = book;
  }

  /** Returns what a pointer at a place on the canvas (CSS pixels) can grab, or null. */
  pick(x: number, y: number): DragHit | null {
    const { engine, stage, turning } = this.#book;
    const ray = stage.rayAt(x, y);
    let best: DragHit | null = this.#pickSide(ray);
    for (const [index, flight] of turning.flights.entries()) {
      // A board in flight can be grabbed anywhere, wherever its page is seen.
      if (flight.part !== "leaf") return best && { ...best, on: flight };
      const hit = pickSurface(ray, engine.surface(index), engine.columns);
      // The leaf is preferred to the page under it.
      if (hit && (best === null || hit.distance < best.distance + 0.001)) {
        best = { ...hit, on: flight };
      }
    }
    return best;
  }

  /** Grabs what `pick` found; the leaf then follows `drag`. */
  grab(hold: DragHit, grab: number): boolean {
    const { turning } = this.#book;
    const flight = typeof hold.on === "number" ? turning.pickUp(hold.on) : hold.on;
    if (flight === null) return false;
    const u = Math.min(Math.max(hold.u, nearestHeld), 1);
    turning.grab(flight, grab, u, Math.min(Math.max(hold.v, 0), 1));
    this.#pointers.set(grab, { x: 0, y: 0, u, across: 0 });
    return true;
  }

  /** Moves a grab to a place on the canvas, CSS pixels. Returns whether it holds something. */
  drag(grab: number, x: number, y: number): boolean {
    const held = this.#pointers.get(grab);
    if (held === undefined) return false;
    const { stage, turning, width } = this.#book;
    [held.x, held.y] = [x, y];
    const ray = stage.rayAt(x, y);
    const place = handAt(ray, held.u * width, (at) => this.floor(at));
    held.across = place[0];
    turning.hold(grab, ...place);
    return true;
  }

  /**
   * Returns the side, 1 left or -1 right, to which a pointer has carried a leaf
   * that would fall back if released at rest: one held far from the edge,
   * because most of it still hangs over the other side; or one of a page that
   * stands alone, which a pointer on the screen can carry no farther than
   * upright. Returns 0 if the engine decides.
   */
  carried(grab: number): 1 | 0 | -1 {
    const held = this.#pointers.get(grab);
    if (held === undefined) return 0;
    const { alone, width } = this.#book;
    const fraction = held.across / width;
    if (alone) return fraction * alone < nearSpine ? alone : 0;
    if (held.u >= farFromEdge || Math.abs(fraction) < beyondSpine) return 0;
    return fraction < 0 ? 1 : -1;
  }

  /** Carries held leaves along when the camera has moved. */
  follow(): void {
    for (const [grab, { x, y }] of this.#pointers) this.drag(grab, x, y);
  }

  /** Releases a grab. */
  release(grab: number): void {
    this.#pointers.delete(grab);
    this.#book.turning.release(grab);
  }

  /** Returns the height of the pages under x, metres. */
  floor(x: number): number {
    // The height of the fore-edge suffices, because a leaf is held near its edge.
    return heightOf(this.#book.engine.pile(x >= 0 ? Side.right : Side.left));
  }

  #pickSide(ray: Ray): DragHit | null {
    const { engine, height } = this.#book;
    let best: DragHit | null = null;
    for (const side of [Side.right, Side.left]) {
      if (!this.#book.hasLeaf(side)) continue;
      const sign = side === Side.right ? 1 : -1;
      const hit = pickPile(ray, engine.pile(side), sign, engine.columns, height);
      if (hit && (best === null || hit.distance < best.distance)) best = { ...hit, on: side };
    }
    return best;
  }
}

/** Returns the height of a pile's uppermost page at its fore-edge, metres: the pile's thickness. */
export function heightOf(pile: Pile): number {
  return pile.curves[2 * pile.columns - 1];
}
