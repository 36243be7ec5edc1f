/**
 * Counts the pages of a book of flowing text. Its sections are laid out one after another, those
 * about the reader first; until then their pages are estimated, by parts of the book that are. Where
 * numbers change, or another typography is chosen, the new ones are announced.
 */

import { closedError } from "../failures.ts";
import { BookError, type NewIndex, type Typography } from "../page_source.ts";
import { orAborted } from "../shared_tasks.ts";
import { Edition } from "./edition.ts";
import type { FlowBook } from "./flow_book.ts";
import type { FlowWarnings } from "./flow_warnings.ts";
import { idle } from "./idle.ts";
import type { LaidChapter } from "./laid_chapter.ts";
import { NumberedPages } from "./numbered_pages.ts";
import { firstRead, mostOff, openingRead, type SectionLengths } from "./page_estimate.ts";
import type { SectionContents } from "./section_contents.ts";
import { placeOfAnchor } from "./text_place.ts";

/** Sections about the reader's place: those of two open pages, and one beside them. */
export const nearSections = 3;

/** Milliseconds after which a section is laid out for its number of pages, even where there is no rest. */
const longestWait = 300;

/** A book whose pages are counted: what it is laid out from. */
export interface CountedBook {
  readonly book: FlowBook;
  readonly contents: SectionContents;
  readonly warnings: FlowWarnings;
  /** The lengths of its sections. */
  readonly lengths: SectionLengths;
  /** Resolves once the first of these are read. */
  readonly reading: Promise<void>;
  /** Ends the reading, and the book. */
  readonly ended: AbortController;
}

/** What a counter asks and tells the source of the pages. */
export interface CounterHooks {
  /** Returns the sections that were drawn last, the last one first. */
  readonly recent: () => readonly number[];
  /** Pages are about to have other numbers. */
  readonly renumbering: () => void;
  /** They have; null if all of them are to be drawn anew. */
  readonly renumbered: (moved: NewIndex | null) => void;
}

/** Counts the pages of one book. */
export class PageCounter {
  /** The pages as they are numbered now. */
  readonly pages: NumberedPages;
  readonly #book: FlowBook;
  readonly #counted: CountedBook;
  readonly #hooks: CounterHooks;
  /** Another edition, whose pages are to replace these once it is ready: laid out where the reader is. */
  #next: Edition | null = null;
  #isReady = false;
  /** Resolves once all pages of the last edition are counted. */
  #counting: Promise<void>;
  #listener: ((change: () => NewIndex) => void) | null = null;
  #isDue = false;
  /** Whether parts of the book are laid out by which its pages are estimated, and whether these are. */
  #isSampled = false;
  #hasEstimate = false;
  #estimating: Promise<void> | null = null;

  constructor(counted: CountedBook, edition: Edition, hooks: CounterHooks) {
    this.#book = counted.book;
    this.#counted = counted;
    this.#hooks = hooks;
    this.pages = new NumberedPages(counted.book.sections.length, edition);
    this.#counting = this.#layRest(edition);
  }

  /** The book as it is set now. */
  get edition(): Edition {
    return this.pages.edition;
  }

  /** Whether the book is closed. */
  get isClosed(): boolean {
    return this.#counted.ended.signal.aborted;
  }

  /**
   * Resolves once the number of pages is estimated by text of the whole book, and by parts of it that are
   * laid out. That begins when it is first asked for, and else once the first pages are drawn: a book is
   * read sooner than its number of pages.
   */
  get estimated(): Promise<void> {
    this.#estimating ??= this.#estimate();
    return this.#estimating;
  }

  /** Whether the number of pages is a guess by the size of the file alone. */
  get isGuessed(): boolean {
    return this.pages.numbers.isEstimated && !this.#hasEstimate;
  }

  /** As `PageSource.keptCounts`. */
  get keptCounts(): string | undefined {
    return this.edition.keptCounts;
  }

  /** As `PageSource.expectCounts`. */
  expectCounts(kept: string): void {
    const edition = this.#next ?? this.edition;
    edition.expect(kept);
    if (edition.isExpected) this.#isSampled = true;
  }

