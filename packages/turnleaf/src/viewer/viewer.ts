/**
 * One book on one screen, from a command to a frame. It owns the engine's book,
 * the stage that draws it and the pool of page bitmaps; its frame loop brings
 * them together while something moves. At rest it has no animation frame and no
 * timer.
 */

import { faceOf } from "../book/faces.ts";
import type { Paper } from "../book/paper.ts";
import { type Binding, clampSpread, pageOf, pagesAt } from "../book/spreads.ts";
import type { BookState, Turning } from "../book/turning.ts";
import type { BookEngine } from "../engine/book_engine.ts";
import type { ModelChoice } from "../leaf_models/model_choice.ts";
import { ModelSwitch } from "../leaf_models/model_switch.ts";
import { leafSize } from "../pages/leaf_size.ts";
import { type LiveBitmaps, PageBitmaps } from "../pages/page_bitmaps.ts";
import type { NewIndex, PageBox, PageSize, PageSource } from "../sources/page_source.ts";
import type { BookStage, Place } from "../stage/book_stage.ts";
import type { Zoom } from "../stage/zoom.ts";
import type { PageTheme } from "../themes.ts";
import type { Backend } from "./backend.ts";
import { BookExtent } from "./book_extent.ts";
import {
  type Bindable,
  type BindingLayout,
  type BindingOptions,
  type BookEvents,
  type BoundBook,
  layOutBinding,
} from "./bound_book.ts";
import { CameraMotion } from "./camera_motion.ts";
import { CrossFade } from "./cross_fade.ts";
import type { Drags } from "./drag.ts";
import { type BitmapWidths, bitmapWidths } from "./face_textures.ts";
import { FoldOut } from "./fold_out.ts";
import { FrameLoop } from "./frame_loop.ts";
import { LeafCommands } from "./leaf_commands.ts";
import type { MovedPages } from "./moved_pages.ts";
import { Rebinder } from "./rebinder.ts";
import { Sharpness } from "./sharpness.ts";
import { SheetCommands } from "./sheet_commands.ts";
import { defaultBinding, type ViewerOptions } from "./viewer_options.ts";

export type { DrawnPage, LiveBitmaps } from "../pages/page_bitmaps.ts";

export type { Zoom } from "../stage/zoom.ts";
export type { Backend } from "./backend.ts";
export type { ViewerOptions } from "./viewer_options.ts";

/** One book on one canvas. */
export class Viewer {
  /** Turns its leaves and unfolds its pages. */
  readonly commands: LeafCommands;
  /** Folds its leaves, and tears them out. */
  readonly sheets: SheetCommands;
  /** How large it is shown. */
  readonly extent: BookExtent;
  readonly #options: ViewerOptions;
  readonly #stage: BookStage;
  readonly #source: PageSource;
  readonly #book: Bindable;
  readonly #camera: CameraMotion;
  readonly #bitmaps: PageBitmaps;
  readonly #crossFade: CrossFade;
  readonly #sharpness: Sharpness;
  readonly #foldOut: FoldOut;
  readonly #modelSwitch: ModelSwitch;
  readonly #rebinder: Rebinder;
  readonly #frames: FrameLoop;
  #destroyed = false;

