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
  bind,
  leafCount,
  leftPage,
  paperLeaves,
  rightPage,
  spreadOf,
} from "./book/spreads.ts";
import { Turning } from "./book/turning.ts";
import type { BookShape } from "./draw/pose.ts";
import type { BookStage } from "./draw/stage.ts";
import type { BookEngine, BookSize } from "./engine/engine.ts";
import { Cover, Side } from "./engine/phases.ts";
import type { Surface } from "./engine/shapes.ts";
import { PagePictures } from "./pages/page_pictures.ts";
import type { PageSource } from "./sources/page_source.ts";
import { type Hold, Holding, heightOf } from "./view/holding.ts";
import { Picturing, spreadsBetween } from "./view/picturing.ts";
import { Ticks } from "./view/ticks.ts";

/** What moves a book's leaves and what draws them; the two of a craft are made for each other. */
export interface Craft {
  engine(size: BookSize): Promise<BookEngine>;
  stage(canvas: HTMLCanvasElement, shape: BookShape): BookStage;
}

/** How a book is shown. */
export interface ViewerOptions {
  readonly cover: "hard" | "none";
  /** Colour of the boards' cloth, as CSS writes it. */
  readonly cloth: string;
  /** What the leaves are made of, asked for when the book lies open. */
  readonly paper: () => Paper;
  /** The page (from 1) at which the book lies open first, asked for when it does. */
  readonly page: () => number;
  /** Length of a played turn, seconds, asked for likewise. */
  readonly turnSeconds: () => number;
  /** A turn begins between two spreads. */
  readonly onStart: (low: number, high: number, forward: boolean) => void;
  /** The book came to rest at a spread. */
  readonly onRest: (from: number, to: number) => void;
  /** A page that lies open cannot be shown; the sentence says why. */
  readonly onFailure: (sentence: string) => void;
}

/** Room above the head, from none to that of a leaf standing upright: at rest, and while something turns. */
const restingRoom = 0.5;
const turningRoom = 1;

/** Time in seconds in which the camera does two thirds of its way between the two. */
const roomTime = 0.11;

/** A square-rooted page area of 140 x 210 mm, metres: every book has paper of this size. */
const paperSize = Math.sqrt(0.14 * 0.21);

/**
 * A leaf's width over its height: that of an inner page, as covers often have
 * another size; of another page where that one cannot be read.
 */
async function leafAspect(source: PageSource, signal: AbortSignal): Promise<number> {
  let failure: unknown;
  for (const index of [2, 3, 1, 0, 4].filter((index) => index < source.pageCount)) {
    try {
      const { width, height } = await source.size(index, signal);
      return Math.min(Math.max(width / height, 0.25), 4);
    } catch (error) {
      signal.throwIfAborted();
      failure = error;
    }
  }
  throw failure;
}

/** One book on one canvas. */
export class Viewer {
  readonly binding: Binding;
  readonly turning: Turning;
  readonly #engine: BookEngine;
  readonly #stage: BookStage;
  readonly #pictures: PagePictures;
  readonly #picturing: Picturing;
  readonly #holding: Holding;
  readonly #ticks: Ticks;
  readonly #listeners = new Set<() => void>();
  readonly #width: number;
  readonly #height: number;
  #cssWidth = 0;
  #pixelRatio = 1;
  #frame = 0;
  #room = restingRoom;
  /** Paper that waits for the leaves in flight to land. */
  #nextPaper: Paper | null;
  /** The view that listeners were told of last. */
  #toldView = "";
  #destroyed = false;

