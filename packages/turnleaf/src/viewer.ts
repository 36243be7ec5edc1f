/**
 * One book on one screen: the way from a command to a frame. It owns the
 * engine's book, the stage that draws it and the pool of page pictures, and
 * brings them together frame by frame while something moves. At rest it has no
 * animation frame and no timer.
 */

import { faceOf } from "./book/faces.ts";
import type { Paper } from "./book/paper.ts";
import { type Binding, clampSpread, pagesAt } from "./book/spreads.ts";
import type { Flight, Turning, TurningEvents } from "./book/turning.ts";
import type { BookStage, Place } from "./draw/stage.ts";
import type { Zoom } from "./draw/zoom.ts";
import type { BookEngine } from "./engine/engine.ts";
import { leafSize } from "./pages/leaf_size.ts";
import { PagePictures } from "./pages/page_pictures.ts";
import type { PageBox, PageSize, PageSource } from "./sources/page_source.ts";
import { Binder } from "./view/binder.ts";
import {
  type Bindable,
  type BindingPlan,
  type Bound,
  planBinding,
  type Wish,
} from "./view/bound.ts";
import { Fade } from "./view/fade.ts";
import { Folding } from "./view/folding.ts";
import { Modelling } from "./view/modelling.ts";
import { type Craft, usualWish, type ViewerOptions } from "./view/options.ts";
import { pictureWidth } from "./view/picturing.ts";
import { QualityGovernor } from "./view/quality.ts";
import { Sharpness } from "./view/sharpness.ts";
import { Steering } from "./view/steering.ts";
import { Stillness } from "./view/stillness.ts";
import { Viewing } from "./view/viewing.ts";
import { Views } from "./view/views.ts";
import type { ModelChoice } from "./wear/model_choice.ts";

export type { Zoom } from "./draw/zoom.ts";
export type { Craft, ViewerOptions } from "./view/options.ts";

/** How much of the width of its place, as high as its leaves need, an open book takes. */
const fullness = 0.9;

/** One book on one canvas. */
export class Viewer {
  /** How the reader moves its leaves. */
  readonly steering: Steering;
  readonly #options: ViewerOptions;
  readonly #stage: BookStage;
  readonly #viewing: Viewing;
  readonly #pictures: PagePictures;
  readonly #fade: Fade;
  readonly #sharpness: Sharpness;
  readonly #folding: Folding;
  readonly #modelling: Modelling;
  readonly #views = new Views();
  readonly #stillness = new Stillness();
  readonly #governor = new QualityGovernor();
  readonly #binder: Binder;
  /** The window in which the canvas is seen: another's frames stop when that one is hidden. */
  readonly #window: Window;
  #cssWidth = 0;
  #cssHeight = 0;
  #frame = 0;
  #handled = false;
  #destroyed = false;

