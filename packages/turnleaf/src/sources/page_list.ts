/** A book whose pages may be added, removed and replaced while it is open. */

import { limits } from "./limits.ts";
import { loadPart } from "./load_part.ts";
import {
  BookError,
  type BookWarning,
  type LinkTarget,
  type Narration,
  type NewIndex,
  type OutlineEntry,
  type PageBox,
  type PageColours,
  type PageField,
  type PageLink,
  type PageMedium,
  type PagePicture,
  type PageSize,
  type PageSource,
  placeOf,
  type TextPage,
  type TextRun,
} from "./page_source.ts";
import { joinedWarnings } from "./warnings.ts";

/**
 * A page of a list: which page (from 0) of which source it is. It is the same object for as long
 * as the list has the page.
 */
interface Entry {
  readonly source: PageSource;
  index: number;
  /** Whether it is taken out, and may be put back. */
  isOut: boolean;
}

/** Pages of a list, however others are added, removed or taken out. */
export type ListedPages = readonly Entry[];

/** Maximum of pages in a list: far more than a book has, few enough to keep in memory. */
const mostPages = 100_000;

/**
 * Presents pages of several sources as those of one book. Its title, direction
 * and other properties are the first source's; a source is closed once none of
 * its pages is left.
 */
export class PageList implements PageSource {
  /** The source that the book was opened from. */
  readonly first: PageSource;
  /** The pages, in order, and among them those that are taken out, each where it belongs. */
  #all: readonly Entry[] = [];
  /** The pages, without those. */
  #entries: readonly Entry[] = [];
  #listener: ((change: () => NewIndex) => void) | null = null;
  #onDrawing: ((index: number) => void) | null = null;
  #onWarning: (() => void) | null = null;
  /** Why pages could not be drawn when they were drawn last. */
  readonly #errors = new Map<Entry, BookError>();
  /** The colours in which pages are drawn, unless `draw` is given others; null for their own. */
  colours: PageColours | null = null;

  constructor(source: PageSource) {
    this.first = source;
    this.#set(entriesOf(source));
  }