  private constructor(
    source: PageSource,
    aspect: number,
    binding: Binding,
    engine: BookEngine,
    stage: BookStage,
    shape: BookShape,
    options: ViewerOptions,
  ) {
    this.binding = binding;
    this.#engine = engine;
    this.#nextPaper = options.paper();
    this.#width = shape.width;
    this.#height = shape.height;
    this.#stage = stage;
    this.#stage.onRestored = () => this.invalidate();
    this.#stage.room = restingRoom;
    this.#pictures = new PagePictures(source, aspect, {
      onArrive: (page) => {
        this.#show();
        const sentence = this.#pictures.failure(page);
        if (sentence !== null && this.#lieOpen(page)) options.onFailure(sentence);
      },
      onDrop: (picture) => this.#stage.forget(picture),
    });
    this.turning = new Turning(engine, binding, {
      started: (flight) => {
        this.#show();
        options.onStart(flight.low, flight.high, flight.to === Side.left);
      },
      landed: () => this.#show(),
      rested: (from, to) => {
        this.#changePaper();
        options.onRest(from, to);
      },
    });
    this.#picturing = new Picturing(binding, this.#stage, this.turning, this.#pictures);
    this.#holding = new Holding({
      engine,
      stage: this.#stage,
      turning: this.turning,
      width: shape.width,
      height: shape.height,
      hasLeaf: (side) => this.#hasLeaf(side),
    });
    this.#ticks = new Ticks(engine.tick);
    this.turning.seconds = options.turnSeconds();
    this.#changePaper();
    this.turning.lay(spreadOf(binding, options.page()));
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
    const binding = bind(source.pageCount, options.cover);
    const aspect = await leafAspect(source, signal);
    const width = paperSize * Math.sqrt(aspect);
    const height = paperSize / Math.sqrt(aspect);
    const leaves = paperLeaves(binding);
    // Thicker than the paper would be, so that reading on is seen; but no book is a brick.
    const thickness = 0.024 * (1 - Math.exp((-leaves * 0.0004) / 0.024));
    const engine = await craft.engine({ width, height, leaves, thickness });
    signal.throwIfAborted();
    const { kind } = source;
    const cover = binding.hardCover ? "hard" : "none";
    const shape: BookShape = {
      width,
      height,
      thickness,
      leaves,
      cover,
      cloth: options.cloth,
      kind,
    };
    const stage = craft.stage(canvas, shape);
    return new Viewer(source, aspect, binding, engine, stage, shape, options);
  }

  /** Fits the book to the canvas's size in CSS pixels. */
  resize(cssWidth: number, cssHeight: number, pixelRatio: number): void {
    this.#cssWidth = cssWidth;
    this.#pixelRatio = pixelRatio;
    this.#stage.resize(cssWidth, cssHeight, pixelRatio);
    this.#show();
  }

  /** Opens the book at a spread (clamped to the book) without a turn. */
  lay(spread: number): void {
    this.turning.lay(Math.min(Math.max(spread, 0), leafCount(this.binding)));
    this.#changePaper();
    this.#show();
  }

  /** Makes the leaves of another paper: at once, or as soon as none is in flight. */
  setPaper(paper: Paper): void {
    this.#nextPaper = paper;
    this.#changePaper();
  }

  /** Asks for a frame, unless one is already asked for. */
  invalidate(): void {
    if (this.#destroyed || this.#frame !== 0) return;
    this.#frame = requestAnimationFrame((now) => this.#draw(now));
  }

  /** What a hand at a place on the canvas (CSS pixels) could hold, or null. */
  pick(x: number, y: number): Hold | null {
    return this.#holding.pick(x, y);
  }

  /** A hand takes hold where `pick` found something; the leaf then follows `drag`. */
  grab(hold: Hold, hand: number): boolean {
    return !this.#destroyed && this.#holding.grab(hold, hand);
  }

  /** A hand that holds something moves to a place on the canvas, CSS pixels. */
  drag(hand: number, x: number, y: number): void {
    if (!this.#destroyed && this.#holding.drag(hand, x, y)) this.invalidate();
  }

  /** A hand lets go. */
  release(hand: number): void {
    if (this.#destroyed) return;
    this.#holding.release(hand);
    this.invalidate();
  }

  /**
   * Where a place on a page is seen, CSS pixels from the canvas's upper left
   * corner; null where that page does not lie open, or leaves are in flight.
   *
   * @param page from 1
   * @param x,y shares of the page from its upper left corner
   */
  project(page: number, x: number, y: number): { x: number; y: number } | null {
    if (this.#destroyed || this.#cssWidth === 0 || this.turning.moving) return null;
    const face = faceOf(this.binding, this.turning.spread, page);
    return face && this.#stage.projectOn(face, x, y);
  }

  /**
   * Calls `listener` after a frame in which the book came to rest as it was not
   * before: other pages lie open, or they are seen elsewhere. What `project`
   * answers holds until the next call or the next turn. Answers how to take the
   * listener away.
   */
  onView(listener: () => void): () => void {
    this.#listeners.add(listener);
    return () => this.#listeners.delete(listener);
  }

  /** Whether every page in sight is shown at its full sharpness. */
  get settled(): boolean {
    // Before there is room for the book no page is asked for, so none is missing.
    return this.#cssWidth > 0 && this.#frame === 0 && this.#pictures.settled;
  }

  /** Stops everything and frees what the graphics card and the engine hold. */
  destroy(): void {
    if (this.#destroyed) return;
    this.#destroyed = true;
    cancelAnimationFrame(this.#frame);
    this.#frame = 0;
    this.turning.close();
    this.#pictures.close();
    this.#stage.destroy();
    this.#engine.destroy();
  }

  #draw(now: number): void {
    this.#frame = 0;
    const ticks = this.#ticks.pass(now);
    // Without a turn nothing in the engine has moved since the book was laid open.
    const turned = this.turning.moving;
    const turning = turned && this.turning.step(ticks);
    // Whoever hears of a turn may take the book away at once.
    if (this.#destroyed) return;
    const stepping = this.#stepBack(turning, ticks * this.#engine.tick);
    if (stepping) this.#holding.follow();
    const moving = turning || stepping;
    if (turned) this.#engine.update();
    this.#pose();
    this.#stage.draw({ resting: !moving });
    this.#pictures.paused = moving;
    if (moving) this.invalidate();
    else {
      this.#ticks.stop();
      this.#tellView();
    }
  }

  /** Tells of another view, once for each. */
  #tellView(): void {
    const view = `${this.turning.spread} ${this.#stage.viewKey}`;
    if (view === this.#toldView) return;
    this.#toldView = view;
    for (const listener of this.#listeners) listener();
  }

  #changePaper(): void {
    if (this.#nextPaper === null || this.turning.flights.length > 0) return;
    makeOf(this.#nextPaper, this.#engine);
    this.#nextPaper = null;
  }

  /** Moves the camera back from a turning leaf and near again; answers whether it still moves. */
  #stepBack(turning: boolean, seconds: number): boolean {
    const wanted = turning ? turningRoom : restingRoom;
    const apart = wanted - this.#room;
    if (apart === 0) return false;
    const arrived = Math.abs(apart) < 0.004;
    this.#room = arrived ? wanted : this.#room + apart * (1 - Math.exp(-seconds / roomTime));
    this.#stage.room = this.#room;
    return !arrived;
  }

  #pose(): void {
    const engine = this.#engine;
    const { flights } = this.turning;
    const paper = paperLeaves(this.binding) > 0;
    const [low, high] = spreadsBetween(this.turning);
    const boards = this.binding.hardCover ? 1 : 0;
    const [left, right] = [engine.pile(Side.left), engine.pile(Side.right)];
    const leaves: Surface[] = [];
    for (const [index, { part }] of flights.entries()) {
      if (part === "leaf") leaves.push(engine.surface(index));
    }
    this.#stage.pose({
      left: paper && low > boards ? left : null,
      right: paper && high < leafCount(this.binding) - boards ? right : null,
      leaves,
      lean: paper ? (heightOf(right) - heightOf(left)) / 2 : 0,
      frontBoard: engine.boardAngle(Cover.front),
      backBoard: engine.boardAngle(Cover.back),
    });
  }

  /** Brings every face's picture up to date, and asks for the pages wanted next. */
  #show(): void {
    if (this.#destroyed) return;
    if (this.#cssWidth > 0) this.#picturing.want(this.#pictureWidth());
    this.#picturing.show();
    this.invalidate();
  }

  #hasLeaf(side: Side): boolean {
    const [low, high] = spreadsBetween(this.turning);
    return side === Side.right ? high < leafCount(this.binding) : low > 0;
  }

  #lieOpen(page: number): boolean {
    const { spread } = this.turning;
    return page === leftPage(this.binding, spread) || page === rightPage(this.binding, spread);
  }

  /** Width in device pixels at which a page looks sharp, in steps, so that a small change of size redraws nothing. */
  #pictureWidth(): number {
    const middle = 0.4 * this.#height;
    // As seen at rest: the pages of a turn are those of the rest after it.
    this.#stage.room = restingRoom;
    const spine = this.#stage.project([0, middle, 0]);
    const edge = this.#stage.project([this.#width, middle, 0]);
    this.#stage.room = this.#room;
    const onScreen = Math.hypot(edge.x - spine.x, edge.y - spine.y) * Math.max(this.#pixelRatio, 2);
    return Math.min(Math.ceil((onScreen * 1.2) / 256) * 256, 2048);
  }
}
