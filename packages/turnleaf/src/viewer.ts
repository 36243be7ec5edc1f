/**
 * One book on one screen: the way from a command to a frame. It owns the
 * engine's book, the stage that draws it and the pool of page pictures, and
 * brings them together frame by frame while something moves. At rest it has no
 * animation frame and no timer.
 */

import { faceOf } from "./book/faces.ts";
import { makeOf, type Paper } from "./book/paper.ts";
import {
  type Binding,
  clampSpread,
  leftPage,
  pageOf,
  pagesAt,
  rightPage,
  spineOf,
  spreadOf,
} from "./book/spreads.ts";
import type { Flight, Turning } from "./book/turning.ts";
import type { BookStage, Place } from "./draw/stage.ts";
import type { BookEngine } from "./engine/engine.ts";
import { Side } from "./engine/phases.ts";
import { leafSize } from "./pages/leaf_size.ts";
import { PagePictures } from "./pages/page_pictures.ts";
import { isFoldOut } from "./pages/placing.ts";
import type { PageBox, PageSize, PageSource } from "./sources/page_source.ts";
import { type Bindable, type BindingPlan, Bound, planBinding, type Wish } from "./view/bound.ts";
import { Details } from "./view/details.ts";
import { Fade } from "./view/fade.ts";
import { Folding } from "./view/folding.ts";
import type { Hold } from "./view/holding.ts";
import { type Craft, usualWish, type ViewerOptions } from "./view/options.ts";
import { pictureWidth } from "./view/picturing.ts";
import { QualityGovernor } from "./view/quality.ts";
import { Stillness } from "./view/stillness.ts";
import { Viewing } from "./view/viewing.ts";
import { Views } from "./view/views.ts";

export type { Craft, ViewerOptions } from "./view/options.ts";

/** One book on one canvas. */
export class Viewer {
  readonly #book: Bindable;
  readonly #options: ViewerOptions;
  readonly #stage: BookStage;
  readonly #viewing: Viewing;
  readonly #pictures: PagePictures;
  readonly #fade: Fade;
  readonly #details: Details;
  readonly #folding: Folding;
  readonly #views = new Views();
  readonly #stillness = new Stillness();
  readonly #governor = new QualityGovernor();
  #bound: Bound;
  #wish: Wish;
  /** The page to keep in sight however the book is bound. */
  #place: number;
  #mustRebind = false;
  /** Changes of the pages that wait for the book to lie still. */
  readonly #changes: (() => void)[] = [];
  #cssWidth = 0;
  #cssHeight = 0;
  #frame = 0;
  #handled = false;
  /** Paper that waits for the leaves in flight to land. */
  #nextPaper: Paper | null = null;
  #destroyed = false;