  watchPages(listener: (change: () => NewIndex) => void): void {
    this.#listener = listener;
    for (const source of new Set(this.#entries.map((entry) => entry.source))) this.#watch(source);
  }

  watchDrawings(listener: (index: number) => void): void {
    this.#onDrawing = listener;
    const sources = new Set(this.#entries.map((entry) => entry.source));
    for (const source of sources) this.#watchDrawings(source);
  }

  /** What cannot be shown of all sources, and the pages that could not be drawn. */
  get warnings(): readonly BookWarning[] {
    const sources = [...new Set(this.#entries.map((entry) => entry.source))];
    const listed = sources.flatMap((source) =>
      (source.warnings ?? []).flatMap((warning): BookWarning[] => {
        if (warning.page === undefined) return [warning];
        const page = this.#pageOf(source, warning.page);
        return page === null ? [] : [{ ...warning, page }];
      }),
    );
    const failed = [...this.#errors].flatMap(([entry, error]): BookWarning[] => {
      const index = this.indexOf(entry);
      const { message, source } = error;
      const about = source === undefined ? {} : { source };
      return index === null ? [] : [{ code: "page", message, page: index + 1, error, ...about }];
    });
    // A page that was drawn says more of why it is none.
    const pages = new Set(failed.map(({ page }) => page));
    const others = listed.filter(({ code, page }) => code !== "page" || !pages.has(page));
    return joinedWarnings(others, failed);
  }

  watchWarnings(listener: () => void): void {
    this.#onWarning = listener;
    for (const source of new Set(this.#entries.map((entry) => entry.source))) {
      source.watchWarnings?.(listener);
    }
  }

  outdate(index: number): void {
    const entry = this.#entries[index];
    entry?.source.outdate?.(entry.index);
  }

  watchSizes(listener: () => void): void {
    for (const source of new Set(this.#entries.map((entry) => entry.source))) {
      source.watchSizes?.(listener);
    }
  }

  element(index: number): HTMLElement | null {
    const entry = this.#entries[index];
    return entry?.source.element?.(entry.index) ?? null;
  }

  get title(): string {
    return this.first.title;
  }

  get language(): string {
    return this.first.language;
  }

  get direction(): "ltr" | "rtl" {
    return this.first.direction;
  }

  widthInMetres(size: PageSize): number | undefined {
    return this.first.widthInMetres?.(size);
  }

  /** The first source's; without the page that is its cover the boards are stamped. */
  get cover(): PageSource["cover"] {
    const { first } = this;
    const [entry] = this.#entries;
    const isLost = entry?.source !== first || entry.index > 0;
    return first.cover === "picture" && isLost ? "stamped" : first.cover;
  }

  get authors(): PageSource["authors"] {
    return this.first.authors;
  }

  get kind(): "typeset" | "scan" {
    return this.first.kind;
  }

  get pageCount(): number {
    return this.#entries.length;
  }

  get isEstimated(): boolean {
    return this.first.isEstimated ?? false;
  }

  get isGuessed(): boolean {
    return this.first.isGuessed ?? false;
  }

  get openingPage(): number | undefined {
    return this.first.openingPage;
  }

  get edge(): PageSource["edge"] {
    return this.first.edge;
  }

  get layout(): PageSource["layout"] {
    return this.first.layout;
  }

  mayFace(width: number, alone: number): boolean {
    return this.first.mayFace?.(width, alone) ?? true;
  }

  get leaf(): PageSize | undefined {
    return this.first.leaf;
  }

  get usualLeaf(): PageSize | undefined {
    return this.first.usualLeaf;
  }

  get titleFont(): PageSource["titleFont"] {
    return this.first.titleFont;
  }

  get titleDirection(): PageSource["titleDirection"] {
    return this.first.titleDirection;
  }

  get details(): PageSource["details"] {
    return this.first.details;
  }

  get allows(): PageSource["allows"] {
    return this.first.allows;
  }

  /** The first source's anchors; a page of another has that of the page before it. */
  get anchor(): PageSource["anchor"] {
    const first = this.first;
    if (!first.anchor) return undefined;
    return (index) => {
      const before = this.#entries.slice(0, index + 1).findLast(({ source }) => source === first);
      return first.anchor?.(before?.index ?? 0) ?? "";
    };
  }

  /** Finds anchors of the first source. */
  get findAnchors(): PageSource["findAnchors"] {
    const first = this.first;
    if (!first.findAnchors) return undefined;
    return async (anchors) => {
      const found = (await first.findAnchors?.(anchors)) ?? [];
      // Its pages are counted anew.
      if (this.#listener === null) this.#set(entriesOf(first));
      return found.map((index) => {
        const page = index === null ? null : this.#pageOf(first, index + 1);
        return page === null ? null : page - 1;
      });
    };
  }

  keepSide(index: number, side: "first" | "second"): void {
    const entry = this.#entries[index];
    entry?.source.keepSide?.(entry.index, side);
  }

  /** Sets the first source's text anew, if it can be. */
  get typeset(): PageSource["typeset"] {
    const first = this.first;
    return first.typeset?.bind(first);
  }

  /** The first source's file, while the book has no other pages. */
  get file(): (() => Promise<Blob>) | undefined {
    const first = this.first;
    const isWhole =
      this.#entries.length === first.pageCount &&
      this.#entries.every(({ source, index }, k) => source === first && index === k);
    return isWhole ? first.file?.bind(first) : undefined;
  }

  /** What is read aloud of the first source, on its pages that are left. */
  get narration(): Narration | undefined {
    const first = this.first;
    const { narration } = first;
    if (narration === undefined) return undefined;
    return {
      clipFrom: async (index, signal) => {
        const next = this.#entries.slice(index).find(({ source }) => source === first);
        return next ? await narration.clipFrom(next.index, signal) : null;
      },
      clip: async (number, signal) => {
        const clip = await narration.clip(number, signal);
        if (clip === null) return null;
        const pages = clip.pages.flatMap(({ page, from }) => {
          const here = this.#pageOf(first, page + 1);
          return here === null ? [] : [{ page: here - 1, from }];
        });
        return { ...clip, pages };
      },
      mark: (number) => narration.mark(number),
    };
  }

  size(index: number, signal?: AbortSignal): Promise<PageSize> {
    return this.#of(index, (source, own) => source.size(own, signal));
  }

  label(index: number): string {
    const entry = this.#entries[index];
    const label = entry?.source.label(entry.index);
    // Pages that are merely numbered are renumbered.
    return label === undefined || label === String(entry.index + 1) ? String(index + 1) : label;
  }

  inSpread(index: number): ReturnType<NonNullable<PageSource["inSpread"]>> {
    const entry = this.#entries[index];
    return entry?.source.inSpread?.(entry.index);
  }

  roll(index: number): number | null {
    const entry = this.#entries[index];
    return entry?.source.roll?.(entry.index) ?? null;
  }

  /** What is done with a page (from 0) in the colours as they are, if their paper is dark: "" if nothing, or it is set in them. */
  darkened(index: number): PageColours["pictures"] {
    const { colours } = this;
    const what = this.#drawnAs(index);
    if (!colours?.isDark || what === "text") return "";
    return colours.pictures || (what === "print" ? "invert" : "dim");
  }

  /** Returns what page `index` is in other colours; elements are as the web page has them. */
  #drawnAs(index: number): "text" | "print" | "picture" {
    const entry = this.#entries[index];
    if (!entry || entry.source.element?.(entry.index)) return "text";
    const { source } = entry;
    return source.colouring?.(entry.index) ?? (source.kind === "typeset" ? "print" : "picture");
  }

  /** Returns the picture of a page in colours of the reader's. */
  async #inColours(
    index: number,
    picture: PagePicture,
    colours: PageColours,
  ): Promise<PagePicture> {
    // Nobody turns a cover's colours over.
    const isCover = this.cover === "picture" && index === 0;
    const what = isCover ? "picture" : this.#drawnAs(index);
    if (what === "text") return picture;
    const { tinted } = await loadPart(import("./tint.ts"));
    const other = tinted(picture, what, isCover ? { ...colours, pictures: "dim" } : colours);
    if (other !== picture && "close" in picture) picture.close();
    return other;
  }

  async draw(
    index: number,
    width: number,
    signal: AbortSignal,
    region?: PageBox,
    colours: PageColours | null = this.colours,
  ): Promise<PagePicture> {
    const entry = this.#entries[index];
    try {
      const picture = await this.#of(index, (source, own) =>
        source.draw(own, width, signal, region, colours),
      );
      if (entry) this.#errors.delete(entry);
      return colours === null ? picture : await this.#inColours(index, picture, colours);
    } catch (error) {
      const isListed = entry !== undefined && this.#errors.size < limits.warnings;
      if (isListed && error instanceof BookError && error.code !== "closed") {
        this.#errors.set(entry, error);
        this.#onWarning?.();
      }
      throw error;
    }
  }

  text(index: number, signal: AbortSignal, exact?: boolean): Promise<readonly TextRun[]> {
    return this.#of(index, async (source, own) => (await source.text?.(own, signal, exact)) ?? []);
  }

  /** Goes through the pages as they lie, and through all those at once whose source goes through its own. */
  async *textPages(signal: AbortSignal): AsyncGenerator<TextPage> {
    const done = new Set<PageSource>();
    for (let at = 0, entry = this.#entries[0]; entry; entry = this.#entries[++at]) {
      const { source } = entry;
      if (!source.textPages) {
        const page = entry;
        const text = async (own: AbortSignal): Promise<readonly TextRun[]> =>
          (await source.text?.(page.index, own)) ?? [];
        yield { key: page, index: () => this.indexOf(page), text };
      } else if (!done.has(source)) {
        done.add(source);
        for await (const page of source.textPages(signal)) {
          const index = (): number | null => {
            const own = page.index();
            const here = own === null ? null : this.#pageOf(source, own + 1);
            return here === null ? null : here - 1;
          };
          if (index() !== null) yield { ...page, index };
        }
      }
      // Pages may have been added and removed meanwhile.
      const now = this.#entries.indexOf(entry);
      if (now >= 0) at = now;
    }
  }

  alt(index: number, signal: AbortSignal): Promise<string> {
    return this.#of(index, async (source, own) => (await source.alt?.(own, signal)) ?? "");
  }

  fields(index: number, signal: AbortSignal): Promise<readonly PageField[]> {
    return this.#of(index, async (source, own) => (await source.fields?.(own, signal)) ?? []);
  }

  media(index: number, signal: AbortSignal): Promise<readonly PageMedium[]> {
    return this.#of(index, async (source, own) => (await source.media?.(own, signal)) ?? []);
  }

  fill(index: number, name: string, value: string): void {
    const entry = this.#entries[index];
    entry?.source.fill?.(entry.index, name, value);
  }

  /** Returns a page's links, without those to removed pages. */
  links(index: number, signal: AbortSignal): Promise<readonly PageLink[]> {
    return this.#of(index, async (source, own) => {
      const links = (await source.links?.(own, signal)) ?? [];
      return links.flatMap((link) => {
        const to = this.#target(source, link.to);
        return to ? [{ ...link, to }] : [];
      });
    });
  }

  async outline(signal: AbortSignal): Promise<readonly OutlineEntry[]> {
    const moved = (entries: readonly OutlineEntry[]): readonly OutlineEntry[] =>
      entries.map((entry) => ({
        ...entry,
        page: entry.page && this.#pageOf(this.first, entry.page),
        children: moved(entry.children),
      }));
    return moved((await this.first.outline?.(signal)) ?? []);
  }

  /** Closes every source. */
  close(): void {
    const sources = this.#sources;
    this.#set([]);
    for (const source of sources) source.close();
  }

  /**
   * Replaces `count` pages from `at` (from 0) on by another source's pages; at
   * the end, appends them. The list owns the source from then on. Pages that are taken out stay
   * after the page that they followed.
   *
   * @throws BookError if there are no such pages, or if none or too many would
   * be left; nothing has changed then
   */
  splice(at: number, count: number, source: PageSource | null): NewIndex {
    const { length } = this.#entries;
    if (!Number.isInteger(at) || !(at >= 0 && count >= 0 && at + count <= length)) {
      throw new BookError(`${this.title} has pages 1 to ${length} alone; name those.`, {
        code: "noPage",
        source: this.title,
      });
    }
    const added = source ? entriesOf(source) : [];
    const removed = new Set(this.#entries.slice(at, at + count));
    const next = this.#entries[at];
    const place = next === undefined ? this.#all.length : this.#all.indexOf(next);
    const kept = (entry: Entry): boolean => !removed.has(entry);
    const [before, after] = [this.#all.slice(0, place), this.#all.slice(place)];
    checkCount(length - count + added.length);
    const moved = this.#change([...before, ...added, ...after.filter(kept)]);
    if (source) {
      this.#watch(source);
      this.#watchDrawings(source);
      if (this.#onWarning) source.watchWarnings?.(this.#onWarning);
    }
    if (added.length === 0 || count === 0) return moved;
    // What replaces a page has its place.
    const follow = (index: number): number =>
      index >= at && index < at + count
        ? at + Math.min(index - at, added.length - 1)
        : (moved(index) as number);
    return Object.assign((index: number) => moved(index), { placeOf: follow });
  }

  /** Returns pages (from 0), to be taken out wherever they lie by then. */
  pagesAt(indices: readonly number[]): ListedPages {
    return indices.flatMap((index) => this.#entries[index] ?? []);
  }

  /** Returns the page that follows others, in the list or taken out; undefined if none does. */
  after(pages: ListedPages): ListedPages[number] | undefined {
    const last = this.#all.findLastIndex((entry) => pages.includes(entry));
    return this.#all.slice(last + 1).find(({ isOut }) => !isOut);
  }

  /** Returns which page (from 0) of the source that the book was opened from a page is; null for another's. */
  homeOf(page: ListedPages[number] | undefined): number | null {
    return page?.source === this.first ? page.index : null;
  }

  /** Returns where a page lies (from 0); null if it is taken out or no longer in the list. */
  indexOf(page: ListedPages[number]): number | null {
    const index = this.#entries.indexOf(page);
    return index < 0 ? null : index;
  }

  /**
   * Takes pages out of the list, which still owns their sources, as far as they are in it. Returns
   * where the others lie now.
   *
   * @throws BookError if none of them is in the list, or no other; nothing has changed then
   */
  takeOut(pages: ListedPages): NewIndex {
    const present = pages.filter((page) => this.indexOf(page) !== null);
    if (present.length === 0)
      throw new BookError("These pages were removed; name others.", { code: "noPage" });
    checkCount(this.pageCount - present.length);
    for (const page of present) page.isOut = true;
    return this.#change(this.#all);
  }

  /**
   * Puts pages that are taken out back where they belong. Returns where the others lie now.
   *
   * @throws BookError if there would be too many; nothing has changed then
   */
  putBack(pages: ListedPages): NewIndex {
    const back = pages.filter((page) => page.isOut && this.#all.includes(page));
    checkCount(this.pageCount + back.length);
    for (const page of back) page.isOut = false;
    return this.#change(this.#all);
  }

  /** The sources of all pages, those that are taken out too, and the first one. */
  get #sources(): ReadonlySet<PageSource> {
    return new Set(this.#all.map(({ source }) => source)).add(this.first);
  }

  #set(all: readonly Entry[]): void {
    this.#all = all;
    this.#entries = all.filter(({ isOut }) => !isOut);
  }

  /** Changes the pages, and closes sources without any. Returns where those from before lie now. */
  #change(all: readonly Entry[]): NewIndex {
    const [before, sources] = [this.#entries, this.#sources];
    this.#set(all);
    const inUse = this.#sources;
    for (const source of sources) if (!inUse.has(source)) source.close();
    const places = new Map(this.#entries.map((entry, index) => [entry, index]));
    return (index) => places.get(before[index] as Entry) ?? null;
  }

  #watch(source: PageSource): void {
    if (this.#listener === null) return;
    source.watchPages?.((change) => this.#listener?.(() => this.#renumber(source, change)));
  }

  #watchDrawings(source: PageSource): void {
    if (this.#onDrawing === null) return;
    source.watchDrawings?.((own) => {
      const page = this.#pageOf(source, own + 1);
      if (page !== null) this.#onDrawing?.(page - 1);
    });
  }

  /**
   * Follows a source that has changed its pages. Pages of other sources stay
   * after the page that they followed; pages that were removed stay away, and those that are
   * taken out are what has become of them.
   */
  #renumber(source: PageSource, change: () => NewIndex): NewIndex {
    const before = this.#entries;
    const count = source.pageCount;
    const own = this.#all.filter((entry) => entry.source === source);
    const ownIndex = new Map(own.map((entry) => [entry, entry.index]));
    const moved = change();
    const placeIn = (index: number): number =>
      Math.min(placeOf(moved, index), source.pageCount - 1);
    const removed = removedPages(new Set(ownIndex.values()), count, moved);
    // The page that each of the source's pages now is. Where one is taken out, it stays out.
    const pages = new Map<number, Entry>();
    for (const entry of [...own].sort((a, b) => Number(b.isOut) - Number(a.isOut))) {
      const index = moved(entry.index);
      if (index !== null && !pages.has(index)) pages.set(index, entry);
    }
    const after: Entry[] = [];
    let next = 0;
    const addUntil = (end: number): void => {
      for (; next < end; next++) {
        const page = pages.get(next);
        if (removed.has(next) && !page?.isOut) continue;
        after.push(page ?? { source, index: next, isOut: false });
      }
    };
    for (const entry of this.#all) {
      const index = ownIndex.get(entry);
      if (index === undefined) after.push(entry);
      else addUntil(entry === own.at(-1) ? source.pageCount : placeIn(index) + 1);
    }
    for (const [index, page] of pages) page.index = index;
    this.#set(after);
    const places = new Map(this.#entries.map((entry, index) => [entry, index]));
    const placeOfOwn = (index: number): number | null =>
      places.get(pages.get(index) as Entry) ??
      this.#entries.findIndex((entry) => entry.source === source && entry.index === index);
    const follow = (k: number, move: (index: number) => number | null): number | null => {
      const entry = before[k] as Entry;
      const index = ownIndex.get(entry);
      const now = index === undefined ? undefined : move(index);
      const place = now === undefined ? places.get(entry) : now === null ? null : placeOfOwn(now);
      return place === undefined || place === null || place < 0 ? null : place;
    };
    return Object.assign((k: number) => follow(k, moved), {
      placeOf: (k: number) => follow(k, placeIn) ?? 0,
    });
  }

  async #of<T>(index: number, ask: (source: PageSource, own: number) => Promise<T>): Promise<T> {
    const entry = this.#entries[index];
    if (!entry)
      throw new BookError(`${this.title} has no page ${index + 1}; turn to another.`, {
        code: "noPage",
        source: this.title,
      });
    return await ask(entry.source, entry.index);
  }

  /** The page (from 1) of this book that is a source's page (from 1), or null. */
  #pageOf(source: PageSource, page: number): number | null {
    const here = (entry: Entry | undefined): boolean =>
      entry?.source === source && entry.index === page - 1;
    // Most books are never changed.
    if (here(this.#entries[page - 1])) return page;
    return this.#entries.findIndex(here) + 1 || null;
  }

  #target(source: PageSource, to: LinkTarget): LinkTarget | null {
    if (!("page" in to)) return to;
    const page = this.#pageOf(source, to.page);
    return page === null ? null : { ...to, page };
  }
}

/** @throws BookError if a list may not have so many pages */
function checkCount(pages: number): void {
  if (pages === 0)
    throw new BookError("A book needs a page; leave one of them.", { code: "noPage" });
  if (pages > mostPages)
    throw new BookError(`A book has ${mostPages} pages at most; add fewer.`, { code: "tooLarge" });
}

/** Returns a source's pages as those of a list. */
function entriesOf(source: PageSource): Entry[] {
  return Array.from({ length: source.pageCount }, (_, index) => ({ source, index, isOut: false }));
}

/** Returns where the pages of a source now are that a list does not have, of so many before a change. */
function removedPages(
  listed: ReadonlySet<number>,
  count: number,
  moved: NewIndex,
): ReadonlySet<number | null> {
  const removed = new Set<number | null>();
  for (let index = 0; index < count; index++) if (!listed.has(index)) removed.add(moved(index));
  return removed;
}
