/** `<turnleaf-book>`: a book on a web page. */

import { isStock, type Paper } from "./book/paper.ts";
import { leftPage, pageOf, rightPage, spreadOf } from "./book/spreads.ts";
import { style } from "./element.css.ts";
import type { Stock } from "./engine/shapes.ts";
import { Input } from "./input.ts";
import { openViewer } from "./open_viewer.ts";
import { type BookInput, openSource } from "./sources/open.ts";
import { BookError, type PageSource } from "./sources/page_source.ts";
import type { Viewer } from "./viewer.ts";

/** Where a turn leads, in page numbers from 1: the first page seen before and after. */
export interface TurnDetail {
  readonly from: number;
  readonly to: number;
  readonly direction: "forward" | "backward";
}

/** The events of `<turnleaf-book>` by name. */
export interface TurnleafEventMap {
  /** The book is open and can be turned. */
  load: CustomEvent<{ pageCount: number; title: string }>;
  /** A leaf leaves its side, by hand or by command. */
  turnstart: CustomEvent<TurnDetail>;
  /** The book came to rest at another spread. */
  pagechange: CustomEvent<TurnDetail>;
  /** The book could not be opened; the sentence says why. */
  error: CustomEvent<{ message: string }>;
}

/** On a server there is no DOM: importing the package is safe there, using the element is not. */
const Base: typeof HTMLElement =
  globalThis.HTMLElement ?? (class {} as unknown as typeof HTMLElement);

/**
 * The element's class. Attributes: `src`, `page`, `cover` ("hard" or "none"), `cloth` (a colour), `duration` (ms),
 * `stock` (a preset paper), `assist` ("on" or "off").
 */
export class TurnleafBook extends Base {
  /** Attributes that are answered when they change. */
  static readonly observedAttributes: readonly string[] = [
    "src",
    "page",
    "cover",
    "cloth",
    "duration",
    "stock",
    "assist",
  ];

  #book: { source: PageSource; viewer: Viewer; input: Input } | null = null;
  #opening: AbortController | null = null;
  #observer: ResizeObserver | null = null;
  #input: BookInput | null = null;
  #paper: Paper | null = null;
  /** The page asked for while no book is open, and the one where this book was left. */
  #asked: number | null = null;
  #left: number | null = null;
  /** Ends what listens for as long as the element is in a document. */
  #connected: AbortController | null = null;
  #canvas: HTMLCanvasElement | null = null;

  /** Address of a PDF, an image or a manifest of images. */
  get src(): string {
    return this.getAttribute("src") ?? "";
  }

  set src(src: string) {
    this.setAttribute("src", src);
  }

  /** What the book is made of where it has no address: images in order, a manifest, or a file. */
  get pages(): BookInput | null {
    return this.#input;
  }

  set pages(pages: BookInput | null) {
    this.#input = pages;
    this.#left = null;
    this.#reopen();
  }

  /** The preset that the leaves are made of: "book" where the attribute names none. */
  get stock(): Stock {
    const stock = this.getAttribute("stock");
    return isStock(stock) ? stock : "book";
  }

  set stock(stock: Stock) {
    this.setAttribute("stock", stock);
  }

  /** The paper in figures, how it is bound, and the wind; what it says goes before the attributes. */
  get paper(): Paper | null {
    return this.#paper;
  }

  set paper(paper: Paper | null) {
    this.#paper = paper;
    this.#book?.viewer.setPaper(this.#leaves);
  }

  /** The first page in sight, from 1. Setting it turns there. */
  get page(): number {
    const viewer = this.#book?.viewer;
    return viewer ? pageOf(viewer.binding, viewer.turning.spread) : this.#firstPage();
  }

  set page(page: number) {
    void this.goTo(page);
  }

  /** Number of pages; 0 until the book is open. */
  get pageCount(): number {
    return this.#book?.source.pageCount ?? 0;
  }

  /** The book's title; empty until it is open. */
  get bookTitle(): string {
    return this.#book?.source.title ?? "";
  }

  /** Whether the pages in sight are at full sharpness and nothing moves. */
  get settled(): boolean {
    return this.#book?.viewer.settled ?? false;
  }

  /** What a page (from 1) calls itself, such as "iv" or "23". */
  label(page: number): string {
    const source = this.#book?.source;
    return source && page >= 1 && page <= source.pageCount ? source.label(page - 1) : String(page);
  }

  /** Turns one leaf on. Resolves, once the book is at rest, to whether it lies there. */
  next(): Promise<boolean> {
    return this.#turn(1);
  }

  /** Turns one leaf back. Resolves, once the book is at rest, to whether it lies there. */
  previous(): Promise<boolean> {
    return this.#turn(-1);
  }

