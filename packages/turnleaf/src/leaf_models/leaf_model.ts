/** Models that draw leaves in flight in place of the engine's sheets. */

import { sideBefore } from "../book/leaf_order.ts";
import type { Turning } from "../book/turning.ts";
import type { BookEngine } from "../engine/book_engine.ts";
import { Side } from "../engine/phases.ts";
import type { BookPose, BookShape } from "../stage/book_pose.ts";

/** A book whose leaves are turned. */
export interface ModelledBook {
  readonly engine: BookEngine;
  readonly turning: Turning;
  readonly shape: BookShape;
  /** Holds the leaf whose corner only lifts, if nothing else is in flight. */
  readonly peek: { readonly flight: object | null };
}

/** A model of a book's leaves in flight: it follows their sheets, and is drawn in place of them. */
export interface LeafModel {
  /** Advances by `seconds`, and writes where each leaf is for the engine's next update. */
  show(book: ModelledBook, seconds: number): void;
  /**
   * Called after that update: corrects what the engine does not know of leaves
   * that are not sheets.
   */
  finish?(book: ModelledBook): void;
  /**
   * Whether it draws nothing else while the engine sleeps; false while leaves with a motion
   * of their own have not come to rest. The default is true.
   */
  readonly isAsleep?: boolean;
  /** Returns what is drawn of a book, if the model changes it. */
  pose?(pose: BookPose): BookPose;
  /** Frees its resources. */
  close(): void;
}

/** Where the engine's own grab holds a leaf that it turns: the same as in its play.rs. */
const turner = [1, 0.14] as const;

/** A leaf that was picked up. */
export interface PickedUpLeaf {
  /** The side on which it lay. */
  readonly from: "left" | "right";
  /** Where it is held. */
  readonly u: number;
  readonly v: number;
  /** Number of its points. */
  readonly count: number;
}

/**
 * The leaves in flight with the state that a model keeps of each, from when it
 * is picked up until it lands.
 */
export class FlightModels<Kept> {
  readonly #make: (taken: PickedUpLeaf) => Kept;
  readonly #free: (kept: Kept) => void;
  readonly #kept = new Map<object, Kept>();

  /**
   * @param make creates the state of a leaf that is picked up
   *
   * @param free frees the state of one that has landed
   */
  constructor(make: (taken: PickedUpLeaf) => Kept, free: (kept: Kept) => void = () => {}) {
    this.#make = make;
    this.#free = free;
  }

  /** Writes every leaf in flight; `points` are as of `BookEngine.overrideSurface`. */
  show({ engine, turning }: ModelledBook, write: (kept: Kept, points: Float32Array) => void): void {
    const { flights } = turning;
    for (const [flight, kept] of this.#kept) {
      if ((flights as readonly object[]).includes(flight)) continue;
      this.#kept.delete(flight);
      this.#free(kept);
    }
    for (const [index, flight] of flights.entries()) {
      const points = flight.part === "leaf" ? engine.overrideSurface(index) : null;
      if (points === null) continue;
      let kept = this.#kept.get(flight);
      if (kept === undefined) {
        const [u, v] = flight.grip ?? turner;
        const from = sideBefore(flight) === Side.right ? "right" : "left";
        kept = this.#make({ from, u, v, count: points.length / 3 });
        this.#kept.set(flight, kept);
      }
      write(kept, points);
    }
  }

  /** Returns whether the state of every leaf passes a test. */
  every(test: (kept: Kept) => boolean): boolean {
    return [...this.#kept.values()].every(test);
  }

  /** Returns the state of a leaf; undefined if the model does not draw it. */
  of(flight: object): Kept | undefined {
    return this.#kept.get(flight);
  }

  /** Frees the state of every leaf. */
  clear(): void {
    for (const kept of this.#kept.values()) this.#free(kept);
    this.#kept.clear();
  }
}
