/**
 * Keeps where a book lies open, as its attributes say: in the document's
 * address, as `#page=23`, and over a reload, in the browser's storage. Storage
 * may be missing, full, or written by other code: what is read is checked, and
 * a failed write does not stop reading.
 */

import type { DogEar } from "../book/dog_ears.ts";
import type { PageFold } from "../book/page_folds.ts";
import type { BookState } from "../book/turning.ts";
import { pageInHash, pageOfHash } from "../sources/page_hash.ts";
import type { PageList } from "../sources/page_list.ts";
import type { PageSize, Typography } from "../sources/page_source.ts";
import { cleanDogEars, cleanFolds } from "./fold_lists.ts";
import type { PageLists } from "./page_lists.ts";
import { cleanPages, isPage } from "./page_numbers.ts";
import { themeAttributes } from "./page_theme.ts";
import { typographyAttributes } from "./typography.ts";

/** The element, as far as its place is kept. */
interface PlacedBook extends HTMLElement {
  readonly src: string;
  readonly page: number;
  readonly pageCount: number;
  readonly state: BookState;
  readonly bookTitle: string;
  zoom: number;
  bookmarks: readonly number[];
  shifts: readonly number[];
  turnTo(page: number): Promise<boolean>;
  dogEars: readonly DogEar[];
  folds: readonly PageFold[];
}

/** A place in a book by the pages that the book has when it is opened: all, and no other. */
export interface HomePlace {
  readonly page: number;
  readonly lists: PageLists;
}

/** What keeps the place that the document's address names. */
let addressed: PlaceKeeper | null = null;

/** Follows one element for as long as it is in a document. */
export class PlaceKeeper {
  readonly #book: PlacedBook;
  readonly #source: () => PageList | undefined;
  readonly #home: () => HomePlace;
  readonly #textSize: () => PageSize;
  #ended: AbortController | null = null;
  /** Whether a book is open whose place is worth keeping. */
  #isOpen = false;

  /** What was found of a book that is about to open, its pages as they lie now. */
  #restored: RestoredPlace | null = null;
  /** Whether the last step of the history is a jump in the book. */
  #hasJumped = false;
  /** The element's address of each book: it names another while the next book opens. */
  readonly #addresses = new WeakMap<PageList, string>();

  /**
   * @param source returns the open book's pages
   * @param home returns where the book lies open and what names its pages, as it will be opened again
   * @param textSize returns the size of pages for which text is set, CSS pixels
   */
  constructor(
    book: PlacedBook,
    source: () => PageList | undefined,
    home: () => HomePlace,
    textSize: () => PageSize,
  ) {
    this.#book = book;
    this.#source = source;
    this.#home = home;
    this.#textSize = textSize;
  }

