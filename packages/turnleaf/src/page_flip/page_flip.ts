/** A book with the interface of page-flip 2.0.7, shown by `<turnleaf-book>`. */

import type { BookInput, BookState, TurnleafBook } from "../index.ts";
import { BookPlace, type Orientation, type PageRect } from "./book_place.ts";
import { EventListeners, type WidgetEvent } from "./event_listeners.ts";
import { LentStyle } from "./lent_style.ts";
import { completeSettings, type FlipSetting } from "./settings.ts";
import { hardPages, numbersOf, sideOf, spreadsOf, spreadWith } from "./spreads.ts";

/** page-flip's words for what happens to a book. */
export type FlippingState = "user_fold" | "fold_corner" | "flipping" | "read";

/** page-flip's words for the corners by which a page is turned. */
export type FlipCorner = "top" | "bottom";

/** The page that was asked for (from 0), and how many there are side by side. */
export interface BookMode {
  page: number;
  mode: Orientation;
}

/** What the listeners of each event get as `data`. */
export interface FlipEvents {
  /** Another page is in sight: its index from 0. */
  flip: number;
  /** The book shows one page instead of two, or two instead of one. */
  changeOrientation: Orientation;
  /** The state has changed. */
  changeState: FlippingState;
  /** The book is open. */
  init: BookMode;
  /** The book is open with other pages. */
  update: BookMode;
}

/** Elements that keep their clicks. */
const pressed = "a, button, input, select, textarea, label, summary, video, audio, iframe";

/** Movement between press and release, CSS pixels, from which it is no click. */
const dragStart = 5;

/** page-flip's fraction of a page's diagonal that counts as a corner. */
const cornerFraction = 1 / 5;

/** Pages of an open book. */
interface ShownPages {
  readonly count: number;
  readonly index: number;
  /** The elements that are its pages; none of images. */
  readonly items: HTMLElement[];
  /** Those of board. */
  readonly hard: ReadonlySet<number>;
}

const noPages: ShownPages = { count: 0, index: 0, items: [], hard: new Set() };

/** A book with the interface of page-flip: its pages are images, or elements of the web page. */
export class PageFlip {
  private readonly host: HTMLElement;
  private readonly settings: FlipSetting;
  private readonly listeners = new EventListeners<FlipEvents, PageFlip>();
  private book: TurnleafBook | null = null;
  private place: BookPlace | null = null;
  private items: HTMLElement[] = [];
  /** What each item has on it as a page. */
  private lent: LentStyle[] = [];
  private hard: ReadonlySet<number> = noPages.hard;
  private count = 0;
  private index = 0;
  /** The pages that are shown while others are loaded, and after these could not be. */
  private shown: ShownPages | null = null;
  private loading = new AbortController();
  private state: FlippingState = "read";
  private isOpen = false;
  /** The commands that came before the book was open. */
  private waiting: ((book: TurnleafBook) => void)[] = [];
  private downAt: { readonly x: number; readonly y: number } | null = null;
  private ended = new AbortController();

  /**
   * @param host in which the book is shown
   *
   * @param options `width` and `height` of a page are required
   *
   * @throws Error with page-flip's message if an option is not valid
   */
  constructor(host: HTMLElement, options: Partial<FlipSetting>) {
    this.settings = completeSettings(options);
    this.host = host;
  }

  /** Shows images, by their addresses. */
  loadFromImages(images: readonly string[]): void {
    this.load(imagePages(images), images.length, [], "init");
  }

  /** Shows elements of the web page; `data-density="hard"` makes one a board. */
  loadFromHTML(items: Iterable<HTMLElement>): void {
    const pages = [...items];
    this.load(pages, pages.length, pages, "init");
  }

  /** The same as `loadFromHTML`, as page-flip's README spells it. */
  loadFromHtml(items: Iterable<HTMLElement>): void {
    this.loadFromHTML(items);
  }

  /** Shows other images, at the same index. */
  updateFromImages(images: readonly string[]): void {
    this.load(imagePages(images), images.length, [], "update");
  }

