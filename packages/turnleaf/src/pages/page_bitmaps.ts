/** The bitmaps shown on leaves: the pool's own, fitted to the leaf, or stand-ins. */

import { loadPart } from "../sources/load_part.ts";
import type {
  BookError,
  PageBox,
  PagePicture,
  PageSize,
  PageSource,
} from "../sources/page_source.ts";
import { lookOf, type PageTheme, type ThemeLook } from "../themes.ts";
import { coverStamp } from "./cover_stamp.ts";
import {
  foldAt,
  isFoldOut,
  type PrintedOn,
  panelsOf,
  placeOnLeaf,
  wholeLeaf,
} from "./page_place.ts";
import { closePicture, PagePool, type PagePoolOptions, type PoolSource } from "./page_pool.ts";
import { barePage, failedPage, slowPage, waitingPage, whitePage } from "./stand_in.ts";

/** Callbacks for changes of bitmaps. */
export interface PageBitmapsOptions {
  /**
   * The bitmap of a page (from 1) has changed, its drawing failed, or its
   * stand-in says something else.
   */
  readonly onArrive: (page: number) => void;
  /** A bitmap will not be used again; textures made of it can be freed. */
  readonly onDrop: (picture: PagePicture) => void;
  /** Returns the sentence for a page that takes long to draw, from its label. */
  readonly slowText?: (label: string) => string;
  /** Returns the sentence for a page (from 1) that cannot be drawn. The default is the error's own. */
  readonly failureText?: (error: BookError, page: number) => string;
  /** The theme of bare paper and of what stands in for pages, until `recolour`. The default is `light`. */
  readonly theme?: PageTheme;
  /** As in the pool's options. */
  readonly later?: PagePoolOptions["later"];
}

/**
 * Number of stand-ins kept: more than a riffle shows at once, because a visible
 * one may not be dropped.
 */
const standInsKept = 32;

/** Width at which a page that passes by is recognisable, device pixels. */
const leastRoughWidth = 512;

/** The pages wanted, most urgent first. */
interface PagesWanted {
  readonly pages: readonly number[];
  /** How many of the first are visible now, and how many of those lie open. */
  readonly inSight: number;
  readonly lyingOpen: number;
}

/** A page as it was drawn: its bitmap, of its leaf's proportions. */
export interface DrawnPage {
  readonly picture: PagePicture;
  /** The part of its leaf that the page covers, fractions from the upper left corner. */
  readonly place: PageBox;
  /** Whether the page looks otherwise by now. */
  readonly isOutdated: boolean;
}

/** Pages whose bitmaps follow what they show while they turn. */
export interface LiveBitmaps {
  /**
   * Returns a canvas that shows a page (from 1) as it looks now; null where it looks as it was
   * drawn.
   */
  bitmapOf(page: number, drawn: DrawnPage): HTMLCanvasElement | null;
}

/** An open fold-out: the bitmaps of its parts, and the part of its leaf that all of it covers. */
export interface OpenFoldOut {
  readonly page: PagePicture;
  readonly flap: PagePicture;
  readonly back: PagePicture;
  readonly place: PageBox;
}

/** Maximum of pixels across a fold-out. */
const mostAcross = 4096;

/** Loads what pages of other sizes than the leaf's need. */
const fitting = () => loadPart(import("./fit.ts"));

/** A book's pages as bitmaps of its leaf's proportions. */
export class PageBitmaps {
  readonly #source: PageSource;
  readonly #pool: PagePool;
  #leaf: PageSize;
  #aspect: number;
  readonly #options: PageBitmapsOptions;
  #inSight: ReadonlySet<number> = new Set();
  readonly #standIns = new Map<string, HTMLCanvasElement>();
  /** Draws pages as they look now, while leaves are in flight; null at rest. */
  live: LiveBitmaps | null = null;

  /** What each page is printed on, and the part of its leaf that each page drawn so far covers. */
  #printedOn: (page: number) => PrintedOn = () => "left";
  readonly #places = new Map<number, PageBox>();
  #unfolded: { number: number; parts: OpenFoldOut } | null = null;

  #look: ThemeLook;

