/**
 * Random operations on a book, the same for the same seed, and checks at rest
 * that every page in sight shows what it should.
 */

import type { TurnleafBook } from "../element.ts";
import { turnModels } from "../leaf_models/model_choice.ts";
import { clock } from "./clock.ts";
import { differences, foldOperations } from "./fold_operations.ts";
import { type Content, HuePages, hueCount } from "./hue_pages.ts";
import { contrastIn, hues, partOf, textBoxes } from "./picture_measures.ts";
import { TestPointer } from "./test_pointer.ts";

export interface OperationsOptions {
  readonly seed: number;
  /** Address of a PDF with text on most of its pages. */
  readonly pdf: string;
  /** Returns what is seen of an element, one pixel for each CSS pixel. */
  readonly picture: (element: TurnleafBook) => Promise<ImageData>;
  /** Draws only folds, tears and what undoes them, of a book whose pages all have other hues. */
  readonly only?: "folds";
}

/** Operations by their names, all as likely as each other. */
type Group = Readonly<Record<string, () => unknown>>;

/** What the checks have seen so far. */
export interface Checked {
  /** Rests at which something was checked. */
  rests: number;
  hues: number;
  prints: number;
  /** Changes of the folds that are listed, and leaves that came off. */
  folds: number;
  tears: number;
  /** Times that all folds and tears were undone and each page was looked for. */
  undone: number;
}

/** Small, as drawing is in software. CSS pixels. */
const [width, height] = [120, 90];
const size = `width: ${width}px; height: ${height}px; min-height: 0`;

/**
 * Least part of the element that a page of one hue takes at rest: two thirds of
 * what a square one does in the PDF bound at its head, the smallest.
 */
const leastHue = 0.01;

/**
 * Least mean difference of brightness, of 255, between a pixel within a text and the one below it: a tenth of
 * what the book's pages have, which is 10 to 25.
 */
const leastPrint = 1.5;

/** Resolves once the element's own observer has reported its size, too: it was made earlier. */
const observed = (element: Element): Promise<void> =>
  new Promise((resolve) => {
    const observer = new ResizeObserver(() => {
      observer.disconnect();
      resolve();
    });
    observer.observe(element);
  });

/** Numbers from 0 to 1, the same for the same seed. */
export function randomNumbers(seed: number): () => number {
  let state = seed;
  return () => {
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    return state / 2 ** 32;
  };
}

/** One book after another in an element, and what is done to them. */
export class RandomOperations {
  readonly checked: Checked = { rests: 0, hues: 0, prints: 0, folds: 0, tears: 0, undone: 0 };
  /** Names of the last operations. */
  readonly recent: string[] = [];
  /** Errors that the element has reported. */
  readonly errors: string[] = [];
  readonly #options: OperationsOptions;
  readonly #random: () => number;
  readonly #hues = new HuePages();
  readonly #operations: readonly Group[];
  #element = document.createElement("turnleaf-book");
  #pages: Content[] = [];
  /** The pages that were torn out, and where they were, the last ones last. */
  readonly #torn: { readonly at: number; readonly pages: readonly Content[] }[] = [];
  /** What the open book's input holds: the book opens with it again. */
  #given: readonly Content[] = [];
  #pdfPages = 0;

  constructor(options: OperationsOptions) {
    this.#options = options;
    this.#random = randomNumbers(options.seed);
    this.#operations = this.#all();
  }

