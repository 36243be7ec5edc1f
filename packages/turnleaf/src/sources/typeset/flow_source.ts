import { cleanAddress, cleanText } from "../book_text.ts";
import { closedError } from "../failures.ts";
import { limits, wholePage } from "../limits.ts";
import {
  type BookDetail,
  BookError,
  type BookWarning,
  type NewIndex,
  type OutlineEntry,
  type PageBox,
  type PageColours,
  type PageLink,
  type PageMedium,
  type PagePicture,
  type PageSize,
  type PageSource,
  type TextPage,
  type TextRun,
  type TitleFont,
  type Typography,
} from "../page_source.ts";
import { orAborted } from "../shared_tasks.ts";
import { drawMarkup } from "./draw_markup.ts";
import { Edition } from "./edition.ts";
import { type FlowBook, type FlowOutline, type FlowTarget, isAllText } from "./flow_book.ts";
import { FlowWarnings } from "./flow_warnings.ts";
import type { LaidChapter } from "./laid_chapter.ts";
import { Narrator } from "./narrator.ts";
import type { NumberedPages } from "./numbered_pages.ts";
import { type CountedBook, nearSections, PageCounter } from "./page_counter.ts";
import { openingRead, SectionLengths } from "./page_estimate.ts";
import { leafOf, mayFace, paperback } from "./page_measures.ts";
import type { SectionPage } from "./page_numbers.ts";
import { RunningHeads } from "./running_heads.ts";
import { SectionContents } from "./section_contents.ts";
import { anchorOf, pageOfPlace, placeOfPage, type TextPlace } from "./text_place.ts";
import { type LoadedTitleFont, loadTitleFont } from "./title_font.ts";
import { ownTypography } from "./typography.ts";