  private constructor(
    canvas: HTMLCanvasElement,
    source: PageSource,
    book: Bindable,
    plan: BindingPlan,
    engine: BookEngine,
    stage: BookStage,
    options: ViewerOptions,
  ) {
    this.#book = book;
    this.#options = options;
    this.#wish = { ...usualWish, ...options };
    this.#place = options.page();
    this.#stage = stage;
    this.#stage.onRestored = () => this.invalidate();
    this.#stage.onGone = () => options.onGone?.();
    this.#fade = new Fade(canvas, (from) => options.onRest(from, this.turning.spread));
    this.#viewing = new Viewing(stage);
    this.#pictures = new PagePictures(source, book.leaf, {
      onArrive: (page) => {
        this.#show();
        const sentence = this.#pictures.failure(page);
        if (sentence !== null && this.#lieOpen(page)) options.onFailure(sentence);
      },
      onDrop: (picture) => this.#stage.forget(picture),
    });
    const arrived = (): void => this.invalidate();
    this.#details = new Details(source, stage, book.aspect, this.#pictures, arrived);
    this.#folding = new Folding(this.#pictures, () => this.#show());
    this.#bound = this.#bind(plan, engine);
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
    return new Viewer(canvas, source, book, plan, engine, stage, options);
  }

  /** The part of its leaf that a page (from 1) of some size covers, shares from the upper left corner. */
  placeOf(page: number, size: PageSize): PageBox {
    return this.#pictures.placeOf(page, size);
  }

  /** How the book is bound now. Another once `rebind` has done its work. */
  get binding(): Binding {
    return this.#bound.binding;
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
    this.#wish = { ...this.#wish, ...changes };
    this.#mustRebind = true;
    this.peek(null);
    if (!this.turning.moving) this.#bindAnew();
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
    const changed = new Promise<boolean>((resolve, reject) => {
      this.#changes.push(() => {
        if (this.#destroyed) return resolve(false);
        try {
          const moved = change();
          this.#pictures.renumber(moved);
          this.#place = this.#placeAfter(moved);
          this.#mustRebind = true;
          resolve(true);
        } catch (error) {
          reject(error);
        }
      });
    });
    this.peek(null);
    if (this.#destroyed || !this.turning.moving) this.#bindAnew();
    return changed;
  }

  /** Fits the book to the canvas's size in CSS pixels. */
  resize(cssWidth: number, cssHeight: number, pixelRatio: number): void {
    this.#cssWidth = cssWidth;
    this.#cssHeight = cssHeight;
    this.#stage.resize(cssWidth, cssHeight, pixelRatio);
    if (this.#plan().binding.layout !== this.binding.layout) this.rebind({});
    this.#show();
  }

  /** Opens the book at a spread (clamped to the book) without a turn. */
  lay(spread: number): void {
    this.#folding.close();
    this.turning.lay(clampSpread(this.binding, spread));
    this.#changePaper();
    this.#keepPlace();
    this.#bindAnew();
    this.#show();
  }

  /**
   * Opens the book at a spread (clamped to the book) by a quiet cross-fade.
   * Resolves, once that is over, to whether it lies there.
   */
  fadeTo(spread: number): Promise<boolean> {
    const from = this.turning.spread;
    const to = clampSpread(this.binding, spread);
    if (to !== from) this.#options.onStart(Math.min(from, to), Math.max(from, to), to > from);
    // Whoever hears of it may take the book away at once.
    if (this.#destroyed) return Promise.resolve(false);
    if (to !== from || this.turning.moving) {
      this.#stage.draw({ resting: true });
      this.#fade.begin(from);
      this.lay(to);
    }
    return this.#fade.isOn ? this.#fade.promise(to) : Promise.resolve(true);
  }

  /** The page (from 1) of the fold-out that lies open or opens, or null. */
  get unfolded(): number | null {
    return this.#folding.page;
  }

  /**
   * Unfolds a page (from 1) that lies open and is wider than the book. Resolves,
   * once it does, to whether it lies unfolded.
   */
  unfold(page: number): Promise<boolean> {
    const { spread, moving } = this.turning;
    const face = this.#destroyed || moving ? null : faceOf(this.binding, spread, page);
    const isPage = face === "left" || face === "right";
    if (!isPage || !this.#stage.unfolds) return Promise.resolve(false);
    const sign = face === "right" ? 1 : -1;
    return this.#folding.unfold(page, sign, this.#pictureWidth);
  }

  /** Folds in the page that lies unfolded. Resolves once it does. */
  foldIn(): Promise<void> {
    const folded = this.#folding.foldIn();
    this.invalidate();
    return folded;
  }

  /** A tap at a place on the canvas, CSS pixels: unfolds the fold-out there, and folds it in again. */
  tap(x: number, y: number): void {
    if (this.#destroyed || this.turning.moving) return;
    if (this.unfolded !== null) return void this.foldIn();
    const on = this.pick(x, y)?.on;
    if (typeof on !== "number") return;
    const { spread } = this.turning;
    const page = (on === Side.right ? rightPage : leftPage)(this.binding, spread);
    if (page !== null && isFoldOut(this.#pictures.placeOfDrawn(page))) void this.unfold(page);
  }

  /** Makes the leaves of another paper: at once, or as soon as none is in flight. */
  setPaper(paper: Paper): void {
    this.#nextPaper = paper;
    this.peek(null);
    this.#changePaper();
  }

  /** Draws a page (from 1) anew, as its source shows something else there now. */
  redraw(page: number): void {
    if (this.#destroyed) return;
    this.#pictures.redraw(page);
    this.#details.redraw(page);
    this.invalidate();
  }

  /** Asks for a frame, unless one is already asked for. */
  invalidate(): void {
    this.#stillness.stir();
    this.#askForFrame();
  }

  /** What a hand at a place on the canvas (CSS pixels) could hold, or null. */
  pick(x: number, y: number): Hold | null {
    const { holding, peek } = this.#bound;
    const hold = holding.pick(x, y);
    // Beside a corner that is lifted a hand takes that leaf, not the one under it.
    return hold && peek.flight && hold.on === peek.side ? { ...hold, on: peek.flight } : hold;
  }

  /**
   * A hand takes hold where `pick` found something; the leaf then follows `drag`.
   *
   * @param pull how far the hand has moved since, CSS pixels
   */
  grab(found: Hold, hand: number, pull: Place = { x: 0, y: 0 }): boolean {
    if (this.#destroyed) return false;
    const { holding, peek } = this.#bound;
    const hold = this.#bound.pulled(found, pull.x, pull.y);
    const taken = typeof hold.on === "number" ? null : peek.take(hold.on);
    const grabbed = holding.grab(hold, hand);
    peek.end();
    if (taken) this.#tellStart(taken);
    return grabbed && !this.#destroyed;
  }

  /** The corner of a resting leaf lifts a little, until null is told. Answers whether it does. */
  peek(hold: Hold | null): boolean {
    // A page that lies unfolded keeps its corners.
    if (this.#destroyed || (hold !== null && this.#folding.parts !== null)) return false;
    const { peek, holding } = this.#bound;
    if (hold === null) peek.end();
    const lifts = hold !== null && peek.begin(hold, holding.floor(hold.on === Side.right ? 1 : -1));
    if (this.turning.moving) this.invalidate();
    return lifts;
  }

  /** Whether a place that `pick` found is on a leaf that only lifts a corner. */
  peeks(hold: Hold): boolean {
    return hold.on === this.#bound.peek.flight;
  }

  /** Turns a leaf to the left (1) or the right (-1); resolves as `Turning.turn` does. */
  turn(way: 1 | -1): Promise<boolean> {
    return this.#command(
      () => this.turning.turn(way),
      (flight) => (flight.from === flight.low) === (way === 1),
    );
  }

  /** Turns to a spread; resolves as `Turning.goTo` does. */
  goTo(spread: number): Promise<boolean> {
    return this.#command(
      () => this.turning.goTo(spread),
      () => false,
    );
  }

  /** A hand that holds something moves to a place on the canvas, CSS pixels. */
  drag(hand: number, x: number, y: number): void {
    if (!this.#destroyed && this.#bound.holding.drag(hand, x, y)) this.invalidate();
  }

  /** A hand lets go. */
  release(hand: number): void {
    if (this.#destroyed) return;
    const way = this.turning.holds(hand) ? this.#bound.holding.carried(hand) : 0;
    if (way !== 0) void this.turning.turn(way);
    this.#bound.holding.release(hand);
    this.invalidate();
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
    return this.#pictures.settled && this.#details.settled;
  }

  /** Stops everything and frees what the graphics card and the engine hold. */
  destroy(): void {
    if (this.#destroyed) return;
    this.#destroyed = true;
    cancelAnimationFrame(this.#frame);
    this.#frame = 0;
    this.#fade.close();
    this.#folding.close();
    this.#bindAnew();
    this.#bound.destroy();
    this.#details.close();
    this.#pictures.close();
    this.#stage.destroy();
  }

  #askForFrame(): void {
    if (this.#destroyed || this.#frame !== 0) return;
    this.#frame = requestAnimationFrame((now) => this.#draw(now));
  }

  #draw(now: number): void {
    this.#frame = 0;
    const { engine, ticks } = this.#bound;
    const passed = ticks.pass(now);
    // Without a turn nothing in the engine has moved since the book was laid open.
    const turned = this.turning.moving;
    const turning = turned && this.turning.step(passed);
    // Whoever hears of a turn may take the book away at once.
    if (this.#destroyed) return;
    if (turned) engine.update();
    if (!turning) this.#bindAnew();
    const { peek } = this.#bound;
    const seconds = passed * engine.tick;
    peek.step(seconds);
    const folding = this.#folding.step(seconds);
    const stepping = this.#viewing.step(turning && peek.flight === null, seconds) || folding;
    const posed = this.#bound.pose();
    const pose = { ...posed, flap: this.#folding.surface(posed, this.#bound.shape) };
    if (stepping) this.#bound.holding.follow();
    // What is held quite still takes no more frames until the hand moves.
    const still = turning && this.turning.inHand && this.#stillness.check(pose.leaves);
    const moving = (turning && !still) || stepping;
    const resting = !moving && !this.#handled;
    // Of a view that fingers move, the next frame comes when they do.
    if (moving) this.#governor.frame(now);
    else this.#governor.rest();
    const { pixels, roughly } = this.#governor.quality;
    this.#stage.pose(pose, roughly && !resting);
    this.#options.onMotion?.(pose, seconds, turning && !still);
    this.#stage.draw({ resting, pixels });
    this.#pictures.paused = !resting;
    this.#fade.step(now, this.turning.spread);
    if (this.#destroyed) return;
    if (moving || this.#fade.isOn) this.#askForFrame();
    else ticks.stop();
    if (!resting) this.#details.pause();
    else if (!turning) this.#lookClosely();
    const gone = stepping || this.#handled || this.#fade.isOn || (turning && !peek.flight);
    this.#views.tell(gone ? "" : `${this.turning.spread} ${this.#stage.viewKey}`);
  }

  /** Draws anew what is seen larger than its picture is. */
  #lookClosely(): void {
    this.#details.look(this.#bound.picturing.open, this.#cssWidth, this.#cssHeight);
  }

  async #afterFolding(command: () => Promise<boolean>): Promise<boolean> {
    await this.foldIn();
    return this.#destroyed ? false : await command();
  }

  /**
   * A command while a corner is lifted: that leaf falls back, or is turned.
   *
   * @param turns whether the command is to turn that leaf
   */
  #command(order: () => Promise<boolean>, turns: (flight: Flight) => boolean): Promise<boolean> {
    if (this.unfolded !== null) return this.#afterFolding(() => this.#command(order, turns));
    const { peek } = this.#bound;
    const { flight } = peek;
    if (flight === null || !turns(flight)) peek.end();
    const done = order();
    // Whether it was meant or only lay in the way: it is a turn from now on.
    const turned =
      flight !== null && (flight.to === Side.left) === (flight.from === flight.low)
        ? peek.take(flight)
        : null;
    if (turned) this.#tellStart(turned);
    this.invalidate();
    return done;
  }

  #tellStart({ low, high, from }: Flight): void {
    this.#options.onStart(low, high, from === low);
  }

  #changePaper(): void {
    if (this.#nextPaper === null || this.turning.flights.length > 0) return;
    makeOf(this.#nextPaper, this.#bound.engine);
    this.#nextPaper = null;
  }

  #plan(): BindingPlan {
    return planBinding(
      this.#book,
      this.#wish,
      this.#cssWidth,
      this.#cssHeight,
      this.binding.layout,
    );
  }

  /** Binds the book as planned, at the page to keep in sight. */
  #bind(plan: BindingPlan, engine: BookEngine): Bound {
    const options = this.#options;
    const bound = new Bound(plan, engine, this.#stage, this.#pictures, {
      started: (flight) => {
        this.#folding.close();
        this.#show();
        if (!bound.peek.lifting) this.#tellStart(flight);
      },
      landed: () => this.#show(),
      rested: (from, to) => {
        this.#changePaper();
        this.#keepPlace();
        options.onRest(from, to);
      },
    });
    this.#pictures.bind((page) => spineOf(plan.binding, page));
    bound.turning.seconds = options.turnSeconds();
    makeOf(options.paper(), engine);
    this.#nextPaper = null;
    bound.turning.lay(spreadOf(plan.binding, this.#place));
    return bound;
  }

  /** Does what waited for the book to lie still. */
  #bindAnew(): void {
    if (this.#changes.length > 0 || this.#mustRebind) this.#folding.close();
    for (const change of this.#changes.splice(0)) change();
    if (!this.#mustRebind || this.#destroyed) return;
    this.#mustRebind = false;
    const before = this.#bound;
    const plan = this.#plan();
    this.#details.close();
    this.#stage.bind(plan.shape);
    this.#bound = this.#bind(plan, before.engine.another(plan.shape));
    before.destroy();
    this.#views.forget();
    const { edge, layout } = before.binding;
    if (edge !== this.binding.edge || layout !== this.binding.layout) this.#options.onLayout?.();
    this.#show();
  }

  /** Where the place is once pages have moved: at its own page, else behind the one before it. */
  #placeAfter(moved: (index: number) => number | null): number {
    for (let index = this.#place - 1; index >= 0; index--) {
      const now = moved(index);
      if (now !== null) return now + (index === this.#place - 1 ? 1 : 2);
    }
    return 1;
  }

  /** Of two pages in sight, the one that was asked for stays the place. */
  #keepPlace(): void {
    const { spread } = this.turning;
    if (!pagesAt(this.binding, spread).includes(this.#place)) {
      this.#place = pageOf(this.binding, spread);
    }
  }

  /** Brings every face's picture up to date, and asks for the pages wanted next. */
  #show(): void {
    if (this.#destroyed) return;
    if (this.#cssWidth > 0) {
      this.#bound.picturing.want(this.#pictureWidth);
    }
    this.#bound.picturing.show(this.#folding.parts);
    this.#details.keep(this.#bound.picturing.pages);
    this.invalidate();
  }

  get #pictureWidth(): number {
    return pictureWidth(this.#bound.shape, this.#stage, this.#viewing);
  }

  #lieOpen(page: number): boolean {
    return pagesAt(this.binding, this.turning.spread).includes(page);
  }
}
