/** What a reader does with an open book beside turning it: finds, marks, prints, keeps the place. */

import { loaded } from "../sources/loaded.ts";
import {
  BookError,
  type OutlineEntry,
  type PagePicture,
  type PageSource,
} from "../sources/page_source.ts";
import type { SearchHit } from "../text/searching.ts";
import type { OpenBook } from "./book_lifecycle.ts";
import { cleanBookmarks } from "./clean_bookmarks.ts";
import type { Film, RecordOptions } from "./film.ts";
import type { Place } from "./place.ts";
import type { PrintOptions } from "./printing.ts";
import { ReflectingElement } from "./reflecting.ts";
import { SlideShow } from "./slide_show.ts";

/** Widest a page is drawn for whoever asks, pixels. */
const widestDrawn = 2048;

/** Everything about the book that is not the book: its own subclass opens and turns it. */
export abstract class ReaderElement extends ReflectingElement {
  abstract readonly page: number;
  abstract zoom: number;
  abstract goTo(page: number): Promise<boolean>;
  abstract next(): Promise<boolean>;
  /**
   * The book that lies open.
   * @internal
   */
  protected abstract get book(): OpenBook | null;

  /** What keeps the place, once an attribute has asked for it. */
  #place: Place | null = null;
  readonly #show = new SlideShow(this, () =>
    this.emit("playchange", { playing: this.#show.playing }),
  );
  #bookmarks: readonly number[] = [];
  #film: Film | null = null;

  /** Number of pages; 0 until the book is open. */
  get pageCount(): number {
    return this.source?.pageCount ?? 0;
  }

  /** The book's title; empty until it is open. */
  get bookTitle(): string {
    return this.source?.title ?? "";
  }

  /** What a page (from 1) calls itself, such as "iv" or "23". */
  label(page: number): string {
    const { source } = this;
    return source && page >= 1 && page <= source.pageCount ? source.label(page - 1) : String(page);
  }

  /**
   * Finds every place of the book where `query` stands. Resolves to them in reading order, at most 2,000;
   * to none while no book is open.
   * Case, accents, ligatures, quotation marks and hyphens do not count.
   * Rejects with the signal's reason when aborted, or when the book is closed, and with a `BookError`
   * where the part of the viewer that searches cannot be loaded.
   * @param options `signal` gives the search up
   */
  async search(query: string, options?: { signal?: AbortSignal }): Promise<readonly SearchHit[]> {
    return (await this.book?.reading.search(query, options?.signal)) ?? [];
  }

  /**
   * Turns to a hit and marks it, strongly, and faintly every other place of its query that comes in sight;
   * null takes the marks away. Resolves, once the book is at rest, to whether the hit lies open.
   */
  showHit(hit: SearchHit | null): Promise<boolean> {
    this.book?.reading.mark(hit);
    return hit ? this.goTo(hit.page) : Promise.resolve(true);
  }

  /** Resolves to the book's table of contents; empty where it has none, or no book is open. Rejects with a `BookError`. */
  async outline(): Promise<readonly OutlineEntry[]> {
    return (await this.book?.reading.outline()) ?? [];
  }

  /** The bookmarked pages, from 1, in order; at most 500. */
  get bookmarks(): readonly number[] {
    return this.#bookmarks;
  }

  set bookmarks(pages: readonly number[]) {
    this.#bookmarks = cleanBookmarks(pages);
    this.emit("bookmarkchange", { bookmarks: this.#bookmarks });
  }

  /**
   * Pages lie elsewhere than before: `moved` answers where one (from 0) does, or null. Bookmarks go with theirs.
   * @internal
   */
  protected moveBookmarks(moved: (index: number) => number | null): void {
    const pages = this.#bookmarks.flatMap((page) => {
      const index = moved(page - 1);
      return index === null ? [] : [index + 1];
    });
    if (pages.join() !== this.#bookmarks.join()) this.bookmarks = pages;
  }

  /** Bookmarks a page (from 1), the first in sight where none is given; one that is bookmarked no more. */
  toggleBookmark(page: number = this.page): void {
    const others = this.#bookmarks.filter((other) => other !== page);
    this.bookmarks = others.length < this.#bookmarks.length ? others : [...others, page];
  }

  /** Whether a leaf or a board is on its way, or in a hand. */
  get turning(): boolean {
    return this.book?.viewer.turning.moving ?? false;
  }

  /**
   * Takes the element out of its page, which ends and frees everything, as taking it out by any
   * other way does. Put into a page again, it opens its book where that lay.
   */
  destroy(): void {
    this.remove();
  }

  /** Whether the pages turn by themselves. */
  get playing(): boolean {
    return this.#show.playing;
  }

  /** Turns the pages one after another, each shown for `secondsPerPage` (1 to 3600; 6 where not given), until the last or `pause()`. */
  play(secondsPerPage?: number): void {
    this.#show.play(secondsPerPage);
  }

  /** Ends the slide-show. */
  pause(): void {
    this.#show.pause();
  }

  /** Turns to the first page. Resolves as `goTo` does. */
  first(): Promise<boolean> {
    return this.goTo(1);
  }

  /** Turns to the last page. Resolves as `goTo` does. */
  last(): Promise<boolean> {
    return this.goTo(Number.POSITIVE_INFINITY);
  }

  /**
   * Draws a page (from 1) by itself, `width` pixels wide (at most 2048), as for a thumbnail.
   * Resolves to the picture. A bitmap is whoever's who asked for it: `close()` frees it.
   * Rejects with a `BookError`, or with the reason of `signal`.
   */
  async drawPage(page: number, width: number, signal?: AbortSignal): Promise<PagePicture> {
    const { source } = this;
    if (!source || !(page >= 1 && page <= source.pageCount)) {
      throw new BookError(`There is no page ${page} to draw; open a book that has it.`);
    }
    const across = Math.min(width, widestDrawn);
    return await source.draw(Math.round(page) - 1, across, signal ?? new AbortController().signal);
  }

  /** What the book's owner and its source let a reader do; nothing while none is open. */
  get allows(): { readonly print: boolean; readonly download: boolean } {
    const { source } = this;
    return {
      print: source !== undefined && source.allows?.print !== false,
      download: source?.file !== undefined,
    };
  }

  /**
   * Draws the pages that `options` name and opens the browser's print dialog with them, a sheet each.
   * Resolves, once they are there, to whether the book may be printed. Rejects with a `BookError` where a
   * page cannot be drawn, and where no page or more than 300 are asked for.
   */
  async print(options: PrintOptions = {}): Promise<boolean> {
    const { source } = this;
    if (!source || !this.allows.print) return false;
    const { printPages } = await loaded(import("./print_pages.ts"));
    return await printPages(source, options);
  }

  /** Hands the book's own file to the reader. Resolves to whether there is one. */
  async download(): Promise<boolean> {
    const { source } = this;
    if (!source || !this.allows.download) return false;
    const { downloadFile } = await loaded(import("./print_pages.ts"));
    return await downloadFile(source);
  }

  /**
   * Records a film of the book as it is shown, until `stopRecording()`, or for so many seconds. Resolves to
   * the film, WebM where the browser writes it. Rejects with a `BookError` where no book is open, one is
   * recorded already, or the browser cannot.
   * @param options `seconds` (0.1 to 600) ends it by itself
   */
  async record(options: RecordOptions = {}): Promise<Blob> {
    const { Film } = await loaded(import("./film.ts"));
    const { book } = this;
    if (!book || this.#film) {
      const sentence = book
        ? "A film is recorded already."
        : "There is no book to record; open one.";
      throw new BookError(sentence);
    }
    const film = new Film(() => this.book?.canvas, options);
    this.#film = film;
    // What lies still is drawn once, to be seen.
    book.viewer.invalidate();
    try {
      return await film.done;
    } finally {
      this.#film = null;
    }
  }

  /** Ends the film that `record()` began. */
  stopRecording(): void {
    this.#film?.stop();
  }

  /** Whether a film is recorded. */
  get recording(): boolean {
    return this.#film !== null;
  }

  /**
   * The book is about to be drawn.
   * @internal
   */
  protected filmed(): void {
    this.#film?.frame();
  }

  /** Fills the screen with the element, or leaves full screen. Resolves to whether the browser let it. */
  async toggleFullscreen(): Promise<boolean> {
    try {
      const { ownerDocument } = this;
      if (ownerDocument.fullscreenElement === this) await ownerDocument.exitFullscreen();
      else await this.requestFullscreen();
      return true;
    } catch {
      return false;
    }
  }

  /**
   * The open book's pages.
   * @internal
   */
  protected get source(): PageSource | undefined {
    return this.book?.source;
  }

  /**
   * Loads what keeps the place, where an attribute asks for it. Rejects with a `BookError` where it cannot.
   * @internal
   */
  protected async keepPlace(): Promise<void> {
    if (!this.address && !this.remember) return;
    const { Place } = await loaded(import("./place.ts"));
    // Both attributes may have asked.
    if (this.#place) return;
    this.#place = new Place(this);
    if (this.isConnected) this.#place.follow();
  }

  /**
   * The element is in a document.
   * @internal
   */
  protected connectReader(): void {
    this.#place?.follow();
  }

  /**
   * The element leaves its document, its book still open.
   * @internal
   */
  protected disconnectReader(): void {
    this.pause();
    this.stopRecording();
    this.#place?.leave();
  }

  /**
   * Another book takes the place of the one that is open.
   * @internal
   */
  protected forgetBook(): void {
    this.pause();
    this.#place?.closed();
    this.#bookmarks = [];
  }

  /**
   * The page at which a book is to open, as the address says or where it was left; null where neither does.
   * @internal
   */
  protected keptPage(source: PageSource | undefined, left: number | null): number | null {
    return this.#place ? this.#place.opening(source, left) : left;
  }
}
