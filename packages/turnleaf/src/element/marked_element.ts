/**
 * What a reader leaves on the pages of an open book, and what else names pages: bookmarks, folded
 * corners and folds, shifts of the offset. These lists follow the pages where those move.
 */

import { type Corner, type DogEar, dogEarSize, foldedDegrees } from "../book/dog_ears.ts";
import { coverFor, faceIn, placePages } from "../book/layout.ts";
import type { PageMove } from "../book/moved_lists.ts";
import type { PageFold, PagePlace } from "../book/page_folds.ts";
import { leafOf, spineOf } from "../book/spreads.ts";
import { loadPart } from "../sources/load_part.ts";
import type { PageList } from "../sources/page_list.ts";
import { bindingOptionsOf } from "./attribute_options.ts";
import { cleanDogEars, cleanFolds, withDogEars } from "./fold_lists.ts";
import type { OpenBook } from "./open_book.ts";
import { emptyLists, movedLists, type PageLists } from "./page_lists.ts";
import { cleanPages } from "./page_numbers.ts";
import type { HomePlace } from "./place_keeper.ts";
import { ReflectingElement } from "./reflecting_element.ts";

/** The marks on the pages of the open book. A subclass opens the book. */
export abstract class MarkedElement extends ReflectingElement {
  abstract readonly page: number;
  /**
   * The open book.
   *
   * @internal
   */
  protected abstract get book(): OpenBook | null;
  /**
   * Returns lists of the pages of the whole book with what they said of those that are torn out.
   *
   * @internal
   */
  protected abstract addTornPages(lists: PageLists): PageLists;

  /** What names pages, as they lie now. */
  #lists: PageLists = emptyLists;
  /** The lists of which listeners know. */
  #reportedLists: PageLists = emptyLists;
  /** The last fold that was asked for: they are made one after the other. */
  #folding: Promise<unknown> = Promise.resolve();

  /** Number of pages; 0 until the book is open. */
  get pageCount(): number {
    return this.source?.pageCount ?? 0;
  }

  /**
   * The open book's pages.
   * @internal
   */
  protected get source(): PageList | undefined {
    return this.book?.source;
  }

  /** The bookmarked pages, from 1, in order; at most 500. */
  get bookmarks(): readonly number[] {
    return this.#lists.bookmarks;
  }

