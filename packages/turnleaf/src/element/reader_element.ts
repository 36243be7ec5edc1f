/**
 * What a reader does with an open book besides turning it: search, bookmarks,
 * printing, keeping the place.
 */

import { type Corner, type DogEar, dogEarSize, foldedDegrees } from "../book/dog_ears.ts";
import { coverFor, faceIn, placePages } from "../book/layout.ts";
import type { PageMove } from "../book/moved_lists.ts";
import type { PageFold, PagePlace } from "../book/page_folds.ts";
import { leafOf, spineOf } from "../book/spreads.ts";
import type { BookState } from "../book/turning.ts";
import type { Reading } from "../read_aloud/reading.ts";
import { loadPart } from "../sources/load_part.ts";
import type { PageList } from "../sources/page_list.ts";
import {
  type BookDetail,
  BookError,
  type OutlineEntry,
  type PagePicture,
  type Typography,
} from "../sources/page_source.ts";
import type { SearchHit } from "../text/searching.ts";
import { languageOf } from "../words/languages.ts";
import { bindingOptionsOf } from "./attribute_options.ts";
import type { WarningDetail } from "./events.ts";
import { failureDetail, warningDetail } from "./failure_detail.ts";
import type { FilmRecorder, RecordOptions } from "./film_recorder.ts";
import { cleanDogEars, cleanFolds, withDogEars } from "./fold_lists.ts";
import { Jumps } from "./jumps.ts";
import type { OpenBook } from "./open_book.ts";
import { emptyLists, layoutLists, movedLists, type PageLists } from "./page_lists.ts";
import { cleanPages } from "./page_numbers.ts";
import type { HomePlace, PlaceKeeper } from "./place_keeper.ts";
import type { PrintOptions } from "./printing.ts";
import { ReflectingElement } from "./reflecting_element.ts";
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
export abstract class ReaderElement extends ReflectingElement {
  abstract readonly page: number;
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
   * The open book.
   *
   * @internal
   */
  protected abstract get book(): OpenBook | null;
  /**
   * Returns lists of the pages of the whole book with what they said of those that are torn out.
   *
   * @internal
   */
  protected abstract addTornPages(lists: PageLists): PageLists;

