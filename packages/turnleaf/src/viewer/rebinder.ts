/** Binds one book: at first, and again when its pages or its options change. */

import { applyPaper, type Paper, scaleOf } from "../book/paper.ts";
import { type Binding, type Layout, pageOf, pagesAt, spineOf, spreadOf } from "../book/spreads.ts";
import type { BookEngine, BookSize } from "../engine/book_engine.ts";
import type { PageBitmaps } from "../pages/page_bitmaps.ts";
import { type NewIndex, type PageSize, placeOf } from "../sources/page_source.ts";
import type { BookStage } from "../stage/book_stage.ts";
import {
  type Bindable,
  type BindingLayout,
  type BindingOptions,
  type BookEvents,
  BoundBook,
  layOutBinding,
} from "./bound_book.ts";
import type { DragTargets } from "./drag.ts";
import type { MovedPages } from "./moved_pages.ts";
import { defaultBinding, type ViewerOptions } from "./viewer_options.ts";

/** The dependencies of a rebinder. */
export interface RebinderParts {
  readonly book: Bindable;
  readonly stage: BookStage;
  readonly pictures: PageBitmaps;
  readonly options: ViewerOptions;
  /** Receives the events of the bound book. */
  readonly events: BookEvents;
}

/** Returns which side is up at a spread at which a book lies shut and shows no page; null at any other. */
function shutSide(binding: Binding, spread: number): "front" | "back" | null {
  const { first, last, reversed } = binding;
  if (pagesAt(binding, spread).length > 0 || (spread !== first && spread !== last)) return null;
  return (spread === first) === reversed ? "back" : "front";
}

/** The book as it is bound now, and all changes that wait for its rest. */
export class Rebinder {
  /** What the drags on the book can do besides, however it is bound. */
  readonly targets: DragTargets = { foldOut: null, loose: null, cornerAt: null };
  readonly #parts: RebinderParts;
  #bound: BoundBook;
  /** The layout in which the book shows pages that are not to be shown by themselves. */
  #usual: Layout;
  #options: BindingOptions;
  /** The page to keep in sight however the book is bound. */
  #place: number;
  /** The page that was asked for last, until the book has come to rest. */
  #asked: number | null = null;
  #mustBind = false;
  /** Makes the next books in the place of the engine of the book as it is. */
  #nextEngine: BookEngine | null = null;
  /** Waiting changes of the pages. Each returns where these lie after it; null if it was not made. */
  readonly #changes: (() => NewIndex | null)[] = [];
  /** Whether pages have other numbers than those by which the book is bound. */
  #isRenumbered = false;
  /** Paper that waits for the leaves in flight to land. */
  #nextPaper: Paper | null = null;
  #closed = false;

  /** @param plan the first binding */
  constructor(tools: RebinderParts, plan: BindingLayout, engine: BookEngine) {
    this.#parts = tools;
    this.#options = { ...defaultBinding, ...tools.options };
    this.#place = tools.options.page();
    this.#usual = plan.usual;
    this.#bound = this.#bind(plan, engine, tools.options.opensShut?.() ? "front" : null);
  }

  /** The book as it is bound now. `bindAnew` replaces it. */
  get bound(): BoundBook {
    return this.#bound;
  }

  /** Whether the open page is shown by itself, in a book that shows spreads. */
  get isAside(): boolean {
    return this.#bound.binding.layout !== this.#usual;
  }

  /** Whether `bindAnew` has something to do. */
  get hasPending(): boolean {
    return this.#mustBind || this.#changes.length > 0;
  }

  /** Changes options of the binding. Options left out stay as they were. */
  setOptions(changes: Partial<BindingOptions>): void {
    const before: BindingOptions = this.#options;
    const names = Object.keys(changes) as (keyof BindingOptions)[];
    this.#options = { ...before, ...changes };
    this.#mustBind ||= names.some((name) => String(before[name]) !== String(changes[name]));
  }

  /** Binds the book anew, with the options that it has, as soon as it rests. */
  bindSoon(): void {
    this.#mustBind = true;
  }