  set bookmarks(pages: readonly number[]) {
    const bookmarks = cleanPages(pages);
    this.#list({ bookmarks });
    const ears = this.#lists.dogEars.filter(({ page }) => bookmarks.includes(page));
    void this.#foldCorners(this.foldBookmarks ? withDogEars(ears, bookmarks) : ears, true);
    this.emit("bookmarkchange", { bookmarks: this.#lists.bookmarks });
  }

  /**
   * The corners that are folded over, at most one a page. Setting it folds them without motion,
   * opens all others and bookmarks their pages. As bookmarks, they are of the open book, and
   * `remember` keeps them. Entries that are none are left out. A book on the flat shows none.
   */
  get dogEars(): readonly DogEar[] {
    return this.#lists.dogEars;
  }

  set dogEars(ears: readonly DogEar[]) {
    this.#bookmarkDogEars(cleanDogEars(ears), false);
  }

  /**
   * Folds a corner of a page (from 1, by default the first visible one) over onto it, and
   * bookmarks the page. Resolves, once it is folded, to whether it is: false on the flat, and for a
   * board, which does not fold.
   *
   * @param corner at the head, the default, or at the foot of the edge away from the spine;
   * where the spine is above or below, on the right or on the left
   * @param size how far from the corner the fold meets the page's edges: a fraction of its
   * width, 0.05 to 0.5 (0.2)
   */
  dogEar(page: number = this.page, corner: Corner = "head", size?: number): Promise<boolean> {
    const [ear] = cleanDogEars([{ page, corner, size: dogEarSize(size) }]);
    const binding = this.book?.viewer.binding;
    if (ear === undefined || !binding || page > this.pageCount) return Promise.resolve(false);
    if (spineOf(binding, page) === "board") return Promise.resolve(false);
    // On the other side of its leaf the same corner cannot be folded too.
    const isSameCorner = (other: DogEar): boolean =>
      other.corner === ear.corner && leafOf(binding, other.page) === leafOf(binding, page);
    const others = this.dogEars.filter((other) => other.page !== page && !isSameCorner(other));
    return this.#bookmarkDogEars(cleanDogEars([...others, ear]), true);
  }

  /**
   * The folds of pages besides their corners, in the order in which they were made; at most 500.
   * Setting it folds them without motion and opens all others. As bookmarks, they are of the open
   * book, and `remember` keeps them. Entries that are none are left out. A book on the flat shows
   * none.
   */
  get folds(): readonly PageFold[] {
    return this.#lists.folds;
  }

  set folds(folds: readonly PageFold[]) {
    void this.#foldPages(cleanFolds(folds), false);
  }

  /**
   * Folds a page (from 1) along a straight line, in about half a second where it lies open and is
   * folded toward the reader, else without motion. Folds that are asked for at once are made one
   * after the other. A fold along the same line changes its angle. Resolves, once the page is
   * folded, to whether it is: false on the flat, and for a board, which does not fold. Rejects
   * with a `BookError` if the line meets the spine, is too near to other folds of the page or
   * to an edge, or is none.
   *
   * @param from,to two places on the line, as fractions of the page from its upper left corner;
   * the fold goes on to the edges of the page
   * @param angle at which it rests, degrees: above 0 toward the reader who looks at the page,
   * below it away, 180 or -180 folded shut, 0 flat; the default is 160, as paper rests that a
   * finger has pressed
   */
  fold(
    page: number,
    from: PagePlace,
    to: PagePlace,
    angle: number = foldedDegrees,
  ): Promise<boolean> {
    const folded = this.#folding.then(() => this.#foldLine({ page, from, to, angle }));
    this.#folding = folded.catch(() => {});
    return folded;
  }

  /**
   * Opens the folded corner of a page, removes its bookmark, and opens its folds. Returns null
   * if it has none of these; else resolves, once they are open, to whether they are.
   *
   * @internal
   */
  protected openFolds(page: number): Promise<boolean> | null {
    const has = (folds: readonly { readonly page: number }[]) =>
      folds.some((fold) => fold.page === page);
    const [hasCorner, hasFolds] = [has(this.dogEars), has(this.folds)];
    if (!hasCorner && !hasFolds) return null;
    const others = this.folds.filter((fold) => fold.page !== page);
    // Of two that are opened at once the second would not be seen.
    if (hasCorner && hasFolds) this.#list({ folds: others });
    const opened = hasCorner
      ? this.#foldCorners(
          this.dogEars.filter((ear) => ear.page !== page),
          true,
        )
      : this.#foldPages(others, true);
    if (hasCorner && hasFolds) this.emit("foldchange", { folds: others });
    if (this.bookmarks.includes(page) && hasCorner) this.toggleBookmark(page);
    return opened;
  }

  /**
   * Folds the pages of a book that has just opened, and loads what folds them where they may be
   * folded by hand.
   *
   * @internal
   */
  protected foldOpened(): void {
    if (this.dogEars.length > 0 || this.folds.length > 0 || this.foldBookmarks)
      void this.#refold(false);
  }

  /**
   * The pages, from 1, at which the offset is shifted: in a spread the side
   * before each is left blank, so that from there on other pages face each
   * other. At most 500. Where a book says itself on which side a page lies, as
   * for a picture across a spread, a shift there has no effect. As bookmarks,
   * they are of the open book, and `remember` keeps them.
   */
  get shifts(): readonly number[] {
    return this.#lists.shifts;
  }

  set shifts(pages: readonly number[]) {
    const shifts = cleanPages(pages);
    if (shifts.join() === this.shifts.join()) return;
    this.#list({ shifts });
    this.book?.viewer.rebind({ shifts });
    this.emit("shiftchange", { shifts });
  }

  /** Shifts the offset at a page (from 1), by default the first visible one, or undoes that. */
  toggleShift(page: number = this.page): void {
    this.shifts = toggled(this.shifts, page);
  }

  /** Bookmarks a page (from 1), by default the first visible one, or removes its bookmark. */
  toggleBookmark(page: number = this.page): void {
    this.bookmarks = toggled(this.bookmarks, page);
  }

  /**
   * The lists that name pages, as they lie now. Set while these move; `reportLists` is to follow.
   *
   * @internal
   */
  protected get lists(): PageLists {
    return this.#lists;
  }

  protected set lists(lists: PageLists) {
    this.#lists = lists;
  }

  /**
   * Takes over what an attribute says of pages as they lie now.
   *
   * @internal
   */
  protected listPages(name: "hardPages" | "stocks", list: string): void {
    this.#list({ [name]: list });
  }

  /**
   * Has the lists follow the pages; `reportLists` is to follow.
   *
   * @param pageCount of the book before
   *
   * @internal
   */
  protected moveLists(move: PageMove, pageCount: number): void {
    this.lists = movedLists(this.#lists, move, pageCount);
  }

  /**
   * Returns what says on which face a page (from 1) lies where two are shown side by side, in the
   * order of reading: an odd face and the next one face each other.
   *
   * @internal
   */
  pageFaces(): (page: number) => number {
    const { source, shifts } = this;
    const { cover, offset } = bindingOptionsOf(this);
    const inSpread = source?.inSpread.bind(source);
    const { boards } = coverFor(cover, source?.cover, this.pageCount);
    const placed = placePages(this.pageCount, { offset, shifts }, inSpread, boards);
    return (page) => faceIn(placed, page);
  }

  /**
   * Reports the lists that have followed their pages.
   *
   * @internal
   */
  protected reportLists(): void {
    const [before, now] = [this.#reportedLists, this.#lists];
    this.#reportedLists = now;
    const { bookmarks, dogEars, folds, shifts } = now;
    const isOther = (name: keyof PageLists): boolean =>
      JSON.stringify(now[name]) !== JSON.stringify(before[name]);
    if (isOther("dogEars") || isOther("folds")) void this.#refold(false);
    if (isOther("dogEars")) this.emit("dogearchange", { dogEars });
    if (isOther("folds")) this.emit("foldchange", { folds });
    if (isOther("shifts")) this.emit("shiftchange", { shifts });
    // A bookmark that has come back may want its corner folded.
    if (isOther("bookmarks")) this.bookmarks = bookmarks;
  }

  /**
   * Where the open book lies and what names its pages, by the pages that it has when it is opened
   * again: without those that were added, and with those that were removed or torn out.
   *
   * @internal
   */
  protected get homePlace(): HomePlace {
    const { source } = this;
    if (source === undefined) return { page: this.page, lists: this.#lists };
    const home = (index: number): number | null =>
      source.order.homeOf(source.order.pagesAt([index])[0]);
    const lists = this.addTornPages(movedLists(this.#lists, home, source.pageCount));
    // A page that was added has the place of the one before it.
    let at = this.page - 1;
    while (at > 0 && home(at) === null) at--;
    return { page: (home(at) ?? 0) + 1, lists };
  }

  /**
   * Has the lists name the pages of the book as it is opened again; `reportLists` is to follow.
   *
   * @internal
   */
  protected returnLists(): void {
    const { hardPages, stocks } = this;
    this.#lists = { ...this.homePlace.lists, hardPages, stocks };
  }

  /**
   * Has the lists name no pages: another book replaces the open one.
   *
   * @internal
   */
  protected forgetLists(): void {
    const { hardPages, stocks } = this;
    this.#list({ ...emptyLists, hardPages, stocks });
  }

  /** Takes lists over, of which listeners know or are about to. */
  #list(lists: Partial<PageLists>): void {
    this.#lists = { ...this.#lists, ...lists };
    this.#reportedLists = { ...this.#reportedLists, ...lists };
  }

  #bookmarkDogEars(ears: readonly DogEar[], isSeen: boolean): Promise<boolean> {
    const folded = this.#foldCorners(ears, isSeen);
    const pages = ears.map(({ page }) => page);
    if (pages.some((page) => !this.bookmarks.includes(page))) {
      this.bookmarks = [...this.bookmarks, ...pages];
    }
    return folded;
  }

  #foldCorners(ears: readonly DogEar[], isSeen: boolean): Promise<boolean> {
    return this.#listDogEars(ears) ? this.#refold(isSeen) : Promise.resolve(true);
  }

  #foldPages(folds: readonly PageFold[], isSeen: boolean): Promise<boolean> {
    return this.#listFolds(folds) ? this.#refold(isSeen) : Promise.resolve(true);
  }

  /** Takes a list of folded corners over. Returns whether it is another. */
  #listDogEars(ears: readonly DogEar[]): boolean {
    if (JSON.stringify(ears) === JSON.stringify(this.dogEars)) return false;
    this.#list({ dogEars: ears });
    this.emit("dogearchange", { dogEars: ears });
    return true;
  }

  /** Takes a list of folds over. Returns whether it is another. */
  #listFolds(folds: readonly PageFold[]): boolean {
    if (JSON.stringify(folds) === JSON.stringify(this.folds)) return false;
    this.#list({ folds });
    this.emit("foldchange", { folds });
    return true;
  }

