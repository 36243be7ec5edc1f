/** What turns leaves otherwise than as the sheets that they are. */

import type { Turning } from "../book/turning.ts";
import type { BookEngine } from "../engine/book_engine.ts";
import type { BookPose, BookShape } from "../stage/book_pose.ts";

/** A book whose leaves are turned. */
export interface ModelledBook {
  readonly engine: BookEngine;
  readonly turning: Turning;
  readonly shape: BookShape;
  /** Holds the leaf whose corner only lifts, where nothing else is in flight. */
  readonly peek: { readonly flight: object | null };
}

/** A leaf as paper: x, y, z of its points over a flat table. */
export interface Sheet {
  readonly positions: Float32Array;
}

/** A model of a book's leaves in flight: it follows their sheets, and is drawn in place of them. */
export interface LeafModel {
  /** Moves on by `seconds`, and writes where each leaf is for the engine's next update. */
  show(book: ModelledBook, seconds: number): void;
  /** After that update: puts right what the engine cannot know of leaves that are no sheets. */
  finish?(book: ModelledBook): void;
  /** The sheets of the leaves in flight as they were last. */
  readonly sheets: readonly Sheet[];
  /** What is drawn of a book in whose leaves it has a say. */
  pose?(pose: BookPose): BookPose;
  /** Takes away all that it holds. */
  close(): void;
}

/** Where the engine's own hand holds a leaf that it turns: the same as in its play.rs. */
const turner = [1, 0.14] as const;

/** A leaf that is taken up. */
export interface LiftedLeaf {
  /** The side on which it lay. */
  readonly from: "left" | "right";
  /** Where it is held. */
  readonly u: number;
  readonly v: number;
  /** Number of its points. */
  readonly count: number;
}

/** The leaves in flight by what a model keeps of each, from when it is taken up until it lies. */
export class FlightModels<Kept> {
  readonly #make: (taken: LiftedLeaf) => Kept;
  readonly #free: (kept: Kept) => void;
  readonly #kept = new Map<object, Kept>();
  #sheets: Sheet[] = [];

  /**
   * @param make of a leaf that is taken up
   * @param free of one that lies again
   */
  constructor(make: (taken: LiftedLeaf) => Kept, free: (kept: Kept) => void = () => {}) {
    this.#make = make;
    this.#free = free;
  }

  /** The sheets of the leaves in flight as they were last. */
  get sheets(): readonly Sheet[] {
    return this.#sheets;
  }

  /** Writes every leaf in flight; `points` are as of `BookEngine.overrideSurface`. */
  show({ engine, turning }: ModelledBook, write: (kept: Kept, points: Float32Array) => void): void {
    const { flights } = turning;
    for (const [flight, kept] of this.#kept) {
      if ((flights as readonly object[]).includes(flight)) continue;
      this.#kept.delete(flight);
      this.#free(kept);
    }
    this.#sheets = [];
    for (const [index, flight] of flights.entries()) {
      const points = flight.part === "leaf" ? engine.overrideSurface(index) : null;
      if (points === null) continue;
      this.#sheets.push({ positions: points.slice() });
      let kept = this.#kept.get(flight);
      if (kept === undefined) {
        const [u, v] = flight.grip ?? turner;
        const from = flight.from === flight.low ? "right" : "left";
        kept = this.#make({ from, u, v, count: points.length / 3 });
        this.#kept.set(flight, kept);
      }
      write(kept, points);
    }
  }

  /** What is kept of a leaf; undefined where it is not worn. */
  of(flight: object): Kept | undefined {
    return this.#kept.get(flight);
  }

  /** Frees what is kept of all. */
  clear(): void {
    for (const kept of this.#kept.values()) this.#free(kept);
    this.#kept.clear();
  }
}
