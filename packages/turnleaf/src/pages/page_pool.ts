import { unknownFailure } from "../sources/failures.ts";
import type { BookError, PagePicture, PageSource } from "../sources/page_source.ts";
import {
  type Bounds,
  dropOrder,
  type HeldPage,
  isAsWanted,
  pictureBytes,
  type WantedPage,
  withinBudget,
} from "./page_budget.ts";

export type { WantedPage } from "./page_budget.ts";

export interface PagePoolOptions {
  /** A better bitmap of the page has arrived, or its drawing failed. */
  readonly onArrive?: (index: number) => void;
  /**
   * The bitmap is about to be closed: free whatever was made of it. Called
   * after `onArrive` of a better one.
   */
  readonly onDrop?: (picture: PagePicture) => void;
  /** A page without any bitmap takes long to draw; its drawing continues. */
  readonly onSlow?: (index: number) => void;
  /**
   * Calls back after some milliseconds, and returns a function that cancels it.
   * The default is a timer.
   */
  readonly later?: (call: () => void, milliseconds: number) => () => void;
  /** Maximum of pages held at once. The default is 12. */
  readonly maxPages?: number;
  /** Maximum of bytes of bitmaps held at once, 4 per pixel. The default is 192 MB. */
  readonly maxBytes?: number;
  /** Pages drawn at the same time. The default is 2. */
  readonly drawing?: number;
  /**
   * Returns a time in milliseconds, to learn whether a rough bitmap arrives
   * much sooner than a sharp one.
   */
  readonly now?: () => number;
}

/** Width of a rough bitmap as a fraction of the wanted width. */
const roughFraction = 1 / 3;
/** A sharp bitmap that takes no longer than this, in milliseconds, needs no rough one before it. */
const quick = 40;

/** A drawing that takes longer than this, in milliseconds, counts as slow. */
export const slowTime = 5000;

/** What the pool needs of a book. */
export type PoolSource = Pick<PageSource, "pageCount" | "title" | "draw">;

interface Job {
  readonly index: number;
  readonly width: number;
  readonly rough: boolean;
  readonly controller: AbortController;
  isSlow: boolean;
  /** Cancels the timer that marks it as slow. */
  readonly cancelTimer: () => void;
}

/**
 * Keeps the wanted pages drawn, within a bound on memory. It works only while
 * something wanted is missing: at rest it has no timer and no request.
 */
export class PagePool {
  readonly #source: PoolSource;
  readonly #options: PagePoolOptions;
  readonly #held = new Map<number, HeldPage>();
  readonly #failed = new Map<number, BookError>();
  readonly #jobs = new Map<number, Job>();
  /** Height over width of every page drawn so far. */
  readonly #ratios = new Map<number, number>();
  /** Mean milliseconds of a rough and of a sharp drawing; 0 before the first. */
  readonly #mean = { rough: 0, sharp: 0 };
  #wanted: readonly WantedPage[] = [];
  #inSight = 0;
  #isPaused = false;
  #isClosed = false;

  constructor(source: PoolSource, options: PagePoolOptions = {}) {
    this.#source = source;
    this.#options = options;
  }

