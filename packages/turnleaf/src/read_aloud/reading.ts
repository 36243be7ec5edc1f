/** Reads a book aloud: its recordings or its text, with what is read marked, and turns the pages as it goes. */

import { unknownFailure } from "../sources/failures.ts";
import type { BookError, NarratedClip, Narration } from "../sources/page_source.ts";
import { RecordingPlayer } from "./recording_player.ts";
import { speak } from "./speech.ts";

/** Clips of one recording that follow each other this closely are heard without a break, seconds. */
const joined = 0.05;

/** Milliseconds for which the sound goes on over a clip's end while the next one is not known yet. */
const longestOverrun = 50;

/** The part of the element that is read aloud. */
export interface BookReadAloud extends EventTarget {
  readonly page: number;
  readonly bookTitle: string;
  /** The open pages. */
  readonly spread: { readonly left: number | null; readonly right: number | null };
  /** "turning" while its leaves turn. */
  readonly state: string;
  turnTo(page: number): Promise<boolean>;
}

/** One reading of an open book. */
export class Reading {
  readonly #book: BookReadAloud;
  readonly #narration: Narration;
  readonly #language: string;
  readonly #player: RecordingPlayer;
  readonly #ended = new AbortController();
  /** The clip that is heard, and its number. */
  #clip: NarratedClip | null = null;
  #number: number | null = null;
  /** Aborts when the reader leaves that clip. */
  #left = new AbortController();
  /** The fraction of it that has been heard. */
  #heard = 0;
  /** The page that a turn under way leads to. */
  #turningTo: number | null = null;

  /** @param language BCP 47 tag of the text; "" if unknown */
  constructor(book: BookReadAloud, narration: Narration, language: string) {
    this.#book = book;
    this.#narration = narration;
    this.#language = language;
    this.#player = new RecordingPlayer(book.bookTitle, () => this.stop());
  }

  /**
   * Reads from the first open page on. Resolves at the end of the book, when
   * `stop` is called, or when something cannot be read: that is an `error` of
   * the element.
   *
   * @param ended called at the end, before it is reported
   *
   * @param failed called if something cannot be read
   */
  async run(ended: () => void, failed: (error: BookError) => void): Promise<void> {
    this.#report(true);
    try {
      await this.#read();
    } catch (error) {
      const what = `${this.#book.bookTitle} cannot be read aloud`;
      const detail = { code: "silent", source: this.#book.bookTitle } as const;
      failed(unknownFailure(what, error, "update the browser, or get the book again", detail));
    }
    ended();
    this.#report(false);
  }

  /** Ends the reading. */
  stop(): void {
    this.#ended.abort();
    this.#left.abort();
    this.#player.pause();
  }

  /** Resolves when the reading has ended. Rejects with a `BookError` if something cannot be read. */
  async #read(): Promise<void> {
    const { signal } = this.#ended;
    this.#book.addEventListener("pagechange", () => this.#follow(), { signal });
    this.#book.addEventListener("pageschange", () => void this.#placeAnew(), { signal });
    const narration = this.#narration;
    try {
      let number = await this.#firstClip();
      let next = number === null ? null : narration.clip(number, signal);
      let goesOn = false;
      while (number !== null) {
        const clip = await next;
        if (!clip) break;
        this.#left = new AbortController();
        [this.#clip, this.#number] = [clip, number];
        narration.mark(number);
        next = narration.clip(number + 1, signal);
        const isFollowed = await this.#hear(clip, goesOn, next);
        signal.throwIfAborted();
        const isLeft = this.#left.signal.aborted;
        goesOn = isFollowed && !isLeft;
        number = isLeft ? await this.#firstClip() : number + 1;
        if (isLeft && number !== null) next = narration.clip(number, signal);
      }
    } catch (error) {
      if (!signal.aborted) throw error;
    } finally {
      this.stop();
      this.#player.close();
      narration.mark(null);
    }
  }

  #report(reading: boolean): void {
    this.#book.dispatchEvent(new CustomEvent("readaloudchange", { detail: { reading } }));
  }

  #firstClip(): Promise<number | null> {
    return this.#narration.clipFrom(this.#book.page - 1, this.#ended.signal);
  }

  /** Leaves the clip where the reader has turned away from it; else turns as far as it is heard. */
  #follow(): void {
    if (this.#clip?.pages.some(({ page }) => this.#isOpen(page))) this.#show(this.#heard);
    else {
      this.#player.pause();
      this.#left.abort();
    }
  }

  /** Finds where the clip stands once the pages are others. */
  async #placeAnew(): Promise<void> {
    const number = this.#number;
    if (number === null) return;
    const clip = await this.#narration.clip(number, this.#ended.signal).catch(() => null);
    if (clip === null || number !== this.#number || this.#ended.signal.aborted) return;
    this.#clip = clip;
    this.#narration.mark(number);
  }

  /**
   * Resolves when a clip has been heard, or is left, to whether the sound goes
   * on as the next one. Rejects with a `BookError`.
   *
   * @param goesOn whether the sound goes on as this one
   */
  async #hear(
    clip: NarratedClip,
    goesOn: boolean,
    next: Promise<NarratedClip | null>,
  ): Promise<boolean> {
    const left = this.#left.signal;
    const { recording } = clip;
    const heard = (fraction: number): void => this.#show(fraction);
    heard(0);
    if (recording === null) {
      this.#player.pause();
      await speak(clip.text, this.#language, left, heard);
      return false;
    }
    await this.#player.play({ ...clip, recording }, goesOn, left, heard);
    const following = left.aborted ? null : await soon(next);
    const isFollowed = follows(following, clip);
    if (!isFollowed) this.#player.pause();
    return isFollowed;
  }

  /** Turns to the page on which the text stands once some fraction of the clip has been heard. */
  #show(fraction: number): void {
    this.#heard = fraction;
    // A reader who jumps is followed once the book rests: `#follow` is called then.
    if (this.#book.state === "turning" && this.#turningTo === null) return;
    const pages = this.#clip?.pages ?? [];
    const page = (pages.findLast(({ from }) => from <= fraction) ?? pages[0])?.page;
    if (page === undefined || page === this.#turningTo || this.#isOpen(page)) return;
    this.#turningTo = page;
    void this.#book.turnTo(page + 1).finally(() => {
      if (this.#turningTo === page) this.#turningTo = null;
    });
  }

  /** @param page from 0 */
  #isOpen(page: number): boolean {
    const { left, right } = this.#book.spread;
    return page + 1 === left || page + 1 === right;
  }
}

/** Resolves to the next clip; null if it is not known in time, or fails: that is reported at its turn. */
function soon(next: Promise<NarratedClip | null>): Promise<NarratedClip | null> {
  return Promise.race([
    next.catch(() => null),
    new Promise<null>((resolve) => setTimeout(resolve, longestOverrun, null)),
  ]);
}

/** Returns whether a clip goes on where another ends. */
function follows(next: NarratedClip | null, clip: NarratedClip): boolean {
  return next?.recording === clip.recording && Math.abs(next.begin - clip.end) <= joined;
}
