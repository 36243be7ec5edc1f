/** Which pages of which sources a book has, in their order, and where they are after each change. */

import { BookError, type NewIndex, type PageSource, placeOf } from "./page_source.ts";

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

/** The pages of a book, in order. Each is the same object for as long as the book has it. */
export class PageOrder {
  /** The source that the book was opened from. */
  readonly first: PageSource;
  /** The pages, and among them those that are taken out, each where it belongs. */
  #all: readonly Entry[] = [];
  /** The pages, without those. */
  #pages: ListedPages = [];

  constructor(first: PageSource) {
    this.first = first;
    this.reset();
  }

  /** The pages that are in the book. */
  get pages(): ListedPages {
    return this.#pages;
  }

  /** The sources of the pages that are in the book. */
  get shown(): ReadonlySet<PageSource> {
    return new Set(this.#pages.map(({ source }) => source));
  }

  /** The sources of all pages, those that are taken out too, and the first one. */
  get sources(): ReadonlySet<PageSource> {
    return new Set(this.#all.map(({ source }) => source)).add(this.first);
  }

  /**
   * Replaces `count` pages from `at` (from 0) on, which have to be there, by another source's pages; at the
   * end, appends them. Pages that are taken out stay after the page that they followed. Returns where the
   * others lie now.
   *
   * @throws BookError if none or too many would be left; nothing has changed then
   */
  splice(at: number, count: number, source: PageSource | null): NewIndex {
    const added = source ? entriesOf(source) : [];
    const removed = new Set(this.#pages.slice(at, at + count));
    const next = this.#pages[at];
    const place = next === undefined ? this.#all.length : this.#all.indexOf(next);
    const kept = (entry: Entry): boolean => !removed.has(entry);
    const [before, after] = [this.#all.slice(0, place), this.#all.slice(place)];
    checkCount(this.#pages.length - count + added.length);
    const moved = this.#change([...before, ...added, ...after.filter(kept)]);
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
    return indices.flatMap((index) => this.#pages[index] ?? []);
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
    const index = this.#pages.indexOf(page);
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
    checkCount(this.#pages.length - present.length);
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
    checkCount(this.#pages.length + back.length);
    for (const page of back) page.isOut = false;
    return this.#change(this.#all);
  }

  /** Has the first source's pages alone, as many as that counts now. */
  reset(): void {
    this.#set(entriesOf(this.first));
  }

  /** Takes all pages away. */
  clear(): void {
    this.#set([]);
  }

  /** Returns the page (from 1) that is a source's page (from 1), or null. */
  pageOf(source: PageSource, page: number): number | null {
    const here = (entry: Entry | undefined): boolean =>
      entry?.source === source && entry.index === page - 1;
    // Most books are never changed.
    if (here(this.#pages[page - 1])) return page;
    return this.#pages.findIndex(here) + 1 || null;
  }

  /**
   * Follows a source that has changed its pages. Pages of other sources stay
   * after the page that they followed; pages that were removed stay away, and those that are
   * taken out are what has become of them.
   *
   * @param change makes the source's change
   */
  renumber(source: PageSource, change: () => NewIndex): NewIndex {
    const before = this.#pages;
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
    const places = new Map(this.#pages.map((entry, index) => [entry, index]));
    const placeOfOwn = (index: number): number | null =>
      places.get(pages.get(index) as Entry) ??
      this.#pages.findIndex((entry) => entry.source === source && entry.index === index);
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

  #set(all: readonly Entry[]): void {
    this.#all = all;
    this.#pages = all.filter(({ isOut }) => !isOut);
  }

  /** Changes the pages. Returns where those from before lie now. */
  #change(all: readonly Entry[]): NewIndex {
    const before = this.#pages;
    this.#set(all);
    const places = new Map(this.#pages.map((entry, index) => [entry, index]));
    return (index) => places.get(before[index] as Entry) ?? null;
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
