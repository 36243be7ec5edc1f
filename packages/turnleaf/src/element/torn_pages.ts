/** The pages of an element's book that were torn out, and may be put back. */

import type { ListedPages, PageList } from "../sources/page_list.ts";
import { BookError } from "../sources/page_source.ts";
import type { TearOwner } from "../viewer/viewer_options.ts";
import type { OpenBook } from "./book_lifecycle.ts";
import { numbersOf, type PageNotes } from "./page_lists.ts";

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
  /** The book has other pages. */
  readonly changed: () => void;
  /** Returns what lists say of pages (from 1). */
  readonly notesOf: (pages: readonly number[]) => PageNotes;
  /**
   * Returns on which face of its leaf a page (from 1) lies, 0 or 1 in the order of reading; null
   * where each leaf has one page.
   */
  readonly faceOf: (page: number) => number | null;
  /** Shifts the offset at a page (from 1), or undoes that. */
  readonly shift: (page: number) => void;
  /** Has lists say it of pages again: the number (from 1) of each, null for one that is not there. */
  readonly note: (notes: PageNotes, pages: readonly (number | null)[]) => void;
  /** Turns to a page (from 1) without motion. */
  readonly show: (page: number) => void;
  /** Work was done in tearing, J. */
  readonly heard: (work: number) => void;
}

/** What lists said of the pages of a leaf that is out. */
export interface TornLeafNotes {
  readonly pages: ListedPages;
  readonly notes: PageNotes;
}

/** A leaf that is out. */
interface TornLeaf extends TornLeafNotes {
  readonly id: number;
  /** Whether the pages after it lie on the faces where they lay. */
  readonly keepsFaces: boolean;
}

/** Keeps the torn leaves of one book, the last one torn last. */
export class TornPages implements TearOwner {
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
    return this.leaves.length;
  }

  /** The leaves that are out of the open book. */
  get leaves(): readonly TornLeafNotes[] {
    return this.#host.book() === null ? [] : this.#leaves;
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
    const leaf = book.source.pagesAt(pages.map((page) => page - 1));
    const id = ++this.#lastId;
    const notes = this.#host.notesOf(pages);
    let isOut = false;
    let keepFaces = noFaces;
    // The viewer lies at rest: the change is made at once, after those that waited for that.
    const made = book.changePages(
      () => {
        keepFaces = this.#facesAfter(book.source, leaf);
        const moved = book.source.takeOut(leaf);
        this.#leaves.push({ id, pages: leaf, notes, keepsFaces: keepFaces !== noFaces });
        isOut = true;
        return moved;
      },
      () => keepFaces(),
    );
    // A book keeps its last page, and the leaf's own may have been removed meanwhile.
    made.catch((error: unknown) => {
      if (!(error instanceof BookError)) throw error;
    });
    if (!isOut) return null;
    this.#host.changed();
    this.#host.torn(pages);
    return id;
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
    const numbers = () => numbersOf(leaf.pages.map((page) => source.indexOf(page)));
    try {
      isBack = await book.changePages(
        () => {
          if (leaf.keepsFaces) keepFaces = this.#facesAfter(source, leaf.pages);
          return source.putBack(leaf.pages);
        },
        () => {
          this.#host.note(leaf.notes, numbers());
          keepFaces();
        },
      );
    } finally {
      // It stays out.
      if (!isBack && this.#host.book()?.source === this.#source) this.#leaves.push(leaf);
    }
    if (!isBack) return false;
    viewer.removeSheet(leaf.id);
    this.#host.changed();
    const first = numbers().find((page) => page !== null);
    if (first !== undefined) this.#host.show(first);
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
    const next = source.after(leaf);
    const faceOfNext = (): number | null => {
      const index = next && source.indexOf(next);
      return typeof index === "number" ? this.#host.faceOf(index + 1) : null;
    };
    const before = faceOfNext();
    if (before === null) return noFaces;
    return () => {
      if (faceOfNext() !== before)
        this.#host.shift((source.indexOf(next as ListedPages[number]) ?? 0) + 1);
    };
  }
}

/** Keeps no faces. */
const noFaces = (): void => undefined;