  /** Shows other elements, at the same index. */
  updateFromHtml(items: Iterable<HTMLElement>): void {
    const pages = [...items];
    this.load(pages, pages.length, pages, "update");
  }

  /** Removes the pages; elements go back to the host. */
  clear(): void {
    this.loading.abort();
    this.isOpen = false;
    this.shown = null;
    this.waiting = [];
    this.count = 0;
    this.index = 0;
    // First, as elements in the book are its pages if it has no others.
    this.giveBack(this.host);
    if (this.book) this.book.pages = null;
  }

  /** Fits the book to its host, whose size it follows by itself. */
  update(): void {
    this.fit();
  }

  /** Removes the book and its listeners. The host stays, as it was, with the elements in it. */
  destroy(): void {
    this.ended.abort();
    this.loading.abort();
    this.isOpen = false;
    this.shown = null;
    this.waiting = [];
    this.giveBack(this.host);
    this.book?.remove();
    this.book = null;
    this.place?.remove();
    this.place = null;
    this.count = 0;
  }

  /** Turns one leaf forward, with motion. The corner is the engine's to choose. */
  flipNext(_corner: FlipCorner = "top"): void {
    this.command((book) => void book.next());
  }

  /** Turns one leaf back, with motion. The corner is the engine's to choose. */
  flipPrev(_corner: FlipCorner = "top"): void {
    this.command((book) => void book.previous());
  }

  /** Turns to a page (from 0), with motion; does nothing if there is none. */
  flip(page: number, _corner: FlipCorner = "top"): void {
    if (this.hasPage(page)) this.command((book) => void book.goTo(page + 1));
  }

  /** Shows a page (from 0) at once; does nothing if there is none. */
  turnToPage(page: number): void {
    if (!this.hasPage(page)) return;
    const spreads = this.spreads;
    this.index = spreads[spreadWith(spreads, page)]?.[0] ?? page;
    this.command((book) => void book.goTo(page + 1, { motion: false }));
    this.emit("flip", this.index);
  }

  /** Shows the next pages at once. */
  turnToNextPage(): void {
    this.turnBy(1);
  }

  /** Shows the pages before at once. */
  turnToPrevPage(): void {
    this.turnBy(-1);
  }

  /** Returns how many pages there are. */
  getPageCount(): number {
    return this.count;
  }

  /** Returns the index (from 0) of the first page in sight. */
  getCurrentPageIndex(): number {
    return this.index;
  }

  /** Returns whether one page is shown (`portrait`) or two (`landscape`). */
  getOrientation(): Orientation {
    return this.place?.orientation ?? "landscape";
  }

  /** Returns where the book is in its host, CSS pixels. */
  getBoundsRect(): PageRect {
    return this.place?.rect ?? { left: 0, top: 0, width: 0, height: 0, pageWidth: 0 };
  }

  /** Returns what happens to the book. */
  getState(): FlippingState {
    return this.state;
  }

  /** Returns the options, completed. */
  getSettings(): FlipSetting {
    return this.settings;
  }

  /** Returns the element that shows the book, for all that page-flip has no word for; null before it is loaded. */
  getBook(): TurnleafBook | null {
    return this.book;
  }

  /** Adds a listener. Returns the book. */
  on<K extends keyof FlipEvents>(
    event: K,
    listener: (event: WidgetEvent<FlipEvents[K], PageFlip>) => void,
  ): this {
    this.listeners.add(event, listener);
    return this;
  }

  /** Removes a listener of an event, or all of them if none is given. */
  off(event: keyof FlipEvents, listener?: (event: never) => void): void {
    this.listeners.remove(event, listener);
  }

  private get spreads(): number[][] {
    const isPortrait = this.getOrientation() === "portrait";
    return spreadsOf(this.count, this.settings.showCover, isPortrait);
  }

  private hasPage(page: number): boolean {
    return Number.isInteger(page) && page >= 0 && page < this.count;
  }

