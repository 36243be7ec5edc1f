/** A book under one binding. Each change of binding makes a new one, shown by the same stage. */

import { edgeFor, type LayoutOptions, layoutFor, pagesNamed } from "../book/layout.ts";
import { type Binding, bind, type Layout, leafCount, paperLeaves } from "../book/spreads.ts";
import { Turning, type TurningEvents } from "../book/turning.ts";
import type { BookEngine } from "../engine/book_engine.ts";
import { Cover, Side } from "../engine/phases.ts";
import type { Surface } from "../engine/shapes.ts";
import type { PageBitmaps } from "../pages/page_bitmaps.ts";
import type { PageSize, PageSource } from "../sources/page_source.ts";
import type { BookPose, BookShape } from "../stage/book_pose.ts";
import type { BookStage } from "../stage/book_stage.ts";
import { caseSizes } from "../stage/case_sizes.ts";
import { CornerPeek } from "./corner_peek.ts";
import { type DragHit, DragState, heightOf } from "./drag_state.ts";
import { FaceTextures, spreadsBetween } from "./face_textures.ts";
import { paperPerBoard, Stiffening } from "./stiff.ts";
import { TickCounter } from "./tick_counter.ts";

/** Square root of a page area of 140 x 210 mm, in metres: every book has paper of this size. */
const paperSize = Math.sqrt(0.14 * 0.21);

/** How a book is to be bound, and the CSS colour of its cloth. */
export interface BindingOptions extends LayoutOptions {
  readonly cloth: string;
}

/** The properties of a book that no binding changes. */
export interface Bindable {
  readonly source: Pick<PageSource, "pageCount" | "direction" | "kind">;
  /** A page's size in the source's unit, and its width over its height. */
  readonly leaf: PageSize;
  readonly aspect: number;
}

/** Where the pages lie, and the shape that the stage draws. */
export interface BindingLayout {
  readonly binding: Binding;
  readonly shape: BookShape;
}

/**
 * Lays a book out by its options.
 *
 * @param width,height of the place where it is shown, CSS pixels; 0 if unknown
 * @param before the previous layout, null at first
 */
export function layOutBinding(
  book: Bindable,
  options: BindingOptions,
  width: number,
  height: number,
  before: Layout | null = null,
): BindingLayout {
  const { pageCount, direction, kind } = book.source;
  const { cover, offset, cloth } = options;
  const edge = edgeFor(options.binding, direction);
  const isQuarterTurned = edge === "top" || edge === "bottom";
  const layout = layoutFor(options.layout, book.aspect, isQuarterTurned, width, height, before);
  const hardPages = pagesNamed(options.hardPages, pageCount);
  const binding = bind(pageCount, cover, { edge, layout, offset, hardPages });
  const { quarterTurned, reversed } = binding;
  // The engine's book is as wide as its pages are from the spine outward.
  const aspect = quarterTurned ? 1 / book.aspect : book.aspect;
  const leaves = paperLeaves(binding);
  // Thicker than the paper would be, so that progress through the book is visible, but bounded.
  const bulk = leaves + binding.hardLeaves.size * (paperPerBoard - 1);
  const thickness = 0.024 * (1 - Math.exp((-bulk * 0.0004) / 0.024));
  const shape: BookShape = {
    width: paperSize * Math.sqrt(aspect),
    height: paperSize / Math.sqrt(aspect),
    thickness,
    leaves,
    cover: binding.hardCover ? "hard" : "none",
    rim: binding.hardCover ? caseSizes.rim : 0,
    cloth,
    kind,
    quarterTurned,
    alone: layout === "spread" ? 0 : reversed ? -1 : 1,
  };
  return { binding, shape };
}

/** A bound book: its binding, its engine's book, its state and the grabs on it. */
export class BoundBook {
  readonly binding: Binding;
  readonly shape: BookShape;
  readonly engine: BookEngine;
  readonly turning: Turning;
  readonly faceTextures: FaceTextures;
  readonly drag: DragState;
  readonly peek: CornerPeek;
  readonly ticks: TickCounter;
  readonly #stiffening: Stiffening;

