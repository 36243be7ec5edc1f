/**
 * Keeps where a book lies open, as its attributes say: in the document's
 * address, as `#page=23`, and over a reload, in the browser's storage. Storage
 * may be missing, full, or written by other code: what is read is checked, and
 * a failed write does not stop reading.
 */

import type { PageSource } from "../sources/page_source.ts";
import { cleanPages, isPage } from "./page_numbers.ts";

/** The element, as far as its place is kept. */
interface PlacedBook extends HTMLElement {
  readonly src: string;
  readonly page: number;
  readonly pageCount: number;
  readonly bookTitle: string;
  zoom: number;
  bookmarks: readonly number[];
  shifts: readonly number[];
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
    on(this.#book, "shiftchange", () => this.#keep());
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
    if (kept.shifts.length > 0) book.shifts = kept.shifts;
    if (kept.zoom > 1) book.zoom = kept.zoom;
  }

  #write(): void {
    if (this.#book.hasAttribute("address")) writeAddress(this.#book.page);
    this.#keep();
  }

  #keep(): void {
    const { bookTitle, pageCount, page, zoom, bookmarks, shifts } = this.#book;
    if (!this.#isOpen || !this.#book.hasAttribute("remember")) return;
    savePlace(this.#name(bookTitle, pageCount), { page, zoom, bookmarks, shifts });
  }

  /** Returns what identifies a book: its address, its title, its length. */
  #name(title: string, pageCount: number): string {
    return `${this.#book.src} ${pageCount} ${title}`;
  }
}

/** The state kept of a book. */
export interface SavedPlace {
  /** From 1. */
  readonly page: number;
  /** 1 to 8. */
  readonly zoom: number;
  /** Pages from 1, in order. */
  readonly bookmarks: readonly number[];
  /** Likewise. */
  readonly shifts: readonly number[];
}

/** Everything is under one key, the last book read first. */
const key = "turnleaf";
const mostBooks = 100;
const longestName = 300;
const longestStore = 400_000;

/** Returns the state kept of the book of a name, or null. */
export function loadPlace(name: string): SavedPlace | null {
  const found = read().find(([other]) => other === short(name));
  if (found === undefined) return null;
  const [, page, zoom, bookmarks, shifts] = found;
  return {
    page: isPage(page) ? page : 1,
    zoom: typeof zoom === "number" && zoom >= 1 && zoom <= 8 ? zoom : 1,
    bookmarks: cleanPages(bookmarks),
    shifts: cleanPages(shifts),
  };
}

/** Keeps a book; the one read longest ago is dropped. */
export function savePlace(name: string, { page, zoom, bookmarks, shifts }: SavedPlace): void {
  const others = read().filter(([other]) => other !== short(name));
  const all = [[short(name), page, Math.round(zoom * 100) / 100, bookmarks, shifts], ...others];
  try {
    localStorage.setItem(key, JSON.stringify(all.slice(0, mostBooks)));
  } catch {
    // Full, or forbidden.
  }
}

/** Returns rows of name, page, zoom, bookmarks, shifts (if any); only the name is checked. */
function read(): [string, ...unknown[]][] {
  try {
    const text = localStorage.getItem(key) ?? "";
    const rows: unknown = text.length > longestStore ? [] : JSON.parse(text);
    if (!Array.isArray(rows)) return [];
    return rows
      .slice(0, mostBooks)
      .filter((row) => Array.isArray(row) && typeof row[0] === "string" && row.length >= 4);
  } catch {
    return [];
  }
}

const short = (name: string): string => name.slice(0, longestName);

const pattern = /(^#?|&)page=(\d{1,6})(?=&|$)/;

/**
 * Returns the page (from 1) that a fragment such as `#page=12` or
 * `#a=b&page=12` names; null if it names none.
 */
export function pageOfHash(hash: string): number | null {
  const page = Number(pattern.exec(hash)?.[2] ?? 0);
  return page >= 1 ? page : null;
}

/** Returns the fragment with another page in it; the rest stays. */
export function hashWithPage(hash: string, page: number): string {
  if (pattern.test(hash)) return hash.replace(pattern, `$1page=${page}`);
  return hash.length > 1 ? `${hash}&page=${page}` : `#page=${page}`;
}

/** Writes the page into the address, without a step in the history. */
export function writeAddress(page: number): void {
  const hash = hashWithPage(location.hash, page);
  if (hash === location.hash) return;
  try {
    history.replaceState(history.state, "", hash);
  } catch {
    // Browsers throw if it is called too often, and in a page without an address of its own.
  }
}
