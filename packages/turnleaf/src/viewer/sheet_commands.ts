/** What a book is commanded beside turns: its leaves are folded, torn out, and torn further. Loads what does it. */

import type { Fold } from "../book/creases.ts";
import type { PagePlace } from "../book/page_folds.ts";
import { isCover, leafOf, pagesAt } from "../book/spreads.ts";
import type { TearLine } from "../engine/shapes.ts";
import type { PageBitmaps } from "../pages/page_bitmaps.ts";
import type { BookPose } from "../stage/book_pose.ts";
import type { BookStage } from "../stage/book_stage.ts";
import type { Backend } from "./backend.ts";
import type { Folds } from "./folds.ts";
import type { Rebinder } from "./rebinder.ts";
import type { TearHooks, Tearing, TearView } from "./tearing.ts";
import type { ViewerOptions } from "./viewer_options.ts";

/** What folding and tearing need of a book. */
export interface SheetParts {
  readonly rebinder: Rebinder;
  readonly bitmaps: PageBitmaps;
  readonly stage: BookStage;
  readonly backend: Pick<Backend, "creasable" | "folds" | "tearing">;
  readonly options: Pick<ViewerOptions, "tearing" | "onMissingPart">;
}

/** What they need of its viewer. */
export interface SheetHooks extends TearView {
  /** Has what waits for the book's rest done as soon as it rests. */
  readonly bindSoon: () => void;
  /** Lets a corner fall that is lifted. Resolves, once it lies, to whether the book rests. */
  readonly dropCorner: () => Promise<boolean>;
}

/** Folds the leaves of one book and tears them out, however it is bound. */
export class SheetCommands {
  readonly #parts: SheetParts;
  readonly #hooks: SheetHooks;
  /** The folded pages, once there is one, and what loads what folds them. */
  #folds: Promise<Folds | null> | null = null;
  #loadedFolds: Folds | null = null;
  /** What tears leaves out, once they may be, and what loads it. */
  #tearing: Promise<Tearing | null> | null = null;
  #loadedTearing: Tearing | null = null;
  /** How the leaves are bound; null if none may be torn out. */
  #line: TearLine | null = null;
  #closed = false;

  constructor(parts: SheetParts, hooks: SheetHooks) {
    this.#parts = parts;
    this.#hooks = hooks;
  }

