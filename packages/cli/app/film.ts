/** The page that `turnleaf film` films: one book, turned, folded and torn as the command says. */

import "turnleaf";
import type { TurnleafBook } from "turnleaf";
import type { FilmAction } from "../src/film/film_actions.ts";
import { FilmClock } from "./film_clock.ts";
import { type Performed, perform, tears } from "./perform.ts";

/** The command's configuration of the film. */
interface Config {
  readonly src: string;
  readonly fps: number;
  readonly turnSeconds: number;
  readonly stock: string;
  readonly theme: string;
  /** Attributes of the book. */
  readonly attributes: Readonly<Record<string, string>>;
}

/** Where the film begins or goes on. */
interface FilmRequest {
  /** The first page and the last one (from 1); null for the book's last. */
  readonly from: number;
  readonly to: number | null;
  /** Turns or actions of the film that are done already. */
  readonly done: number;
  /** What is done in place of turns to the last page. */
  readonly actions?: readonly FilmAction[];
}

/** Interval of the polls whether the pages are drawn, milliseconds. */
const look = 20;

/** Maximum time, milliseconds, in which what an action needs is loaded or drawn. */
const patience = 60_000;

const clock = new FilmClock();

class Film {
  readonly #book: TurnleafBook;
  readonly #frame: number;
  /** Whether an action or a turn is not done yet. */
  #isPending = false;
  /** Why the action cannot be done. */
  #failure: unknown = null;

  constructor(config: Config) {
    const book = document.createElement("turnleaf-book");
    book.setAttribute("stock", config.stock);
    book.setAttribute("theme", config.theme);
    book.setAttribute("duration", String(1000 * config.turnSeconds));
    for (const [name, value] of Object.entries(config.attributes)) book.setAttribute(name, value);
    // The clock waits for every frame.
    Object.assign(book, { filmFrames: clock });
    this.#book = book;
    this.#frame = 1000 / config.fps;
    this.#src = config.src;
  }

  readonly #src: string;

  /**
   * Opens the book where the film begins or goes on. Returns the number of
   * turns in the whole film, if it has no actions.
   */
  async open(request: FilmRequest) {
    const book = this.#book;
    const { from, to, done, actions } = request;
    if (actions?.some(tears) && !book.hasAttribute("tearable")) book.setAttribute("tearable", "");
    const loaded = new Promise<void>((resolve, reject) => {
      book.addEventListener("load", () => resolve(), { once: true });
      book.addEventListener("error", ({ detail }) => reject(new Error(detail.message)));
    });
    book.setAttribute("page", String(from));
    book.setAttribute("src", this.#src);
    document.getElementById("desk")?.append(book);
    await loaded;
    const last = to ?? book.pageCount;
    const pages = actions?.map((action) => ("page" in action ? action.page : undefined)) ?? [];
    const beyond = [last, ...pages].find((page) => page !== undefined && page > book.pageCount);
    if (beyond !== undefined) {
      throw new Error(`The book has ${book.pageCount} pages; page ${beyond} is none of them.`);
    }
    await this.rest();
    if (actions) {
      for (const action of actions.slice(0, done)) await this.#repeat(action);
      return { pages: book.pageCount, turns: 0 };
    }
    // Only the end shows how a book's pages lie in spreads: walked without a turn.
    const places = [from];
    const step = book.shownLayout === "single" ? 1 : 2;
    for (let page = lastOf(book.spread); page < last; page += step) places.push(page + 1);
    if (done > 0) await this.#layAt(places[done] ?? from);
    return { pages: book.pageCount, turns: places.length - 1 };
  }

  /** Returns what the book lists and cannot be shown, a sentence each. */
  warnings(): string[] {
    return this.#book.warnings.map(({ message }) => message);
  }

  /** Waits until the book is at rest and its pages and those beside them are drawn. */
  async rest(): Promise<void> {
    clock.free = true;
    while (!this.#book.ready || clock.isAsked) {
      await new Promise((resolve) => setTimeout(resolve, look));
    }
    clock.free = false;
    this.#isPending = false;
  }

  /** Starts turning a leaf. Returns whether it moves. */
  turn(): boolean {
    this.#isPending = true;
    clock.begin();
    void this.#book.next().then(() => {
      this.#isPending = false;
    });
    return true;
  }

  /**
   * Begins an action. Resolves, once what it needs is there and it has begun to
   * move, to whether anything moves.
   */
  async begin(action: Performed): Promise<boolean> {
    this.#isPending = true;
    this.#failure = null;
    clock.begin();
    const failed = (error: unknown): void => {
      this.#failure = error;
    };
    void perform(this.#book, action)
      .catch(failed)
      .then(() => {
        this.#isPending = false;
      });
    return await this.#isMoving();
  }

  /**
   * Advances by one frame. Returns whether something still moves.
   *
   * @param isSeen whether the frame is drawn in any case
   */
  async step(isSeen = true): Promise<boolean> {
    clock.pass(this.#frame, isSeen);
    // Promises that waited for the end of the motion resolve.
    await new Promise((resolve) => setTimeout(resolve));
    const isMoving = clock.isMoving();
    if (this.#isPending && !isMoving) return await this.#isMoving();
    this.#throwFailure();
    return isMoving;
  }

  /** Does an action again that is in the film already. */
  async #repeat(action: FilmAction): Promise<void> {
    if (action.name === "wait") return;
    let isMoving = await this.begin(action);
    while (isMoving) isMoving = await this.step(false);
    await this.rest();
  }

  /**
   * Waits while no time passes until the action is done or something moves: what it needs is
   * loaded and drawn in a time that is another on every machine, and that no frame shows. Returns
   * whether anything moves.
   */
  async #isMoving(): Promise<boolean> {
    const end = Date.now() + patience;
    while (this.#isPending && !clock.isMoving()) {
      if (Date.now() > end) throw new Error("What an action needs was not loaded within a minute.");
      await new Promise((resolve) => setTimeout(resolve, look));
    }
    this.#throwFailure();
    const isMoving = clock.isMoving();
    // The first frame of a motion has no time: it is this one, whatever came before it.
    if (isMoving) clock.stand(true);
    return isMoving;
  }

  #throwFailure(): void {
    if (this.#failure !== null) throw this.#failure;
  }

  async #layAt(page: number): Promise<void> {
    void this.#book.goTo(page);
    clock.free = true;
    while (!inSight(this.#book.spread, page)) {
      await new Promise((resolve) => setTimeout(resolve, look));
    }
    await this.rest();
  }
}

type Spread = TurnleafBook["spread"];

function lastOf({ left, right }: Spread): number {
  return Math.max(left ?? 0, right ?? 0);
}

function inSight({ left, right }: Spread, page: number): boolean {
  return left === page || right === page;
}

const config: Config = await (await fetch("./config.json")).json();
Object.assign(globalThis, { film: new Film(config) });
