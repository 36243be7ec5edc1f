/** A book as it is bound now. Bound anew, it is another one, which the same stage shows. */

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

/** A square-rooted page area of 140 x 210 mm, metres: every book has paper of this size. */
const paperSize = Math.sqrt(0.14 * 0.21);

/** How a book is to be bound, and the colour of its cloth as CSS writes it. */
export interface BindingOptions extends LayoutOptions {
  readonly cloth: string;
}

/** What of a book is the same however it is bound. */
export interface Bindable {
  readonly source: Pick<PageSource, "pageCount" | "direction" | "kind">;
  /** A page's size in the source's unit, and its width over its height. */
  readonly leaf: PageSize;
  readonly aspect: number;
}

/** Where pages lie and what the stage is to draw. */
export interface BindingLayout {
  readonly binding: Binding;
  readonly shape: BookShape;
}

/**
 * How a book is bound as wished.
 *
 * @param width,height of the place where it is shown, CSS pixels; 0 where not known
 * @param before the layout there was, null at first
 */
export function layOutBinding(
  book: Bindable,
  wish: BindingOptions,
  width: number,
  height: number,
  before: Layout | null = null,
): BindingLayout {
  const { pageCount, direction, kind } = book.source;
  const { cover, offset, cloth } = wish;
  const edge = edgeFor(wish.binding, direction);
  const isRolled = edge === "top" || edge === "bottom";
  const layout = layoutFor(wish.layout, book.aspect, isRolled, width, height, before);
  const hardPages = pagesNamed(wish.hardPages, pageCount);
  const binding = bind(pageCount, cover, { edge, layout, offset, hardPages });
  const { rolled, reversed } = binding;
  // The engine's book is as wide as its pages reach from the spine.
  const aspect = rolled ? 1 / book.aspect : book.aspect;
  const leaves = paperLeaves(binding);
  // Thicker than the paper would be, so that reading on is seen; but no book is a brick.
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
    rolled,
    alone: layout === "spread" ? 0 : reversed ? -1 : 1,
  };
  return { binding, shape };
}

/** One way that a book is bound: its engine's book, its state, and the hands on it. */
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

  /** Where the book's parts are now. */
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
   * What a hand takes that pulls by x, y CSS pixels from where it found `hold`: where a page stands alone,
   * a pull away from its spine, from the page or from beside the spine, brings the one before it back.
   */
  pulled(hold: DragHit, x: number, y: number): DragHit {
    const { alone, rolled } = this.shape;
    const isOutward = (rolled ? y : x) * alone > 0;
    if (!isOutward || typeof hold.on !== "number") return hold;
    return { ...hold, on: alone === 1 ? Side.left : Side.right, u: 1 };
  }

  /** Ends what is under way and frees the engine's book. */
  destroy(): void {
    this.turning.close();
    this.engine.destroy();
  }

  /** The boards' angles; where there are none, how far the outermost leaves have opened the book. */
  #covers(leaves: readonly Surface[]): Pick<BookPose, "frontBoard" | "backBoard"> {
    const { engine, binding } = this;
    if (binding.hardCover) {
      return {
        frontBoard: engine.boardAngle(Cover.front),
        backBoard: engine.boardAngle(Cover.back),
      };
    }
    // Of a book of single pages one side is shown, which stays where it is.
    if (binding.layout === "single") return { frontBoard: Math.PI, backBoard: 0 };
    const [low, high] = spreadsBetween(this.turning);
    return {
      frontBoard: low > 0 ? Math.PI : this.#angleOf(leaves[0], 0),
      backBoard: high < leafCount(binding) ? 0 : this.#angleOf(leaves.at(-1), Math.PI),
    };
  }

  /** How far a leaf has turned, 0 on the right to pi on the left; `resting` where there is none. */
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