  /**
   * Folds pages, in place of what was folded before. Resolves, once that is done, to the folds
   * that there are: those of a leaf that cannot be folded so stay as they were. Null where leaves
   * cannot be creased, and if what folds them cannot be loaded.
   *
   * @param isSeen whether a leaf that lies open is seen to be folded
   */
  async fold(folds: readonly Fold[], isSeen: boolean): Promise<readonly Fold[] | null> {
    this.#folds ??= this.#loadFolds();
    const loaded = await this.#folds;
    if (this.#closed || loaded === null) return null;
    this.#hooks.bindSoon();
    const folded = loaded.fold(folds, isSeen);
    this.#hooks.moved();
    const found = await folded;
    // What was folded at once since the last frame has to be drawn with the pages that it bares.
    this.#hooks.moved();
    return found;
  }

  /** Takes over the folds of pages that lie elsewhere: the book is about to be bound anew by them. */
  keepFolds(folds: readonly Fold[]): void {
    this.#loadedFolds?.keep(folds);
  }

  /**
   * Says how leaves are bound, so that they can be torn out. Resolves once what tears them is
   * loaded, or cannot be.
   *
   * @param line null if they may not be torn out any more
   */
  async allowTearing(line: TearLine | null): Promise<void> {
    this.#line = line;
    if (line === null) return;
    this.#tearing ??= this.#loadTearing();
    await this.#tearing;
    if (this.#closed) return;
    this.#hooks.bindSoon();
  }

  /**
   * Tears the leaf of an open page (from 1) out. Resolves, once it is off, to whether it is.
   *
   * @param isSeen whether it is seen to be torn, and lies beside the book then
   */
  async tearOut(page: number, isSeen: boolean): Promise<boolean> {
    await this.#tearing;
    if (this.#closed || this.#line === null || !(await this.#hooks.dropCorner())) return false;
    const torn = this.#loadedTearing?.tearOut(page, isSeen) ?? false;
    this.#hooks.moved();
    return await torn;
  }

  /** The first open page (from 1) whose leaf may be torn out; null if none may. */
  get tearablePage(): number | null {
    const { binding, turning } = this.#parts.rebinder.bound;
    if (!this.#parts.backend.tearing || this.#line === null) return null;
    const pages = pagesAt(binding, turning.spread);
    return pages.find((page) => !isCover(binding, leafOf(binding, page))) ?? null;
  }

  /** The loose sheets that are neither crumpled nor torn across: one is flat, all are folded, or null. */
  get wholeSheet(): "flat" | "folded" | null {
    return this.#loadedTearing?.wholeSheet ?? null;
  }

  /** Crumples the loose sheet that was torn out last and is not crumpled. Returns whether there is one. */
  crumple(): boolean {
    return this.#loadedTearing?.crumple() ?? false;
  }

  /**
   * Tears the loose sheet across that was torn out last and is neither crumpled nor torn, from a
   * place on an edge of the page that it shows to another. Returns whether there is one that can
   * be torn so.
   */
  tearAcross(from: PagePlace, to: PagePlace): boolean {
    return this.#loadedTearing?.tearAcross(from, to) ?? false;
  }

  /** Takes a loose sheet away: the one that the owner of the pages has given a number. */
  remove(id: number): void {
    this.#loadedTearing?.remove(id);
    this.#hooks.moved();
  }

  /** Has the book bound, as soon as it rests, by an engine whose leaves can be creased, if there is one. */
  async useCreasable(): Promise<void> {
    const { creasable } = this.#parts.backend;
    if (creasable) await this.#parts.rebinder.useCreasable(creasable);
  }

  /** Folds on what is being folded. Returns whether anything is. */
  stepFolds(seconds: number): boolean {
    return this.#loadedFolds?.step(seconds) ?? false;
  }

  /** Moves what is torn by the ticks of a frame. Returns whether anything goes on moving. */
  stepLoose(ticks: number): boolean {
    return this.#loadedTearing?.step(ticks) ?? false;
  }

  /** Returns what is drawn of a book whose parts are as `pose` says. */
  pose(pose: BookPose): BookPose {
    return this.#loadedTearing?.pose(pose) ?? pose;
  }

  /** Shows the pictures of the loose sheets. */
  show(): void {
    this.#loadedTearing?.show(this.#parts.stage);
  }

  /** Call it when the book was bound anew. */
  bound(): void {
    this.#loadedFolds?.bound();
    this.#loadedTearing?.bound();
  }

  /** Call it when the canvas has another size. */
  resized(): void {
    this.#loadedTearing?.resized();
  }

  /** Call it when the reader goes on with the book. */
  readOn(): void {
    this.#loadedTearing?.readOn();
  }

  /** Ends everything; before the book is freed. */
  close(): void {
    this.#closed = true;
    this.#loadedFolds?.close();
    this.#loadedTearing?.close();
  }

  async #loadFolds(): Promise<Folds | null> {
    const { backend, rebinder, options } = this.#parts;
    try {
      const [loaded] = await Promise.all([backend.folds?.(), this.useCreasable()]);
      if (loaded) this.#loadedFolds = new loaded.Folds(rebinder, this.#hooks.moved);
    } catch (error) {
      options.onMissingPart?.(error);
    }
    return this.#loadedFolds;
  }

  async #loadTearing(): Promise<Tearing | null> {
    const { backend, rebinder, bitmaps, stage, options } = this.#parts;
    const owner = options.tearing;
    try {
      const [loaded] = await Promise.all([backend.tearing?.(), this.useCreasable()]);
      if (loaded && owner) {
        const hooks: TearHooks = {
          ...this.#hooks,
          line: () => this.#line,
          mayTear: (pages) => owner.mayTear(pages),
          heard: (work) => owner.heard(work),
        };
        this.#loadedTearing = new loaded.Tearing(rebinder, bitmaps, stage, hooks);
      }
    } catch (error) {
      options.onMissingPart?.(error);
    }
    if (this.#closed) this.#loadedTearing?.close();
    return this.#loadedTearing;
  }
}