  private constructor(
    canvas: HTMLCanvasElement,
    source: PageSource,
    book: Bindable,
    plan: BindingLayout,
    engine: BookEngine,
    stage: BookStage,
    options: ViewerOptions,
    backend: Backend,
  ) {
    this.#options = options;
    this.#stage = stage;
    this.#source = source;
    this.#book = book;
    this.#stage.onRestored = () => this.invalidate();
    this.#stage.onContextLost = () => options.onContextLost?.();
    this.#crossFade = new CrossFade(canvas, (from) => options.onRest(from, this.turning.spread));
    this.#camera = new CameraMotion(stage);
    this.#bitmaps = new PageBitmaps(source, book.leaf, {
      theme: plan.shape.theme ?? "light",
      slowText: options.slowText,
      failureText: options.failureText,
      onArrive: (page) => {
        this.#showArrived();
        const error = this.#bitmaps.failure(page);
        if (error === null || this.#destroyed) return;
        const isOpen = pagesAt(this.binding, this.turning.spread).includes(page);
        options.onFailure(page, error, isOpen);
      },
      onDrop: (picture) => this.#stage.forget(picture),
    });
    const arrived = (): void => this.invalidate();
    const failed = (error: unknown): void => options.onMissingPart?.(error);
    const pictures = this.#bitmaps;
    this.#sharpness = new Sharpness({ source, stage, book, pictures, arrived, failed });
    this.#foldOut = new FoldOut(this.#bitmaps, {
      unfolds: stage.unfolds,
      width: () => this.#bitmapWidths.page,
      bound: () => this.#bound,
      ready: () => this.#readyFoldOuts(),
      rayAt: (x, y) => stage.rayAt(x, y),
      changed: () => this.#show(),
      moved: arrived,
    });
    this.#modelSwitch = new ModelSwitch(backend.models, failed);
    if (options.model) void this.setModel(options.model());
    const events: BookEvents = {
      started: () => {
        this.#foldOut.close();
        this.#show();
      },
      turnStarted: ({ low, high, from }) => {
        this.sheets.readOn();
        options.onStart(low, high, from === low);
      },
      moved: arrived,
      landed: () => this.#show(),
      rested: (from, to) => {
        this.#rebinder.rested(this.extent.room);
        options.onRest(from, to);
      },
    };
    const tools = { book, stage, pictures: this.#bitmaps, options, events };
    this.#rebinder = new Rebinder(tools, plan, engine);
    this.#rebinder.targets.foldOut = this.#foldOut;
    const rebinder = this.#rebinder;
    this.extent = new BookExtent({ book, stage, camera: this.#camera, rebinder });
    this.commands = new LeafCommands(rebinder, this.#foldOut, arrived);
    this.sheets = new SheetCommands(
      { rebinder, bitmaps: this.#bitmaps, stage, backend, options },
      {
        moved: () => this.#show(),
        bindSoon: () => this.#bindSoon(),
        dropCorner: () => this.commands.dropCorner(),
        lay: (spread) => this.#layBare(spread),
        takeOut: (pages) => this.#takeOut(pages),
        extent: this.extent,
        lookAtRest: (look) => this.#camera.lookAtRest(look),
        showWhole: (whole, seconds) => {
          this.#camera.showWhole(whole, options.calm?.() ? 0 : seconds);
          this.invalidate();
        },
      },
    );
    this.#frames = new FrameLoop({
      window: canvas.ownerDocument.defaultView ?? window,
      ...{ options, stage, bitmaps: this.#bitmaps, camera: this.#camera },
      ...{ crossFade: this.#crossFade, sharpness: this.#sharpness, foldOut: this.#foldOut },
      ...{ modelSwitch: this.#modelSwitch, rebinder, sheets: this.sheets },
      bindAnew: () => this.#bindAnew(),
      extent: this.extent,
    });
  }

  /**
   * Checks that a book can be opened, before there is a canvas for it. Rejects
   * with a `BookError` if no page's size can be read, or with the signal's reason.
   */
  static async check(source: PageSource, signal: AbortSignal): Promise<void> {
    await leafSize(source, signal);
  }

  /**
   * Opens a book on a canvas. Rejects with a `BookError` if no page's size can
   * be read, or with an `Error` if WebGL 2 or WebAssembly is unavailable.
   */
  static async open(
    canvas: HTMLCanvasElement,
    source: PageSource,
    options: ViewerOptions,
    backend: Backend,
    signal: AbortSignal,
  ): Promise<Viewer> {
    const first = options.page() - 1;
    for (const index of [first, first + 1].filter((index) => index < source.pageCount)) {
      // Images begin to load beside the one of which the leaf has its size; what fails is reported when it is drawn.
      source.size(index, signal).catch(() => {});
    }
    const leaf = await leafSize(source, signal);
    const pageWidth = source.widthInMetres?.(leaf);
    const book = { source, leaf, aspect: leaf.width / leaf.height, pageWidth };
    const { clientWidth, clientHeight } = canvas;
    const binding = { ...defaultBinding, ...options };
    const plan = layOutBinding(book, binding, clientWidth, clientHeight, options.page());
    const engine = await backend.engine(plan.shape);
    signal.throwIfAborted();
    const stage = backend.stage(canvas, plan.shape);
    return new Viewer(canvas, source, book, plan, engine, stage, options, backend);
  }

  /**
   * Returns the part of its leaf that a page (from 1) of some size covers, as
   * fractions from the upper left corner.
   */
  placeOf(page: number, size: PageSize): PageBox {
    return this.#bitmaps.placeOf(page, size);
  }

  /** The current binding. `rebind` replaces it. */
  get binding(): Binding {
    return this.#bound.binding;
  }

  /** Where the book lies open and how it gets elsewhere; replaced with every binding. */
  get turning(): Turning {
    return this.#bound.turning;
  }

  /** What happens to its leaves. */
  get state(): BookState {
    const { turning, peek } = this.#bound;
    if (this.#crossFade.isOn) return "turning";
    if (!turning.moving) return "resting";
    if (peek.flight) return "lifting";
    return turning.hasHeld ? "dragged" : "turning";
  }

  /** The drags of pointers on it; replaced with every binding. */
  get drags(): Drags {
    return this.#bound.drags;
  }

  /**
   * Changes options of the binding, as soon as the book is at rest, and keeps
   * the visible page in sight. Options left out stay as they were.
   */
  rebind(changes: Partial<BindingOptions>): void {
    this.#rebinder.setOptions(changes);
    this.#bindSoon();
  }

  /**
   * Shows the book in the colours of a theme: paper, edges and boards as soon as it is at rest, and its
   * pages, whose source draws them in other colours now, as they are drawn anew.
   */
  recolour(theme: PageTheme): void {
    this.#bitmaps.recolour(theme);
    for (let page = 1; page <= this.#source.pageCount; page++) this.#sharpness.redraw(page);
    this.rebind({ theme });
  }

  /**
   * Changes the book's pages as soon as it is at rest. The visible page stays
   * in sight, or the one that lies in its place.
   *
   * Resolves to whether the change was made: false if the book was closed
   * before. Rejects with what `change` throws.
   *
   * @param change changes the source and returns where its pages lie now, and what names them
   */
  changePages(change: () => MovedPages): Promise<boolean> {
    const changed = this.#rebinder.change(() => this.#changed(change()));
    this.#bindSoon();
    return changed;
  }

  /** Gives the leaves the size and the folds of the pages that there are now. */
  #changed(pages: MovedPages): MovedPages {
    const { leaf } = this.#source;
    if (leaf) this.#cutLeaves(leaf);
    this.sheets.keepFolds(pages.folds);
    return pages;
  }

  /**
   * Takes the pages (from 1) of a leaf that has come off out of the book, which lies at rest and is
   * bound without them at once. Returns the number of its sheet; null if its owner keeps them.
   */
  #takeOut(pages: readonly number[]): number | null {
    const rebinder = this.#rebinder;
    const taken = this.#options.tearing?.takeOut(pages, rebinder.makeChanges()) ?? null;
    if (taken !== null) rebinder.follow(this.#changed(taken));
    this.#bindSoon();
    return taken?.id ?? null;
  }

  /**
   * Measures the pages, whose source knows only now how large they are. Resolves to a change of
   * the source for `changePages`, which gives the leaves that size. Rejects with a `BookError` if no
   * page's size can be read, or with the signal's reason.
   */
  async measure(signal: AbortSignal): Promise<() => NewIndex> {
    const leaf = await leafSize(this.#source, signal);
    return () => {
      this.#cutLeaves(leaf);
      return (index) => index;
    };
  }

  /** Gives the leaves a size, in the source's unit, if they have another. */
  #cutLeaves(leaf: PageSize): void {
    const before = this.#book.leaf;
    if (leaf.width === before.width && leaf.height === before.height) return;
    Object.assign(this.#book, { leaf, aspect: leaf.width / leaf.height });
    this.#bitmaps.measure(leaf);
  }

  /**
   * Fits the book to the size of the canvas in CSS pixels.
   *
   * @param pixelRatio as of `BookStage.resize`
   * @param scale likewise
   * @param room the place for which the book is laid out, CSS pixels: larger than the canvas while a panel
   * lies beside that
   */
  resize(
    cssWidth: number,
    cssHeight: number,
    pixelRatio: number,
    scale = 1,
    room: PageSize = { width: cssWidth, height: cssHeight },
  ): void {
    // An observer reports the size that is known already, and a frame of the same costs as much as another.
    if (!this.extent.resize({ width: cssWidth, height: cssHeight }, pixelRatio, scale, room))
      return;
    this.sheets.resized();
    if (!this.#rebinder.suits(room)) {
      this.#rebinder.bindSoon();
      this.#bindSoon();
    }
    this.#options.onPageWidth?.();
    this.#show();
  }

  /** Opens the book at a spread (clamped to the book) without a turn. */
  lay(spread: number): void {
    this.#foldOut.close();
    this.turning.lay(clampSpread(this.binding, spread));
    this.#rebinder.rested(this.extent.room);
    this.#bindAnew();
    this.#show();
  }

  /** Call it before the book is turned to a page (from 1) that is asked for, as `Rebinder.seek`. */
  seek(page: number): void {
    this.#rebinder.seek(page);
  }

  /**
   * Opens the book at a spread (clamped to the book) without turning leaves: by
   * a cross-fade, or at once. Resolves, once that is over, to whether the book
   * lies there.
   *
   * @param by resolves to true also if the book lies farther on (1) or back
   * (-1) then
   */
  change(spread: number, fades: boolean, by: 1 | 0 | -1 = 0): Promise<boolean> {
    const from = this.turning.restedAt;
    const to = clampSpread(this.binding, spread);
    if (to !== from) this.#options.onStart(Math.min(from, to), Math.max(from, to), to > from);
    // A listener may destroy the viewer at once.
    if (this.#destroyed) return Promise.resolve(false);
    if (to !== from || this.turning.moving) {
      this.sheets.readOn();
      if (fades) {
        this.#frames.drawAtOnce();
        this.#crossFade.begin(from);
      }
      this.lay(to);
      if (!this.#crossFade.isOn) this.#options.onRest(from, to);
    }
    if (!this.#crossFade.isOn) return Promise.resolve(true);
    return this.#crossFade.promise((at) => (by === 0 ? at === to : (at - to) * by >= 0));
  }

  /** Changes the paper: at once, or as soon as no leaf is in flight. */
  setPaper(paper: Paper): void {
    this.commands.peek(null);
    this.#rebinder.setPaper(paper);
  }

  /** Changes the model that turns the leaves, as soon as it is loaded and no leaf is in flight. */
  async setModel(choice: ModelChoice): Promise<void> {
    await this.#modelSwitch.choose(choice);
    this.#bindSoon();
  }

  /** Redraws a page (from 1) whose content has changed. */
  redraw(page: number): void {
    if (this.#destroyed) return;
    this.#bitmaps.redraw(page);
    this.#sharpness.redraw(page);
    this.#show();
  }

  /** Sets what draws pages as they look now, while leaves are in flight; null for their bitmaps. */
  setLiveBitmaps(live: LiveBitmaps | null): void {
    if (this.#destroyed) return;
    this.#bitmaps.live = live;
    this.#showArrived();
  }

  /** Shows what has been drawn on a canvas of the live bitmaps since the last frame. */
  canvasChanged(canvas: HTMLCanvasElement): void {
    if (this.#destroyed) return;
    this.#updateFaces();
    this.#stage.refresh(canvas);
    this.invalidate();
  }

  /** Frees what the stage has made of a canvas that was one of the live bitmaps. */
  forgetCanvas(canvas: HTMLCanvasElement): void {
    if (!this.#destroyed) this.#stage.forget(canvas);
  }

  /** Requests a frame, unless one is already requested. */
  invalidate(): void {
    this.#frames.request();
  }

  /** The zoom level, 1 for the whole book to 8; during a motion, the one that it leads to. */
  get zoomLevel(): number {
    return this.#camera.level;
  }

  /**
   * Shows the book at a level so that the point seen at `from` comes to `to`,
   * CSS pixels on the canvas, clamped to the book.
   *
   * @param seconds duration; 0 for at once
   */
  zoom(level: number, from: Place, to: Place, seconds: number): void {
    if (this.#destroyed || !(level > 0)) return;
    this.#bound.peek.end();
    const before = this.#camera.level;
    this.#camera.zoom(level, from, to, seconds);
    this.invalidate();
    if (this.#camera.level !== before) this.#options.onZoom?.(this.#camera.level);
  }

  /**
   * The current view of the book, or the one the camera is moving to. Setting
   * it shows the view at once, clamped to the book.
   */
  get view(): Zoom {
    return this.#camera.view;
  }

  set view(view: Zoom) {
    if (this.#destroyed) return;
    this.#camera.view = view;
    this.invalidate();
  }

  /**
   * Whether fingers move the view: frames are then drawn as while something
   * moves, and none sharper between them.
   */
  set handled(handled: boolean) {
    this.#frames.handled = handled;
  }

  /**
   * Returns where a point of a page is seen, CSS pixels from the canvas's upper
   * left corner, or null if the page does not lie open or leaves are in flight.
   *
   * @param page from 1
   * @param x,y fractions of the page from its upper left corner
   */
  project(page: number, x: number, y: number): Place | null {
    if (this.#destroyed || this.extent.isEmpty) return null;
    if (this.turning.moving && this.#bound.peek.flight === null) return null;
    const face = faceOf(this.binding, this.turning.spread, page);
    if (face === null || !this.#bitmaps.isBare(page, x)) return null;
    return this.#stage.projectOn(face, x, y);
  }

  /**
   * Adds a listener, called after a frame in which the book has come to rest
   * (other pages lie open, or they are seen elsewhere, or the same lie still
   * again) and after the first frame in which it leaves that rest, with whether
   * it rests. Results of `project` hold until the next call. Returns a function
   * that removes the listener.
   */
  onViewChange(listener: (rests: boolean) => void): () => void {
    return this.#frames.viewHistory.add(listener);
  }

  /**
   * Adds a listener, called after each frame that shows the open pages elsewhere
   * while nothing but the camera moves, and after the first frame in which
   * anything else does, with whether the pages lie still. Returns a function that
   * removes it.
   */
  onStillChange(listener: (isStill: boolean) => void): () => void {
    return this.#frames.stillHistory.add(listener);
  }

  /** Returns whether page `page` (from 1) is an element that may lie over its place now. */
  isElement(page: number): boolean {
    return this.#frames.isElement(page);
  }

  /** Whether every visible page is shown at its full sharpness. */
  get settled(): boolean {
    // Before the book has a size no page is requested, so none is missing.
    if (this.extent.isEmpty || this.#frames.isRequested || this.#stage.isLost) return false;
    if (this.#foldOut.isMaking) return false;
    return this.#bitmaps.settled && this.#sharpness.settled;
  }

  /**
   * Whether the book is settled, its model is loaded, and the pages that a turn
   * may bring into sight are drawn, as far as memory allows.
   */
  get ready(): boolean {
    return this.settled && this.#bitmaps.ready && this.#modelSwitch.ready;
  }

  /**
   * Stops everything and frees the memory of the graphics card and the engine.
   *
   * @param keepCanvas whether another viewer will draw on its canvas; without it the
   * canvas's context is released too
   * @returns whether another can
   */
  destroy(keepCanvas = false): boolean {
    if (this.#destroyed) return false;
    this.#destroyed = true;
    this.#frames.close();
    this.#crossFade.close();
    this.commands.close();
    this.#foldOut.close();
    this.sheets.close();
    this.#modelSwitch.close();
    this.#rebinder.close();
    this.#sharpness.close();
    this.#bitmaps.close();
    return this.#stage.destroy(keepCanvas);
  }

  get #bound(): BoundBook {
    return this.#rebinder.bound;
  }

  /** Applies waiting changes as soon as the book is at rest. */
  #bindSoon(): void {
    this.commands.peek(null);
    if (!this.turning.moving) this.#bindAnew();
  }

  /** Applies waiting changes. */
  #bindAnew(): void {
    if (this.#destroyed) return;
    this.#modelSwitch.rest();
    if (!this.#rebinder.hasPending) return;
    this.#foldOut.close();
    this.#sharpness.close();
    const before = this.binding;
    const page = pageOf(before, this.turning.spread);
    const isRenumbered = this.#rebinder.bindAnew(this.extent.room);
    this.sheets.bound();
    this.#frames.bound();
    const { edge, layout } = this.binding;
    if (edge !== before.edge || layout !== before.layout) this.#options.onLayout?.();
    this.#options.onPageWidth?.();
    const now = pageOf(this.binding, this.turning.spread);
    if (now !== page && !isRenumbered) this.#options.onPage?.(page, now);
    this.#show();
  }

  /** Lays the book open where a leaf has come off. */
  #layBare(spread: number): void {
    const from = this.turning.restedAt;
    this.turning.lay(spread);
    this.#rebinder.rested(this.extent.room);
    if (from !== spread) this.#options.onRest(from, spread);
  }

  /** Has the book bound by an engine whose fold-outs open, as soon as it rests. */
  async #readyFoldOuts(): Promise<void> {
    try {
      await this.sheets.useCreasable();
      await this.commands.dropCorner();
      this.#bindSoon();
    } catch (error) {
      this.#options.onMissingPart?.(error);
    }
  }

  /** Updates the bitmap of every face, requests the pages wanted next, and draws them. */
  #show(): void {
    if (this.#destroyed) return;
    this.#updateFaces();
    this.invalidate();
  }

  /** Shows a bitmap that has arrived; nothing is drawn for one that is not in sight. */
  #showArrived(): void {
    if (this.#destroyed) return;
    const hasChanged = this.#updateFaces();
    if (hasChanged || this.#frames.isOutdated) this.invalidate();
  }

  /** Updates the bitmap of every face, and requests the pages wanted next. Returns whether any is new. */
  #updateFaces(): boolean {
    const { faceTextures: picturing } = this.#bound;
    if (!this.extent.isEmpty) picturing.want(this.#bitmapWidths);
    const hasChanged = picturing.show(this.#foldOut.parts, this.#frames.isStill);
    this.sheets.show();
    this.#sharpness.keep(picturing.pages);
    return hasChanged;
  }

  get #bitmapWidths(): BitmapWidths {
    return bitmapWidths(this.#bound.shape, this.#stage, this.#camera);
  }
}
