/** A book whose pages may be added, removed and replaced while it is open. */

import {
  BookError,
  type LinkTarget,
  type Narration,
  type NewIndex,
  type OutlineEntry,
  type PageBox,
  type PageField,
  type PageLink,
  type PageMedium,
  type PagePicture,
  type PageSize,
  type PageSource,
  placeOf,
  type TextRun,
} from "./page_source.ts";

/** A page of a list: which page (from 0) of which source it is. */
interface Entry {
  readonly source: PageSource;
  readonly index: number;
}

/** Pages that were taken out of a list and may be put back. */
export type TakenPages = readonly Entry[];

/** Maximum of pages in a list: far more than a book has, few enough to keep in memory. */
const mostPages = 100_000;

/**
 * Presents pages of several sources as those of one book. Its title, direction
 * and other properties are the first source's; a source is closed once none of
 * its pages is left.
 */
export class PageList implements PageSource {
  readonly #first: PageSource;
  #entries: Entry[];
  /** What was taken out: its sources stay open. */
  readonly #taken = new Set<Entry[]>();
  #listener: ((change: () => NewIndex) => void) | null = null;
  #onDrawing: ((index: number) => void) | null = null;

  constructor(source: PageSource) {
    this.#first = source;
    this.#entries = entriesOf(source);
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

  element(index: number): HTMLElement | null {
    const entry = this.#entries[index];
    return entry?.source.element?.(entry.index) ?? null;
  }

  get title(): string {
    return this.#first.title;
  }

  get language(): string {
    return this.#first.language;
  }

  get direction(): "ltr" | "rtl" {
    return this.#first.direction;
  }

  get kind(): "typeset" | "scan" {
    return this.#first.kind;
  }

  get pageCount(): number {
    return this.#entries.length;
  }

  get openingPage(): number | undefined {
    return this.#first.openingPage;
  }

  get edge(): PageSource["edge"] {
    return this.#first.edge;
  }

  get layout(): PageSource["layout"] {
    return this.#first.layout;
  }

  get titleDirection(): PageSource["titleDirection"] {
    return this.#first.titleDirection;
  }

  get details(): PageSource["details"] {
    return this.#first.details;
  }

  get allows(): PageSource["allows"] {
    return this.#first.allows;
  }

  /** The first source's anchors; a page of another has that of the page before it. */
  get anchor(): PageSource["anchor"] {
    const first = this.#first;
    if (!first.anchor) return undefined;
    return (index) => {
      const before = this.#entries.slice(0, index + 1).findLast(({ source }) => source === first);
      return first.anchor?.(before?.index ?? 0) ?? "";
    };
  }

  /** Finds anchors of the first source, before it is watched. */
  get findAnchors(): PageSource["findAnchors"] {
    const first = this.#first;
    if (!first.findAnchors) return undefined;
    return async (anchors) => {
      const found = (await first.findAnchors?.(anchors)) ?? [];
      // Its pages are counted anew.
      if (this.#listener === null) this.#entries = entriesOf(first);
      return found;
    };
  }

  /** Sets the first source's text anew, if it can be. */
  get typeset(): PageSource["typeset"] {
    const first = this.#first;
    return first.typeset?.bind(first);
  }

  /** The first source's file, while the book has no other pages. */
  get file(): (() => Promise<Blob>) | undefined {
    const first = this.#first;
    const isWhole =
      this.#entries.length === first.pageCount &&
      this.#entries.every(({ source, index }, k) => source === first && index === k);
    return isWhole ? first.file?.bind(first) : undefined;
  }

  /** What is read aloud of the first source, on its pages that are left. */
  get narration(): Narration | undefined {
    const first = this.#first;
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

  draw(index: number, width: number, signal: AbortSignal, region?: PageBox): Promise<PagePicture> {
    return this.#of(index, (source, own) => source.draw(own, width, signal, region));
  }

  text(index: number, signal: AbortSignal, exact?: boolean): Promise<readonly TextRun[]> {
    return this.#of(index, async (source, own) => (await source.text?.(own, signal, exact)) ?? []);
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
        page: entry.page && this.#pageOf(this.#first, entry.page),
        children: moved(entry.children),
      }));
    return moved((await this.#first.outline?.(signal)) ?? []);
  }

  /** Closes every source. */
  close(): void {
    const kept = [this.#entries, ...this.#taken].flat();
    const sources = new Set(kept.map(({ source }) => source)).add(this.#first);
    this.#entries = [];
    this.#taken.clear();
    for (const source of sources) source.close();
  }

  /**
   * Replaces `count` pages from `at` (from 0) on by another source's pages; at
   * the end, appends them. The list owns the source from then on.
   *
   * @throws BookError if there are no such pages, or if none or too many would
   * be left; nothing has changed then
   */
  splice(at: number, count: number, source: PageSource | null): NewIndex {
    const moved = this.#replace(at, count, source ? entriesOf(source) : []);
    if (source) {
      this.#watch(source);
      this.#watchDrawings(source);
    }
    return moved;
  }

  /**
   * Returns what says where the page that is page `at` (from 0) now lies after later changes; -1
   * once it is not in the list.
   */
  track(at: number): () => number {
    const entry = this.#entries[at];
    return () => (entry ? this.#entries.indexOf(entry) : -1);
  }

  /**
   * Takes `count` pages from `at` (from 0) on out of the list, which still owns their sources.
   * Returns them, and where the others lie now.
   *
   * @throws BookError as `splice` does
   */
  take(at: number, count: number): { readonly pages: TakenPages; readonly moved: NewIndex } {
    const pages = this.#entries.slice(at, at + count);
    this.#taken.add(pages);
    try {
      return { pages, moved: this.#replace(at, count, []) };
    } catch (error) {
      this.#taken.delete(pages);
      throw error;
    }
  }

  /**
   * Puts pages that were taken out back before page `at` (from 0, clamped to the list). Returns
   * where the others lie now; null if they are not out.
   */
  putBack(at: number, pages: TakenPages): NewIndex | null {
    if (!this.#taken.delete(pages as Entry[])) return null;
    return this.#replace(Math.min(Math.max(at, 0), this.pageCount), 0, pages);
  }

  #replace(at: number, count: number, added: readonly Entry[]): NewIndex {
    const before = this.#entries;
    const left = before.length - count + added.length;
    if (!Number.isInteger(at) || !(at >= 0 && count >= 0 && at + count <= before.length)) {
      throw new BookError(`${this.title} has pages 1 to ${before.length} alone; name those.`);
    }
    if (left === 0) throw new BookError("A book needs a page; leave one of them.");
    if (left > mostPages) throw new BookError(`A book has ${mostPages} pages at most; add fewer.`);
    this.#entries = [...before.slice(0, at), ...added, ...before.slice(at + count)];
    const kept = [this.#entries, ...this.#taken].flat();
    const inUse = new Set(kept.map((entry) => entry.source)).add(this.#first);
    for (const used of new Set(before.map((entry) => entry.source))) {
      if (!inUse.has(used)) used.close();
    }
    return (index) => {
      if (index < at) return index;
      return index < at + count ? null : index - count + added.length;
    };
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
   * after the page that they followed; pages that were removed stay away, and those that were
   * taken out are what has become of them.
   */
  #renumber(source: PageSource, change: () => NewIndex): NewIndex {
    const before = this.#entries;
    const count = source.pageCount;
    const moved = change();
    const placeIn = (own: number): number => Math.min(placeOf(moved, own), source.pageCount - 1);
    const left = new Set(before.flatMap((entry) => (entry.source === source ? entry.index : [])));
    const removed = new Set<number | null>();
    for (let own = 0; own < count; own++) if (!left.has(own)) removed.add(moved(own));
    const after: Entry[] = [];
    const newIndices: number[] = [];
    let next = 0;
    const addUntil = (end: number): void => {
      for (; next < end; next++) if (!removed.has(next)) after.push({ source, index: next });
    };
    const last = before.findLastIndex((entry) => entry.source === source);
    before.forEach((entry, k) => {
      if (entry.source !== source) newIndices[k] = after.push(entry) - 1;
      else addUntil(k === last ? source.pageCount : placeIn(entry.index) + 1);
    });
    this.#entries = after;
    for (const taken of this.#taken) {
      const kept = taken.flatMap((entry) => {
        const index = entry.source === source ? moved(entry.index) : entry.index;
        return index === null ? [] : [{ source: entry.source, index }];
      });
      const isFirst = (entry: Entry, k: number): boolean =>
        kept.findIndex((one) => one.source === entry.source && one.index === entry.index) === k;
      taken.splice(0, taken.length, ...kept.filter(isFirst));
    }
    const find = (own: number | null): number =>
      after.findIndex((entry) => entry.source === source && entry.index === own);
    const follow = (k: number, own: (index: number) => number | null): number | null => {
      const entry = before[k];
      const index = entry?.source === source ? find(own(entry.index)) : newIndices[k];
      return index === undefined || index < 0 ? null : index;
    };
    return Object.assign((k: number) => follow(k, moved), {
      placeOf: (k: number) => follow(k, placeIn) ?? 0,
    });
  }

  async #of<T>(index: number, ask: (source: PageSource, own: number) => Promise<T>): Promise<T> {
    const entry = this.#entries[index];
    if (!entry) throw new BookError(`${this.title} has no page ${index + 1}; turn to another.`);
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

function entriesOf(source: PageSource): Entry[] {
  return Array.from({ length: source.pageCount }, (_, index) => ({ source, index }));
}
