/** A book under one binding. Each change of binding makes a new one, shown by the same stage. */

import { coverFor, edgeFor, type LayoutOptions, pagesNamed, placePages } from "../book/layout.ts";
import { nextTo } from "../book/leaf_order.ts";
import { bookThickness, type StockRun, stockRuns } from "../book/leaf_stocks.ts";
import {
  type Binding,
  bind,
  type Layout,
  leafCount,
  paperLeaves,
  spreadOf,
} from "../book/spreads.ts";
import { type Flight, Turning, type TurningEvents } from "../book/turning.ts";
import type { BookEngine } from "../engine/book_engine.ts";
import { Cover, Side } from "../engine/phases.ts";
import { pileHeight, type Surface } from "../engine/shapes.ts";
import type { PageBitmaps } from "../pages/page_bitmaps.ts";
import type { PageSize, PageSource } from "../sources/page_source.ts";
import type { BookPose, BookShape } from "../stage/book_pose.ts";
import type { BookStage } from "../stage/book_stage.ts";
import { caseSizes } from "../stage/case_sizes.ts";
import { layoutIn, paperSize } from "../stage/page_width.ts";
import { areStapled } from "../stage/staples.ts";
import type { PageTheme } from "../themes.ts";
import { CornerPeek } from "./corner_peek.ts";
import { Drags, type DragTargets } from "./drag.ts";
import { FaceTextures } from "./face_textures.ts";
import { TickCounter } from "./frame_timing.ts";

/** How a book is to be bound, and how it looks. */
export interface BindingOptions extends LayoutOptions {
  /** CSS colour of the boards. */
  readonly cloth: string;
  /** The colours of paper, edges and boards. */
  readonly theme: PageTheme;
  /** Strength of the shadows of leaves on pages, 0 to 1. */
  readonly shadows: number;
  /** From where it is seen: where a reader sits, or right above. */
  readonly camera: "reader" | "overhead";
  /** How far a reader's eye leans back from right above the open book, degrees: 0 to 12. */
  readonly tilt: number;
  /** Fraction of its place that stays free at each edge of the book: 0 to 0.25. */
  readonly margin: number;
}

/** The properties of a book that no binding changes. */
export interface Bindable {
  readonly source: Pick<
    PageSource,
    | "pageCount"
    | "usualLeaf"
    | "direction"
    | "edge"
    | "layout"
    | "inSpread"
    | "kind"
    | "mayFace"
    | "cover"
  >;
  /** A page's size in the source's unit, and its width over its height: others once it is measured anew. */
  leaf: PageSize;
  aspect: number;
  /** A page's width in metres, if the source knows it. */
  readonly pageWidth?: number | undefined;
}

/** Where the pages lie, and the shape that the stage draws. */
export interface BindingLayout {
  readonly binding: Binding;
  readonly shape: BookShape;
  /** The leaves of a stock of their own. */
  readonly stocks: readonly StockRun[];
  /** The layout in which the book shows pages that are not to be shown by themselves. */
  readonly usual: Layout;
}

/**
 * Lays a book out by its options.
 *
 * @param width,height of the place where it is shown, CSS pixels; 0 if unknown
 * @param page the page (from 1) to keep in sight
 * @param before the layout that the space had before, null at first
 */
export function layOutBinding(
  book: Bindable,
  options: BindingOptions,
  width: number,
  height: number,
  page: number,
  before: Layout | null = null,
): BindingLayout {
  const { source } = book;
  const { pageCount, kind } = source;
  const { cloth, theme, shadows, camera, tilt, margin } = options;
  const { cover, boards } = coverFor(options.cover, source.cover, pageCount);
  const edge = edgeFor(options.binding, source);
  const isQuarterTurned = edge === "top" || edge === "bottom";
  const requested = options.layout === "auto" ? (source.layout ?? "auto") : options.layout;
  const frame = { aspect: book.aspect, quarterTurned: isQuarterTurned, cover, margin };
  const { layout: usual } = layoutIn(
    { width, height },
    requested,
    before,
    frame,
    (...widths) => source.mayFace?.(...widths) ?? true,
  );
  const hardPages = pagesNamed(options.hardPages, pageCount);
  const places = placePages(pageCount, options, source.inSpread?.bind(source), boards);
  const bindIn = (layout: Layout): Binding =>
    bind(pageCount, cover, { edge, layout, hardPages, ...places });
  const inUsual = bindIn(usual);
  const mayChange = usual === "spread" && options.layout === "auto";
  const binding = mayChange && standsSingle(source, inUsual, page) ? bindIn("single") : inUsual;
  const { layout } = binding;
  const { quarterTurned, reversed } = binding;
  // The engine's book is as wide as its pages are from the spine outward.
  const aspect = quarterTurned ? 1 / book.aspect : book.aspect;
  const stocks = stockRuns(binding, options.stocks);
  const held = {
    cover: binding.hardCover ? "hard" : "none",
    leaves: paperLeaves(binding),
    thickness: bookThickness(binding, stocks),
  } as const;
  const shape: BookShape = {
    ...held,
    isStapled: source.cover === "none" && areStapled(held),
    width: paperSize * Math.sqrt(aspect),
    height: paperSize / Math.sqrt(aspect),
    rim: binding.hardCover ? caseSizes.rim : 0,
    cloth,
    theme,
    shadows,
    fromAbove: camera === "overhead",
    tilt,
    margin,
    kind,
    quarterTurned,
    alone: layout === "spread" ? 0 : reversed ? -1 : 1,
  };
  return { binding, shape, stocks, usual };
}