  constructor(
    { binding, shape }: BindingLayout,
    engine: BookEngine,
    stage: BookStage,
    pictures: PageBitmaps,
    events: TurningEvents,
  ) {
    this.binding = binding;
    this.shape = shape;
    this.engine = engine;
    this.turning = new Turning(engine, binding, events);
    this.faceTextures = new FaceTextures(binding, stage, this.turning, pictures);
    const hasLeaf = (side: Side): boolean => this.#hasLeaf(side);
    this.drag = new DragState({ engine, stage, turning: this.turning, hasLeaf, ...shape });
    this.peek = new CornerPeek(this.turning, binding, shape);
    this.ticks = new TickCounter(engine.tick);
    this.#stiffening = new Stiffening(binding, shape.width);
  }

  /** Returns where the book's parts are now. */
  pose(): BookPose {
    const { engine, binding } = this;
    const { flights } = this.turning;
    const paper = paperLeaves(binding) > 0;
    const [low, high] = spreadsBetween(this.turning);
    const boards = binding.hardCover ? 1 : 0;
    const [left, right] = [engine.pile(Side.left), engine.pile(Side.right)];
    const leaves: Surface[] = [];
    for (const [index, flight] of flights.entries()) {
      if (flight.part === "leaf") leaves.push(this.#stiffening.leaf(engine.surface(index), flight));
    }
    const [onLeft, onRight] = this.#stiffening.piles(left, right, low, flights, leaves);
    return {
      left: paper && low > boards ? onLeft : null,
      right: paper && high < leafCount(binding) - boards ? onRight : null,
      leaves,
      lean: paper ? (heightOf(right) - heightOf(left)) / 2 : 0,
      ...this.#covers(leaves),
    };
  }

  /**
   * Returns what a pull by x, y CSS pixels from `hold` moves. If a page stands
   * alone, a pull away from its spine, from the page or from beside the spine,
   * brings the previous page back.
   */
  pulled(hold: DragHit, x: number, y: number): DragHit {
    const { alone, quarterTurned } = this.shape;
    const isOutward = (quarterTurned ? y : x) * alone > 0;
    if (!isOutward || typeof hold.on !== "number") return hold;
    return { ...hold, on: alone === 1 ? Side.left : Side.right, u: 1 };
  }

  /** Stops all motion and frees the engine's book. */
  destroy(): void {
    this.turning.close();
    this.engine.destroy();
  }

  /**
   * Returns the angles of the boards; without boards, how far the outermost
   * leaves have opened the book.
   */
  #covers(leaves: readonly Surface[]): Pick<BookPose, "frontBoard" | "backBoard"> {
    const { engine, binding } = this;
    if (binding.hardCover) {
      return {
        frontBoard: engine.boardAngle(Cover.front),
        backBoard: engine.boardAngle(Cover.back),
      };
    }
    // A book of single pages shows one side, which stays where it is.
    if (binding.layout === "single") return { frontBoard: Math.PI, backBoard: 0 };
    const [low, high] = spreadsBetween(this.turning);
    return {
      frontBoard: low > 0 ? Math.PI : this.#angleOf(leaves[0], 0),
      backBoard: high < leafCount(binding) ? 0 : this.#angleOf(leaves.at(-1), Math.PI),
    };
  }

  /**
   * Returns how far a leaf has turned, 0 on the right to pi on the left;
   * `resting` if there is no leaf.
   */
  #angleOf(leaf: Surface | undefined, resting: number): number {
    if (leaf === undefined) return resting;
    const { positions, columns, rows } = leaf;
    const edge = 3 * ((rows >> 1) * columns + columns - 1);
    const x = positions[edge];
    const under = heightOf(this.engine.pile(x > 0 ? Side.right : Side.left));
    return Math.atan2(Math.max(positions[edge + 2] - under, 0), x);
  }

  #hasLeaf(side: Side): boolean {
    const [low, high] = spreadsBetween(this.turning);
    return side === Side.right ? high < this.binding.last : low > this.binding.first;
  }
}
