/** The pages of an element's book that were torn out, and may be put back. */

import type { PageList, TakenPages } from "../sources/page_list.ts";
import { BookError, type NewIndex, placeOf } from "../sources/page_source.ts";
import type { TearOwner } from "../viewer/viewer_options.ts";
import type { OpenBook } from "./book_lifecycle.ts";

/** What torn pages need of their element. */
export interface TornPagesHost {
  /** Returns the open book. */
  readonly book: () => OpenBook | null;
  /** Returns how leaves are bound; null if none may be torn out. */
  readonly line: TearOwner["line"];
  /** Asks listeners whether pages (from 1) may be torn out. */
  readonly ask: (pages: readonly number[]) => boolean;
  /** Pages are torn out. */
  readonly torn: (pages: readonly number[]) => void;
  /** The book's pages lie elsewhere. */
  readonly changed: (moved: NewIndex) => void;
  /** Returns the bookmarked pages (from 1). */
  readonly bookmarks: () => readonly number[];
  /** Bookmarks pages (from 1) besides those that are bookmarked. */
  readonly bookmark: (pages: readonly number[]) => void;
  /** Turns to a page (from 1) without motion. */
  readonly show: (page: number) => void;
  /** Work was done in tearing, J. */
  readonly heard: (work: number) => void;
}

/** A leaf that is out: its pages, and where they were. */
interface TornLeaf {
  readonly id: number;
  readonly pages: TakenPages;
  /** Which of its pages were bookmarked, from 0. */
  readonly bookmarked: readonly number[];
  /** Index (from 0) before which they belong. */
  at: number;
}

/** Keeps the torn leaves of one book, the last one torn last. */
export class TornPages implements TearOwner {
  readonly #host: TornPagesHost;
  #leaves: TornLeaf[] = [];
  /** The pages of the book that they are out of. */
  #source: PageList | null = null;
  #lastId = 0;
  /** Whether a change of pages is this one's own: others move what is out. */
  #isOwn = false;

  constructor(host: TornPagesHost) {
    this.#host = host;
  }

  /** Number of leaves that are out of the open book. */
  get count(): number {
    return this.#host.book() === null ? 0 : this.#leaves.length;
  }

  line(): ReturnType<TearOwner["line"]> {
    return this.#host.line();
  }

  mayTear(pages: readonly number[]): boolean {
    return this.#host.ask(pages);
  }

  heard(work: number): void {
    this.#host.heard(work);
  }

  takeOut(pages: readonly number[]): number | null {
    const book = this.#host.book();
    if (book === null) return null;
    const place = book.source.track(pages[0] - 1);
    const id = ++this.#lastId;
    const marks = this.#host.bookmarks();
    const bookmarked = [...pages.keys()].filter((k) => marks.includes(pages[k]));
    // The viewer lies at rest: the change is made at once, after those that waited for that.
    const isOut = this.#change(book, () => {
      const at = place();
      const { pages: taken, moved } = book.source.take(at, pages.length);
      this.#leaves.push({ id, pages: taken, bookmarked, at });
      return moved;
    });
    if (isOut) this.#host.torn(pages);
    return isOut ? id : null;
  }

  /** Puts the pages that were torn out last back. They lie open then. Resolves to whether there were any. */
  async putBack(): Promise<boolean> {
    const book = this.#host.book();
    const leaf = book && this.#leaves.pop();
    if (!leaf) return false;
    let moved = null as NewIndex | null;
    try {
      await book.viewer.changePages(() => {
        moved = book.elements.after(
          () => book.source.putBack(leaf.at, leaf.pages) ?? ((index) => index),
        );
        return moved;
      });
    } finally {
      // It stays out.
      if (moved === null && this.#host.book()?.source === this.#source) this.#leaves.push(leaf);
    }
    if (moved === null) return false;
    book.viewer.removeSheet(leaf.id);
    this.#changed(book, moved);
    // Text that was set anew meanwhile may have fewer pages there.
    const back = leaf.bookmarked.filter((k) => k < leaf.pages.length);
    if (back.length > 0) this.#host.bookmark(back.map((k) => leaf.at + 1 + k));
    this.#host.show(leaf.at + 1);
    return true;
  }

  /** Follows other changes of the pages: what is out stays after the page that it followed. */
  move(moved: NewIndex): void {
    if (this.#isOwn) return;
    for (const leaf of this.#leaves) {
      const before = leaf.at - 1;
      // Where the page before it was removed, what has its place comes after it.
      if (leaf.at > 0) leaf.at = placeOf(moved, before) + (moved(before) === null ? 0 : 1);
    }
  }

  /** Call it when a book is open: forgets what is out of another. */
  opened(source: PageList): void {
    if (source !== this.#source) this.#leaves = [];
    this.#source = source;
  }

  #change(book: OpenBook, change: () => NewIndex): boolean {
    let moved = null as NewIndex | null;
    const made = book.viewer.changePages(() => {
      moved = book.elements.after(change);
      return moved;
    });
    // A book keeps its last page: that one stays bound.
    made.catch((error: unknown) => {
      if (!(error instanceof BookError)) throw error;
    });
    if (moved === null) return false;
    this.#changed(book, moved);
    return true;
  }

  #changed(book: OpenBook, moved: NewIndex): void {
    book.reading.changed();
    this.#isOwn = true;
    this.#host.changed(moved);
    this.#isOwn = false;
  }
}
