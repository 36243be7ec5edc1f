import { cleanAddress, cleanText } from "../book_text.ts";
import { limits, wholePage } from "../limits.ts";
import {
  type BookDetail,
  BookError,
  type BookWarning,
  type NewIndex,
  type OutlineEntry,
  type PageBox,
  type PageLink,
  type PageMedium,
  type PagePicture,
  type PageSize,
  type PageSource,
  type TextRun,
  type Typography,
} from "../page_source.ts";
import { drawMarkup } from "./draw_markup.ts";
import { Edition } from "./edition.ts";
import type { FlowBook, FlowOutline, FlowTarget } from "./flow_book.ts";
import { FlowWarnings } from "./flow_warnings.ts";
import { idle } from "./idle.ts";
import type { LaidChapter } from "./laid_chapter.ts";
import { Narrator } from "./narrator.ts";
import { PageNumbers } from "./page_numbers.ts";
import { SectionContents } from "./section_contents.ts";
import { ownTypography, paperback, paperOf } from "./typography.ts";

/** A place in the text: a section, and characters before it there. */
interface Place {
  readonly section: number;
  readonly offset: number;
}

/** Sections about the reader's place: those of two open pages, and one beside them. */
const nearSections = 3;

/** Milliseconds after which a section is laid out for its number of pages, even where there is no rest. */
const longestWait = 300;

/** Sections that the links of one page may have laid out, to find where they lead. */
const mostTargets = 4;

/**
 * A book of flowing text, set into pages. Sections are laid out when they are
 * needed, and one after another while nothing else is asked for; until then
 * their pages are estimated.
 */
export class FlowSource implements PageSource {
  readonly title: string;
  readonly titleDirection: "ltr" | "rtl" | "auto";
  readonly language: string;
  readonly direction: "ltr" | "rtl";
  readonly kind = "typeset";
  readonly layout?: "spread" | "single";
  readonly details: readonly BookDetail[];
  /** Sets the book in another typography; absent if all its pages are of fixed layout. */
  readonly typeset?: (typography: Typography) => Promise<void>;
  readonly narration?: Narrator;
  /** Absent if all pages are turned. */
  readonly roll?: (index: number) => number | null;
  readonly #book: FlowBook;
  readonly #contents: SectionContents;
  readonly #warnings: FlowWarnings;
  #edition: Edition;
  /** Another edition, whose pages are to replace these. */
  #next: Edition | null = null;
  #numbers: PageNumbers;
  /** The places of readers on pages that are not those where these begin. */
  #places = new Map<number, Place>();
  #listener: ((change: () => NewIndex) => void) | null = null;
  #isDue = false;
  #onDrawing: ((index: number) => void) | null = null;
  /** The sections that were drawn last, the last one first. */
  #recent: readonly number[] = [0];
  #isClosed = false;

  /** Returns a book's pages. Rejects with a `BookError` if its only section cannot be laid out. */
  static async open(book: FlowBook, typography: Typography = ownTypography): Promise<FlowSource> {
    const contents = new SectionContents(book);
    const warnings = new FlowWarnings(book);
    const edition = new Edition(book, contents, warnings, typography);
    try {
      await edition.lay(0);
    } catch (error) {
      // A first section among others says so on its page.
      if (book.sections.length === 1) {
        edition.close();
        book.close();
        throw error;
      }
    }
    return new FlowSource(book, contents, warnings, edition);
  }