/** Returns whether a page is to be shown by itself, and would lie in an open book otherwise. */
function standsSingle(source: Bindable["source"], binding: Binding, page: number): boolean {
  const s = spreadOf(binding, page);
  return source.inSpread?.(page - 1) === "single" && s > 0 && s < leafCount(binding);
}

/** The events of a bound book. */
export interface BookEvents extends TurningEvents {
  /** A turn begins: of a leaf that was picked up, or of one whose corner was only lifted. */
  readonly turnStarted: (flight: Flight) => void;
  /** Something moves: a frame should show it. */
  readonly moved: () => void;
}

/** What a bound book has in common with those before and after it. */
export interface BoundBookParts {
  readonly stage: BookStage;
  readonly pictures: PageBitmaps;
  readonly events: BookEvents;
  readonly targets: DragTargets;
}

/** A bound book: its binding, its engine's book, its state and the grabs on it. */
export class BoundBook {
  readonly binding: Binding;
  readonly shape: BookShape;
  /** The leaves of a stock of their own. */
  readonly stocks: readonly StockRun[];
  readonly engine: BookEngine;
  readonly turning: Turning;
  readonly faceTextures: FaceTextures;
  readonly drags: Drags;
  readonly peek: CornerPeek;
  readonly ticks: TickCounter;
  #isFolding = false;

  constructor(
    { binding, shape, stocks }: BindingLayout,
    engine: BookEngine,
    { stage, pictures, events, targets }: BoundBookParts,
  ) {
    this.binding = binding;
    this.shape = shape;
    this.stocks = stocks;
    this.engine = engine;
    const started = (flight: Flight): void => {
      events.started(flight);
      if (!this.peek.isLifting && !this.#isFolding) events.turnStarted(flight);
    };
    const turning = new Turning(engine, binding, { ...events, started });
    const peek = new CornerPeek(turning, binding, shape, events.turnStarted);
    this.turning = turning;
    this.peek = peek;
    const { moved } = events;
    this.drags = new Drags({ engine, stage, binding, turning, peek, shape, targets, moved });
    this.faceTextures = new FaceTextures(binding, stage, turning, pictures, shape.cloth);
    this.ticks = new TickCounter(engine.tick);
  }

  /** Returns where the book's parts are now. */
  pose(): BookPose {
    const { engine, binding } = this;
    const paper = paperLeaves(binding) > 0;
    const { low, high } = this.turning.under;
    const boards = binding.hardCover ? 1 : 0;
    const [left, right] = [engine.pile(Side.left), engine.pile(Side.right)];
    const drawn = this.turning.leaves;
    const leaves = drawn.map((_, index) => engine.surface(index));
    return {
      left: paper && low > boards ? left : null,
      right: paper && high < leafCount(binding) - boards ? right : null,
      leaves,
      lying: leaves.filter((_, index) => !("part" in drawn[index])),
      lean: paper ? (pileHeight(right) - pileHeight(left)) / 2 : 0,
      ...this.#covers(leaves),
    };
  }

  /**
   * Picks up the uppermost leaf on a side to be folded there, which is no turn. Returns whether
   * there is one.
   */
  pickUpToFold(side: Side): boolean {
    this.#isFolding = true;
    const flight = this.turning.pickUp(side);
    this.#isFolding = false;
    return flight !== null;
  }

  /** Stops all motion and frees the engine's book. */
  destroy(): void {
    this.drags.close();
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
    const { low, high } = this.turning.under;
    const isLast = high === leafCount(binding);
    return {
      frontBoard: low > 0 ? Math.PI : this.#angleOf(nextTo(Side.left, leaves), 0),
      backBoard: isLast ? this.#angleOf(nextTo(Side.right, leaves), Math.PI) : 0,
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
    const under = pileHeight(this.engine.pile(x > 0 ? Side.right : Side.left));
    return Math.atan2(Math.max(positions[edge + 2] - under, 0), x);
  }
}