  /**
   * Folds pages as the lists say; what cannot be folded is taken out of them. Resolves to whether
   * all is folded.
   */
  async #refold(isSeen: boolean): Promise<boolean> {
    const { dogEars: ears, folds } = this.#lists;
    const asked = [...ears, ...folds];
    const found = await this.book?.viewer.sheets.fold(asked, isSeen);
    if (!found) return false;
    // Others may have been set, or another book opened.
    if (this.dogEars === ears && this.folds === folds) {
      this.#listDogEars(cleanDogEars(found));
      this.#listFolds(cleanFolds(found));
    }
    return asked.every((fold) => found.includes(fold));
  }

  async #foldLine(asked: PageFold): Promise<boolean> {
    const { foldAlong } = await loadPart(import("./line_folds.ts"));
    const viewer = this.book?.viewer;
    if (viewer === undefined) return false;
    const { folds: before, dogEars } = this.#lists;
    const folds = await foldAlong(asked, viewer, this.#lists);
    // Others may have been set, or another book opened.
    if (folds === null || this.folds !== before) return false;
    this.#listFolds(folds);
    // Corners that were folded meanwhile were folded without this one.
    if (this.dogEars !== dogEars) void this.#refold(false);
    return true;
  }
}

/** Returns the pages without one that is among them, or with it. */
function toggled(pages: readonly number[], page: number): readonly number[] {
  const others = pages.filter((other) => other !== page);
  return others.length < pages.length ? others : [...others, page];
}