  private turnBy(by: 1 | -1): void {
    const spreads = this.spreads;
    const [page] = spreads[spreadWith(spreads, this.index) + by] ?? [];
    if (page !== undefined) this.turnToPage(page);
  }

  private emit<K extends keyof FlipEvents>(event: K, data: FlipEvents[K]): void {
    this.listeners.call(event, data, this);
  }

  /** Calls a command of the element, once the book is open. */
  private command(command: (book: TurnleafBook) => void): void {
    if (this.book && this.isOpen) command(this.book);
    else if (this.count > 0) this.waiting.push(command);
  }

  private load(
    pages: BookInput,
    count: number,
    items: HTMLElement[],
    event: "init" | "update",
  ): void {
    if (this.place?.isInHost === false) this.destroy();
    const book = this.book ?? this.open();
    if (count === 0) {
      this.clear();
      return;
    }
    this.loading.abort();
    this.loading = new AbortController();
    const { signal } = this.loading;
    if (this.isOpen) {
      this.shown = {
        count: this.count,
        index: this.index,
        items: this.items,
        hard: this.hard,
      };
    }
    this.isOpen = false;
    this.waiting = [];
    this.giveBack(null);
    this.count = count;
    this.take(items);
    const asked = event === "init" ? this.settings.startPage : this.index;
    const isHard = Array.from({ length: count }, (_, k) => items[k]?.dataset.density === "hard");
    this.hard = hardPages(isHard, this.settings.showCover);
    book.setAttribute("hard-pages", numbersOf(this.hard));
    // One page is the back, as in page-flip.
    book.setAttribute("offset", this.settings.showCover && count > 1 ? "1" : "0");
    this.fit();
    this.index = 0;
    const failed = (): void => {
      // An error may be about a part of the book that it can be read without.
      if (!book.isOpening) this.fail(book);
    };
    book.addEventListener("error", failed, { signal });
    book.addEventListener(
      "load",
      () => {
        this.loading.abort();
        this.shown = null;
        this.isOpen = true;
        this.place?.measure();
        for (const command of this.waiting.splice(0)) command(book);
        const page = event === "init" ? asked : this.index;
        this.emit(event, { page, mode: this.getOrientation() });
      },
      { signal },
    );
    book.pages = pages;
    // After the pages: it is one of theirs, and not of those that are shown meanwhile.
    book.setAttribute("page", String(this.hasPage(asked) ? asked + 1 : 1));
    if (this.hasPage(asked)) {
      const spreads = this.spreads;
      this.index = spreads[spreadWith(spreads, asked)]?.[0] ?? asked;
      this.emit("flip", this.index);
    }
  }

  /** Goes on with the pages from before, if the element still shows them, as others could not be loaded. */
  private fail(book: TurnleafBook): void {
    this.loading.abort();
    this.waiting = [];
    this.isOpen = this.shown !== null && book.pageCount > 0;
    this.giveBack(this.isOpen ? null : this.host);
    const { count, index, items, hard } = (this.isOpen && this.shown) || noPages;
    this.shown = null;
    this.count = count;
    this.index = index;
    this.take(items);
    this.hard = hard;
    book.setAttribute("hard-pages", numbersOf(hard));
    this.fit();
  }

  /** Makes the element, and puts it into the host. */
  private open(): TurnleafBook {
    const settings = this.settings;
    this.ended = new AbortController();
    const { signal } = this.ended;
    // Written as attributes: in a global build its class may still be loading.
    const book = this.host.ownerDocument.createElement("turnleaf-book");
    const attributes = {
      binding: "left",
      cover: "none",
      camera: "overhead",
      duration: String(settings.flippingTime),
      shadows: settings.drawShadow ? String(settings.maxShadowOpacity) : "0",
      "swipe-distance": String(settings.swipeDistance),
      gestures: !settings.useMouseEvents
        ? "none"
        : settings.showPageCorners
          ? "drag corner"
          : "drag",
    };
    for (const [name, value] of Object.entries(attributes)) book.setAttribute(name, value);
    book.addEventListener("pagechange", ({ detail }) => this.turned(detail.to - 1), { signal });
    book.addEventListener("statechange", ({ detail }) => this.changeState(detail.state), {
      signal,
    });
    book.addEventListener("layoutchange", () => this.place?.measure(), { signal });
    this.book = book;
    this.place = new BookPlace(this.host, book, settings, () => this.fit());
    if (settings.useMouseEvents) this.listen(signal);
    return book;
  }