  /** Keeps the place, once an attribute has asked for it. */
  #place: PlaceKeeper | null = null;
  readonly #show = new SlideShow(this, () =>
    this.emit("playchange", { playing: this.#show.playing }),
  );
  /** What names pages, as they lie now. */
  #lists: PageLists = emptyLists;
  /** The lists of which listeners know. */
  #reportedLists: PageLists = emptyLists;
  /** The sentences of the warnings of which listeners know. */
  #reportedWarnings = "[]";
  /** The last fold that was asked for: they are made one after the other. */
  #folding: Promise<unknown> = Promise.resolve();
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

  /** Number of pages; 0 until the book is open. */
  get pageCount(): number {
    return this.source?.pageCount ?? 0;
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

  /** The bookmarked pages, from 1, in order; at most 500. */
  get bookmarks(): readonly number[] {
    return this.#lists.bookmarks;
  }

  set bookmarks(pages: readonly number[]) {
    const bookmarks = cleanPages(pages);
    this.#list({ bookmarks });
    const ears = this.#lists.dogEars.filter(({ page }) => bookmarks.includes(page));
    void this.#foldCorners(this.foldBookmarks ? withDogEars(ears, bookmarks) : ears, true);
    this.emit("bookmarkchange", { bookmarks: this.#lists.bookmarks });
  }

  /**
   * The corners that are folded over, at most one a page. Setting it folds them without motion,
   * opens all others and bookmarks their pages. As bookmarks, they are of the open book, and
   * `remember` keeps them. Entries that are none are left out. A book on the flat shows none.
   */
  get dogEars(): readonly DogEar[] {
    return this.#lists.dogEars;
  }

  set dogEars(ears: readonly DogEar[]) {
    this.#bookmarkDogEars(cleanDogEars(ears), false);
  }

  /**
   * Folds a corner of a page (from 1, by default the first visible one) over onto it, and
   * bookmarks the page. Resolves, once it is folded, to whether it is: false on the flat, and for a
   * board, which does not fold.
   *
   * @param corner at the head, the default, or at the foot of the edge away from the spine;
   * where the spine is above or below, on the right or on the left
   * @param size how far from the corner the fold meets the page's edges: a fraction of its
   * width, 0.05 to 0.5 (0.2)
   */
  dogEar(page: number = this.page, corner: Corner = "head", size?: number): Promise<boolean> {
    const [ear] = cleanDogEars([{ page, corner, size: dogEarSize(size) }]);
    const binding = this.book?.viewer.binding;
    if (ear === undefined || !binding || page > this.pageCount) return Promise.resolve(false);
    if (spineOf(binding, page) === "board") return Promise.resolve(false);
    // On the other side of its leaf the same corner cannot be folded too.
    const isSameCorner = (other: DogEar): boolean =>
      other.corner === ear.corner && leafOf(binding, other.page) === leafOf(binding, page);
    const others = this.dogEars.filter((other) => other.page !== page && !isSameCorner(other));
    return this.#bookmarkDogEars(cleanDogEars([...others, ear]), true);
  }

  /**
   * The folds of pages besides their corners, in the order in which they were made; at most 500.
   * Setting it folds them without motion and opens all others. As bookmarks, they are of the open
   * book, and `remember` keeps them. Entries that are none are left out. A book on the flat shows
   * none.
   */
  get folds(): readonly PageFold[] {
    return this.#lists.folds;
  }

  set folds(folds: readonly PageFold[]) {
    void this.#foldPages(cleanFolds(folds), false);
  }

  /**
   * Folds a page (from 1) along a straight line, in about half a second where it lies open and is
   * folded toward the reader, else without motion. Folds that are asked for at once are made one
   * after the other. A fold along the same line changes its angle. Resolves, once the page is
   * folded, to whether it is: false on the flat, and for a board, which does not fold. Rejects
   * with a `BookError` if the line meets the spine, is too near to other folds of the page or
   * to an edge, or is none.
   *
   * @param from,to two places on the line, as fractions of the page from its upper left corner;
   * the fold goes on to the edges of the page
   * @param angle at which it rests, degrees: above 0 toward the reader who looks at the page,
   * below it away, 180 or -180 folded shut, 0 flat; the default is 160, as paper rests that a
   * finger has pressed
   */
  fold(
    page: number,
    from: PagePlace,
    to: PagePlace,
    angle: number = foldedDegrees,
  ): Promise<boolean> {
    const folded = this.#folding.then(() => this.#foldLine({ page, from, to, angle }));
    this.#folding = folded.catch(() => {});
    return folded;
  }

  /**
   * Opens the folded corner of a page, removes its bookmark, and opens its folds. Returns null
   * if it has none of these; else resolves, once they are open, to whether they are.
   *
   * @internal
   */
  protected openFolds(page: number): Promise<boolean> | null {
    const has = (folds: readonly { readonly page: number }[]) =>
      folds.some((fold) => fold.page === page);
    const [hasCorner, hasFolds] = [has(this.dogEars), has(this.folds)];
    if (!hasCorner && !hasFolds) return null;
    const others = this.folds.filter((fold) => fold.page !== page);
    // Of two that are opened at once the second would not be seen.
    if (hasCorner && hasFolds) this.#list({ folds: others });
    const opened = hasCorner
      ? this.#foldCorners(
          this.dogEars.filter((ear) => ear.page !== page),
          true,
        )
      : this.#foldPages(others, true);
    if (hasCorner && hasFolds) this.emit("foldchange", { folds: others });
    if (this.bookmarks.includes(page) && hasCorner) this.toggleBookmark(page);
    return opened;
  }

  /**
   * Folds the pages of a book that has just opened, and loads what folds them where they may be
   * folded by hand.
   *
   * @internal
   */
  protected foldOpened(): void {
    if (this.dogEars.length > 0 || this.folds.length > 0 || this.foldBookmarks)
      void this.#refold(false);
  }

  /**
   * The pages, from 1, at which the offset is shifted: in a spread the side
   * before each is left blank, so that from there on other pages face each
   * other. At most 500. Where a book says itself on which side a page lies, as
   * for a picture across a spread, a shift there has no effect. As bookmarks,
   * they are of the open book, and `remember` keeps them.
   */
  get shifts(): readonly number[] {
    return this.#lists.shifts;
  }

  set shifts(pages: readonly number[]) {
    const shifts = cleanPages(pages);
    if (shifts.join() === this.shifts.join()) return;
    this.#list({ shifts });
    this.book?.viewer.rebind({ shifts });
    this.emit("shiftchange", { shifts });
  }

  /** Shifts the offset at a page (from 1), by default the first visible one, or undoes that. */
  toggleShift(page: number = this.page): void {
    this.shifts = toggled(this.shifts, page);
  }

  /**
   * The lists that name pages, as they lie now. Once they are set, `reportLists` is to follow.
   *
   * @internal
   */
  protected get lists(): PageLists {
    return this.#lists;
  }

  protected set lists(lists: PageLists) {
    this.#lists = lists;
    // The book is about to be bound anew, with the folds of its pages as they lie then.
    this.book?.viewer.sheets.keepFolds([...lists.dogEars, ...lists.folds]);
  }

  /**
   * Takes over what an attribute says of pages as they lie now.
   *
   * @internal
   */
  protected listPages(name: "hardPages" | "stocks", list: string): void {
    this.#list({ [name]: list });
  }

  /**
   * Has the lists follow the pages; `reportLists` is to follow.
   *
   * @param pageCount of the book before
   *
   * @internal
   */
  protected moveLists(move: PageMove, pageCount: number): void {
    this.lists = movedLists(this.#lists, move, pageCount);
  }

  /**
   * Returns what says on which face a page (from 1) lies where two are shown side by side, in the
   * order of reading: an odd face and the next one face each other.
   *
   * @internal
   */
  pageFaces(): (page: number) => number {
    const { source, shifts } = this;
    const { cover, offset } = bindingOptionsOf(this);
    const inSpread = source?.inSpread.bind(source);
    const { boards } = coverFor(cover, source?.cover, this.pageCount);
    const placed = placePages(this.pageCount, { offset, shifts }, inSpread, boards);
    return (page) => faceIn(placed, page);
  }

  /**
   * Reports the lists that have followed their pages, and shows the open book by them.
   *
   * @internal
   */
  protected reportLists(): void {
    const [before, now] = [this.#reportedLists, this.#lists];
    this.#reportedLists = now;
    const { bookmarks, dogEars, folds, shifts } = now;
    const isOther = (name: keyof PageLists): boolean =>
      JSON.stringify(now[name]) !== JSON.stringify(before[name]);
    this.book?.viewer.rebind(layoutLists(now));
    if (isOther("dogEars") || isOther("folds")) void this.#refold(false);
    if (isOther("dogEars")) this.emit("dogearchange", { dogEars });
    if (isOther("folds")) this.emit("foldchange", { folds });
    if (isOther("shifts")) this.emit("shiftchange", { shifts });
    // A bookmark that has come back may want its corner folded.
    if (isOther("bookmarks")) this.bookmarks = bookmarks;
  }

  /**
   * Where the open book lies and what names its pages, by the pages that it has when it is opened
   * again: without those that were added, and with those that were removed or torn out.
   *
   * @internal
   */
  protected get homePlace(): HomePlace {
    const { source } = this;
    if (source === undefined) return { page: this.page, lists: this.#lists };
    const home = (index: number): number | null => source.homeOf(source.pagesAt([index])[0]);
    const lists = this.addTornPages(movedLists(this.#lists, home, source.pageCount));
    // A page that was added has the place of the one before it.
    let at = this.page - 1;
    while (at > 0 && home(at) === null) at--;
    return { page: (home(at) ?? 0) + 1, lists };
  }

  /**
   * Has the lists name the pages of the book as it is opened again; `reportLists` is to follow.
   *
   * @internal
   */
  protected returnLists(): void {
    const { hardPages, stocks } = this;
    this.#lists = { ...this.homePlace.lists, hardPages, stocks };
  }

  /** Takes lists over, of which listeners know or are about to. */
  #list(lists: Partial<PageLists>): void {
    this.#lists = { ...this.#lists, ...lists };
    this.#reportedLists = { ...this.#reportedLists, ...lists };
  }

  #bookmarkDogEars(ears: readonly DogEar[], isSeen: boolean): Promise<boolean> {
    const folded = this.#foldCorners(ears, isSeen);
    const pages = ears.map(({ page }) => page);
    if (pages.some((page) => !this.bookmarks.includes(page))) {
      this.bookmarks = [...this.bookmarks, ...pages];
    }
    return folded;
  }

  #foldCorners(ears: readonly DogEar[], isSeen: boolean): Promise<boolean> {
    return this.#listDogEars(ears) ? this.#refold(isSeen) : Promise.resolve(true);
  }

  #foldPages(folds: readonly PageFold[], isSeen: boolean): Promise<boolean> {
    return this.#listFolds(folds) ? this.#refold(isSeen) : Promise.resolve(true);
  }

  /** Takes a list of folded corners over. Returns whether it is another. */
  #listDogEars(ears: readonly DogEar[]): boolean {
    if (JSON.stringify(ears) === JSON.stringify(this.dogEars)) return false;
    this.#list({ dogEars: ears });
    this.emit("dogearchange", { dogEars: ears });
    return true;
  }

  /** Takes a list of folds over. Returns whether it is another. */
  #listFolds(folds: readonly PageFold[]): boolean {
    if (JSON.stringify(folds) === JSON.stringify(this.folds)) return false;
    this.#list({ folds });
    this.emit("foldchange", { folds });
    return true;
  }

  /**
   * Folds pages as the lists say; what cannot be folded is taken out of them. Resolves to whether
   * all is folded.
   */
  async #refold(isSeen: boolean): Promise<boolean> {
    const { dogEars: ears, folds } = this.#lists;
    const asked = [...ears, ...folds];
    const found = await this.book?.viewer.sheets.fold(asked, isSeen);
    if (!found) return false;
    // Others may have been set, or another book opened.
    if (this.dogEars === ears && this.folds === folds) {
      this.#listDogEars(cleanDogEars(found));
      this.#listFolds(cleanFolds(found));
    }
    return asked.every((fold) => found.includes(fold));
  }

  async #foldLine(asked: PageFold): Promise<boolean> {
    const { foldAlong } = await loadPart(import("./line_folds.ts"));
    const viewer = this.book?.viewer;
    if (viewer === undefined) return false;
    const { folds: before, dogEars } = this.#lists;
    const folds = await foldAlong(asked, viewer, this.#lists);
    // Others may have been set, or another book opened.
    if (folds === null || this.folds !== before) return false;
    this.#listFolds(folds);
    // Corners that were folded meanwhile were folded without this one.
    if (this.dogEars !== dogEars) void this.#refold(false);
    return true;
  }

  /** Bookmarks a page (from 1), by default the first visible one, or removes its bookmark. */
  toggleBookmark(page: number = this.page): void {
    this.bookmarks = toggled(this.bookmarks, page);
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
   * The open book's pages.
   * @internal
   */
  protected get source(): PageList | undefined {
    return this.book?.source;
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
    this.#place = new PlaceKeeper(this, source, () => this.homePlace);
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
    const { hardPages, stocks } = this;
    this.#list({ ...emptyLists, hardPages, stocks });
  }

  /**
   * Sets a book's text as its reader had it, and finds where it was left: before
   * it is shown. Resolves to the page (from 1) of `left`, null if that is unknown. Never rejects.
   *
   * @param src the element's address of it
   * @param typography returns how the attributes say that text is set
   * @param left the anchor at which this element left the book, if it was open before
   *
   * @internal
   */
  protected async restorePlace(
    source: PageList,
    src: string,
    typography: () => Typography,
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

/** Returns the pages without one that is among them, or with it. */
function toggled(pages: readonly number[], page: number): readonly number[] {
  const others = pages.filter((other) => other !== page);
  return others.length < pages.length ? others : [...others, page];
}