  private constructor(
    canvas: HTMLCanvasElement,
    source: PageSource,
    book: Bindable,
    plan: BindingPlan,
    engine: BookEngine,
    stage: BookStage,
    options: ViewerOptions,
    craft: Craft,
  ) {
    this.#options = options;
    this.#window = canvas.ownerDocument.defaultView ?? window;
    this.#stage = stage;
    this.#stage.onRestored = () => this.invalidate();
    this.#stage.onGone = () => options.onGone?.();
    this.#fade = new Fade(canvas, (from) => options.onRest(from, this.turning.spread));
    this.#viewing = new Viewing(stage);
    this.#pictures = new PagePictures(source, book.leaf, {
      slowText: options.slowText,
      onArrive: (page) => {
        this.#show();
        const sentence = this.#pictures.failure(page);
        if (sentence === null || this.#destroyed) return;
        const isOpen = pagesAt(this.binding, this.turning.spread).includes(page);
        options.onFailure(page, sentence, isOpen);
      },
      onDrop: (picture) => this.#stage.forget(picture),
    });
    const arrived = (): void => this.invalidate();
    const failed = (error: unknown): void => options.onLack?.(error);
    const { aspect } = book;
    const pictures = this.#pictures;
    this.#sharpness = new Sharpness({ source, stage, aspect, pictures, arrived, failed });
    this.#folding = new Folding(this.#pictures, {
      unfolds: stage.unfolds,
      width: () => this.#pictureWidth,
      changed: () => this.#show(),
      failed,
    });
    this.#modelling = new Modelling(craft.models, failed);
    if (options.model) void this.setModel(options.model());
    const events: TurningEvents = {
      started: (flight) => {
        this.#folding.close();
        this.#show();
        if (!this.#bound.peek.lifting) this.#tellStart(flight);
      },
      landed: () => this.#show(),
      rested: (from, to) => {
        this.#binder.rested();
        options.onRest(from, to);
      },
    };
    const tools = { book, stage, pictures: this.#pictures, options, events };
    this.#binder = new Binder(tools, plan, engine);
    this.steering = new Steering(this.#binder, this.#folding, {
      started: (flight) => this.#tellStart(flight),
      stirred: arrived,
    });
  }

  /**
   * Opens a book on a canvas.
   * Rejects with a `BookError` where no page's size can be had, or
   * with an `Error` where WebGL 2 or WebAssembly is not to be had.
   */
  static async open(
    canvas: HTMLCanvasElement,
    source: PageSource,
    options: ViewerOptions,
    craft: Craft,
    signal: AbortSignal,
  ): Promise<Viewer> {
    const leaf = await leafSize(source, signal);
    const book = { source, leaf, aspect: leaf.width / leaf.height };
    const { clientWidth, clientHeight } = canvas;
    const plan = planBinding(book, { ...usualWish, ...options }, clientWidth, clientHeight);
    const engine = await craft.engine(plan.shape);
    signal.throwIfAborted();
    const stage = craft.stage(canvas, plan.shape);
    return new Viewer(canvas, source, book, plan, engine, stage, options, craft);
  }

  /** The part of its leaf that a page (from 1) of some size covers, shares from the upper left corner. */
  placeOf(page: number, size: PageSize): PageBox {
    return this.#pictures.placeOf(page, size);
  }

  /** How the book is bound now. Another once `rebind` has done its work. */
  get binding(): Binding {
    return this.#bound.binding;
  }

  /** Width over height of a place that two pages fill with the room that their leaves need. */
  get placeRatio(): number {
    const { width, height, rolled } = this.#bound.shape;
    const pages = rolled ? height / (2 * width) : (2 * width) / height;
    return fullness * pages;
  }

  /** Where the book lies open and how it gets elsewhere; another with every binding. */
  get turning(): Turning {
    return this.#bound.turning;
  }

  /**
   * Binds the book anew, as soon as it lies still, with the page in sight that
   * is in sight now. What is left out stays as it was.
   */
  rebind(changes: Partial<Wish>): void {
    this.#binder.wish(changes);
    this.#bindSoon();
  }

  /**
   * Changes the book's pages, as soon as it lies still; the page in sight stays,
   * or the one that lies in its place does.
   *
   * Resolves to whether it was done: not where the book was taken away before.
   * Rejects as `change` throws.
   *
   * @param change changes the source and answers where a page (from 0) lies then, null where it is gone
   */
  changePages(change: () => (index: number) => number | null): Promise<boolean> {
    const changed = this.#binder.change(change);
    this.#bindSoon();
    return changed;
  }

  /** Fits the book to the canvas's size in CSS pixels. */
  resize(cssWidth: number, cssHeight: number, pixelRatio: number): void {
    this.#cssWidth = cssWidth;
    this.#cssHeight = cssHeight;
    this.#stage.resize(cssWidth, cssHeight, pixelRatio);
    if (!this.#binder.suits(cssWidth, cssHeight)) this.rebind({});
    this.#show();
  }

  /** Opens the book at a spread (clamped to the book) without a turn. */
  lay(spread: number): void {
    this.#folding.close();
    this.turning.lay(clampSpread(this.binding, spread));
    this.#binder.rested();
    this.#bindAnew();
    this.#show();
  }

  /**
   * Opens the book at a spread (clamped to the book) without turning leaves: by a
   * quiet cross-fade, or at once. Resolves, once that is over, to whether the book lies there.
   *
   * @param by resolves to true also where the book lies farther on (1) or back (-1) then
   */
  change(spread: number, fades: boolean, by: 1 | 0 | -1 = 0): Promise<boolean> {
    const from = this.turning.restedAt;
    const to = clampSpread(this.binding, spread);
    if (to !== from) this.#options.onStart(Math.min(from, to), Math.max(from, to), to > from);
    // Whoever hears of it may take the book away at once.
    if (this.#destroyed) return Promise.resolve(false);
    if (to !== from || this.turning.moving) {
      if (fades) {
        this.#stage.draw({ resting: true });
        this.#fade.begin(from);
      }
      this.lay(to);
      if (!this.#fade.isOn) this.#options.onRest(from, to);
    }
    if (!this.#fade.isOn) return Promise.resolve(true);
    return this.#fade.promise((at) => (by === 0 ? at === to : (at - to) * by >= 0));
  }

  /** Makes the leaves of another paper: at once, or as soon as none is in flight. */
  setPaper(paper: Paper): void {
    this.steering.peek(null);
    this.#binder.setPaper(paper);
  }

  /** Turns the leaves in another way, as soon as it is loaded and none is in flight. */
  async setModel(choice: ModelChoice): Promise<void> {
    await this.#modelling.choose(choice);
    this.#bindSoon();
  }

  /** Draws a page (from 1) anew, as its source shows something else there now. */
  redraw(page: number): void {
    if (this.#destroyed) return;
    this.#pictures.redraw(page);
    this.#sharpness.redraw(page);
    this.invalidate();
  }

  /** Asks for a frame, unless one is already asked for. */
  invalidate(): void {
    this.#stillness.stir();
    this.#askForFrame();
  }

  /** How near the book is seen, from 1 for all of it to 8; on the way there, what it leads to. */
  get zoomLevel(): number {
    return this.#viewing.level;
  }

  /**
   * Shows the book at a level so that what is seen at `from` comes to `to`, CSS
   * pixels on the canvas, as far as the book reaches.
   *
   * @param seconds that it takes; 0 at once
   */
  zoom(level: number, from: Place, to: Place, seconds: number): void {
    if (this.#destroyed || !(level > 0)) return;
    this.#bound.peek.end();
    const before = this.#viewing.level;
    this.#viewing.zoom(level, from, to, seconds);
    this.invalidate();
    if (this.#viewing.level !== before) this.#options.onZoom?.(this.#viewing.level);
  }

  /** What is shown of the book, or on the way to being; setting it shows that at once, as far as the book reaches. */
  get view(): Zoom {
    return this.#viewing.view;
  }

  set view(view: Zoom) {
    if (this.#destroyed) return;
    this.#viewing.view = view;
    this.invalidate();
  }

  /** Whether fingers are at the view: frames are drawn as while something moves, and none sharper between them. */
  set handled(handled: boolean) {
    this.#handled = handled;
    this.invalidate();
  }

  /**
   * Where a place on a page is seen, CSS pixels from the canvas's upper left
   * corner; null where that page does not lie open, or leaves are in flight.
   *
   * @param page from 1
   * @param x,y shares of the page from its upper left corner
   */
  project(page: number, x: number, y: number): Place | null {
    if (this.#destroyed || this.#cssWidth === 0) return null;
    if (this.turning.moving && this.#bound.peek.flight === null) return null;
    const face = faceOf(this.binding, this.turning.spread, page);
    if (face === null || !this.#pictures.isBare(page, x)) return null;
    return this.#stage.projectOn(face, x, y);
  }

  /**
   * Calls `listener` after a frame in which the book came to rest: other pages
   * lie open, or they are seen elsewhere, or the same lie still again; and after
   * the first frame in which it leaves that rest, with whether it rests. What
   * `project` answers then holds until the next call. Answers how to take the listener away.
   */
  onView(listener: (rests: boolean) => void): () => void {
    return this.#views.add(listener);
  }

  /** Whether every page in sight is shown at its full sharpness. */
  get settled(): boolean {
    // Before there is room for the book no page is asked for, so none is missing.
    if (this.#cssWidth === 0 || this.#frame !== 0 || this.#stage.isLost) return false;
    return this.#pictures.settled && this.#sharpness.settled;
  }

  /** Whether, besides, the model that turns them is there, and the pages that a turn may bring into sight are drawn, as far as memory allows. */
  get ready(): boolean {
    return this.settled && this.#pictures.ready && this.#modelling.ready;
  }

  /** Stops everything and frees what the graphics card and the engine hold. */
  destroy(): void {
    if (this.#destroyed) return;
    this.#destroyed = true;
    this.#window.cancelAnimationFrame(this.#frame);
    this.#frame = 0;
    this.#fade.close();
    this.steering.close();
    this.#folding.close();
    this.#modelling.close();
    this.#binder.close();
    this.#sharpness.close();
    this.#pictures.close();
    this.#stage.destroy();
  }

  #askForFrame(): void {
    if (this.#destroyed || this.#frame !== 0) return;
    this.#frame = this.#window.requestAnimationFrame((now) => this.#draw(now));
  }

  #draw(now: number): void {
    this.#frame = 0;
    const {
      ticks,
      engine: { tick },
    } = this.#bound;
    const passed = ticks.pass(now);
    const seconds = passed * tick;
    // Without a turn nothing in the engine has moved since the book was laid open.
    const turned = this.turning.moving;
    const turning = turned && this.turning.step(passed);
    // Whoever hears of a turn may take the book away at once.
    if (this.#destroyed) return;
    if (turned) this.#modelling.update(this.#bound, seconds);
    if (!turning) this.#bindAnew();
    if (this.#destroyed) return;
    const { peek } = this.#bound;
    peek.step(seconds);
    const folding = this.#folding.step(seconds);
    const stepping = this.#viewing.step(seconds) || folding;
    const posed = this.#bound.pose();
    const flap = this.#folding.surface(posed, this.#bound.shape);
    const pose = { ...this.#modelling.pose(posed), flap };
    if (stepping) this.#bound.holding.follow();
    // What is held quite still takes no more frames until the hand moves.
    const still =
      turning &&
      this.turning.inHand &&
      this.#stillness.check([...posed.leaves, ...this.#modelling.sheets]);
    const moving = (turning && !still) || stepping;
    const resting = !moving && !this.#handled;
    // Of a view that fingers move, the next frame comes when they do.
    if (moving) this.#governor.frame(now);
    else this.#governor.rest();
    const { pixels, roughly } = this.#governor.quality;
    this.#stage.pose(pose, roughly && !resting);
    this.#options.onMotion?.(posed, seconds, turning && !still);
    this.#stage.draw({ resting, pixels });
    this.#pictures.paused = !resting;
    this.#fade.step(now, this.turning.spread);
    if (this.#destroyed) return;
    if (moving || this.#fade.isOn) this.#askForFrame();
    else ticks.stop();
    if (!resting) this.#sharpness.pause();
    else if (!turning) {
      this.#sharpness.look(this.#bound.picturing.open, this.#cssWidth, this.#cssHeight);
    }
    const gone = stepping || this.#handled || this.#fade.isOn || (turning && !peek.flight);
    this.#views.tell(gone ? "" : `${this.turning.spread} ${this.#stage.viewKey}`);
  }

  #tellStart({ low, high, from }: Flight): void {
    this.#options.onStart(low, high, from === low);
  }

  get #bound(): Bound {
    return this.#binder.bound;
  }

  /** Does what waits for the book to lie still as soon as it does. */
  #bindSoon(): void {
    this.steering.peek(null);
    if (!this.turning.moving) this.#bindAnew();
  }

  /** Does what waited for the book to lie still. */
  #bindAnew(): void {
    if (this.#destroyed) return;
    this.#modelling.rest();
    if (!this.#binder.waits) return;
    this.#folding.close();
    this.#sharpness.close();
    const before = this.binding;
    this.#binder.bindAnew(this.#cssWidth, this.#cssHeight);
    this.#views.forget();
    const { edge, layout } = this.binding;
    if (edge !== before.edge || layout !== before.layout) this.#options.onLayout?.();
    this.#show();
  }

  /** Brings every face's picture up to date, and asks for the pages wanted next. */
  #show(): void {
    if (this.#destroyed) return;
    const { picturing } = this.#bound;
    if (this.#cssWidth > 0) picturing.want(this.#pictureWidth);
    picturing.show(this.#folding.parts);
    this.#sharpness.keep(picturing.pages);
    this.invalidate();
  }

  get #pictureWidth(): number {
    return pictureWidth(this.#bound.shape, this.#stage, this.#viewing);
  }
}