/** Drawn pages whose numbers are known: more than are kept as pictures. */
const mostDrawn = 200;

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
  readonly usualLeaf?: PageSize;
  readonly cover: PageSource["cover"];
  readonly authors: readonly string[];
  readonly details: readonly BookDetail[];
  /** Sets the book in another typography; absent if all its pages are of fixed layout. */
  readonly typeset?: (typography: Typography) => Promise<void>;
  readonly narration?: Narrator;
  /** Absent if all pages are turned. */
  readonly roll?: (index: number) => number | null;
  readonly #book: FlowBook;
  readonly #warnings: FlowWarnings;
  readonly #counter: PageCounter;
  /** Pages that are being drawn. */
  #drawing = 0;
  #onDrawing: ((index: number) => void) | null = null;
  /** The sections that were drawn last, the last one first. */
  #recent: readonly number[] = [0];
  readonly #heads: RunningHeads;
  readonly #titleFont: LoadedTitleFont | null;
  /** The pages that were drawn last, which have their numbers on them. */
  readonly #drawn = new Set<number>();

  /** Returns a book's pages. Rejects with a `BookError` if its only section cannot be laid out. */
  static async open(book: FlowBook, typography: Typography = ownTypography): Promise<FlowSource> {
    const contents = new SectionContents(book);
    const warnings = new FlowWarnings(book);
    const lengths = new SectionLengths(book.sections);
    const edition = new Edition(book, contents, warnings, lengths, typography);
    const ended = new AbortController();
    const reading = lengths.read(ended.signal, openingRead);
    let titleFont: LoadedTitleFont | null = null;
    try {
      const laid = await edition.lay(0);
      // A face that the reader chose is not the book's.
      const isStamped = book.cover === "stamped" && typography.font === "";
      const face = isStamped ? await laid.titleFace() : null;
      titleFont = face && (await loadTitleFont(face));
    } catch (error) {
      // A first section among others says so on its page.
      if (book.sections.length === 1) {
        ended.abort();
        edition.close();
        book.close();
        throw error;
      }
    }
    const counted = { book, contents, warnings, lengths, reading, ended };
    return new FlowSource(counted, edition, titleFont);
  }

  private constructor(counted: CountedBook, edition: Edition, titleFont: LoadedTitleFont | null) {
    const { book, warnings } = counted;
    this.title = book.title;
    this.titleDirection = book.titleDirection ?? "auto";
    this.language = book.language;
    this.direction = book.direction;
    if (book.layout) this.layout = book.layout;
    if (isAllText(book)) this.usualLeaf = paperback;
    this.cover = book.cover;
    this.#titleFont = titleFont;
    this.details = book.details ?? [];
    // A name without a word about it is an author's.
    this.authors = this.details.filter(({ label }) => label === "").map(({ value }) => value);
    this.#book = book;
    this.#warnings = warnings;
    this.#heads = new RunningHeads(book);
    this.#counter = new PageCounter(counted, edition, {
      recent: () => this.#recent,
      renumbering: () => this.narration?.forgetPages(),
      renumbered: (moved) => this.#renumbered(moved),
    });
    if (book.sections.some(({ isFixed }) => !isFixed)) {
      this.typeset = (typography) => this.#counter.typeset(typography);
    }
    if (book.sections.some(({ roll }) => roll !== undefined)) {
      this.roll = (index) => book.sections[this.#pages.numbers.at(index).section]?.roll ?? null;
    }
    if (book.narration) {
      this.narration = new Narrator(book.narration, {
        at: (index) => this.#at(index),
        indexOf: (section, page) => this.#pages.indexOf(section, page),
        lay: (section, signal) => this.#lay(section, signal),
        redraw: (section, pages) => this.#redraw(section, pages),
        whileSet: (read, signal) => this.#whileSet(read, signal),
      });
    }
  }

  get estimated(): Promise<void> {
    return this.#counter.estimated;
  }

  get pageCount(): number {
    return this.#pages.numbers.pageCount;
  }

  get titleFont(): TitleFont | undefined {
    return this.#titleFont ?? undefined;
  }

  get warnings(): readonly BookWarning[] {
    return this.#warnings.all((section, page) => this.#pages.numbers.indexOf(section, page) + 1);
  }

  watchWarnings(listener: () => void): void {
    this.#warnings.watch(listener);
  }

  mayFace(width: number, alone: number): boolean {
    const { typography } = this.#edition;
    const leaf = leafOf(typography);
    const height = (alone * leaf.height) / leaf.width;
    return !this.typeset || mayFace(typography, width, { width: alone, height });
  }

  get leaf(): PageSize | undefined {
    return this.usualLeaf && leafOf(this.#edition.typography);
  }

  get isEstimated(): boolean {
    return this.#pages.numbers.isEstimated;
  }

  get isGuessed(): boolean {
    return this.#counter.isGuessed;
  }

  async size(index: number, signal?: AbortSignal): Promise<PageSize> {
    const { section } = this.#at(index);
    const { isFixed, roll } = this.#book.sections[section] ?? {};
    if (isFixed || roll !== undefined) await this.#edition.lay(section, signal);
    return this.#edition.mapOf(section)?.size ?? leafOf(this.#edition.typography);
  }

  inSpread(index: number): ReturnType<NonNullable<PageSource["inSpread"]>> {
    const { section, page } = this.#pages.numbers.at(index);
    const { side, roll } = this.#book.sections[section] ?? {};
    if (roll !== undefined) return "single";
    if (page > 0) return undefined;
    if (side === undefined) return this.#pages.sideOf(section);
    if (side === "center") return "single";
    return (side === "left") === (this.direction === "ltr") ? "first" : "second";
  }

  colouring(index: number): "text" | "picture" {
    const { section } = this.#pages.numbers.at(index);
    return this.#book.sections[section]?.isFixed ? "picture" : "text";
  }

  label(index: number): string {
    return String(index + 1);
  }

  async draw(
    index: number,
    width: number,
    signal: AbortSignal,
    region: PageBox = wholePage,
    colours: PageColours | null = null,
  ): Promise<PagePicture> {
    signal.throwIfAborted();
    this.#drawing += 1;
    try {
      return await this.#draw(index, width, signal, region, colours);
    } finally {
      this.#drawing -= 1;
      if (this.#drawing === 0) void this.estimated;
    }
  }

  async #draw(
    index: number,
    width: number,
    signal: AbortSignal,
    region: PageBox,
    colours: PageColours | null,
  ): Promise<PagePicture> {
    const { section } = this.#at(index);
    const others = this.#recent.filter((other) => other !== section);
    this.#recent = [section, ...others].slice(0, nearSections);
    const { laid, page } = await this.#layPage(index, signal);
    if (this.#counter.isClosed) throw closedError(this.#book.name);
    laid.mark(this.narration?.markIn(section) ?? null);
    const size = laid.layoutSize;
    // Its pages were estimated.
    const own = this.colouring(index) === "text" ? colours : null;
    const paper = own?.paper ?? "#fff";
    const isBlank = page < 0 || page >= laid.map.pageCount;
    const margins = this.#heads.marginsOf(section, page, index + 1, laid.map);
    this.#keepDrawn(index);
    const svg = isBlank ? blank(size, paper) : await laid.svg(page, margins, own);
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
    if (!signal.aborted && !this.#counter.isClosed) return picture;
    picture.close();
    signal.throwIfAborted();
    throw closedError(this.#book.name);
  }

  async text(index: number, signal: AbortSignal, exact = false): Promise<readonly TextRun[]> {
    const { laid, page } = await this.#layPage(index, signal);
    return laid.runs(page, exact);
  }

  async *textPages(signal: AbortSignal): AsyncGenerator<TextPage> {
    for (const section of this.#book.sections.keys()) {
      let place: TextPlace = { section, fraction: 0 };
      // Set anew meanwhile, the section goes on where it was.
      for (let edition: Edition | null = null; edition !== this.#edition; ) {
        edition = this.#edition;
        // One that cannot be laid out has no text.
        await orAborted(
          edition.measure(section).catch(() => {}),
          signal,
        );
        if (this.#counter.isClosed) throw closedError(this.#book.name);
        const map = edition.mapOf(section);
        if (map === undefined) continue;
        for (let page = pageOfPlace(place, map); page < map.pageCount; page++) {
          if (edition !== this.#edition) break;
          place = placeOfPage(section, page, map);
          yield this.#textPage(edition, place, page);
        }
      }
    }
  }

  /** Returns a page of a section as an edition has it. */
  #textPage(edition: Edition, place: TextPlace, page: number): TextPage {
    const { section } = place;
    return {
      key: edition.keyOf(section, page),
      index: () => this.#pages.indexOfPlace(place),
      text: async (signal) => {
        const laid = await this.#lay(section, signal);
        return await laid.runs(
          edition === this.#edition ? page : pageOfPlace(place, laid.map),
          false,
        );
      },
    };
  }

  async alt(index: number, signal: AbortSignal): Promise<string> {
    const { laid, page } = await this.#layPage(index, signal);
    return laid.alt(page);
  }

  async links(index: number, signal: AbortSignal): Promise<readonly PageLink[]> {
    const { section } = this.#at(index);
    const { laid: chapter, page } = await this.#layPage(index, signal);
    const found = await chapter.links(page);
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
    const { section } = this.#at(index);
    const { laid, page } = await this.#layPage(index, signal);
    const found = await laid.media(page);
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
    return anchorOf(this.#pages.placeOn(index));
  }

  get keptCounts(): string | undefined {
    return this.#counter.keptCounts;
  }

  expectCounts(kept: string): void {
    this.#counter.expectCounts(kept);
  }

  findAnchors(anchors: readonly string[]): Promise<readonly (number | null)[]> {
    return this.#counter.findAnchors(anchors);
  }

  keepSide(index: number, side: "first" | "second"): void {
    this.#pages.keepSide(index, side);
  }

  keepOpen(indices: readonly number[]): void {
    this.#pages.keepOpen(indices);
  }

  settle(signal?: AbortSignal): Promise<void> {
    return this.#counter.settle(signal);
  }

  watchPages(listener: (change: () => NewIndex) => void): void {
    this.#counter.watch(listener);
  }

  watchDrawings(listener: (index: number) => void): void {
    this.#onDrawing = listener;
  }

  close(): void {
    if (this.#counter.isClosed) return;
    this.#counter.close();
    this.#titleFont?.close();
    this.#book.close();
  }

  get #pages(): NumberedPages {
    return this.#counter.pages;
  }

  get #edition(): Edition {
    return this.#counter.edition;
  }

  /** Returns which page a page is. */
  #at(index: number): SectionPage {
    if (this.#counter.isClosed) throw closedError(this.#book.name);
    if (!(index >= 0 && index < this.pageCount)) {
      throw new BookError(`${this.#book.name} has no page ${index + 1}; turn to another.`, {
        code: "noPage",
        source: this.#book.name,
      });
    }
    return this.#pages.show(this.#pages.numbers.at(index));
  }

  /** Lays out the section of a page (from 0), and returns which of its pages that is. */
  async #layPage(
    index: number,
    signal: AbortSignal,
  ): Promise<{ readonly laid: LaidChapter; readonly page: number }> {
    const { numbering } = this.#pages;
    this.#at(index);
    const numbered = numbering.numbers.at(index);
    const { section } = numbered;
    const laid = await this.#laid(section, signal);
    // It may have been counted since.
    const page =
      numbering === this.#pages.numbering
        ? this.#pages.show(numbered).page
        : numbering.pageOf(numbered, laid.map);
    // Now that it is known what is shown under the number.
    this.#counter.checkCount(section, laid);
    return { laid, page };
  }

  async #lay(section: number, signal: AbortSignal): Promise<LaidChapter> {
    const laid = await this.#laid(section, signal);
    this.#counter.checkCount(section, laid);
    return laid;
  }

  async #laid(section: number, signal: AbortSignal): Promise<LaidChapter> {
    try {
      return await this.#edition.lay(section, signal);
    } catch (error) {
      signal.throwIfAborted();
      throw this.#counter.isClosed ? closedError(this.#book.name) : error;
    }
  }

  /** Reads something of the book as it is set, and once more where it is set anew meanwhile. */
  async #whileSet<T>(read: () => Promise<T>, signal: AbortSignal): Promise<T> {
    for (;;) {
      const edition = this.#edition;
      try {
        return await read();
      } catch (error) {
        signal.throwIfAborted();
        if (this.#counter.isClosed) throw closedError(this.#book.name);
        if (edition === this.#edition) throw error;
      }
    }
  }

  /** Reports that pages of a section look otherwise; all of them if `pages` is null. */
  #redraw(section: number, pages: readonly number[] | null): void {
    const count = this.#pages.numbers.countOf(section);
    for (const page of pages ?? Array.from({ length: count }, (_, k) => k)) {
      this.#onDrawing?.(this.#pages.indexOf(section, page));
    }
  }

  #keepDrawn(index: number): void {
    this.#drawn.delete(index);
    this.#drawn.add(index);
    const [oldest] = this.#drawn;
    if (this.#drawn.size > mostDrawn && oldest !== undefined) this.#drawn.delete(oldest);
  }

  /**
   * Returns the page (from 1) of a target, and how far down that it is where it is scrolled; the
   * first page of its section, while no more is known.
   */
  #placeOf({ section, id }: FlowTarget): { page: number; top?: number } {
    const map = this.#edition.mapOf(section);
    const page = this.#pages.indexOf(section, map?.ids.get(id) ?? 0) + 1;
    const top = map?.tops.get(id);
    return top === undefined ? { page } : { page, top };
  }

  /** Has the pages drawn anew that have another number, once they have it. */
  #renumbered(moved: NewIndex | null): void {
    const drawn = [...this.#drawn];
    this.#drawn.clear();
    if (moved === null) return;
    queueMicrotask(() => {
      for (const index of drawn) {
        const now = moved(index);
        if (now === null || this.#counter.isClosed) continue;
        this.#drawn.add(now);
        if (now !== index) this.#onDrawing?.(now);
      }
    });
  }
}

function blank({ width, height }: PageSize, paper: string): string {
  return `<svg xmlns="http://www.w3.org/2000/svg" width="${width}" height="${height}"><rect width="${width}" height="${height}" fill="${paper}"/></svg>`;
}