  /** Turns pages by clicks, anywhere on the book. */
  private listen(signal: AbortSignal): void {
    const host = this.host;
    host.addEventListener(
      "pointerdown",
      ({ clientX: x, clientY: y }) => {
        this.downAt = { x, y };
      },
      { signal, capture: true },
    );
    host.addEventListener("click", (event) => this.click(event), { signal });
  }

  private click(event: MouseEvent): void {
    const { clientX: x, clientY: y } = event;
    const from = this.downAt ?? { x, y };
    this.downAt = null;
    if (event.defaultPrevented || event.button !== 0) return;
    if (Math.hypot(x - from.x, y - from.y) > dragStart) return;
    const path = event.composedPath();
    const on = path.slice(0, path.indexOf(this.host));
    if (on.some((node) => node instanceof Element && node.matches(pressed))) return;
    const { left, top, width, height, pageWidth } = this.getBoundsRect();
    const box = this.host.getBoundingClientRect();
    const across = x - box.left - this.host.clientLeft - left;
    const along = y - box.top - this.host.clientTop - top;
    if (this.settings.disableFlipByClick) {
      const reach = cornerFraction * Math.hypot(pageWidth, height);
      const isCorner = (at: number, size: number): boolean =>
        at > 0 && at < size && (at < reach || at > size - reach);
      if (!isCorner(across, width) || !isCorner(along, height)) return;
    }
    const isPortrait = this.getOrientation() === "portrait";
    const isBack = isPortrait ? across - pageWidth <= width / 5 : across < width / 2;
    if (isBack) this.flipPrev();
    else this.flipNext();
  }

  private fit(): void {
    const place = this.place;
    if (!place) return;
    const isChanged = place.fit();
    const { pageWidth, height } = place.rect;
    const spreads = this.spreads;
    const isPortrait = place.orientation === "portrait";
    for (const [k, lent] of this.lent.entries()) {
      const side = isPortrait ? "right" : sideOf(spreads, k);
      lent.wear(["stf__item", `--${this.hard.has(k) ? "hard" : "soft"}`, `--${side}`, "--simple"]);
      // Shown, also where a style sheet of page-flip hides what it does not show itself.
      lent.style({ display: "block", width: `${pageWidth}px`, height: `${height}px` });
    }
    if (isChanged) this.emit("changeOrientation", place.orientation);
  }

  private turned(index: number): void {
    if (index === this.index) return;
    this.index = index;
    this.emit("flip", index);
  }

  private changeState(state: BookState): void {
    if (this.place) this.place.isResting = state === "resting";
    const words = {
      resting: "read",
      lifting: "fold_corner",
      dragged: "user_fold",
      // A leaf that was let go is still the reader's until it lies.
      turning: this.state === "user_fold" ? "user_fold" : "flipping",
    } as const;
    if (words[state] === this.state) return;
    this.state = words[state];
    this.emit("changeState", this.state);
  }

  /** Keeps elements that become pages. */
  private take(items: HTMLElement[]): void {
    this.items = items;
    this.lent = items.map((item) => new LentStyle(item));
  }

  /**
   * Makes elements that are pages no longer look as they did; puts them into the host if there is
   * one, but for those that others have taken away, alone or with the book.
   */
  private giveBack(host: HTMLElement | null): void {
    for (const [k, item] of this.items.entries()) {
      this.lent[k]?.restore();
      if (this.place?.isInHost && this.book?.contains(item)) host?.append(item);
    }
    this.items = [];
    this.lent = [];
  }
}

function imagePages(images: readonly string[]): BookInput {
  return images.map((src) => ({ src }));
}