  private constructor(
    book: FlowBook,
    contents: SectionContents,
    warnings: FlowWarnings,
    edition: Edition,
  ) {
    this.title = book.title;
    this.titleDirection = book.titleDirection ?? "auto";
    this.language = book.language;
    this.direction = book.direction;
    if (book.layout) this.layout = book.layout;
    this.details = book.details ?? [];
    this.#book = book;
    this.#contents = contents;
    this.#warnings = warnings;
    this.#edition = edition;
    this.#numbers = this.#numbersOf(edition);
    if (book.sections.some(({ isFixed }) => !isFixed)) {
      this.typeset = (typography) => this.#typeset(typography);
    }
    if (book.sections.some(({ roll }) => roll !== undefined)) {
      this.roll = (index) => book.sections[this.#numbers.at(index).section]?.roll ?? null;
    }
    if (book.narration) {
      this.narration = new Narrator(book.narration, {
        at: (index) => this.#at(index),
        indexOf: (section, page) => this.#numbers.indexOf(section, page),
        lay: (section, signal) => this.#lay(section, signal),
        redraw: (section, pages) => this.#redraw(section, pages),
      });
    }
    this.#layRest(edition);
  }

  get pageCount(): number {
    return this.#numbers.pageCount;
  }

  get warnings(): readonly BookWarning[] {
    return this.#warnings.all((section, page) => this.#numbers.indexOf(section, page) + 1);
  }

  watchWarnings(listener: () => void): void {
    this.#warnings.watch(listener);
  }

  async size(index: number, signal?: AbortSignal): Promise<PageSize> {
    const { section } = this.#at(index);
    const { isFixed, roll } = this.#book.sections[section] ?? {};
    if (isFixed || roll !== undefined) await this.#edition.lay(section, signal);
    return this.#edition.mapOf(section)?.size ?? paperback;
  }

  inSpread(index: number): ReturnType<NonNullable<PageSource["inSpread"]>> {
    const { section, page } = this.#numbers.at(index);
    const { side, roll } = this.#book.sections[section] ?? {};
    if (roll !== undefined) return "single";
    if (side === undefined || page > 0) return undefined;
    if (side === "center") return "single";
    return (side === "left") === (this.direction === "ltr") ? "first" : "second";
  }

  label(index: number): string {
    return String(index + 1);
  }

  async draw(
    index: number,
    width: number,
    signal: AbortSignal,
    region: PageBox = wholePage,
  ): Promise<PagePicture> {
    signal.throwIfAborted();
    const { section, page } = this.#at(index);
    const others = this.#recent.filter((other) => other !== section);
    this.#recent = [section, ...others].slice(0, nearSections);
    const laid = await this.#lay(section, signal);
    if (this.#isClosed) throw this.#closed();
    laid.mark(this.narration?.markIn(section) ?? null);
    const size = laid.layoutSize;
    // Its pages were estimated.
    const isBlank = page >= laid.map.pageCount;
    const svg = isBlank ? blank(size, paperOf(this.#edition.typography)) : await laid.svg(page);
    const picture = await drawMarkup(svg, size, region, width).catch(async (error: unknown) => {
      const isAllowed = await drawMarkup(blank(size, "#fff"), size, wholePage, 1).then(
        (drawn) => drawn.close() ?? true,
        () => false,
      );
      const reason = isAllowed
        ? "there is more on it than the browser draws; turn to another."
        : "update the browser, or allow data: in img-src of this page's Content-Security-Policy.";
      const sentence = `Page ${index + 1} of ${this.#book.name} cannot be drawn: ${reason}`;
      throw new BookError(sentence, {
        code: isAllowed ? "tooLarge" : "blocked",
        page: index + 1,
        source: this.#book.name,
        cause: error,
      });
    });
    if (!signal.aborted && !this.#isClosed) return picture;
    picture.close();
    signal.throwIfAborted();
    throw this.#closed();
  }

  async text(index: number, signal: AbortSignal, exact = false): Promise<readonly TextRun[]> {
    const { section, page } = this.#at(index);
    const laid = await this.#lay(section, signal);
    return laid.runs(page, exact);
  }

  async alt(index: number, signal: AbortSignal): Promise<string> {
    const { section, page } = this.#at(index);
    const laid = await this.#lay(section, signal);
    return laid.alt(page);
  }

  async links(index: number, signal: AbortSignal): Promise<readonly PageLink[]> {
    const { section, page } = this.#at(index);
    const found = await (await this.#lay(section, signal)).links(page);
    const links: PageLink[] = [];
    const laid = new Set([section]);
    for (const { href, isNote, ...link } of found) {
      const address = cleanAddress(href);
      const asks = this.#book.asksToLeave ? { asks: true } : {};
      if (address !== "") links.push({ ...link, to: { href: address }, ...asks });
      const target = address === "" ? this.#book.resolve(section, href) : null;
      if (target === null) continue;
      const isUnknown = isNote || this.#edition.mapOf(target.section) === undefined;
      let note = "";
      const mayLay = laid.has(target.section) || laid.size <= mostTargets;
      if (isUnknown && target.id !== "" && mayLay) {
        laid.add(target.section);
        const there = await this.#edition
          .lay(target.section, signal)
          .catch(() => signal.throwIfAborted());
        if (isNote) note = (await there?.note(target.id)) ?? "";
      }
      links.push({ ...link, to: this.#placeOf(target), ...(note === "" ? {} : { note }) });
    }
    return links;
  }

  async media(index: number, signal: AbortSignal): Promise<readonly PageMedium[]> {
    const { section, page } = this.#at(index);
    const found = await (await this.#lay(section, signal)).media(page);
    const read = this.#book.medium?.bind(this.#book);
    if (!read) return [];
    return found.map(({ address, ...medium }) => ({
      ...medium,
      load: () => read(section, address),
    }));
  }

  async outline(): Promise<readonly OutlineEntry[]> {
    let left: number = limits.outlineEntries;
    const entries = (lines: readonly FlowOutline[], depth: number): OutlineEntry[] => {
      if (depth > limits.outlineDepth) return [];
      return lines.slice(0, left).map(({ title, target, children }) => {
        left -= 1;
        const place = target === null ? { page: null } : this.#placeOf(target);
        return { title: cleanText(title), ...place, children: entries(children, depth + 1) };
      });
    };
    return entries(this.#book.outline, 1);
  }

  file(): Promise<Blob> {
    return this.#book.file();
  }

  anchor(index: number): string {
    const { section, page } = this.#at(index);
    const starts = this.#edition.mapOf(section)?.starts;
    const offset = this.#places.get(index)?.offset ?? starts?.[page] ?? 0;
    return `${section}:${offset}`;
  }

  async findAnchors(anchors: readonly string[]): Promise<readonly (number | null)[]> {
    const edition = this.#next ?? this.#edition;
    const places = anchors.map(placeAt);
    for (const place of places) {
      // A section that cannot be laid out says so on its page.
      if (place && place.section < this.#book.sections.length) {
        await edition.measure(place.section).catch(() => {});
      }
    }
    if (this.#isClosed) throw this.#closed();
    if (this.#listener === null) this.#change();
    return places.map((place) => {
      if (!place || place.section >= this.#book.sections.length) return null;
      const starts = this.#edition.mapOf(place.section)?.starts ?? [];
      return this.#numbers.indexOf(place.section, pageAt(starts, place.offset));
    });
  }

  watchPages(listener: (change: () => NewIndex) => void): void {
    this.#listener = listener;
    if (this.#isDue) this.#announce();
  }

  watchDrawings(listener: (index: number) => void): void {
    this.#onDrawing = listener;
  }

  close(): void {
    if (this.#isClosed) return;
    this.#isClosed = true;
    this.#edition.close();
    this.#next?.close();
    this.#book.close();
  }

  /** Returns which page a page is. */
  #at(index: number): { readonly section: number; readonly page: number } {
    if (this.#isClosed) throw this.#closed();
    if (!(index >= 0 && index < this.pageCount)) {
      throw new BookError(`${this.#book.name} has no page ${index + 1}; turn to another.`, {
        code: "noPage",
        source: this.#book.name,
      });
    }
    return this.#numbers.at(index);
  }

  #closed(): BookError {
    return new BookError(`${this.#book.name} is closed; open it again.`, {
      code: "closed",
      source: this.#book.name,
    });
  }

  async #lay(section: number, signal: AbortSignal): Promise<LaidChapter> {
    const edition = this.#edition;
    try {
      const laid = await edition.lay(section, signal);
      // Its pages were estimated.
      if (laid.map.pageCount !== this.#numbers.countOf(section)) this.#announce();
      return laid;
    } catch (error) {
      signal.throwIfAborted();
      throw this.#isClosed ? this.#closed() : error;
    }
  }

  /** Reports that pages of a section look otherwise; all of them if `pages` is null. */
  #redraw(section: number, pages: readonly number[] | null): void {
    const count = this.#numbers.countOf(section);
    for (const page of pages ?? Array.from({ length: count }, (_, k) => k)) {
      this.#onDrawing?.(this.#numbers.indexOf(section, page));
    }
  }

  async #typeset(typography: Typography): Promise<void> {
    const next = new Edition(this.#book, this.#contents, this.#warnings, typography);
    this.#next?.close();
    this.#next = next;
    try {
      // Where the reader is first.
      for (const section of this.#recent) await next.lay(section);
    } catch (error) {
      if (this.#next !== next || this.#isClosed) return;
      // A section that cannot be laid out says so on its page.
      if (!(error instanceof BookError)) throw error;
    }
    if (this.#next === next) this.#announce();
  }

  /** Lays out every section once, so that all pages are known; then changes to them. */
  async #layRest(edition: Edition): Promise<void> {
    const isCurrent = (): boolean => !this.#isClosed && edition === (this.#next ?? this.#edition);
    for (let section = 0; section < this.#book.sections.length; section++) {
      // What the reader sees goes first.
      await idle(longestWait);
      if (!isCurrent()) return;
      // A section that cannot be laid out says so on its page.
      await edition.measure(section).catch(() => {});
    }
    if (isCurrent()) this.#announce();
  }

  #announce(): void {
    if (this.#isClosed) return;
    this.#isDue = this.#listener === null;
    this.#listener?.(() => this.#change());
  }

  /** Counts the pages anew: of another edition, or by what is known of this one. */
  #change(): NewIndex {
    const [before, numbers, places] = [this.#edition, this.#numbers, this.#places];
    const next = this.#next;
    if (next) {
      this.#edition = next;
      this.#next = null;
      before.close();
      this.#layRest(next);
    }
    const after = this.#edition;
    const now = this.#numbersOf(after);
    this.#numbers = now;
    this.narration?.forgetPages();
    const placeOn = (index: number): Place => {
      const { section, page } = numbers.at(index);
      const offset = before.mapOf(section)?.starts[page] ?? 0;
      return places.get(index) ?? { section, offset };
    };
    const placeOf = (index: number): number => {
      const { section, offset } = placeOn(index);
      const starts = after.mapOf(section)?.starts;
      if (starts && (places.has(index) || before.mapOf(section))) {
        const { page } = numbers.at(index);
        const isSame = after === before && !places.has(index);
        return now.indexOf(section, isSame ? page : pageAt(starts, offset));
      }
      // Of a section that was never laid out a fraction is all that is known.
      const fraction = numbers.at(index).page / numbers.countOf(section);
      return now.indexOf(section, Math.floor(fraction * now.countOf(section)));
    };
    this.#places = new Map();
    for (let index = 0; index < numbers.pageCount; index++) {
      const place = placeOn(index);
      const to = placeOf(index);
      const isKnown = places.has(index) || before.mapOf(place.section) !== undefined;
      if (isKnown && !this.#places.has(to)) this.#places.set(to, place);
    }
    const sameIndex = (index: number): number | null => {
      const { section, page } = numbers.at(index);
      const isSame = after === before && page < now.countOf(section);
      return isSame ? now.indexOf(section, page) : null;
    };
    return Object.assign(sameIndex, { placeOf });
  }

  #numbersOf(edition: Edition): PageNumbers {
    return new PageNumbers(edition.counts());
  }

  /**
   * Returns the page (from 1) of a target, and how far down that it is where it is scrolled; the
   * first page of its section, while no more is known.
   */
  #placeOf({ section, id }: FlowTarget): { page: number; top?: number } {
    const map = this.#edition.mapOf(section);
    const page = this.#numbers.indexOf(section, map?.ids.get(id) ?? 0) + 1;
    const top = map?.tops.get(id);
    return top === undefined ? { page } : { page, top };
  }
}

/** Returns the place of an anchor; null if it is none. */
function placeAt(anchor: string): Place | null {
  const [, section, offset] = /^(\d{1,5}):(\d{1,9})$/.exec(anchor) ?? [];
  return section && offset ? { section: Number(section), offset: Number(offset) } : null;
}

function pageAt(starts: readonly number[], offset: number): number {
  return Math.max(
    starts.findLastIndex((start) => start <= offset),
    0,
  );
}

function blank({ width, height }: PageSize, paper: string): string {
  return `<svg xmlns="http://www.w3.org/2000/svg" width="${width}" height="${height}"><rect width="${width}" height="${height}" fill="${paper}"/></svg>`;
}
