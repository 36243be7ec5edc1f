/** Elements of a web page as the pages of a book: shown live at rest, a picture of each while it turns. */

import { cleanLanguage, cleanText } from "../book_text.ts";
import { closedError, unknownFailure } from "../failures.ts";
import { limits, wholePage } from "../limits.ts";
import {
  BookError,
  type NewIndex,
  type OutlineEntry,
  type PageBox,
  type PageSize,
  type PageSource,
  type TextRun,
} from "../page_source.ts";
import { drawMarkup } from "../typeset/draw_markup.ts";
import { pagesIn } from "./child_pages.ts";
import { PixelCache } from "./embedded_pixels.ts";
import { type FrozenCopy, freeze } from "./frozen_copy.ts";
import { headingsIn, textIn } from "./page_texts.ts";

/** A page that is not laid out yet is as large as one without a size of its own, CSS pixels. */
const usualSize: PageSize = { width: 480, height: 720 };

/** How many copies of pages are kept: those of two spreads and their neighbours. */
const mostCopies = 8;

/** How long changes of a page are gathered before it is drawn again, milliseconds. */
const gatherTime = 300;

/** Events after which a page may look otherwise, though no element has changed. */
const changingEvents = ["input", "change", "load", "toggle", "pause", "seeked", "loadeddata"];

/** Elements as pages. They have to be laid out in a document, by the code that shows them. */
export class HtmlPages implements PageSource {
  readonly kind = "typeset";
  readonly title: string;
  readonly language: string;
  readonly direction: "ltr" | "rtl";
  #pages: readonly HTMLElement[];
  readonly #parent: Element | null;
  /** Copies of pages that have not changed since; the last used at the end. */
  readonly #copies = new Map<HTMLElement, Promise<FrozenCopy>>();
  readonly #pixels = new PixelCache(() => this.#outdateAll());
  readonly #ended = new AbortController();
  readonly #content: MutationObserver;
  readonly #sizes: ResizeObserver;
  /** What ends following each page. */
  readonly #watched = new Map<HTMLElement, AbortController>();
  /** The size of each page as it was last seen. */
  readonly #seen = new WeakMap<Element, string>();
  #outdated = new Set<HTMLElement>();
  #timer: ReturnType<typeof setTimeout> | undefined;
  #onDrawing: ((index: number) => void) | null = null;
  #onPages: ((change: () => NewIndex) => void) | null = null;
  #onSizes: (() => void) | null = null;
  /** What goes on once pages are seen that were hidden. */
  readonly #awaited = new Set<() => void>();
  /** Pages whose size was asked for while they were hidden. */
  readonly #guessed = new Set<HTMLElement>();
  #isChangeDue = false;

