/** Hands on the book: what they could take hold of, and where they pull it. */

import type { Flight, Turning } from "../book/turning.ts";
import type { BookEngine } from "../engine/book_engine.ts";
import { Side } from "../engine/phases.ts";
import type { Pile, Ray } from "../engine/shapes.ts";
import { type Hit, pickPile, pickSurface } from "../hand/pick.ts";
import { handAt } from "../hand/reach.ts";
import type { BookStage } from "../stage/book_stage.ts";

/** What a hand could take hold of. */
export interface DragHit extends Hit {
  /** What is in flight there, or the side whose uppermost leaf it is. */
  readonly on: Flight | Side;
}

/** What hands need of the book. */
export interface DragContext {
  readonly engine: BookEngine;
  readonly stage: BookStage;
  readonly turning: Turning;
  /** A page's size, metres. */
  readonly width: number;
  readonly height: number;
  /** The side whose pages alone are seen, 1 right or -1 left; 0 where both are. */
  readonly alone: 1 | 0 | -1;
  /** Whether a leaf or board lies on a side, beside all that is in flight. */
  hasLeaf(side: Side): boolean;
}

/** Nearest to the spine that a leaf is held, a fraction of its width: nearer, a hand could not turn it. */
const nearestHeld = 0.3;

/** Up to this u a leaf is held far from its edge; and how far beyond the spine it is then carried over, shares of its width. */
const farFromEdge = 0.65;
const beyondSpine = 0.12;

/** How near the spine a hand carries a leaf over where there is nothing beyond it to be seen, as a share of its width. */
const nearSpine = 0.35;

/** A hand that holds something. */
interface Hand {
  /** Where on the canvas it is, CSS pixels. */
  x: number;
  y: number;
  /** u of the spot that it holds. */
  readonly u: number;
  /** Where it is across the spine, metres. */
  across: number;
}

/** The hands on one book. */
export class DragState {
  readonly #book: DragContext;
  /** Each hand that holds something. */
  readonly #hands = new Map<number, Hand>();

  constructor(book: DragContext) {
    this.#book = book;
  }

  /** What a hand at a place on the canvas (CSS pixels) could hold, or null. */
  pick(x: number, y: number): DragHit | null {
    const { engine, stage, turning } = this.#book;
    const ray = stage.rayAt(x, y);
    let best: DragHit | null = this.#pickSide(ray);
    for (const [index, flight] of turning.flights.entries()) {
      // Of a board in flight every place counts, wherever its page is seen.
      if (flight.part !== "leaf") return best && { ...best, on: flight };
      const hit = pickSurface(ray, engine.surface(index), engine.columns);
      // A leaf upon the page under it is the one that is taken.
      if (hit && (best === null || hit.distance < best.distance + 0.001)) {
        best = { ...hit, on: flight };
      }
    }
    return best;
  }

  /** A hand takes hold where `pick` found something; the leaf then follows `drag`. */
  grab(hold: DragHit, hand: number): boolean {
    const { turning } = this.#book;
    const flight = typeof hold.on === "number" ? turning.lift(hold.on) : hold.on;
    if (flight === null) return false;
    const u = Math.min(Math.max(hold.u, nearestHeld), 1);
    turning.grab(flight, hand, u, Math.min(Math.max(hold.v, 0), 1));
    this.#hands.set(hand, { x: 0, y: 0, u, across: 0 });
    return true;
  }

  /** A hand moves to a place on the canvas, CSS pixels; answers whether it holds something. */
  drag(hand: number, x: number, y: number): boolean {
    const held = this.#hands.get(hand);
    if (held === undefined) return false;
    const { stage, turning, width } = this.#book;
    [held.x, held.y] = [x, y];
    const ray = stage.rayAt(x, y);
    const place = handAt(ray, held.u * width, (at) => this.floor(at));
    held.across = place[0];
    turning.hold(hand, ...place);
    return true;
  }

  /**
   * The side, 1 left or -1 right, to which a hand has carried a leaf that would fall
   * back, let go at rest: one held far from the edge, as most of it still hangs over
   * the other side; and one of a page that stands alone, which a hand on the screen
   * can carry no farther than upright. 0 where the leaf itself knows.
   */
  carried(hand: number): 1 | 0 | -1 {
    const held = this.#hands.get(hand);
    if (held === undefined) return 0;
    const { alone, width } = this.#book;
    const share = held.across / width;
    if (alone) return share * alone < nearSpine ? alone : 0;
    if (held.u >= farFromEdge || Math.abs(share) < beyondSpine) return 0;
    return share < 0 ? 1 : -1;
  }

  /** The camera moved: what hands hold is carried along under them. */
  follow(): void {
    for (const [hand, { x, y }] of this.#hands) this.drag(hand, x, y);
  }

  /** A hand lets go. */
  release(hand: number): void {
    this.#hands.delete(hand);
    this.#book.turning.release(hand);
  }

  /** Height of the pages under x, metres. */
  floor(x: number): number {
    // The fore-edge's height does for a hand, which holds the leaf near its edge.
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

/** Height of a pile's uppermost page at its fore-edge, metres: the pile's thickness. */
export function heightOf(pile: Pile): number {
  return pile.curves[2 * pile.columns - 1];
}
