/** Keeps where a book lies open, as its attributes say: in the address, and over a reload. */

import type { PageSource } from "../sources/page_source.ts";
import { pageOfHash, writeAddress } from "./address.ts";
import { loadPlace, savePlace } from "./saved_places.ts";

/** The element, as far as its place is kept. */
interface PlacedBook extends HTMLElement {
  readonly src: string;
  readonly page: number;
  readonly pageCount: number;
  readonly bookTitle: string;
  zoom: number;
  bookmarks: readonly number[];
  goTo(page: number): Promise<boolean>;
}

/** Follows one element for as long as it is in a document. */
export class PlaceKeeper {
  readonly #book: PlacedBook;
  #ended: AbortController | null = null;
  /** Whether a book is open whose place is worth keeping. */
  #isOpen = false;

  constructor(book: PlacedBook) {
    this.#book = book;
  }

  /** Starts listening: to the element, to the address, and to the page's unloading. */
  follow(): void {
    this.#ended = new AbortController();
    this.#isOpen = this.#book.pageCount > 0;
    const { signal } = this.#ended;
    const on = (target: EventTarget, name: string, handle: () => void): void =>
      target.addEventListener(name, handle, { signal });
    on(this.#book, "load", () => this.#opened());
    on(this.#book, "pagechange", () => this.#write());
    on(this.#book, "bookmarkchange", () => this.#keep());
    on(window, "pagehide", () => this.#keep());
    on(window, "hashchange", () => {
      const page = this.#asked;
      if (page !== null && page !== this.#book.page) void this.#book.goTo(page);
    });
  }

  /** Keeps the place a last time, and stops listening. */
  leave(): void {
    this.#keep();
    this.#isOpen = false;
    this.#ended?.abort();
  }

  /** Call it when the open book is closed for another. */
  closed(): void {
    this.#keep();
    this.#isOpen = false;
  }

  /** The page in the address; null if there is none, or the address is not used. */
  get #asked(): number | null {
    return this.#book.hasAttribute("address") ? pageOfHash(location.hash) : null;
  }

  /**
   * Returns the page at which a book opens: the one in the address, otherwise
   * where it was left.
   *
   * @param left where this element left it, if it was open before
   */
  opening(source: PageSource | undefined, left: number | null): number | null {
    const remembers = source !== undefined && this.#book.hasAttribute("remember");
    const kept = remembers ? loadPlace(this.#name(source.title, source.pageCount)) : null;
    return this.#asked ?? left ?? kept?.page ?? null;
  }

  #opened(): void {
    const book = this.#book;
    this.#isOpen = true;
    if (!book.hasAttribute("remember")) return;
    const kept = loadPlace(this.#name(book.bookTitle, book.pageCount));
    if (kept === null) return;
    if (kept.bookmarks.length > 0) book.bookmarks = kept.bookmarks;
    if (kept.zoom > 1) book.zoom = kept.zoom;
  }

  #write(): void {
    if (this.#book.hasAttribute("address")) writeAddress(this.#book.page);
    this.#keep();
  }

  #keep(): void {
    const { bookTitle, pageCount, page, zoom, bookmarks } = this.#book;
    if (!this.#isOpen || !this.#book.hasAttribute("remember")) return;
    savePlace(this.#name(bookTitle, pageCount), { page, zoom, bookmarks });
  }

  /** Returns what identifies a book: its address, its title, its length. */
  #name(title: string, pageCount: number): string {
    return `${this.#book.src} ${pageCount} ${title}`;
  }
}
