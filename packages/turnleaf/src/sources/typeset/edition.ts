import { unknownFailure } from "../failures.ts";
import { BookError, type Typography } from "../page_source.ts";
import { SharedTasks } from "../shared_tasks.ts";
import { divide } from "./divide.ts";
import { type FlowBook, isAllText } from "./flow_book.ts";
import type { FlowWarnings } from "./flow_warnings.ts";
import { keptCounts, readCounts } from "./kept_counts.ts";
import { LaidChapter } from "./laid_chapter.ts";
import { LaidSection } from "./laid_section.ts";
import { OverspentError, type SectionMap } from "./lay_section.ts";
import {
  areAlike,
  estimatePages,
  type LaidSample,
  linesIn,
  linesOnPage,
  type SectionLengths,
} from "./page_estimate.ts";
import type { SectionContents } from "./section_contents.ts";

/** Frames kept, so that neighbouring pages are drawn without laying out again. */
const keptFrames = 4;

/** Pieces that are laid out at most before the first estimate: at the half, the quarters and the eighths of the text. */
const samples = 7;

/** Editions so far, of all books. */
let made = 0;

/** A book set in one typography: its sections are laid out one by one, when they are needed. */
export class Edition {
  readonly typography: Typography;
  readonly #book: FlowBook;
  readonly #contents: SectionContents;
  readonly #warnings: FlowWarnings;
  readonly #lengths: SectionLengths;
  readonly #maps = new Map<number, SectionMap>();
  /** Sections in their frames, the last used one last. */
  #frames = new Map<number, LaidChapter>();
  readonly #laying = new SharedTasks<number, LaidChapter>();
  /** One section is laid out at a time. */
  #last: Promise<unknown> = Promise.resolve();
  readonly #ended = new AbortController();
  readonly #number = made++;
  readonly #samples: Map<number, LaidSample>;
  /** Each section's number of pages as it was when the book was set so before; null if that is unknown. */
  #expected: readonly number[] | null = null;
  /** Whether every section has been laid out once, or cannot be. */
  isCounted = false;

  /**
   * @param contents,warnings of the book's sections, for all its editions
   * @param lengths of the sections, likewise
   * @param before the edition that this one replaces, by which its pages are estimated at first
   */
  constructor(
    book: FlowBook,
    contents: SectionContents,
    warnings: FlowWarnings,
    lengths: SectionLengths,
    typography: Typography,
    before: Edition | null = null,
  ) {
    this.#book = book;
    this.#contents = contents;
    this.#warnings = warnings;
    this.#lengths = lengths;
    const isRolled = book.sections.some(({ roll }) => roll !== undefined);
    this.typography = {
      ...typography,
      // A roll is as wide as its window, which is not known here: it is set as a paperback.
      ...(isRolled && { width: 0 }),
      // Pages of fixed layout have a shape of their own.
      ...(!isAllText(book) && { height: 0 }),
    };
    this.#samples = before?.samplesFor(this.typography) ?? new Map();
  }

  /** Whether every section is laid out, and none failed. */
  get isLaid(): boolean {
    return this.#maps.size === this.#book.sections.length;
  }

  /** Returns what is known of a section; undefined before it has been laid out. */
  mapOf(section: number): SectionMap | undefined {
    return this.#maps.get(section);
  }

  /** Returns what is laid out of it, as it fills pages that have room for more or fewer lines. */
  samplesFor(typography: Typography): Map<number, LaidSample> {
    const larger = linesOnPage(this.typography) / linesOnPage(typography);
    const found = new Map<number, LaidSample>();
    for (const section of this.#book.sections.keys()) {
      const lines = this.#lengths.known(section);
      const extent = this.#maps.get(section)?.extent;
      const pages = this.#expected?.[section];
      // The last page is half full in the mean.
      const filled = extent ?? (pages && pages - 0.5);
      const isMeasured = lines !== undefined && filled !== undefined;
      const sample = isMeasured ? { lines, extent: filled } : this.#samples.get(section);
      if (sample) found.set(section, { ...sample, extent: larger * sample.extent });
    }
    return found;
  }