  /** Turns to a page (from 1, clamped to the book). Resolves, once the book is at rest, to whether it lies there. */
  goTo(page: number): Promise<boolean> {
    const book = this.#book;
    if (book === null) {
      this.#asked = page;
      return Promise.resolve(false);
    }
    const spread = spreadOf(book.viewer.binding, page);
    if (this.#calm) return this.#lay(book.viewer, spread);
    const landed = book.viewer.turning.goTo(spread);
    book.viewer.invalidate();
    return landed;
  }

  /** @internal */
  connectedCallback(): void {
    this.#adopt();
    this.#build();
    this.#connected = new AbortController();
    this.#watchRatio(this.#connected.signal);
    this.#reopen();
  }

  /** @internal */
  disconnectedCallback(): void {
    this.#leave();
    this.#connected?.abort();
    this.#connected = null;
    this.#close();
    this.#observer?.disconnect();
    this.#observer = null;
  }

  /** @internal */
  attributeChangedCallback(name: string, before: string | null, now: string | null): void {
    if (before === now) return;
    if (name === "page") void this.goTo(Number(now));
    else if (name === "duration") {
      if (this.#book) this.#book.viewer.turning.seconds = this.#turnSeconds;
    } else if (name === "stock" || name === "assist") this.#book?.viewer.setPaper(this.#leaves);
    else {
      // Another book opens at its beginning; the same one in other covers where it lay.
      if (name === "src") this.#left = null;
      else this.#leave();
      this.#reopen();
    }
  }

  /** The page at which a book opens, or would: where it was asked for, else where its source says. */
  #firstPage(source?: PageSource): number {
    const said = this.getAttribute("page") ?? source?.openingPage ?? 1;
    const page = this.#asked ?? this.#left ?? Number(said);
    return Math.max(Math.round(page) || 1, 1);
  }

  /** Remembers where the open book lies. */
  #leave(): void {
    if (this.#book) this.#left = this.page;
  }

  /** Takes over what was set before the element was defined: it lies on the element and hides the accessors. */
  #adopt(): void {
    for (const name of ["src", "pages", "stock", "paper", "page"] as const) {
      if (!Object.hasOwn(this, name)) continue;
      const { value } = Object.getOwnPropertyDescriptor(this, name) ?? {};
      Reflect.deleteProperty(this, name);
      Reflect.set(this, name, value);
    }
  }