  /** Starts listening: to the element, to the address, and to the page's unloading. */
  follow(): void {
    this.#ended = new AbortController();
    this.#isOpen = this.#book.pageCount > 0;
    if (this.#book.hasAttribute("address")) addressed ??= this;
    const { signal } = this.#ended;
    const on = (target: EventTarget, name: string, handle: () => void): void =>
      target.addEventListener(name, handle, { signal });
    on(this.#book, "load", () => this.#opened());
    on(this.#book, "pagechange", () => this.#write());
    // The same text may have another number now.
    on(this.#book, "pageschange", () => (this.#asked === null ? this.#keep() : this.#write()));
    on(this.#book, "bookmarkchange", () => this.#keep());
    on(this.#book, "dogearchange", () => this.#keep());
    on(this.#book, "foldchange", () => this.#keep());
    on(this.#book, "shiftchange", () => this.#keep());
    on(window, "pagehide", () => this.#keep());
    // A step back from a jump that is under way leads to the same address.
    on(window, "popstate", () => void this.#follow());
  }

  /** Keeps the place a last time, and stops listening. */
  leave(): void {
    this.#keep();
    this.#isOpen = false;
    if (addressed === this) addressed = null;
    this.#ended?.abort();
  }

  /** Call it when the open book is closed for another. */
  closed(): void {
    this.#keep();
    this.#isOpen = false;
  }

  /** Call it when the reader is about to jump in the book: the browser's Back leads back. */
  jump(): void {
    if (!this.#isOpen || !this.#hasAddress) return;
    this.#write();
    // The next place is written into an entry of its own.
    this.#hasJumped = stepInHistory();
  }

  /** Goes back in the history if the last step of it is a jump in the book. Returns whether it is. */
  back(): boolean {
    if (this.#hasJumped) history.back();
    return this.#hasJumped;
  }

  /**
   * Has the book seen and its flowing text set as its reader had it, where the element does not say it
   * otherwise, and finds the page where he was. Resolves to the page (from 1) of `left`, null if that
   * is unknown. Never rejects: a book opens at its beginning where that fails.
   *
   * @param src the element's address of it
   * @param typography returns how the attributes say that text is set, for pages of about the size that it is given
   * @param left the anchor at which the element left the book, if it was open before
   */
  async restore(
    source: PageList,
    src: string,
    typography: (kept?: PageSize) => Typography,
    left?: string,
  ): Promise<number | null> {
    this.#addresses.set(source, src);
    const isKept = this.#book.hasAttribute("remember");
    const kept = isKept ? loadPlace(this.#name(source)) : null;
    this.#say(kept?.seen ?? {});
    if (!source.findAnchors) return null;
    const { anchors = [], typography: said = {}, size, counts } = kept?.text ?? {};
    const asked = this.#asked;
    // A number is of the pages as they were counted then: the text with which its page began says more.
    const isSamePage = asked === null || asked === kept?.page;
    const at = this.#askedText ?? (isSamePage ? anchors[0] : undefined);
    try {
      const isOther = this.#say(said);
      const { width, height } = this.#textSize();
      const setting = typography(size);
      // Pages of another size begin with other words.
      const now = this.#textSize();
      if (isOther || now.width !== width || now.height !== height) await source.typeset?.(setting);
      if (counts) source.first.expectCounts?.(counts);
      const wanted = [at ?? "", left ?? "", ...anchors.slice(1)];
      const [index = null, leftAt = null, ...marks] = await source.findAnchors(wanted);
      const ofFolds = marks.splice(kept?.bookmarks.length ?? 0);
      const bookmarks = cleanPages(marks.map((mark) => (mark ?? -1) + 1));
      const pageFolds = (kept?.text ? kept.pageFolds : []).flatMap((fold, index) => {
        const found = ofFolds[index] ?? null;
        return found === null ? [] : [{ ...fold, page: found + 1 }];
      });
      // It was the first of its spread, and is so again.
      const open = asked === null ? (leftAt ?? index) : index;
      if (open !== null) source.keepSide(open, "first");
      const page = index === null ? null : index + 1;
      const place = kept?.text ? { ...kept, page: page ?? kept.page, bookmarks, pageFolds } : kept;
      this.#restored = { source, page, isAsked: asked !== null || this.#askedText !== null, place };
      return leftAt === null ? null : leftAt + 1;
    } catch {
      // What is wrong with the book is said when it is shown.
      return null;
    }
  }

  /** Sets attributes that the element does not have. Returns whether there are any. */
  #say(attributes: Readonly<Record<string, string>>): boolean {
    const missing = Object.entries(attributes).filter(([name]) => !this.#book.hasAttribute(name));
    for (const [name, value] of missing) this.#book.setAttribute(name, value);
    return missing.length > 0;
  }

  /** Turns to where the address leads that the reader has gone to, as by the browser's Back. */
  async #follow(): Promise<void> {
    this.#hasJumped = false;
    const [source, anchor, page] = [this.#source(), this.#askedText, this.#asked];
    const [found = null] = anchor === null ? [] : ((await source?.findAnchors?.([anchor])) ?? []);
    // Another address may have been gone to since.
    if (source !== this.#source() || anchor !== this.#askedText || page !== this.#asked) return;
    const to = found === null ? page : found + 1;
    const { page: at, state } = this.#book;
    if (to === null || (to === at && state === "resting")) return;
    void this.#book.turnTo(to);
  }

  /** Whether the address names this book's place: a document has one, of its first book that asks for it. */
  get #hasAddress(): boolean {
    if (!this.#book.hasAttribute("address")) return false;
    addressed ??= this;
    return addressed === this;
  }

  /** The page in the address; null if there is none, or the address is not used. */
  get #asked(): number | null {
    return this.#hasAddress ? pageOfHash(location.hash) : null;
  }

  /** The anchor of the text in the address; null if there is none, or the address is not used. */
  get #askedText(): string | null {
    return this.#hasAddress ? anchorOfHash(location.hash) : null;
  }

  /**
   * Returns the page at which a book opens: where the address leads, by its text if that is known,
   * otherwise where it was left.
   *
   * @param left where this element left it, if it was open before
   */
  opening(source: PageList | undefined, left: number | null): number | null {
    const remembers = source !== undefined && this.#book.hasAttribute("remember");
    const kept = remembers ? this.#loaded(source) : null;
    const found = this.#restored?.source === source ? this.#restored : null;
    const asked = found?.isAsked ? (found.page ?? this.#asked) : this.#asked;
    return asked ?? left ?? found?.page ?? kept?.page ?? null;
  }

  #opened(): void {
    const book = this.#book;
    this.#isOpen = true;
    const source = this.#source();
    if (!book.hasAttribute("remember") || !source) return;
    const kept = this.#loaded(source);
    if (kept === null) return;
    if (kept.bookmarks.length > 0) book.bookmarks = kept.bookmarks;
    if (kept.folds.length > 0) book.dogEars = dogEarsOf(kept);
    if (kept.pageFolds.length > 0) book.folds = kept.pageFolds;
    if (kept.shifts.length > 0) book.shifts = kept.shifts;
    if (kept.zoom > 1) book.zoom = kept.zoom;
  }

  #write(): void {
    if (this.#isOpen && this.#hasAddress) {
      const { page } = this.#home();
      writeAddress(this.#book.page, this.#source()?.first.anchor?.(page - 1) ?? null);
    }
    this.#keep();
  }

  #keep(): void {
    const source = this.#source();
    if (!this.#isOpen || !source || !this.#book.hasAttribute("remember")) return;
    const { zoom } = this.#book;
    const { page, lists } = this.#home();
    const { bookmarks, shifts, dogEars, folds: pageFolds } = lists;
    const { first } = source;
    const pages = [page, ...bookmarks, ...pageFolds.map((fold) => fold.page)];
    const anchors = first.anchor && pages.map((one) => first.anchor?.(one - 1) ?? "");
    const size = this.#textSize();
    const typography = this.#said(typographyAttributes);
    const counts = first.keptCounts;
    const known = { ...(size.width > 0 && { size }), ...(counts && { counts }) };
    const text = anchors ? { text: { anchors, typography, ...known } } : {};
    const folds = dogEars.map(
      ({ page, corner, size }): SavedDogEar => [
        bookmarks.indexOf(page),
        corner === "head" ? 1 : 0,
        size,
      ],
    );
    const seen = this.#said(seenAttributes);
    const place = { page, zoom, bookmarks, shifts, folds, pageFolds, seen, ...text };
    savePlace(this.#name(source), place);
  }

  /** Returns those of some attributes that the element has, and their values. */
  #said(names: readonly string[]): Record<string, string> {
    const said = names.map((name) => [name, this.#book.getAttribute(name) ?? ""]);
    return Object.fromEntries(said.filter(([, value]) => value !== ""));
  }

  #loaded(source: PageList): SavedPlace | null {
    if (this.#restored?.source === source) return this.#restored.place;
    return loadPlace(this.#name(source));
  }

  /** Returns what identifies a book: its address, its title, its length as it opens unless text flows in it. */
  #name(source: PageList): string {
    const { title, pageCount, anchor } = source.first;
    return `${this.#addresses.get(source) ?? this.#book.src} ${anchor ? "text" : pageCount} ${title}`;
  }
}

/** A place in a book that is about to open. */
interface RestoredPlace {
  readonly source: PageList;
  /** The page (from 1) that has the text of an anchor; null if no anchor is known. */
  readonly page: number | null;
  /** Whether the address names a place. */
  readonly isAsked: boolean;
  /** What was kept of the book, its pages as they lie now. */
  readonly place: SavedPlace | null;
}

/** A folded corner: the index of its page's bookmark, whether it is at the head, and its size. */
type SavedDogEar = readonly [bookmark: number, isHead: 0 | 1, size: number];

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
  /** The folded corners of bookmarked pages. */
  readonly folds: readonly SavedDogEar[];
  /** The folds of pages besides their corners. */
  readonly pageFolds: readonly PageFold[];
  /** The attributes that say how it is seen. */
  readonly seen: Readonly<Record<string, string>>;
  /** Of flowing text, whose pages change with its size. */
  readonly text?: {
    /** The anchor of the page, those of the bookmarks, and those of the folds' pages. */
    readonly anchors: readonly string[];
    /** The attributes that say how it is set. */
    readonly typography: Readonly<Record<string, string>>;
    /** The size of pages for which it is set, CSS pixels; absent if that was unknown. */
    readonly size?: PageSize;
    /** The numbers of its pages, as `PageSource.keptCounts`; absent if that was unknown. */
    readonly counts?: string;
  };
}

/** The attributes that say from where a book is seen, and in which colours. */
const seenAttributes = ["tilt", ...themeAttributes] as const;

/** Everything is under one key, the last book read first. */
const key = "turnleaf";
const mostBooks = 100;
const longestName = 300;
/** Folded corners, and other folds; anchors of the page, of 500 bookmarks and of as many folds. */
const mostFolds = 500;
const mostAnchors = 1001;
/** Characters of an attribute's value. */
const longestValue = 20;
const longestStore = 400_000;
/** CSS pixels. */
const longestPage = 100_000;

/** Returns the state kept of the book of a name, or null. */
export function loadPlace(name: string): SavedPlace | null {
  const found = read().find(([other]) => other === short(name));
  if (found === undefined) return null;
  const [, page, zoom, bookmarks, shifts, text, folds, pageFolds, seen] = found;
  return {
    page: isPage(page) ? page : 1,
    zoom: typeof zoom === "number" && zoom >= 1 && zoom <= 8 ? zoom : 1,
    bookmarks: cleanPages(bookmarks),
    shifts: cleanPages(shifts),
    folds: Array.isArray(folds) ? folds.slice(0, mostFolds).filter(isSavedDogEar) : [],
    pageFolds: cleanFolds(
      Array.isArray(pageFolds) ? pageFolds.slice(0, mostFolds).map(foldOf) : [],
    ),
    seen: cleanAttributes(seenAttributes, seen),
    ...cleanText(text),
  };
}

/** Returns whether a value is a folded corner, as this code writes it. */
function isSavedDogEar(value: unknown): value is SavedDogEar {
  return (
    Array.isArray(value) && value.length === 3 && value.every((one) => typeof one === "number")
  );
}

/** Returns a value as a fold of a page, as this code writes it: numbers, which are still to be checked. */
function foldOf(row: unknown): unknown {
  if (!Array.isArray(row)) return null;
  const [page, fromX, fromY, toX, toY, angle] = row;
  return { page, from: { x: fromX, y: fromY }, to: { x: toX, y: toY }, angle };
}

/** Returns the folded corners of the bookmarked pages that are kept. */
function dogEarsOf({ bookmarks, folds }: SavedPlace): readonly DogEar[] {
  return cleanDogEars(
    folds.map(([bookmark, isHead, size]) => {
      return { page: bookmarks[bookmark], corner: isHead === 1 ? "head" : "foot", size };
    }),
  );
}

/** Returns what is kept of flowing text, as far as it is what this code writes. */
function cleanText(text: unknown): Pick<SavedPlace, "text"> {
  if (!Array.isArray(text)) return {};
  const [anchors, said, size, counts] = text;
  if (!Array.isArray(anchors) || !anchors.every((one) => typeof one === "string")) return {};
  const typography = cleanAttributes(typographyAttributes, said);
  const known = { ...cleanSize(size), ...(typeof counts === "string" && counts && { counts }) };
  return { text: { anchors: anchors.slice(0, mostAnchors), typography, ...known } };
}

/** Returns the size that is kept of pages, likewise. */
function cleanSize(size: unknown): { readonly size?: PageSize } {
  if (!Array.isArray(size) || size.length !== 2) return {};
  const [width, height]: unknown[] = size;
  const isLength = (length: unknown): length is number =>
    typeof length === "number" && length > 0 && length < longestPage;
  return isLength(width) && isLength(height) ? { size: { width, height } } : {};
}

/** Returns what is kept of some attributes, likewise. */
function cleanAttributes(names: readonly string[], kept: unknown): Record<string, string> {
  const values = Object(kept) as Record<string, unknown>;
  const said = names.map((name) => [name, values[name]] as const);
  return Object.fromEntries(
    said.flatMap(([name, value]) =>
      typeof value === "string" ? [[name, value.slice(0, longestValue)]] : [],
    ),
  );
}

/** Keeps a book; the one read longest ago is dropped. */
export function savePlace(name: string, place: SavedPlace): void {
  const { page, zoom, bookmarks, shifts, folds, pageFolds, text, seen } = place;
  const others = read().filter(([other]) => other !== short(name));
  const row: unknown[] = [short(name), page, Math.round(zoom * 100) / 100, bookmarks, shifts];
  const rows = pageFolds.map(({ page, from, to, angle }) => [
    page,
    from.x,
    from.y,
    to.x,
    to.y,
    angle,
  ]);
  const isSeen = Object.keys(seen).length > 0;
  const hasMore = folds.length > 0 || rows.length > 0 || isSeen;
  const size = text?.size ? [text.size.width, text.size.height] : null;
  const known = text?.counts ? [size, text.counts] : size ? [size] : [];
  if (text || hasMore) row.push(text ? [text.anchors, text.typography, ...known] : null);
  if (hasMore) row.push(folds, rows);
  if (isSeen) row.push(seen);
  const all = [row, ...others].slice(0, mostBooks).map((one) => JSON.stringify(one));
  // What is longer than it may be is not read again.
  while (all.length > 1 && all.join(",").length + 2 > longestStore) all.pop();
  try {
    localStorage.setItem(key, `[${all.join(",")}]`);
  } catch {
    // Full, or forbidden.
  }
}

/** Returns rows of name, page, zoom, bookmarks, shifts, text, folded corners, folds and how it is seen (if any); only the name is checked. */
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

const textPattern = /(^#?|&)at=([\w:.~-]{1,40})(?=&|$)/;

/**
 * Returns the anchor of the text that a fragment such as `#page=12&at=3:1204`
 * names; null if it names none.
 */
export function anchorOfHash(hash: string): string | null {
  return textPattern.exec(hash)?.[2] ?? null;
}

/** Returns the fragment with another page in it, and the anchor of its text if it has one; the rest stays. */
export function hashWithPage(hash: string, page: number, anchor: string | null = null): string {
  const rest = hash
    .replace(/&at=[\w:.~-]{1,40}(?=&|$)/, "")
    .replace(/^#at=[\w:.~-]{1,40}(&|$)/, "#");
  const place = anchor === null ? `page=${page}` : `page=${page}&at=${anchor}`;
  if (pageInHash.test(rest)) return rest.replace(pageInHash, `$1${place}`);
  return rest.length > 1 ? `${rest}&${place}` : `#${place}`;
}

/** Writes the page, and the anchor of its text if it has one, into the address, without a step in the history. */
function writeAddress(page: number, anchor: string | null): void {
  const hash = hashWithPage(location.hash, page, anchor);
  if (hash === location.hash) return;
  try {
    history.replaceState(history.state, "", hash);
  } catch {
    // Browsers throw if it is called too often, and in a page without an address of its own.
  }
}

/** Adds a step to the history, which has the same address until another is written. Returns whether the browser did. */
function stepInHistory(): boolean {
  try {
    history.pushState(history.state, "", location.href);
    return true;
  } catch {
    // As above.
    return false;
  }
}