  /**
   * @param pages at least one
   *
   * @param parent if given, the book follows this element's children as they
   * are added, removed and moved
   */
  constructor(pages: readonly HTMLElement[], parent: Element | null = null) {
    const [first] = pages;
    if (first === undefined)
      throw new BookError("No element was given; give one for each page.", { code: "empty" });
    if (pages.length > limits.pages) {
      throw new BookError(`A book has ${limits.pages} pages at most; give fewer elements.`, {
        code: "tooLarge",
      });
    }
    this.#pages = [...new Set(pages)];
    this.#parent = parent;
    const document = first.ownerDocument;
    const view = document.defaultView ?? window;
    const named = parent?.getAttribute("aria-label") || parent?.getAttribute("title");
    this.title = cleanText(named || document.title) || "This book";
    const around = parent ?? first;
    this.language = cleanLanguage(around.closest("[lang]")?.getAttribute("lang") ?? "");
    this.direction = view.getComputedStyle(around).direction === "rtl" ? "rtl" : "ltr";
    this.#content = new view.MutationObserver((changes) => this.#changed(changes));
    this.#sizes = new view.ResizeObserver((entries) => {
      for (const { target } of entries) this.#resized(target as HTMLElement);
    });
    document.fonts.addEventListener("loadingdone", () => this.#outdateAll(), {
      signal: this.#ended.signal,
    });
    if (parent) this.#content.observe(parent, { childList: true });
    for (const page of this.#pages) this.#watch(page);
  }

  get pageCount(): number {
    return this.#pages.length;
  }

  element(index: number): HTMLElement {
    return this.#page(index);
  }

  async size(index: number): Promise<PageSize> {
    const page = this.#page(index);
    const { offsetWidth, offsetHeight } = page;
    if (offsetWidth === 0 || offsetHeight === 0) {
      this.#guessed.add(page);
      return usualSize;
    }
    return {
      width: Math.min(offsetWidth, limits.pageSide),
      height: Math.min(offsetHeight, limits.pageSide),
    };
  }

  label(index: number): string {
    const own = cleanText(this.#pages[index]?.dataset.label, limits.labelLength);
    return own || String(index + 1);
  }

  async draw(
    index: number,
    width: number,
    signal: AbortSignal,
    region: PageBox = wholePage,
  ): Promise<ImageBitmap> {
    signal.throwIfAborted();
    const page = this.#page(index);
    const name = `Page ${index + 1} of ${this.title}`;
    await this.#shown(page, signal);
    try {
      const { svg, size } = await this.#copyOf(page, name);
      signal.throwIfAborted();
      const picture = await drawMarkup(svg, size, region, width);
      if (signal.aborted || this.#ended.signal.aborted) picture.close();
      signal.throwIfAborted();
      this.#throwIfClosed();
      return picture;
    } catch (error) {
      signal.throwIfAborted();
      throw unknownFailure(
        `${name} could not be drawn`,
        error,
        "its motion shows no picture: allow data: in img-src of this web page's Content-Security-Policy",
        { page: index + 1, source: this.title },
      );
    }
  }

  async text(index: number, signal: AbortSignal): Promise<readonly TextRun[]> {
    signal.throwIfAborted();
    return textIn(this.#page(index));
  }

  async outline(): Promise<readonly OutlineEntry[]> {
    return headingsIn(this.#pages);
  }

  watchPages(listener: (change: () => NewIndex) => void): void {
    this.#onPages = listener;
    if (this.#isChangeDue) listener(() => this.#follow());
  }

  watchDrawings(listener: (index: number) => void): void {
    this.#onDrawing = listener;
  }

  outdate(index: number): void {
    this.#copies.delete(this.#page(index));
  }

  watchSizes(listener: () => void): void {
    this.#onSizes = listener;
    for (const page of this.#guessed) this.#resized(page);
  }

  close(): void {
    this.#ended.abort();
    this.#resume();
    this.#content.disconnect();
    this.#sizes.disconnect();
    for (const page of [...this.#watched.keys()]) this.#unwatch(page);
    clearTimeout(this.#timer);
    this.#copies.clear();
    this.#onDrawing = this.#onPages = this.#onSizes = null;
  }

  #page(index: number): HTMLElement {
    this.#throwIfClosed();
    const page = this.#pages[index];
    if (!page)
      throw new BookError(`${this.title} has no page ${index + 1}; turn to another.`, {
        code: "noPage",
        source: this.title,
      });
    return page;
  }

  #throwIfClosed(): void {
    if (this.#ended.signal.aborted) throw closedError(this.title);
  }

  #copyOf(page: HTMLElement, name: string): Promise<FrozenCopy> {
    // What is painted on a canvas may be other than a moment ago.
    const known = page.querySelector("canvas") ? undefined : this.#copies.get(page);
    // Of a page that is not laid out there is nothing to keep.
    if (page.offsetWidth === 0)
      throw new BookError(`${name} is not laid out; show the book.`, { code: "misused" });
    const copy = known ?? freeze(page, name, this.#pixels);
    this.#copies.delete(page);
    this.#copies.set(page, copy);
    if (!known) copy.catch(() => this.#copies.delete(page));
    const [oldest] = this.#copies.keys();
    if (this.#copies.size > mostCopies && oldest) this.#copies.delete(oldest);
    return copy;
  }

  /**
   * Resolves once a page that is hidden with what is around it, a tab or a dialog, is seen: at once
   * for others, and where the page itself is hidden. Rejects with the signal's reason.
   */
  async #shown(page: HTMLElement, signal: AbortSignal): Promise<void> {
    const isHidden = (): boolean => page.offsetWidth === 0 && !this.#ended.signal.aborted;
    const view = page.ownerDocument.defaultView ?? window;
    while (isHidden() && view.getComputedStyle(page).display !== "none") {
      await new Promise<void>((resolve, reject) => {
        this.#awaited.add(resolve);
        signal.addEventListener("abort", () => reject(signal.reason), { once: true });
      });
    }
  }

  #resume(): void {
    const awaited = [...this.#awaited];
    this.#awaited.clear();
    for (const resume of awaited) resume();
  }

  /** Follows everything about a page that its picture shows. */
  #watch(page: HTMLElement): void {
    this.#content.observe(page, {
      subtree: true,
      childList: true,
      attributes: true,
      characterData: true,
    });
    this.#sizes.observe(page);
    const watching = new AbortController();
    this.#watched.set(page, watching);
    const { signal } = watching;
    for (const name of changingEvents) {
      page.addEventListener(name, () => this.#outdate(page), { capture: true, signal });
    }
  }

  /** Ends following a page; what a mutation observer reports of it until the page comes back is passed over. */
  #unwatch(page: HTMLElement): void {
    this.#watched.get(page)?.abort();
    this.#watched.delete(page);
    this.#sizes.unobserve(page);
  }

  #changed(changes: readonly MutationRecord[]): void {
    for (const { target } of changes) {
      if (target === this.#parent) this.#childrenChanged();
      else for (const page of this.#pages) if (page.contains(target)) this.#outdate(page);
    }
  }

  #resized(page: HTMLElement): void {
    // Hidden, with a tab or a dialog, it is as large as it will be seen again.
    if (page.offsetWidth === 0 || page.offsetHeight === 0) return;
    this.#resume();
    if (this.#guessed.has(page)) {
      // They are seen together.
      this.#guessed.clear();
      this.#onSizes?.();
    }
    const size = `${page.offsetWidth} ${page.offsetHeight}`;
    const before = this.#seen.get(page);
    this.#seen.set(page, size);
    if (before !== undefined && before !== size) this.#outdate(page);
  }

  #outdateAll(): void {
    for (const page of this.#pages) this.#outdate(page);
  }

  /** Has a page drawn again, soon: changes come in crowds. */
  #outdate(page: HTMLElement): void {
    this.#outdated.add(page);
    this.#copies.delete(page);
    this.#timer ??= setTimeout(() => {
      this.#timer = undefined;
      const pages = this.#outdated;
      this.#outdated = new Set();
      for (const page of pages) {
        this.#copies.delete(page);
        const index = this.#pages.indexOf(page);
        if (index >= 0) this.#onDrawing?.(index);
      }
    }, gatherTime);
  }

  #childrenChanged(): void {
    if (this.#isChangeDue) return;
    this.#isChangeDue = true;
    this.#onPages?.(() => this.#follow());
  }

  /** Takes the children of the parent as they are now. A book keeps its last page. */
  #follow(): NewIndex {
    this.#isChangeDue = false;
    const before = this.#pages;
    const now = this.#parent ? pagesIn(this.#parent).slice(0, limits.pages) : [];
    if (now.length > 0) this.#pages = now;
    const places = new Map(this.#pages.map((page, index) => [page, index]));
    for (const page of before) if (!places.has(page)) this.#unwatch(page);
    for (const page of this.#pages) if (!this.#watched.has(page)) this.#watch(page);
    return (index) => places.get(before[index] as HTMLElement) ?? null;
  }
}