  get #turnSeconds(): number {
    const milliseconds = Number(this.getAttribute("duration") ?? 800);
    return milliseconds > 0 && milliseconds <= 60_000 ? milliseconds / 1000 : 0.8;
  }

  get #leaves(): Paper {
    return { stock: this.stock, assist: this.getAttribute("assist") !== "off", ...this.#paper };
  }

  /** Whether the reader asked the system for less motion. */
  get #calm(): boolean {
    return matchMedia("(prefers-reduced-motion: reduce)").matches;
  }

  #turn(by: 1 | -1): Promise<boolean> {
    const viewer = this.#book?.viewer;
    if (viewer === undefined) return Promise.resolve(false);
    if (this.#calm) return this.#lay(viewer, viewer.turning.destination + by);
    const landed = viewer.turning.turn(by);
    viewer.invalidate();
    return landed;
  }

  /** Shows a spread at once. */
  #lay(viewer: Viewer, spread: number): Promise<boolean> {
    const from = viewer.turning.spread;
    viewer.lay(spread);
    if (viewer.turning.spread !== from) this.#rested(from, viewer.turning.spread);
    return Promise.resolve(true);
  }

  #build(): void {
    if (this.shadowRoot === null) {
      const root = this.attachShadow({ mode: "open" });
      // Not a <style> element: pages with a strict security policy forbid those.
      const sheet = new CSSStyleSheet();
      sheet.replaceSync(style);
      root.adoptedStyleSheets = [sheet];
      const message = document.createElement("div");
      message.setAttribute("part", "message");
      message.setAttribute("role", "status");
      const live = document.createElement("div");
      live.className = "live";
      live.setAttribute("aria-live", "polite");
      root.append(message, live);
    }
    if (!this.hasAttribute("tabindex")) this.tabIndex = 0;
    if (!this.hasAttribute("role")) this.setAttribute("role", "group");
  }

  /** A canvas whose context was given up cannot be used again: every book gets its own. */
  #freshCanvas(): HTMLCanvasElement {
    this.#canvas?.remove();
    const canvas = document.createElement("canvas");
    canvas.setAttribute("part", "canvas");
    canvas.setAttribute("role", "img");
    this.shadowRoot?.append(canvas);
    this.#canvas = canvas;
    return canvas;
  }

  #reopen(): void {
    // The parser's attributes come one by one before the element is connected: one book, not four.
    if (this.#connected === null) return;
    this.#close();
    const input = this.#input ?? this.src;
    if (input === "") {
      this.#say("", "status");
      return;
    }
    const opening = new AbortController();
    this.#opening = opening;
    this.#say("Opening the book …", "status");
    this.#open(input, opening.signal).catch((error: unknown) => {
      if (!opening.signal.aborted) this.#fail(error);
    });
  }

  async #open(input: BookInput, signal: AbortSignal): Promise<void> {
    const source = await openSource(input, { signal });
    try {
      // Another book may be open by now, on the canvas that this one would take away.
      signal.throwIfAborted();
      const canvas = this.#freshCanvas();
      const viewer = await openViewer(
        canvas,
        source,
        {
          cover: this.getAttribute("cover") === "none" ? "none" : "hard",
          cloth: this.getAttribute("cloth") ?? "#6a2a26",
          paper: () => this.#leaves,
          page: () => this.#firstPage(source),
          turnSeconds: () => this.#turnSeconds,
          onStart: (low, high, forward) => this.#started(low, high, forward),
          onRest: (from, to) => this.#rested(from, to),
          onFailure: (sentence) => this.#announce(sentence),
        },
        signal,
      );
      if (signal.aborted) viewer.destroy();
      signal.throwIfAborted();
      this.#book = {
        source,
        viewer,
        input: new Input(canvas, this, viewer, (by) => void this.#turn(by)),
      };
    } catch (error) {
      source.close();
      throw error;
    }
    this.#asked = null;
    this.#left = null;
    this.#say("", "status");
    this.#watchSize();
    this.#describe();
    this.#emit("load", { pageCount: source.pageCount, title: source.title });
  }

  #close(): void {
    this.#opening?.abort();
    this.#opening = null;
    this.#book?.input.destroy();
    this.#book?.viewer.destroy();
    this.#book?.source.close();
    this.#book = null;
    this.#canvas?.remove();
    this.#canvas = null;
  }

  #watchSize(): void {
    this.#observer?.disconnect();
    this.#observer = new ResizeObserver(() => this.#resize());
    this.#observer.observe(this);
    this.#resize();
  }

  /** Follows the screen's pixel ratio, which changes with the zoom and from screen to screen. */
  #watchRatio(signal: AbortSignal): void {
    const media = matchMedia(`(resolution: ${devicePixelRatio}dppx)`);
    const changed = (): void => {
      this.#resize();
      this.#watchRatio(signal);
    };
    media.addEventListener("change", changed, { once: true, signal });
  }

  #resize(): void {
    const { clientWidth, clientHeight } = this;
    if (clientWidth > 0 && clientHeight > 0) {
      this.#book?.viewer.resize(clientWidth, clientHeight, devicePixelRatio);
    }
  }

  #started(low: number, high: number, forward: boolean): void {
    const binding = this.#book?.viewer.binding;
    if (binding === undefined) return;
    const [from, to] = forward ? [low, high] : [high, low];
    const direction = forward ? "forward" : "backward";
    this.#emit("turnstart", { from: pageOf(binding, from), to: pageOf(binding, to), direction });
  }

  #rested(from: number, to: number): void {
    const binding = this.#book?.viewer.binding;
    if (binding === undefined || from === to) return;
    this.#describe();
    const direction = to > from ? "forward" : "backward";
    this.#emit("pagechange", { from: pageOf(binding, from), to: pageOf(binding, to), direction });
  }

  /** Says which pages lie open, to those who hear it. */
  #describe(): void {
    const { source, viewer } = this.#book ?? {};
    if (!source || !viewer) return;
    const { spread } = viewer.turning;
    const seen = [leftPage(viewer.binding, spread), rightPage(viewer.binding, spread)]
      .filter((page): page is number => page !== null)
      .map((page) => source.label(page - 1));
    const pages = `${seen.length === 1 ? "Page" : "Pages"} ${seen.join(" and ")}`;
    const text = `${seen.length === 0 ? "Back" : pages} of ${source.pageCount}`;
    this.#canvas?.setAttribute("aria-label", `${source.title}. ${text}`);
    this.#announce(text);
  }

  /** Tells those who listen rather than look. */
  #announce(text: string): void {
    const live = this.shadowRoot?.querySelector(".live");
    if (live) live.textContent = text;
  }

  #fail(error: unknown): void {
    const message =
      error instanceof BookError || error instanceof Error
        ? error.message
        : "The book could not be opened; load the page again.";
    this.#close();
    this.#say(message, "alert");
    this.#emit("error", { message });
  }

  /** Shows a sentence where the page would be; an empty one takes it away. */
  #say(sentence: string, role: "status" | "alert"): void {
    const message = this.shadowRoot?.querySelector<HTMLElement>("[part=message]");
    if (!message) return;
    message.setAttribute("role", role);
    message.textContent = sentence;
    message.hidden = sentence === "";
  }

  #emit<K extends keyof TurnleafEventMap>(name: K, detail: TurnleafEventMap[K]["detail"]): void {
    this.dispatchEvent(new CustomEvent(name, { detail }));
  }
}
