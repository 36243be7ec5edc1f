/** The page that `turnleaf film` films: one book, turned as the command says. */

import "turnleaf";
import type { TurnleafBook } from "turnleaf";
import { FilmClock } from "./film_clock.ts";

/** The command's configuration of the film. */
interface Config {
  readonly src: string;
  readonly fps: number;
  readonly turnSeconds: number;
  readonly stock: string;
  readonly theme: string;
}

/** Interval of the polls whether the pages are drawn, milliseconds. */
const look = 20;

const clock = new FilmClock();

class Film {
  readonly #book: TurnleafBook;
  readonly #frame: number;
  #isTurning = false;

  constructor(config: Config) {
    const book = document.createElement("turnleaf-book");
    book.setAttribute("stock", config.stock);
    book.setAttribute("theme", config.theme);
    book.setAttribute("duration", String(1000 * config.turnSeconds));
    this.#book = book;
    this.#frame = 1000 / config.fps;
    this.#src = config.src;
  }

  readonly #src: string;

  /**
   * Opens the book where the film begins or goes on. Returns the number of
   * turns in the whole film.
   *
   * @param from,to the first page and the last one (from 1); null for the
   * book's last
   * @param done turns of the film that are done already
   */
  async open(request: { from: number; to: number | null; done: number }) {
    const book = this.#book;
    const { from, to, done } = request;
    const loaded = new Promise<void>((resolve, reject) => {
      book.addEventListener("load", () => resolve(), { once: true });
      book.addEventListener("error", ({ detail }) => reject(new Error(detail.message)));
    });
    book.setAttribute("page", String(from));
    book.setAttribute("src", this.#src);
    document.getElementById("desk")?.append(book);
    await loaded;
    const last = to ?? book.pageCount;
    if (last > book.pageCount) {
      throw new Error(`The book has ${book.pageCount} pages; page ${last} is none of them.`);
    }
    await this.rest();
    // Only the end shows how a book's pages lie in spreads: walked without a turn.
    const places = [from];
    const step = book.shownLayout === "single" ? 1 : 2;
    for (let page = lastOf(book.spread); page < last; page += step) places.push(page + 1);
    if (done > 0) await this.#layAt(places[done] ?? from);
    return { pages: book.pageCount, turns: places.length - 1 };
  }

  /** Waits until the book is at rest and its pages and those beside them are drawn. */
  async rest(): Promise<void> {
    clock.free = true;
    while (!this.#book.ready || clock.isAsked) {
      await new Promise((resolve) => setTimeout(resolve, look));
    }
    clock.free = false;
    this.#isTurning = false;
  }

  /** Starts turning a leaf. */
  turn(): void {
    this.#isTurning = true;
    clock.begin();
    void this.#book.next().then(() => {
      this.#isTurning = false;
    });
  }

  /** Advances by one frame. Returns whether something still moves. */
  async step(): Promise<boolean> {
    clock.pass(this.#frame);
    // Promises that waited for the end of the turn resolve.
    await new Promise((resolve) => setTimeout(resolve));
    return this.#isTurning || clock.isAsked;
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