  /**
   * Sets the wanted pages, the most urgent first: the visible ones, then those
   * that may become visible next. Replaces the previous list. Drawings of pages
   * no longer on it are aborted; a failed page is tried again once it has been
   * off the list.
   *
   * @param inSight how many of the first are visible: rough bitmaps are drawn
   * only for them, and they are never dropped
   */
  want(pages: readonly WantedPage[], inSight = 2): void {
    if (this.#isClosed) return;
    this.#inSight = inSight;
    const valid = pages.filter(({ index }) => index >= 0 && index < this.#source.pageCount);
    this.#wanted = valid.filter(
      ({ index }, at) => valid.findIndex((other) => other.index === index) === at,
    );
    const indices = new Set(this.#wanted.map(({ index }) => index));
    for (const index of this.#failed.keys()) {
      if (!indices.has(index)) this.#failed.delete(index);
    }
    for (const job of [...this.#jobs.values()]) {
      if (!indices.has(job.index)) this.#abort(job);
    }
    this.#trim();
    this.#drawNext();
  }

  /** Returns the best bitmap of page `index`, or null. The pool keeps ownership. */
  get(index: number): PagePicture | null {
    return this.#held.get(index)?.picture ?? null;
  }

  /**
   * Returns the width of that bitmap in device pixels: 0 if there is none or a
   * sharper one is to come, infinite if the source has no sharper one.
   */
  sharpness(index: number): number {
    const held = this.#held.get(index);
    if (held === undefined) return 0;
    const wanted = this.#wanted.find((page) => page.index === index);
    if (wanted && held.asked < wanted.width && !this.#failed.has(index)) return 0;
    // A page of other proportions than requested may be a pixel narrower by rounding.
    return held.picture.width < held.asked - 2 ? Number.POSITIVE_INFINITY : held.picture.width;
  }

  /** Returns why page `index` has no bitmap; null while it has one or may yet get one. */
  failed(index: number): BookError | null {
    return this.#held.has(index) ? null : (this.#failed.get(index) ?? null);
  }

  /** Returns whether page `index` has no bitmap yet because its drawing takes long. */
  slow(index: number): boolean {
    return !this.#held.has(index) && this.#jobs.get(index)?.isSlow === true;
  }

  /**
   * Renumbers the pages after a change of the book: bitmaps stay with their
   * pages.
   *
   * @param moved returns where a page lies now; null if it was removed
   */
  renumber(moved: (index: number) => number | null): void {
    for (const job of [...this.#jobs.values()]) this.#abort(job);
    this.#wanted = [];
    for (const index of this.#held.keys()) if (moved(index) === null) this.#drop(index);
    this.#failed.clear();
    for (const kept of [this.#held, this.#ratios] as Map<number, unknown>[]) {
      const entries = [...kept];
      kept.clear();
      for (const [index, value] of entries) {
        const now = moved(index);
        if (now !== null) kept.set(now, value);
      }
    }
  }

  /** Takes the bitmap of page `index` out of the pool; null if it has none. The caller owns it. */
  take(index: number): PagePicture | null {
    const picture = this.get(index);
    this.#held.delete(index);
    return picture;
  }

  /** Marks the bitmap of page `index` as out of date; it is kept until another is drawn. */
  redraw(index: number): void {
    const job = [...this.#jobs.values()].find((running) => running.index === index);
    if (job) this.#abort(job);
    const held = this.#held.get(index);
    if (held) this.#held.set(index, { ...held, asked: 0 });
    this.#drawNext();
  }

  /** Whether the bitmap of a page has been out of date since `redraw`. */
  isOutdated(index: number): boolean {
    return this.#held.get(index)?.asked === 0;
  }

  /** Forgets failures, so that the pages on the list are tried again. */
  retry(): void {
    this.#failed.clear();
    this.#drawNext();
  }

  /**
   * While paused, drawing starts only for a visible page without any bitmap:
   * while a leaf turns, frames come first.
   */
  set paused(paused: boolean) {
    this.#isPaused = paused;
    if (!paused) this.#drawNext();
  }

  get paused(): boolean {
    return this.#isPaused;
  }

  /** Whether every visible page is as sharp as requested, or has failed. */
  get settled(): boolean {
    return this.#wanted
      .slice(0, this.#inSight)
      .every((page) => this.#failed.has(page.index) || this.#isHeld(page));
  }

  /** Whether every listed page that fits in memory is as sharp as requested, or has failed. */
  get ready(): boolean {
    const affordable = withinBudget(this.#wanted, this.#held, this.#bounds, this.#ratios);
    return this.#wanted.every(
      (page) => this.#failed.has(page.index) || !affordable.has(page.index) || this.#isHeld(page),
    );
  }

  /** Bytes of the bitmaps held. */
  get bytes(): number {
    let bytes = 0;
    for (const held of this.#held.values()) bytes += held.bytes;
    return bytes;
  }

  /** Aborts everything and drops every bitmap. The source stays open: its owner closes it. */
  close(): void {
    this.#isClosed = true;
    this.#wanted = [];
    for (const job of [...this.#jobs.values()]) this.#abort(job);
    for (const index of [...this.#held.keys()]) this.#drop(index);
  }

  #drawNext(): void {
    while (!this.#isClosed && this.#isFree) {
      const job = this.#nextJob();
      if (!job) return;
      this.#jobs.set(job.index, job);
      void this.#run(job);
    }
  }

  /**
   * Whether another drawing may start. Slow ones take no place of others, up to
   * as many as there are places.
   */
  get #isFree(): boolean {
    const { drawing = 2 } = this.#options;
    const slow = [...this.#jobs.values()].filter(({ isSlow }) => isSlow).length;
    return this.#jobs.size - Math.min(slow, drawing) < drawing;
  }

  /**
   * Returns the next drawing: first a bitmap of each visible page, then sharp
   * ones of all, in order.
   */
  #nextJob(): Job | null {
    const open = this.#wanted.filter(
      ({ index }) => !this.#jobs.has(index) && !this.#failed.has(index),
    );
    const bare = open.find((page) => this.#isInSight(page) && !this.#held.has(page.index));
    if (bare) return this.#job(bare, !bare.isRough && this.#roughPays);
    if (this.#isPaused) return null;
    const affordable = withinBudget(this.#wanted, this.#held, this.#bounds, this.#ratios);
    const next = open.find((page) => !this.#isHeld(page) && affordable.has(page.index));
    return next ? this.#job(next, false) : null;
  }

  #job({ index, width }: WantedPage, rough: boolean): Job {
    const asked = rough ? Math.ceil(width * roughFraction) : width;
    const later = this.#options.later ?? timer;
    const cancelTimer = later(() => this.#markSlow(job), slowTime);
    const job = {
      index,
      width: asked,
      rough,
      controller: new AbortController(),
      isSlow: false,
      cancelTimer,
    };
    return job;
  }

  /** Marks a drawing as slow, so that others go on beside it. */
  #markSlow(job: Job): void {
    if (this.#jobs.get(job.index) !== job) return;
    job.isSlow = true;
    if (!this.#held.has(job.index)) this.#options.onSlow?.(job.index);
    this.#drawNext();
  }

  /** Ends a drawing: done, failed or aborted. */
  #end(job: Job): void {
    job.cancelTimer();
    this.#jobs.delete(job.index);
  }

  /** Whether a page has a bitmap as wide as it is wanted. */
  #isHeld(page: WantedPage): boolean {
    return isAsWanted(page, this.#held.get(page.index));
  }

  #isInSight(page: WantedPage): boolean {
    return this.#wanted.indexOf(page) < this.#inSight;
  }

  /**
   * Whether a rough bitmap is worth drawing before the sharp one. The first pages are drawn sharp
   * at once; if that takes long, one is drawn roughly, to learn whether that is much quicker.
   */
  get #roughPays(): boolean {
    const { rough, sharp } = this.#mean;
    return sharp > quick && rough < sharp / 2;
  }

  async #run(job: Job): Promise<void> {
    const start = this.#now();
    const { signal } = job.controller;
    try {
      const picture = await this.#source.draw(job.index, job.width, signal);
      if (signal.aborted) {
        closePicture(picture);
        return;
      }
      this.#learn(job, this.#now() - start);
      this.#end(job);
      this.#hold(job, picture);
    } catch (error) {
      if (signal.aborted) return;
      this.#end(job);
      this.#failed.set(job.index, this.#asBookError(error, job.index));
      this.#options.onArrive?.(job.index);
    }
    this.#drawNext();
  }

  #learn(job: Job, milliseconds: number): void {
    const kind = job.rough ? "rough" : "sharp";
    const before = this.#mean[kind];
    this.#mean[kind] = before === 0 ? milliseconds : 0.7 * before + 0.3 * milliseconds;
  }

  #hold(job: Job, picture: PagePicture): void {
    const before = this.#held.get(job.index);
    this.#ratios.set(job.index, picture.height / Math.max(1, picture.width));
    this.#held.set(job.index, { picture, asked: job.width, bytes: pictureBytes(picture) });
    this.#options.onArrive?.(job.index);
    if (before) this.#release(before.picture);
    this.#trim();
  }

  /** Drops the least wanted pages until the rest are within bounds. */
  #trim(): void {
    const bounds = this.#bounds;
    let bytes = this.bytes;
    for (const index of dropOrder(this.#wanted, this.#held)) {
      const isTooMuch = this.#held.size > bounds.pages || bytes > bounds.bytes;
      const held = this.#held.get(index);
      const isVisible = this.#wanted.slice(0, this.#inSight).some((page) => page.index === index);
      if (!isTooMuch || !held || isVisible) return;
      bytes -= held.bytes;
      this.#drop(index);
    }
  }

  #drop(index: number): void {
    const held = this.#held.get(index);
    if (!held) return;
    this.#held.delete(index);
    this.#release(held.picture);
  }

  #release(picture: PagePicture): void {
    this.#options.onDrop?.(picture);
    closePicture(picture);
  }

  #abort(job: Job): void {
    this.#end(job);
    job.controller.abort(new DOMException("The page is no longer wanted.", "AbortError"));
  }

  #asBookError(error: unknown, index: number): BookError {
    const what = `Page ${index + 1} of ${this.#source.title} could not be drawn`;
    return unknownFailure(what, error, "turn back to it to try again", {
      page: index + 1,
      source: this.#source.title,
    });
  }

  #now(): number {
    return (this.#options.now ?? defaultNow)();
  }

  get #bounds(): Bounds {
    const { maxPages = 12, maxBytes = 192 << 20 } = this.#options;
    return { pages: maxPages, bytes: maxBytes, always: this.#inSight };
  }
}

function timer(call: () => void, milliseconds: number): () => void {
  const id = setTimeout(call, milliseconds);
  return () => clearTimeout(id);
}

function defaultNow(): number {
  return performance.now();
}

/** Frees a bitmap's memory at once. */
export function closePicture(picture: PagePicture): void {
  if ("close" in picture) picture.close();
  else picture.width = picture.height = 0;
}