  /** As `PageSource.findAnchors`. */
  async findAnchors(anchors: readonly string[]): Promise<readonly (number | null)[]> {
    const places = anchors.map((anchor) => {
      const place = placeOfAnchor(anchor);
      return place !== null && place.section < this.#book.sections.length ? place : null;
    });
    const current = (): Edition => (this.#listener === null && this.#next) || this.edition;
    let edition: Edition;
    do {
      edition = current();
      for (const place of places) {
        // A section that cannot be laid out says so on its page.
        if (place) await edition.measure(place.section).catch(() => {});
      }
      if (this.isClosed) throw closedError(this.#book.name);
      // Another may have taken its place, which ended what it laid out.
    } while (edition !== current());
    if (this.#listener === null) {
      this.#isReady = true;
      this.#change();
    } else if (places.some((place) => place && !this.pages.numbers.isKnown(place.section)))
      this.announce();
    // Of several on a page the first is kept.
    for (const place of [...places].reverse()) if (place) this.pages.keepPlace(place);
    return places.map((place) => place && this.pages.indexOfPlace(place));
  }

  /** As `PageSource.settle`. */
  async settle(signal?: AbortSignal): Promise<void> {
    let counted: Promise<void>;
    do {
      counted = this.#counting;
      await (signal ? orAborted(counted, signal) : counted);
      if (this.isClosed) throw closedError(this.#book.name);
      if (this.#listener === null && this.#isDue) this.#change();
    } while (counted !== this.#counting);
  }

  /** Calls a listener with each change of the pages from now on, as `PageSource.watchPages`. */
  watch(listener: (change: () => NewIndex) => void): void {
    this.#listener = listener;
    if (this.#isDue) this.announce();
  }

  /** Corrects the number of a section's pages if it was estimated otherwise. */
  checkCount(section: number, { map }: LaidChapter): void {
    if (map.pageCount !== this.pages.numbers.countOf(section)) this.announce();
  }

  /** Sets the book in another typography: announced once the sections about the reader are laid out. */
  async typeset(typography: Typography): Promise<void> {
    const { book, contents, warnings, lengths } = this.#counted;
    const next = new Edition(book, contents, warnings, lengths, typography, this.edition);
    this.#next?.close();
    this.#next = next;
    this.#isReady = false;
    // Where the reader is first. What was drawn before the last jump is not seen.
    const recent = this.#hooks.recent();
    const [here = 0] = recent;
    const near = recent.filter((section) => Math.abs(section - here) < nearSections);
    for (const section of new Set([...this.pages.openSections, ...near])) {
      try {
        await next.lay(section);
      } catch (error) {
        if (this.#next !== next || this.isClosed) return;
        // A section that cannot be laid out says so on its page.
        if (!(error instanceof BookError)) throw error;
      }
    }
    if (this.#next !== next) return;
    this.#isReady = true;
    this.announce();
  }

  /** Announces that pages have other numbers, once they are asked for. */
  announce(): void {
    if (this.isClosed) return;
    this.#isDue = this.#listener === null;
    this.#listener?.(() => this.#change());
  }

  /** Ends what is laid out. */
  close(): void {
    this.#counted.ended.abort();
    this.edition.close();
    this.#next?.close();
  }

  /** Lays out every section once, those about the reader first, so that all pages are known; then changes to them. */
  async #layRest(edition: Edition): Promise<void> {
    const isCurrent = (): boolean => !this.isClosed && edition === (this.#next ?? this.edition);
    const rest = new Set(this.#book.sections.keys());
    while (rest.size > 0) {
      // What the reader sees goes first.
      await idle(longestWait);
      if (!isCurrent()) return;
      const [here = 0] = this.#hooks.recent();
      const distance = (section: number): number => Math.abs(section - here);
      const section = [...rest].reduce((a, b) => (distance(b) < distance(a) ? b : a));
      rest.delete(section);
      // A section that cannot be laid out says so on its page.
      await edition.measure(section).catch(() => {});
      if (isCurrent() && rest.size > 0) this.#correct();
    }
    if (!isCurrent()) return;
    edition.isCounted = true;
    this.announce();
  }

  /** Reads and lays out parts of the book by which the rest is estimated, announces that, and reads on. */
  async #estimate(): Promise<void> {
    const { signal } = this.#counted.ended;
    await this.#counted.reading;
    if (!this.isClosed) await this.#counted.lengths.read(signal, firstRead - openingRead);
    if (this.isClosed) return;
    let edition: Edition;
    do {
      edition = this.edition;
      if (!edition.isExpected) await edition.sample();
      // Another that has taken its place meanwhile has ended what it laid out.
    } while (edition !== this.edition);
    this.#isSampled = true;
    // Otherwise what is counted is about to be announced, or known from the beginning.
    if (!edition.isLaid && !edition.isExpected) this.announce();
    void this.#counted.lengths.read(signal).then(() => this.#correct());
  }

  /** Corrects an estimate of the number of pages that has turned out to be clearly wrong. */
  #correct(): void {
    if (this.isClosed || this.#next || !this.#isSampled) return;
    const { pageCount } = this.pages.numbers;
    const off = Math.abs(this.pages.estimate - pageCount);
    if (off > mostOff * pageCount) this.announce();
  }

  /** Counts the pages anew: of another edition that is ready, or by what is known of this one. */
  #change(): NewIndex {
    this.#isDue = false;
    this.#hasEstimate = this.#isSampled;
    this.#hooks.renumbering();
    const next = this.#isReady ? this.#next : null;
    if (next === null) {
      const moved = this.pages.change(this.edition);
      this.#hooks.renumbered(moved);
      return moved;
    }
    const before = this.edition;
    this.#next = null;
    next.learn(before);
    const moved = this.pages.change(next);
    before.close();
    this.#counting = this.#layRest(next);
    this.#hooks.renumbered(null);
    return moved;
  }
}
