/**
 * What a reader does with an open book besides turning it and marking its pages: search, being
 * read to, printing, keeping the place.
 */

import type { BookState } from "../book/turning.ts";
import type { Reading } from "../read_aloud/reading.ts";
import { loadPart } from "../sources/load_part.ts";
import type { PageList } from "../sources/page_list.ts";
import {
  type BookDetail,
  BookError,
  type OutlineEntry,
  type PagePicture,
  type PageSize,
  type Typography,
} from "../sources/page_source.ts";
import type { SearchHit } from "../text/searching.ts";
import { languageOf } from "../words/languages.ts";
import type { WarningDetail } from "./events.ts";
import { failureDetail, warningDetail } from "./failure_detail.ts";
import type { FilmRecorder, RecordOptions } from "./film_recorder.ts";
import { Jumps } from "./jumps.ts";
import { MarkedElement } from "./marked_element.ts";
import type { PlaceKeeper } from "./place_keeper.ts";
import type { PrintOptions } from "./printing.ts";
import { SlideShow } from "./slide_show.ts";

/** Maximum width of a page drawn for a caller, pixels. */
const widestDrawn = 2048;

/** How a book is searched. */
export interface SearchOptions {
  /** Aborts the search. */
  readonly signal?: AbortSignal;
  /** Called with places as soon as they are found, those of one page at once, in reading order. */
  readonly onHits?: (hits: readonly SearchHit[]) => void;
}

/** Everything around the book: its own subclass opens and turns it. */
export abstract class ReaderElement extends MarkedElement {
  abstract zoom: number;
  abstract goTo(page: number): Promise<boolean>;
  /**
   * Turns the open book to a page for its reader.
   *
   * @internal
   */
  abstract turnTo(page: number, options?: { readonly jump?: boolean }): Promise<boolean>;
  abstract next(): Promise<boolean>;
  abstract readonly spread: { left: number | null; right: number | null };
  abstract readonly state: BookState;
  /**
   * The size of pages for which text is set, CSS pixels; 0 if it is unknown.
   *
   * @internal
   */
  protected abstract readonly textSize: PageSize;