  /** @param leaf size of the book's leaves, in the source's unit */
  constructor(source: PageSource, leaf: PageSize, options: PageBitmapsOptions) {
    this.#look = lookOf(options);
    this.#source = source;
    this.#leaf = leaf;
    this.#aspect = leaf.width / leaf.height;
    this.#options = options;
    // Fitted before the pool holds it: its bounds then apply to the memory really held.
    const draw: PageSource["draw"] = async (index, width, signal) => {
      const before = this.placeOf(index + 1, await source.size(index, signal));
      const picture = await source.draw(index, Math.ceil(width * before.width), signal);
      // A scan's true size is known only now.
      const place = this.placeOf(index + 1, await source.size(index, signal));
      this.#places.set(index + 1, place);
      if (place === wholeLeaf) return picture;
      try {
        const { fitToLeaf } = await fitting();
        return fitToLeaf(picture, place, this.#aspect, width, this.#look.paper);
      } finally {
        closePicture(picture);
      }
    };
    const book: PoolSource = {
      get pageCount() {
        return source.pageCount;
      },
      title: source.title,
      draw,
    };
    this.#pool = new PagePool(book, {
      onArrive: (index) => options.onArrive(index + 1),
      onDrop: options.onDrop,
      onSlow: (index) => options.onArrive(index + 1),
      later: options.later,
    });
  }

  /**
   * Requests pages (from 1).
   *
   * @param widthOf returns the width of one, device pixels
   * @param roughly if true, pages in flight are wanted only roughly: two dozen
   * sharp ones would take more memory than the pool may
   */
  want(
    { pages, inSight, lyingOpen }: PagesWanted,
    widthOf: (page: number) => number,
    roughly: boolean,
  ): void {
    this.#inSight = new Set(pages.slice(0, inSight));
    const wanted = pages.map((page, at) => {
      const width = widthOf(page);
      const rough = Math.min(width, Math.max(Math.ceil(width / 3), leastRoughWidth));
      const isRough = roughly && at >= lyingOpen && at < inSight;
      return { index: page - 1, width: isRough ? rough : width, isRough };
    });
    this.#pool.want(wanted, inSight);
  }

  /**
   * Sets what each page (from 1) is printed on: where its spine is, or that it
   * is on a board. Bitmaps that lie otherwise than before are dropped.
   */
  bind(printedOn: (page: number) => PrintedOn): void {
    const before = this.#printedOn;
    this.#printedOn = printedOn;
    for (const [page, place] of this.#places) {
      if (before(page) === printedOn(page)) continue;
      this.#places.delete(page);
      if (place !== wholeLeaf) this.#pool.renumber((index) => (index === page - 1 ? null : index));
    }
  }

  /** Drops every bitmap, as leaves have another size now, in the source's unit. */
  measure(leaf: PageSize): void {
    this.#leaf = leaf;
    this.#aspect = leaf.width / leaf.height;
    this.foldIn();
    this.renumber(() => null);
    this.#dropStandIns();
  }

  /**
   * Returns the part of its leaf that a page (from 1) of some size covers, as
   * fractions from the upper left corner.
   */
  placeOf(page: number, size: PageSize): PageBox {
    const isTrue = this.#source.kind === "typeset";
    return placeOnLeaf(size, this.#leaf, isTrue, this.#printedOn(page));
  }

  /** Returns the same for a page that has had a bitmap; the whole leaf for others. */
  placeOfDrawn(page: number): PageBox {
    return this.#places.get(page) ?? wholeLeaf;
  }

  /**
   * Draws a fold-out (a page from 1) to be opened; it is shown so until it is
   * folded in. Resolves to null for a page that is not a fold-out. Rejects as
   * drawing does.
   */
  async unfold(page: number, width: number, signal: AbortSignal): Promise<OpenFoldOut | null> {
    const place = this.placeOfDrawn(page);
    if (!isFoldOut(place)) return null;
    const { unfold } = await fitting();
    const across = Math.min(Math.ceil(width * place.width), mostAcross);
    const picture = await this.#source.draw(page - 1, across, signal);
    const parts = { ...unfold(picture, place, this.#aspect, width, this.#look.paper), place };
    closePicture(picture);
    this.foldIn();
    this.#unfolded = { number: page, parts };
    return parts;
  }

  /** Shows every fold-out folded in again. */
  foldIn(): void {
    const { parts } = this.#unfolded ?? {};
    this.#unfolded = null;
    for (const picture of parts ? [parts.page, parts.flap, parts.back] : []) this.drop(picture);
  }

  /** Returns whether a place on a page's leaf, `x` from its left edge, is outside a folded flap. */
  isBare(page: number, x: number): boolean {
    const place = this.placeOfDrawn(page);
    if (!isFoldOut(place) || this.#unfolded?.number === page) return true;
    const free = foldAt - panelsOf(place).across;
    return place.x < 0 ? x > 1 - free : x < free;
  }

  /**
   * Renumbers the pages after a change of the book; `moved` returns where a
   * page (from 0) is now, or null.
   */
  renumber(moved: (index: number) => number | null): void {
    this.#inSight = new Set();
    // `bind` sets where their leaves are now.
    const on = this.#printedOn;
    const places = [...this.#places];
    const before = new Map<number, number>();
    this.#places.clear();
    for (const [page, place] of places) {
      const now = moved(page - 1);
      if (now === null) continue;
      this.#places.set(now + 1, place);
      before.set(now + 1, page);
    }
    this.#printedOn = (page) => on(before.get(page) ?? page);
    this.#pool.renumber(moved);
  }

  /**
   * Takes the bitmap of a page (from 1) that is about to be removed out of the pool; null if it
   * has none. The caller gives it back by `drop`.
   */
  take(page: number): PagePicture | null {
    return this.#pool.take(page - 1);
  }

  /** Closes a bitmap that was taken. */
  drop(picture: PagePicture): void {
    this.#options.onDrop(picture);
    closePicture(picture);
  }

  /** Marks the bitmap of a page (from 1) as out of date; it is shown until the next is drawn. */
  redraw(page: number): void {
    this.#pool.redraw(page - 1);
  }

  /** Marks all bitmaps as out of date, as pages are drawn in the colours of another theme. */
  recolour(theme: PageTheme): void {
    this.#look = lookOf({ theme });
    this.#dropStandIns();
    for (let index = 0; index < this.#source.pageCount; index++) this.#pool.redraw(index);
  }

  /** Returns the best available bitmap of a page (from 1), or a stand-in; never null. */
  get(page: number): PagePicture {
    if (this.#unfolded?.number === page) return this.#unfolded.parts.page;
    const picture = this.#pool.get(page - 1);
    if (picture === null) return this.#standIn(page);
    const place = this.placeOfDrawn(page);
    // A fold-out that is folded in shows a part of its page.
    if (this.live === null || isFoldOut(place)) return picture;
    const isOutdated = this.#pool.isOutdated(page - 1);
    return this.live.bitmapOf(page, { picture, place, isOutdated }) ?? picture;
  }

  /**
   * Returns the width of a page's bitmap in device pixels; 0 if a sharper one is
   * to come, infinite if no sharper one can be drawn.
   */
  sharpness(page: number): number {
    // On a folded fold-out, a sharper detail would lie over the flap.
    const isFolded = isFoldOut(this.placeOfDrawn(page));
    if (isFolded || this.#pool.failed(page - 1)) return Number.POSITIVE_INFINITY;
    return this.#pool.sharpness(page - 1);
  }

  /**
   * Returns the paper under a page (from 1) that is an element and lies over
   * it; null for other pages, and for fold-outs, which are bitmaps at any time.
   */
  under(page: number): PagePicture | null {
    const place = this.placeOfDrawn(page);
    if (!this.#source.element?.(page - 1) || isFoldOut(place)) return null;
    const { x, y, width, height } = place;
    return this.#keep(`under ${x} ${y} ${width} ${height}`, () => whitePage(this.#aspect, place));
  }

  /** As `get`, but null for a page out of sight that is not drawn, or is to be drawn anew, as in other colours. */
  getIfDrawn(page: number): PagePicture | null {
    const isDrawn = this.#pool.get(page - 1) !== null && !this.#pool.isOutdated(page - 1);
    return this.#inSight.has(page) || isDrawn ? this.get(page) : null;
  }

  /** Returns why a page (from 1) cannot be shown, or null. */
  failure(page: number): BookError | null {
    return this.#pool.failed(page - 1);
  }

  /** Blank paper. */
  get bare(): PagePicture {
    return this.#keep("bare", () => barePage(this.#aspect, this.#look));
  }

  /** Returns the title that is stamped on a front board of a cloth without a page; null if it stays plain. */
  stampOn(cloth: string): PagePicture | null {
    const { cover } = this.#source;
    if (cover !== "stamped" && cover !== "none") return null;
    return this.#keep(`stamp ${cloth}`, () => coverStamp(this.#source, this.#aspect, cloth));
  }

  /** Whether the visible pages are as sharp as requested, or have failed. */
  get settled(): boolean {
    return this.#pool.settled;
  }

  /** Whether the pages that may become visible next are so too, as far as memory allows. */
  get ready(): boolean {
    return this.#pool.settled && this.#pool.ready;
  }

  /** While leaves move, only pages without any bitmap are drawn. */
  set paused(paused: boolean) {
    this.#pool.paused = paused;
  }

  /** Drops every picture. */
  close(): void {
    this.foldIn();
    this.#pool.close();
    this.#dropStandIns();
  }

  #dropStandIns(): void {
    for (const canvas of this.#standIns.values()) this.#options.onDrop(canvas);
    this.#standIns.clear();
  }

  #standIn(page: number): PagePicture {
    const failure = this.#pool.failed(page - 1);
    if (failure) {
      const sentence = this.#options.failureText?.(failure, page) ?? failure.message;
      return this.#keep(`! ${sentence}`, () => failedPage(sentence, this.#aspect, this.#look));
    }
    const label = this.#source.label(page - 1);
    const sentence = this.#pool.slow(page - 1) && this.#options.slowText?.(label);
    if (sentence)
      return this.#keep(`… ${sentence}`, () => slowPage(sentence, this.#aspect, this.#look));
    return this.#keep(label, () => waitingPage(label, this.#aspect, this.#look));
  }

  #keep(key: string, make: () => HTMLCanvasElement): HTMLCanvasElement {
    const kept = this.#standIns.get(key) ?? make();
    // The map is in the order of requests: the first one is dropped.
    this.#standIns.delete(key);
    this.#standIns.set(key, kept);
    const oldest = this.#standIns.keys().next().value;
    if (this.#standIns.size > standInsKept && oldest !== undefined) {
      const canvas = this.#standIns.get(oldest);
      this.#standIns.delete(oldest);
      if (canvas) this.#options.onDrop(canvas);
    }
    return kept;
  }
}
