import { unknownFailure } from "../sources/failures.ts";
import type { BookError, PagePicture, PageSource } from "../sources/page_source.ts";
import {
  type Bounds,
  dropOrder,
  type Held,
  pictureBytes,
  type WantedPage,
  withinBudget,
} from "./page_budget.ts";

export type { WantedPage } from "./page_budget.ts";

export interface PagePoolOptions {
  /** A better picture of the page is there, or its drawing failed. */
  readonly onArrive?: (index: number) => void;
  /** The picture is about to be closed: free whatever was made of it. Called after `onArrive` of a better one. */
  readonly onDrop?: (picture: PagePicture) => void;
  /** A page of which there is nothing to show takes long to draw; it is drawn on. */
  readonly onSlow?: (index: number) => void;
  /** Calls back after some milliseconds, and returns how to call that off; a timer unless given. */
  readonly later?: (call: () => void, milliseconds: number) => () => void;
  /** Pages held at once; 12 unless given. */
  readonly maxPages?: number;
  /** Bytes of pictures held at once, 4 a pixel; 192 MB unless given. */
  readonly maxBytes?: number;
  /** Pages drawn at the same time; 2 unless given. */
  readonly drawing?: number;
  /** Milliseconds of a clock, to learn whether a rough picture comes much sooner than a sharp one. */
  readonly now?: () => number;
}

/** A rough picture's share of the wanted width. */
const roughShare = 1 / 3;
/** A sharp picture that takes no longer than this, in milliseconds, needs no rough one before it. */
const quick = 40;

/** A drawing that takes longer than this, in milliseconds, is a slow one. */
export const slowTime = 5000;

/** What the pool needs of a book. */
export type PoolSource = Pick<PageSource, "pageCount" | "title" | "draw">;

interface Job {
  readonly index: number;
  readonly width: number;
  readonly rough: boolean;
  readonly controller: AbortController;
  isSlow: boolean;
  /** Calls off the timer that marks it as slow. */
  readonly cancelTimer: () => void;
}

/**
 * Keeps the pages that are wanted drawn, and no more of them than memory
 * allows. It works only while something wanted is missing: at rest it has no
 * timer and no request.
 */
export class PagePool {
  readonly #source: PoolSource;
  readonly #options: PagePoolOptions;
  readonly #held = new Map<number, Held>();
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
   * The pages to have, the most urgent first: those in sight, then those that
   * may come into sight next. Replaces the list before. Drawings of pages no
   * longer on it are aborted; a page that failed is tried again once it has
   * been off the list.
   *
   * @param inSight how many of the first are in sight: rough pictures are drawn
   *   for them alone, and they are never dropped
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

  /** The best picture there is of page `index`; null while there is none. It stays the pool's own. */
  get(index: number): PagePicture | null {
    return this.#held.get(index)?.picture ?? null;
  }

  /** Width of that picture in device pixels: 0 of none, infinite where the source has no sharper one. */
  sharpness(index: number): number {
    const held = this.#held.get(index);
    if (held === undefined) return 0;
    // A page of other proportions than asked for may lack a pixel by rounding.
    return held.picture.width < held.asked - 2 ? Number.POSITIVE_INFINITY : held.picture.width;
  }

  /** Why page `index` has no picture; null while it has one or may yet get one. */
  failed(index: number): BookError | null {
    return this.#held.has(index) ? null : (this.#failed.get(index) ?? null);
  }

  /** Whether page `index` has no picture yet because its drawing takes long. */
  slow(index: number): boolean {
    return !this.#held.has(index) && this.#jobs.get(index)?.isSlow === true;
  }

  /**
   * The book's pages are others than before: pictures stay with their pages.
   *
   * @param moved where a page lies now; null where it is gone
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

  /** The picture of page `index` is out of date; it is held until another is drawn. */
  redraw(index: number): void {
    const job = [...this.#jobs.values()].find((running) => running.index === index);
    if (job) this.#abort(job);
    const held = this.#held.get(index);
    if (held) this.#held.set(index, { ...held, asked: 0 });
    this.#drawNext();
  }

  /** Forgets failures, so that the pages on the list are tried again. */
  retry(): void {
    this.#failed.clear();
    this.#drawNext();
  }

  /**
   * While paused, drawing starts only for a page in sight of which there is
   * nothing to show: for as long as a leaf turns, so that frames come first.
   */
  set paused(paused: boolean) {
    this.#isPaused = paused;
    if (!paused) this.#drawNext();
  }

  get paused(): boolean {
    return this.#isPaused;
  }

  /** Whether every page in sight is as sharp as it was asked for, or has failed. */
  get settled(): boolean {
    return this.#wanted
      .slice(0, this.#inSight)
      .every(
        ({ index, width }) =>
          this.#failed.has(index) || (this.#held.get(index)?.asked ?? 0) >= width,
      );
  }

  /** Whether every page on the list that memory allows is as sharp as it was asked for, or has failed. */
  get ready(): boolean {
    const affordable = withinBudget(this.#wanted, this.#held, this.#bounds, this.#ratios);
    return this.#wanted.every(
      ({ index, width }) =>
        this.#failed.has(index) ||
        !affordable.has(index) ||
        (this.#held.get(index)?.asked ?? 0) >= width,
    );
  }

  /** Bytes of the pictures held. */
  get bytes(): number {
    let bytes = 0;
    for (const held of this.#held.values()) bytes += held.bytes;
    return bytes;
  }

  /** Aborts everything and drops every picture. The source stays open: it is its owner's. */
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

  /** Whether another drawing may start: slow ones take no place of others', as many as there are places. */
  get #isFree(): boolean {
    const { drawing = 2 } = this.#options;
    const slow = [...this.#jobs.values()].filter(({ isSlow }) => isSlow).length;
    return this.#jobs.size - Math.min(slow, drawing) < drawing;
  }

  /** First a picture of each page in sight, then sharp ones of all, in order. */
  #nextJob(): Job | null {
    const open = this.#wanted.filter(
      ({ index }) => !this.#jobs.has(index) && !this.#failed.has(index),
    );
    const bare = open.find((page) => this.#isInSight(page) && !this.#held.has(page.index));
    if (bare) return this.#job(bare, !bare.isRough && this.#roughPays());
    if (this.#isPaused) return null;
    const affordable = withinBudget(this.#wanted, this.#held, this.#bounds, this.#ratios);
    const next = open.find(
      (page) => (this.#held.get(page.index)?.asked ?? 0) < page.width && affordable.has(page.index),
    );
    return next ? this.#job(next, false) : null;
  }

  #job({ index, width }: WantedPage, rough: boolean): Job {
    const asked = rough ? Math.ceil(width * roughShare) : width;
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

  /** A drawing takes long: others go on beside it. */
  #markSlow(job: Job): void {
    if (this.#jobs.get(job.index) !== job) return;
    job.isSlow = true;
    if (!this.#held.has(job.index)) this.#options.onSlow?.(job.index);
    this.#drawNext();
  }

  /** A drawing is over: done, failed or aborted. */
  #end(job: Job): void {
    job.cancelTimer();
    this.#jobs.delete(job.index);
  }

  #isInSight(page: WantedPage): boolean {
    return this.#wanted.indexOf(page) < this.#inSight;
  }

  #roughPays(): boolean {
    const { rough, sharp } = this.#mean;
    return sharp === 0 ? rough === 0 : sharp > quick && rough < sharp / 2;
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
    return unknownFailure(what, error, "turn back to it to try again");
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

/** Frees a picture's memory at once. */
export function closePicture(picture: PagePicture): void {
  if ("close" in picture) picture.close();
  else picture.width = picture.height = 0;
}