  /** Keeps the place, once an attribute has asked for it. */
  #place: PlaceKeeper | null = null;
  readonly #show = new SlideShow(this, () =>
    this.emit("playchange", { playing: this.#show.playing }),
  );
  /** The sentences of the warnings of which listeners know. */
  #reportedWarnings = "[]";
  /**
   * The last jump of the reader.
   *
   * @internal
   */
  protected readonly jumps: Jumps = new Jumps();
  #film: FilmRecorder | null = null;
  #reading: Reading | null = null;

  /** Whether the open book's text can be set in another size, typeface and so on. */
  get canTypeset(): boolean {
    return this.source?.typeset !== undefined;
  }

  /** Whether the open page is scrolled and not turned, as an EPUB may ask for. */
  get scrolled(): boolean {
    return this.book?.roll?.isShown ?? false;
  }

  /** Whether `pageCount` is an estimate: pages of flowing text are counted while they are read. */
  get estimated(): boolean {
    return this.source?.isEstimated ?? false;
  }

  /** Whether `pageCount` is only a guess by the size of the file: true until some of the text is read and set. */
  get guessed(): boolean {
    return this.source?.isGuessed ?? false;
  }

  /** The book's title; empty until it is open. */
  get bookTitle(): string {
    return this.source?.title ?? "";
  }

  /** The direction in which the title is written; `auto` is that of its first letter. */
  get titleDirection(): "ltr" | "rtl" | "auto" {
    return this.source?.titleDirection ?? "auto";
  }

  /** What the book's owner wants to be shown of it, such as its licence; the controls show it. */
  get details(): readonly BookDetail[] {
    return this.source?.details ?? [];
  }

  /**
   * What the open book lists and cannot be shown, each a sentence with the file and the page that it
   * is about: missing images, fonts, sounds, lines of the contents that lead nowhere, pages that could not
   * be drawn. At most 200. It grows while the book is laid out in the background and its pages are drawn,
   * which the event `warnings` reports; the controls list it under the contents.
   */
  get warnings(): readonly WarningDetail[] {
    const language = languageOf(this);
    return (this.source?.warnings ?? []).map((warning) => warningDetail(warning, language));
  }

  /**
   * Reports `warnings` if there are others than those reported last.
   *
   * @internal
   */
  protected reportWarnings(): void {
    const { warnings } = this;
    const sentences = JSON.stringify(warnings.map(({ message }) => message));
    if (sentences === this.#reportedWarnings) return;
    this.#reportedWarnings = sentences;
    if (warnings.length > 0) this.emit("warnings", { warnings });
  }

  /** Returns the label of a page (from 1), such as "iv" or "23". */
  label(page: number): string {
    const { source } = this;
    return source && page >= 1 && page <= source.pageCount ? source.label(page - 1) : String(page);
  }

  /**
   * Finds every place of the book that contains `query`. Resolves to them in
   * reading order, at most 2,000; to none while no book is open. Case, accents,
   * ligatures, quotation marks and hyphens do not count. Rejects with the
   * signal's reason when aborted, or when the book is closed, and with a
   * `BookError` if the part of the viewer that searches cannot be loaded.
   *
   * @param options `signal` aborts the search; `onHits` is called with places as soon as they are
   * found, those of one page at once
   */
  async search(query: string, options: SearchOptions = {}): Promise<readonly SearchHit[]> {
    return (await this.book?.reading.search(query, options.signal, options.onHits)) ?? [];
  }

  /**
   * Whether there may be text in the book; known once it has been searched.
   *
   * @internal
   */
  get mayHaveText(): boolean {
    return this.book?.reading.mayHaveText ?? true;
  }

  /**
   * Turns to a hit and marks it, strongly, and faintly every other visible
   * place of its query; null removes the marks. Resolves, once the book is at
   * rest, to whether the hit lies open.
   */
  showHit(hit: SearchHit | null): Promise<boolean> {
    this.book?.reading.mark(hit);
    return hit ? this.turnTo(hit.page, { jump: true }) : Promise.resolve(true);
  }

  /**
   * The page (from 1) from which the reader has jumped, as by a link, until he reads on; null if
   * there is none.
   *
   * @internal
   */
  get jumpedFrom(): number | null {
    return this.jumps.from;
  }

  /**
   * Turns back to the page from which the reader has jumped.
   *
   * @internal
   */
  jumpBack(): void {
    const { from } = this.jumps;
    if (from === null || this.#place?.back()) return;
    void this.turnTo(from);
  }

  /**
   * Call it when the reader jumps away from the open page.
   *
   * @internal
   */
  protected jump(): void {
    this.jumps.begin(this.page);
    this.#place?.jump();
  }

  /**
   * Resolves to the book's table of contents; empty if it has none, or no book
   * is open. Rejects with a `BookError`.
   */
  async outline(): Promise<readonly OutlineEntry[]> {
    return (await this.book?.reading.outline()) ?? [];
  }

  /** Whether a leaf or a board is moving or held. */
  get turning(): boolean {
    return this.book?.viewer.turning.moving ?? false;
  }

  /**
   * Removes the element from its page, which ends and frees everything, as
   * removing it in any other way does. Inserted into a page again, it opens its
   * book where that lay.
   */
  destroy(): void {
    this.remove();
  }

  /** Whether the pages turn by themselves. */
  get playing(): boolean {
    return this.#show.playing;
  }

  /**
   * Turns the pages one after another, each shown for `secondsPerPage` (1 to
   * 3600, 6 by default), until the last or `pause()`.
   */
  play(secondsPerPage?: number): void {
    this.#show.play(secondsPerPage);
  }

  /** Stops the slide-show. */
  pause(): void {
    this.#show.pause();
  }

  /** Whether the open book can be read aloud: an EPUB with media overlays. */
  get canReadAloud(): boolean {
    return this.source?.narration !== undefined;
  }

  /** Whether the book is being read aloud. */
  get readingAloud(): boolean {
    return this.#reading !== null;
  }

  /**
   * Reads the book aloud from the open pages on: its recording is played, what
   * is read is marked, and the pages turn with it; a reader who turns to
   * another page is followed. Text without a recording is spoken by the
   * browser. Call it when the reader presses something: browsers play no sound
   * before. Resolves once the end is read, or `stopReadingAloud()` is called;
   * at once if it is being read, or nothing can be. What cannot be read is an
   * `error`. Rejects with a `BookError` if the code that reads cannot be loaded.
   */
  async readAloud(): Promise<void> {
    const { Reading } = await loadPart(import("../read_aloud/reading.ts"));
    const { source } = this;
    if (!source?.narration || this.#reading) return;
    this.#reading = new Reading(this, source.narration, source.language);
    await this.#reading.run(
      () => {
        this.#reading = null;
      },
      (error) => this.emit("error", failureDetail(error, languageOf(this))),
    );
  }

  /** Stops reading aloud. */
  stopReadingAloud(): void {
    this.#reading?.stop();
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
   * Draws a page (from 1) by itself, `width` pixels wide (at most 2048), as for
   * a thumbnail. Resolves to the picture. The caller owns a bitmap: `close()`
   * frees it. Rejects with a `BookError`, or with the reason of `signal`.
   */
  async drawPage(page: number, width: number, signal?: AbortSignal): Promise<PagePicture> {
    const { source } = this;
    if (!source || !(page >= 1 && page <= source.pageCount)) {
      throw new BookError(`There is no page ${page} to draw; open a book that has it.`, {
        code: "noPage",
      });
    }
    const across = Math.min(width, widestDrawn);
    return await source.draw(Math.round(page) - 1, across, signal ?? new AbortController().signal);
  }

  /** What the book's owner and its source permit; nothing while no book is open. */
  get allows(): { readonly print: boolean; readonly download: boolean } {
    const { source } = this;
    return {
      print: source !== undefined && source.allows?.print !== false,
      download: source?.file !== undefined,
    };
  }

  /**
   * Draws the pages that `options` name and opens the browser's print dialog
   * with them, one per sheet. Resolves, once they are there, to whether the
   * book may be printed. Rejects with a `BookError` if a page cannot be drawn,
   * and if no page or more than 300 are requested.
   */
  async print(options: PrintOptions = {}): Promise<boolean> {
    const { source } = this;
    if (!source || !this.allows.print) return false;
    const { printPages } = await loadPart(import("./print_pages.ts"));
    return await printPages(source, options);
  }

  /** Downloads the book's own file. Resolves to whether there is one. */
  async download(): Promise<boolean> {
    const { source } = this;
    if (!source || !this.allows.download) return false;
    const { downloadFile } = await loadPart(import("./print_pages.ts"));
    return await downloadFile(source);
  }

  /**
   * Records a film of the book as it is shown, until `stopRecording()`, or for
   * some seconds. Resolves to the film, WebM if the browser writes it. Rejects
   * with a `BookError` if no book is open, one is recorded already, or the
   * browser cannot.
   *
   * @param options `seconds` (0.1 to 600) ends it by itself
   */
  async record(options: RecordOptions = {}): Promise<Blob> {
    const { FilmRecorder } = await loadPart(import("./film_recorder.ts"));
    const { book } = this;
    if (!book || this.#film) {
      const sentence = book
        ? "A film is recorded already."
        : "There is no book to record; open one.";
      throw new BookError(sentence, { code: "misused" });
    }
    const film = new FilmRecorder(() => this.book?.canvas, options);
    this.#film = film;
    // A resting book is drawn once for the film.
    book.viewer.invalidate();
    try {
      return await film.done;
    } finally {
      this.#film = null;
    }
  }

  /** Ends the film that `record()` started. */
  stopRecording(): void {
    this.#film?.stop();
  }

  /** Whether a film is being recorded. */
  get recording(): boolean {
    return this.#film !== null;
  }

  /**
   * Call it when the book is about to be drawn.
   *
   * @internal
   */
  protected filmed(): void {
    this.#film?.frame();
  }

  /**
   * Fills the screen with the element, or leaves full screen. Resolves to
   * whether the browser allowed it.
   */
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
   * Loads the code that keeps the place, if an attribute asks for it. Rejects
   * with a `BookError` if it cannot be loaded.
   *
   * @internal
   */
  protected async keepPlace(): Promise<void> {
    if (!this.address && !this.remember) return;
    const { PlaceKeeper } = await loadPart(import("./place_keeper.ts"));
    // Both attributes may have asked.
    if (this.#place) return;
    const source = () => this.source;
    const textSize = () => this.textSize;
    this.#place = new PlaceKeeper(this, source, () => this.homePlace, textSize);
    if (this.isConnected) this.#place.follow();
  }

  /**
   * Call it when the element is in a document.
   *
   * @internal
   */
  protected connectReader(): void {
    this.#place?.follow();
  }

  /**
   * Call it when the element leaves its document, its book still open.
   *
   * @internal
   */
  protected disconnectReader(): void {
    this.pause();
    this.stopRecording();
    this.stopReadingAloud();
    this.#place?.leave();
  }

  /**
   * Call it when another book replaces the open one.
   *
   * @internal
   */
  protected forgetBook(): void {
    this.pause();
    this.stopReadingAloud();
    this.#reportedWarnings = "[]";
    this.#place?.closed();
    this.jumps.forget();
    this.forgetLists();
  }

  /**
   * Sets a book's text as its reader had it, and finds where it was left: before
   * it is shown. Resolves to the page (from 1) of `left`, null if that is unknown. Never rejects.
   *
   * @param src the element's address of it
   * @param typography returns how the attributes say that text is set, for pages of about the size that it is given
   * @param left the anchor at which this element left the book, if it was open before
   *
   * @internal
   */
  protected async restorePlace(
    source: PageList,
    src: string,
    typography: (kept?: PageSize) => Typography,
    left: string | undefined,
  ): Promise<number | null> {
    if (this.#place) return await this.#place.restore(source, src, typography, left);
    if (left === undefined) return null;
    try {
      const [found = null] = (await source.findAnchors?.([left])) ?? [];
      return found === null ? null : found + 1;
    } catch {
      // What is wrong with the book is said when it is shown.
      return null;
    }
  }

  /**
   * Returns the page at which a book is to open, by the address or where it was
   * left; null if neither is known.
   *
   * @internal
   */
  protected keptPage(source: PageList | undefined, left: number | null): number | null {
    return this.#place ? this.#place.opening(source, left) : left;
  }
}