  /** Opens the first book in a new element: measurements are to be of the same one. */
  async start(): Promise<void> {
    this.end();
    this.#make();
    if (this.#options.only === "folds") {
      this.#element.setAttribute("tearable", "perforated");
      // Of each hue one, from the same one on.
      this.#hues.restart();
      this.#given = this.#hues.take(hueCount);
      this.#element.pages = this.#hues.images(this.#given);
      await this.#loaded();
    } else {
      this.#element.src = this.#options.pdf;
      await this.#loaded();
      this.#pdfPages = this.#element.pageCount;
      this.#given = this.#prints();
    }
    this.#pages = [...this.#given];
    await this.#until(
      () => this.#element.ready,
      () => "the first book is never ready",
    );
  }

  /** Takes the element away. */
  end(): void {
    this.#element.remove();
  }

  /** Does something to the book. Rejects where it takes longer than anything may. */
  async next(): Promise<void> {
    const group = this.#among(this.#operations);
    const name = this.#among(Object.keys(group));
    this.recent.push(name);
    if (this.recent.length > 8) this.recent.shift();
    await this.#inTime(name, group[name]());
    if (this.#random() < 0.3) await clock.pass(40 * this.#random());
  }

  /** Brings the book to rest. Returns a sentence for each page in sight that does not show what it should. */
  async check(): Promise<string[]> {
    const element = this.#element;
    // As large as it can be: a few pixels of a page say nothing.
    element.controls = false;
    element.style.cssText = size;
    await observed(element);
    element.pause();
    // No corner is lifted where no pointer is.
    this.#pointer()?.stage.dispatchEvent(new PointerEvent("pointerleave"));
    await this.#until(
      () => element.pageCount === this.#pages.length,
      () => `${element.pageCount} pages in place of ${this.#pages.length}`,
    );
    let at = "";
    let open: number[];
    let texts: Map<number, DOMRect>;
    let picture: ImageData;
    // What was asked for before may set out once more, also while the picture is made.
    do {
      at = JSON.stringify(element.spread);
      // To set it draws the book anew, which would mend what is blank.
      if (element.zoom !== 1) element.zoom = 1;
      await this.#until(
        () => element.settled && !element.turning,
        () => "the book does not come to rest",
      );
      await clock.pass(5);
      const { left, right } = element.spread;
      // What is folded over hides pages.
      open = this.#hasFoldInSight ? [] : [left, right].filter((page) => page !== null);
      const prints = open.filter((page) => this.#pages[page - 1] === "print");
      texts = await textBoxes(element, prints);
      picture = await this.#options.picture(element);
    } while (element.turning || at !== JSON.stringify(element.spread));
    const counts = hues(picture);
    this.checked.rests++;
    return open.flatMap((page) => {
      const content = this.#pages[page - 1];
      const where = `page ${page} of ${this.#pages.length}`;
      if (content !== "print") {
        this.checked.hues++;
        const part = partOf(counts, content);
        return part > leastHue ? [] : [`${where} shows ${part} of its hue ${content}`];
      }
      const box = texts.get(page);
      if (box === undefined) return [];
      this.checked.prints++;
      const contrast = contrastIn(picture, box);
      return contrast > leastPrint ? [] : [`${where} shows ${contrast} of its print`];
    });
  }

  /** Undoes all tears and folds. Returns a sentence for each thing that is not as it was before them. */
  async undoAll(): Promise<string[]> {
    const element = this.#element;
    while (element.tornLeaves > 0) await this.#inTime("putBack", this.#putBack());
    const folded = new Set([...element.folds, ...element.dogEars].map(({ page }) => page));
    for (const page of folded) await this.#inTime("unfold", element.unfold(page));
    // Other operations change the pages of the book.
    const before = this.#options.only === "folds" ? this.#given : this.#pages;
    const wrong = await differences(element, before);
    if (this.#torn.length > 0) wrong.push(`${this.#torn.length} leaves were not put back`);
    this.checked.undone++;
    return wrong;
  }

  /** Draws the book as it stands. */
  redraw(): void {
    this.#element.zoomTo(this.#element.zoom);
  }

  /** The element as it stands, for the report of a failure. */
  get state(): string {
    const { outerHTML, spread, folds, dogEars, tornLeaves } = this.#element;
    const shown = JSON.stringify({ spread, folds, dogEars, tornLeaves });
    return `${outerHTML} ${shown} after ${this.recent.join(", ")}`;
  }

  /** All operations in groups, each group as often as it is to be drawn. */
  #all(): readonly Group[] {
    const element = () => this.#element;
    const attribute = (name: string, values: readonly string[]) => () =>
      element().setAttribute(name, this.#among(values));
    const turns: Group = {
      goTo: () => void element().goTo(this.#whole(1, this.#pages.length)),
      next: () => void element().next(),
      previous: () => void element().previous(),
      riffle: () => {
        for (let k = this.#whole(2, 20); k > 0; k--) void element().next();
      },
      key: () => this.#pointer()?.key(this.#among(["ArrowLeft", "ArrowRight", "Home", "End", "+"])),
      drag: () => this.#drag("mouse"),
      touch: () => this.#drag("touch"),
      pinch: () => this.#pinch(),
      wheel: () => this.#pointer()?.roll(0, this.#whole(-200, 200), { ctrlKey: true }),
      hover: () =>
        this.#pointer()?.point("pointermove", this.#whole(0, width), this.#whole(0, height)),
    };
    const places: Group = {
      zoom: () => element().zoomTo(this.#among([1, 2.5, 6])),
      pan: () => element().zoomTo(3, { x: this.#whole(0, width), y: this.#whole(0, height) }),
      nothing: async () => {
        element().style.width = element().style.height = this.#among(["0px", "1px", "3px"]);
        await clock.pass(30 * this.#random());
        element().style.cssText = size;
      },
      narrow: () => {
        element().style.width = this.#among(["50px", "80px", "120px"]);
      },
      hide: async () => {
        element().style.display = "none";
        await clock.pass(30 * this.#random());
        element().style.display = "";
      },
    };
    const modes: Group = {
      cover: attribute("cover", ["hard", "soft", "none"]),
      binding: attribute("binding", ["left", "right", "top", "bottom"]),
      layout: attribute("layout", ["spread", "single", "auto"]),
      offset: attribute("offset", ["0", "1"]),
      hardPages: attribute("hard-pages", ["", "3-4", "1-8", "9"]),
      duration: attribute("duration", ["0", "60", "120"]),
      stock: attribute("stock", ["bible", "book", "card"]),
      stocks: attribute("stocks", ["", "card 1-2, coated 5-8", "board 3-6", "board 1-100"]),
      model: attribute(
        "model",
        turnModels.filter((model) => model !== "photographs"),
      ),
      tearable: attribute("tearable", ["none", "sewn", "stapled", "perforated"]),
      theme: attribute("theme", ["light", "sepia", "grey", "night"]),
      controls: () => element().toggleAttribute("controls"),
      slides: () => (this.#random() < 0.5 ? element().play(1) : element().pause()),
    };
    const pages: Group = {
      insert: () => this.#change(this.#whole(1, this.#pages.length + 1), 0, this.#whole(1, 3)),
      remove: async () => {
        if (this.#pages.length > 20)
          await this.#change(this.#whole(1, this.#pages.length - 3), 2, 0);
      },
      replace: () => this.#change(this.#whole(1, this.#pages.length), 1, 1),
      draw: async () => {
        if (element().pageCount === 0) return;
        const page = await element()
          .drawPage(1, this.#whole(20, 200))
          .catch(() => null);
        if (page && "close" in page) page.close();
      },
      search: () => this.#search(),
    };
    const books: Group = {
      images: () =>
        this.#other(this.#hues.take(this.#whole(4, 60)), (made) => this.#hues.images(made)),
      manifest: () =>
        this.#other(this.#hues.take(this.#whole(4, 60)), (made) => this.#hues.manifest(made)),
      pdf: () => this.#other(this.#prints(), () => this.#options.pdf),
      away: async () => {
        const loaded = this.#loaded();
        element().remove();
        if (this.#random() < 0.5) await clock.pass(20 * this.#random());
        document.body.append(element());
        await loaded;
        this.#pages = [...this.#given];
      },
      anew: async () => {
        element().destroy();
        this.#make();
        await books.images();
      },
      loseContext: () => this.#loseContext(),
    };
    const folds: Group = foldOperations({
      element,
      random: this.#random,
      turns: this.#options.only === "folds",
      putBack: () => this.#putBack(),
    });
    if (this.#options.only === "folds") return [folds];
    const all: [Group, number][] = [
      [turns, 10],
      [places, 5],
      [modes, 5],
      [pages, 2],
      [folds, 2],
      [books, 1],
    ];
    return all.flatMap(([group, times]) => Array<Group>(times).fill(group));
  }

  #make(): void {
    const element = document.createElement("turnleaf-book");
    element.style.cssText = size;
    element.setAttribute("duration", "60");
    element.setAttribute("cloth", "#222222");
    for (const name of ["error", "pageerror"] as const) {
      element.addEventListener(name, (event) => {
        const { message } = (event as CustomEvent<{ message: string }>).detail;
        this.errors.push(`${message} (${this.state})`);
      });
    }
    element.addEventListener("torn", ({ detail: { pages } }) => {
      this.checked.tears++;
      const at = pages[0] - 1;
      this.#torn.push({ at, pages: this.#pages.splice(at, pages.length) });
    });
    for (const name of ["foldchange", "dogearchange"] as const) {
      element.addEventListener(name, () => this.checked.folds++);
    }
    // A book that is opened has all of its pages.
    element.addEventListener("load", () => this.#torn.splice(0));
    this.#element = element;
    document.body.append(element);
  }

  /** Puts the pages that were torn out last back. */
  async #putBack(): Promise<void> {
    const isBack = await this.#element.putBack();
    const last = isBack ? this.#torn.pop() : undefined;
    if (last) this.#pages.splice(last.at, 0, ...last.pages);
  }

  /** Shows another book; most times waits until it is open. */
  async #other(pages: readonly Content[], input: (pages: readonly Content[]) => BookInput) {
    this.#given = pages;
    this.#pages = [...pages];
    const loaded = this.#loaded();
    const book = input(pages);
    if (typeof book === "string") {
      this.#element.pages = null;
      // An address that is there already opens nothing.
      this.#element.src = "";
      this.#element.src = book;
    } else this.#element.pages = book;
    if (this.#random() < 0.8) await loaded;
  }

  async #change(at: number, count: number, added: number): Promise<void> {
    // Else what is out would be counted from other pages.
    while (this.#torn.length > 0 && this.#element.tornLeaves > 0) await this.#putBack();
    const hues = this.#hues.take(added);
    const element = this.#element;
    const isDone =
      added === 0
        ? await element.removePages(at, count)
        : count === 0
          ? await element.insertPages(at, this.#hues.images(hues))
          : await element.replacePage(at, this.#hues.images(hues));
    if (isDone) this.#pages.splice(at - 1, count, ...hues);
  }

  async #search(): Promise<void> {
    const hits = await this.#element
      .search(this.#among(["whale", "sea", "hue", "zzz"]), { signal: AbortSignal.timeout(50) })
      .catch(() => []);
    await this.#element.showHit(hits.length > 0 ? this.#among(hits) : null);
    if (this.#random() < 0.5) await this.#element.showHit(null);
  }

  async #drag(pointerType: string): Promise<void> {
    const pointer = this.#pointer();
    if (pointer === null) return;
    const place = (): [number, number] => [this.#whole(5, width - 5), this.#whole(5, height - 5)];
    const [from, to] = [place(), place()];
    const more = { pointerType, pointerId: 7 };
    pointer.point("pointerdown", ...from, more);
    await pointer.move(from, to, more);
    if (this.#random() < 0.2) await pointer.move(to, from, more);
    pointer.point(this.#random() < 0.8 ? "pointerup" : "pointercancel", ...to, more);
  }

  async #pinch(): Promise<void> {
    const pointer = this.#pointer();
    if (pointer === null) return;
    const fingers = [1, 2].map((pointerId) => ({ pointerId, pointerType: "touch" }));
    const place = (finger: number, off: number): [number, number] => [
      width / 2 + (finger ? off : -off),
      height / 2,
    ];
    const [from, to] = [width / 8, this.#whole(5, width / 3)];
    for (const [k, finger] of fingers.entries())
      pointer.point("pointerdown", ...place(k, from), finger);
    await Promise.all(
      fingers.map((finger, k) => pointer.move(place(k, from), place(k, to), finger)),
    );
    for (const [k, finger] of fingers.entries())
      pointer.point("pointerup", ...place(k, to), finger);
  }

  /** Takes the graphics card away, and most times gives it back before the book is shown without one. */
  async #loseContext(): Promise<void> {
    const canvas = this.#element.shadowRoot?.querySelector("canvas");
    // The book on the flat has no such context; to ask for one there does nothing.
    const context = canvas?.getContext("webgl2")?.getExtension("WEBGL_lose_context");
    if (!context) return;
    context.loseContext();
    await clock.pass(30 * this.#random());
    if (this.#random() < 0.95) context.restoreContext();
    else await clock.pass(4500);
  }

  #pointer(): TestPointer | null {
    return this.#element.shadowRoot?.querySelector("canvas")
      ? new TestPointer(this.#element)
      : null;
  }

  /** Waits until the book in the element is open. */
  #loaded(): Promise<void> {
    const element = this.#element;
    return new Promise((resolve) =>
      element.addEventListener("load", () => resolve(), { once: true }),
    );
  }

  /** Whether a page of the leaves that lie open is folded along a line. */
  get #hasFoldInSight(): boolean {
    const { left, right } = this.#element.spread;
    const open = [left, right].filter((page) => page !== null);
    return this.#element.folds.some(({ page }) => open.some((one) => Math.abs(one - page) <= 1));
  }

  async #inTime(name: string, work: unknown): Promise<void> {
    let hasEnded = false;
    const ended = Promise.resolve(work).finally(() => {
      hasEnded = true;
    });
    // Handled below, at the latest once the operation has ended.
    ended.catch(() => {});
    await this.#until(
      () => hasEnded,
      () => `${name} never ends`,
    );
    await ended;
  }

  async #until(isSo: () => boolean, sentence: () => string): Promise<void> {
    await clock.until(isSo).catch(() => {
      throw new Error(`${sentence()}: ${this.state}`);
    });
  }

  #whole(least: number, most: number): number {
    return least + Math.floor(this.#random() * (most - least + 1));
  }

  #among<T>(values: readonly T[]): T {
    return values[Math.floor(this.#random() * values.length)];
  }

  #prints(): Content[] {
    return Array.from({ length: this.#pdfPages }, () => "print");
  }
}

type BookInput = NonNullable<TurnleafBook["pages"]> | string;