  /** Learns from another edition, whose place this one takes, what that has found since this one was made. */
  learn(before: Edition): void {
    for (const [section, sample] of before.samplesFor(this.typography)) {
      if (!this.#samples.has(section)) this.#samples.set(section, sample);
    }
  }

  /** Returns what identifies a page of a section, as it is set here, among all pages. */
  keyOf(section: number, page: number): string {
    return `${this.#number}:${section}:${page}`;
  }

  /** Returns each section's number of pages, known or estimated. */
  counts(): number[] {
    const { sections } = this.#book;
    const known = sections.map((_, section) => this.#maps.get(section));
    const expected = this.#expected;
    if (expected) return expected.map((count, section) => known[section]?.pageCount ?? count);
    return estimatePages(sections, this.#lengths, known, this.typography, this.#samples);
  }

  /** The numbers of pages as text that `expect` takes; undefined until all are counted or expected. */
  get keptCounts(): string | undefined {
    if (!this.isCounted && !this.#expected) return undefined;
    return keptCounts(this.#book.sections, this.typography, this.counts());
  }

  /** Whether the numbers of pages are those that the book had when it was set so before. */
  get isExpected(): boolean {
    return this.#expected !== null;
  }

  /** Takes the numbers of pages that were kept of the book, if it was set so then. */
  expect(kept: string): void {
    this.#expected = readCounts(kept, this.#book.sections, this.typography);
  }

  /**
   * Lays out pieces of the text here and there, from which the numbers of pages can be estimated, until
   * those are alike. What cannot be laid out is left out.
   */
  async sample(): Promise<void> {
    for (const section of this.#lengths.spread.slice(0, samples)) {
      // One that is laid out as a whole says more than a piece of it.
      if (this.#maps.has(section)) continue;
      const sample = await this.#sampleOf(section).catch(() => null);
      if (this.#ended.signal.aborted) return;
      if (sample !== null) this.#samples.set(section, sample);
      if (areAlike([...this.#samples.values()])) return;
    }
  }

  /** Lays out the middle of a section. */
  async #sampleOf(section: number): Promise<LaidSample> {
    const content = await this.#contents.load(section, false);
    const isScrolled = this.#book.sections[section]?.roll !== undefined;
    const pieces = isScrolled ? [content.root] : divide(content.root);
    const root = pieces[pieces.length >> 1] as Element;
    const { signal } = this.#ended;
    signal.throwIfAborted();
    const laid = await LaidSection.lay({ ...content, root }, this.typography, isScrolled, signal);
    laid.close();
    return { lines: linesIn(root.outerHTML), extent: laid.map.extent };
  }

  /** Returns a section in its frame. Rejects with a `BookError`, or with the signal's reason. */
  async lay(section: number, signal?: AbortSignal): Promise<LaidChapter> {
    const laid =
      this.#frames.get(section) ??
      (await this.#laying.run(section, (own) => this.#layNext(section, true, own), signal));
    // It was used last.
    if (this.#frames.delete(section)) this.#frames.set(section, laid);
    return laid;
  }

  /** Lays a section out only to know its pages; its frame is the first to go. */
  async measure(section: number): Promise<void> {
    if (this.#maps.has(section)) return;
    await this.#laying.run(section, (own) => this.#layNext(section, false, own));
  }

  close(): void {
    this.#ended.abort();
    this.#laying.abortAll();
    for (const laid of this.#frames.values()) laid.close();
    this.#frames.clear();
  }

  /** @param isShown whether its pages are asked for, and not merely their number */
  #layNext(section: number, isShown: boolean, signal: AbortSignal): Promise<LaidChapter> {
    const laying = this.#last.then(() => this.#layNow(section, isShown, signal));
    this.#last = laying.catch(() => {});
    return laying;
  }

  async #layNow(section: number, isShown: boolean, signal: AbortSignal): Promise<LaidChapter> {
    signal.throwIfAborted();
    try {
      const content = await this.#contents.load(section, isShown);
      signal.throwIfAborted();
      const isScrolled = this.#book.sections[section]?.roll !== undefined;
      const laid = await LaidChapter.lay(content, this.typography, isScrolled, signal);
      if (this.#ended.signal.aborted) {
        laid.close();
        throw new DOMException("The book is closed.", "AbortError");
      }
      this.#maps.set(section, laid.map);
      this.#warnings.laid(section, laid.map);
      this.#keep(section, laid);
      return laid;
    } catch (error) {
      signal.throwIfAborted();
      const failure = this.#failureOf(section, error);
      this.#warnings.failed(section, failure);
      throw failure;
    }
  }

  #failureOf(section: number, error: unknown): BookError {
    const part = `Part ${section + 1} of ${this.#book.name}`;
    const source = { source: this.#book.name };
    if (error instanceof OverspentError) {
      return new BookError(
        `${part} takes more time or memory than a page may: ${error.message}; make it simpler.`,
        { code: "tooLarge", ...source },
      );
    }
    return unknownFailure(`${part} cannot be laid out`, error, "get the file again", source);
  }

  /** Keeps a frame as the first to go, until it is used. */
  #keep(section: number, laid: LaidChapter): void {
    this.#frames.delete(section);
    this.#frames = new Map([[section, laid], ...this.#frames]);
    for (const [oldest, old] of this.#frames) {
      if (this.#frames.size <= keptFrames) break;
      // The new one is about to be used.
      if (oldest === section) continue;
      this.#frames.delete(oldest);
      old.close();
    }
  }
}
