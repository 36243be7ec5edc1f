/**
 * The pages of an element's book that were torn out, and may be put back. Loaded when a book may be
 * torn.
 */

import type { PageList } from "../sources/page_list.ts";
import type { ListedPages } from "../sources/page_order.ts";
import { BookError, type NewIndex } from "../sources/page_source.ts";
import type { MovedPages, TakenPages } from "../viewer/moved_pages.ts";
import type { OpenBook } from "./open_book.ts";
import { joinedLists, listsAmong, movedLists, type PageLists } from "./page_lists.ts";
import { cleanPages } from "./page_numbers.ts";

/** What torn pages need of their element. */
export interface TornPagesHost {
  /** Returns the open book. */
  readonly book: () => OpenBook | null;
  /** Pages are torn out. */
  readonly torn: (pages: readonly number[]) => void;
  /** The book has other pages. */
  readonly changed: () => void;
  /** What names pages. A change is reported with the next of the pages. */
  lists: PageLists;
  /**
   * Returns on which face of its leaf a page (from 1) lies, 0 or 1 in the order of reading; null
   * where each leaf has one page.
   */
  readonly faceOf: (page: number) => number | null;
  /** Turns to a page (from 1) without motion. */
  readonly show: (page: number) => void;
}

/** A leaf that is out. */
interface TornLeaf {
  readonly id: number;
  readonly pages: ListedPages;
  /** What lists said of them, each page named by its place among them, from 1. */
  readonly lists: PageLists;
  /** Whether the pages after it lie on the faces where they lay. */
  readonly keepsFaces: boolean;
}

/** Keeps the torn leaves of one book, the last one torn last. */
export class TornPages {
  readonly #host: TornPagesHost;
  #leaves: TornLeaf[] = [];
  /** The pages of the book that they are out of. */
  #source: PageList | null = null;
  #lastId = 0;

  constructor(host: TornPagesHost) {
    this.#host = host;
  }

  /** Number of leaves that are out of the open book. */
  get count(): number {
    return this.#host.book() === null ? 0 : this.#leaves.length;
  }

  /** Returns lists of the pages of the source that the book was opened from, with those that are out of it. */
  addTo(lists: PageLists): PageLists {
    const source = this.#source;
    if (this.#host.book() === null || source === null) return lists;
    return this.#leaves.reduce((all, leaf) => {
      return joinedLists(
        all,
        listsOf(leaf, (page) => source.order.homeOf(page)),
      );
    }, lists);
  }

  /** Takes pages (from 1) out of the book, as `TearOwner` says. */
  takeOut(pages: readonly number[], moved: NewIndex): TakenPages | null {
    const book = this.#host.book();
    if (book === null) return null;
    const { source } = book;
    const indices = pages.map((page) => moved(page - 1)).filter((index) => index !== null);
    const leaf = source.order.pagesAt(indices);
    const named = indices.map((index) => index + 1);
    const lists = listsAmong(this.#host.lists, named, source.pageCount);
    const keepFaces = this.#facesAfter(source, leaf);
    let changed: MovedPages;
    try {
      changed = book.changeNow(() => source.order.takeOut(leaf), keepFaces);
    } catch (error) {
      // A book keeps its last page, and the leaf's own may have been removed meanwhile.
      if (error instanceof BookError) return null;
      throw error;
    }
    const id = ++this.#lastId;
    this.#leaves.push({ id, pages: leaf, lists, keepsFaces: keepFaces !== noFaces });
    // The viewer binds the book first.
    queueMicrotask(() => {
      this.#host.changed();
      this.#host.torn(pages);
    });
    return { id, ...changed };
  }

  /** Puts the pages that were torn out last back. They lie open then. Resolves to whether there were any. */
  async putBack(): Promise<boolean> {
    const book = this.#host.book();
    const leaf = book && this.#leaves.pop();
    if (!leaf) return false;
    const { source, viewer } = book;
    let isBack = false;
    let keepFaces = noFaces;
    // Text that was set anew meanwhile may have fewer pages there.
    const indexOf = (page: ListedPages[number]): number | null => source.order.indexOf(page);
    try {
      isBack = await book.changePages(
        () => {
          if (leaf.keepsFaces) keepFaces = this.#facesAfter(source, leaf.pages);
          return source.order.putBack(leaf.pages);
        },
        () => {
          this.#host.lists = joinedLists(this.#host.lists, listsOf(leaf, indexOf));
          keepFaces();
        },
      );
    } finally {
      // It stays out.
      if (!isBack && this.#host.book()?.source === this.#source) this.#leaves.push(leaf);
    }
    if (!isBack) return false;
    viewer.sheets.remove(leaf.id);
    this.#host.changed();
    const first = leaf.pages.map(indexOf).find((index) => index !== null);
    if (typeof first === "number") this.#host.show(first + 1);
    return true;
  }

  /** Call it when a book is open: forgets what is out of another. */
  opened(source: PageList): void {
    if (source !== this.#source) this.#leaves = [];
    this.#source = source;
  }

  /**
   * Returns what keeps the pages after a leaf on the faces of theirs where they lie now: a leaf
   * with a bare face takes two faces along, and one page.
   */
  #facesAfter(source: PageList, leaf: ListedPages): () => void {
    const next = source.order.after(leaf);
    const faceOfNext = (): number | null => {
      const index = next && source.order.indexOf(next);
      return typeof index === "number" ? this.#host.faceOf(index + 1) : null;
    };
    const before = faceOfNext();
    if (next === undefined || before === null) return noFaces;
    return () => {
      if (faceOfNext() === before) return;
      const page = (source.order.indexOf(next) ?? 0) + 1;
      const { lists } = this.#host;
      const others = lists.shifts.filter((shift) => shift !== page);
      const isShifted = others.length < lists.shifts.length;
      this.#host.lists = { ...lists, shifts: isShifted ? others : cleanPages([...others, page]) };
    };
  }
}

/** Keeps no faces. */
const noFaces = (): void => undefined;

/** Returns what is said of the pages of a leaf, which lie where `indexOf` says (from 0; null for nowhere). */
function listsOf(
  { lists, pages }: TornLeaf,
  indexOf: (page: ListedPages[number]) => number | null,
): PageLists {
  return movedLists(lists, (place) => indexOf(pages[place]), pages.length);
}