  /**
   * Has the book, when it is bound next, and all later ones made by an engine whose leaves can be
   * creased, torn out and folded out, unless they can be already. Rejects as `make` does.
   *
   * @param make makes a book of such an engine, which itself is not used
   */
  async useCreasable(make: (size: BookSize) => Promise<BookEngine>): Promise<void> {
    const isThere = (): boolean =>
      this.#nextEngine !== null || this.#bound.engine.creases !== undefined;
    if (isThere()) return;
    const engine = await make(this.#bound.shape);
    // Sheets that are torn out belong to the engine that they were torn by: it is not changed again.
    if (this.#closed || isThere()) return engine.destroy();
    this.#nextEngine = engine;
    this.#mustBind = true;
  }

  /** Call it when a page (from 1) is asked for: it is kept in sight once it lies open, and not the one beside it. */
  seek(page: number): void {
    const { binding, turning } = this.#bound;
    const isOpen = !turning.moving && pagesAt(binding, turning.spread).includes(page);
    if (isOpen) this.#place = page;
    this.#asked = isOpen ? null : page;
  }

  /** Queues a change of the pages, as `Viewer.changePages` describes. */
  change(change: () => MovedPages): Promise<boolean> {
    if (this.#closed) return Promise.resolve(false);
    return new Promise((resolve, reject) => {
      this.#changes.push(() => {
        let moved: NewIndex | null = null;
        try {
          if (!this.#closed) moved = this.follow(change());
          resolve(moved !== null);
        } catch (error) {
          reject(error);
        }
        return moved;
      });
    });
  }

  /** Follows pages that lie elsewhere now, by whose numbers the book is bound next. Returns where they lie. */
  follow({ moved, lists }: MovedPages): NewIndex {
    this.#parts.pictures.renumber(moved);
    this.#options = { ...this.#options, ...lists };
    this.#place = placeOf(moved, this.#place - 1) + 1;
    this.#mustBind = true;
    this.#isRenumbered = true;
    return moved;
  }

  /** Makes the waiting changes of the pages. Returns where those from before lie now. */
  makeChanges(): NewIndex {
    const made = this.#changes.splice(0).flatMap((change) => change() ?? []);
    return (index) =>
      made.reduce<number | null>((at, moved) => (at === null ? null : moved(at)), index);
  }

  /** Changes the paper: at once, or as soon as no leaf is in flight. */
  setPaper(paper: Paper): void {
    this.#nextPaper = paper;
    this.#changePaper();
  }

  /** Returns whether the layout for a place of some size, CSS pixels, is the current one. */
  suits(room: PageSize): boolean {
    return this.#plan(room).binding.layout === this.#bound.binding.layout;
  }

  /**
   * Call it when the book has come to rest, or was laid open elsewhere: the page
   * may have to be shown by itself there.
   *
   * @param room the available space, CSS pixels
   */
  rested(room: PageSize): void {
    this.#changePaper();
    const { binding, turning } = this.#bound;
    const open = pagesAt(binding, turning.spread);
    // Of two visible pages, the requested one stays the place.
    if (this.#asked !== null && open.includes(this.#asked)) this.#place = this.#asked;
    else if (!open.includes(this.#place)) this.#place = pageOf(binding, turning.spread);
    this.#asked = null;
    const { source } = this.#parts.book;
    const mayChange =
      source.inSpread?.(this.#place - 1) === "single" || binding.layout !== this.#usual;
    if (mayChange && !this.suits(room)) this.#mustBind = true;
  }

  /**
   * Applies waiting changes and keeps the visible page in sight; only while
   * nothing moves. Returns whether pages may have other numbers since.
   *
   * @param room the available space, CSS pixels
   */
  bindAnew(room: PageSize): boolean {
    this.makeChanges();
    if (!this.#mustBind) return false;
    const isRenumbered = this.#isRenumbered;
    this.#mustBind = this.#isRenumbered = false;
    const before = this.#bound;
    const plan = this.#plan(room);
    this.#usual = plan.usual;
    const engine = this.#nextEngine ?? before.engine;
    this.#parts.stage.bind(plan.shape, engine.creases !== undefined);
    const shut = shutSide(before.binding, before.turning.spread);
    this.#bound = this.#bind(plan, engine.another(plan.shape), shut);
    this.#nextEngine?.destroy();
    this.#nextEngine = null;
    before.destroy();
    return isRenumbered;
  }

  /** Stops all motion and frees the engine's book. */
  close(): void {
    this.#closed = true;
    this.makeChanges();
    this.#bound.destroy();
    this.#nextEngine?.destroy();
  }

  #plan({ width, height }: PageSize): BindingLayout {
    return layOutBinding(this.#parts.book, this.#options, width, height, this.#place, this.#usual);
  }

  /**
   * Binds the book by a layout, open at the page to keep in sight, or shut.
   *
   * @param shut the side up on which it lies if that has no page; null to open it in any case
   */
  #bind(plan: BindingLayout, engine: BookEngine, shut: "front" | "back" | null): BoundBook {
    const { stage, pictures, options, events } = this.#parts;
    const bound = new BoundBook(plan, engine, { stage, pictures, events, targets: this.targets });
    pictures.bind((page) => spineOf(plan.binding, page));
    bound.turning.seconds = options.turnSeconds();
    this.#applyPaper(options.paper(), engine, plan);
    this.#nextPaper = null;
    const { first, last, reversed } = plan.binding;
    const at = (shut === "front") === reversed ? last : first;
    const isShut = shut !== null && shutSide(plan.binding, at) === shut;
    bound.turning.lay(isShut ? at : spreadOf(plan.binding, this.#place));
    return bound;
  }

  #changePaper(): void {
    if (this.#nextPaper === null || this.#bound.turning.flights.length > 0) return;
    this.#applyPaper(this.#nextPaper, this.#bound.engine, this.#bound);
    this.#nextPaper = null;
  }

  #applyPaper(
    paper: Paper,
    engine: BookEngine,
    { shape, stocks }: Pick<BindingLayout, "shape" | "stocks">,
  ): void {
    const width = paper.pageWidth ?? this.#parts.book.pageWidth;
    applyPaper(paper, engine, stocks, scaleOf(width, shape));
  }
}
