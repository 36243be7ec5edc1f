/** What tears leaves out of the open book, tears and crumples what is loose, and puts pages back. */

import type { PagePlace } from "../book/page_folds.ts";
import type { TearLine } from "../engine/shapes.ts";
import { loadPart } from "../sources/load_part.ts";
import type { PageList } from "../sources/page_list.ts";
import type { TearOwner } from "../viewer/viewer_options.ts";
import { placeOf } from "./fold_lists.ts";
import type { PageLists } from "./page_lists.ts";
import type { TornPages } from "./torn_pages.ts";
import { TurningElement } from "./turning_element.ts";

/** The leaves that are torn out of the element's books. A subclass opens these. */
export abstract class TearableElement extends TurningElement {
  /**
   * Reports that an optional part of the open book is missing.
   *
   * @internal
   */
  protected abstract reportMissingPart(error: unknown): void;
  /**
   * Call it when the open book has other pages.
   *
   * @internal
   */
  protected abstract pagesChanged(): void;

  /** The pages that were torn out of the open book, once some may be, and what loads that. */
  #torn: TornPages | null = null;
  #loadingTorn: Promise<void> | null = null;
  /** How many calls wait for what tears leaves out. */
  #loadingTears = 0;
  /** The last call of `allowTearing`, which tearing by command waits for. */
  #allowed: Promise<void> = Promise.resolve();

  /**
   * Tears the leaf of an open page (from 1, by default the first visible one) out, if `tearable`
   * allows it: both of its pages leave the book, and it lies beside it as a loose sheet, to be
   * moved or thrown out of sight; without motion it is gone at once. Resolves, once it is off, to whether it is: false on the flat,
   * for a leaf of the cover, if the page does not lie open, and if a listener cancels `tear`.
   */
  async tearOut(page: number = this.page): Promise<boolean> {
    const { book } = this;
    await this.#allowed;
    if (book === null || book !== this.book) return false;
    return await book.viewer.sheets.tearOut(page, this.motion === "turn");
  }

  /**
   * Puts the pages that were torn out last back where they were. Resolves, once the book is at rest
   * and they are in it, to whether there were any.
   */
  putBack(): Promise<boolean> {
    return this.#torn?.putBack() ?? Promise.resolve(false);
  }

  /**
   * Crumples the loose sheet that was torn out last into a ball, where it lies, as a double tap on
   * it does. Returns whether there is one that is not crumpled yet.
   */
  crumple(): boolean {
    return this.book?.viewer.sheets.crumple() ?? false;
  }

  /**
   * Tears the loose sheet across that was torn out last, as two fingers do that pull it apart:
   * from a place on an edge of the page that it shows to a place on another edge. It opens from
   * the first, and takes about a second; `from` and `to` are moved to the edges next to them.
   * Each piece is a loose sheet then, and `putBack()` makes a whole page of both again.
   *
   * Returns whether it is torn: false if no loose sheet is neither crumpled nor torn across, if a
   * place is not on the page, or if a piece would be narrower than some 16 mm.
   */
  tearAcross(from: PagePlace, to: PagePlace): boolean {
    const [start, end] = [from, to].map(placeOf);
    if (!start || !end) return false;
    return this.book?.viewer.sheets.tearAcross(start, end) ?? false;
  }

  /**
   * The first open page (from 1) whose leaf may be torn out; null if none may.
   *
   * @internal
   */
  get tearablePage(): number | null {
    return this.book?.viewer.sheets.tearablePage ?? null;
  }

  /**
   * Whether a loose sheet that is neither crumpled nor torn across is flat, or all are folded that
   * are; null if there is none.
   *
   * @internal
   */
  get wholeSheet(): "flat" | "folded" | null {
    return this.book?.viewer.sheets.wholeSheet ?? null;
  }

  /** Number of leaves that were torn out and can be put back. */
  get tornLeaves(): number {
    return this.#torn?.count ?? 0;
  }

  /**
   * Whether what tears leaves out is being loaded.
   *
   * @internal
   */
  protected get isLoadingTears(): boolean {
    return this.#loadingTears > 0;
  }

  /** @internal */
  protected override addTornPages(lists: PageLists): PageLists {
    return this.#torn?.addTo(lists) ?? lists;
  }

  /**
   * Returns who owns the pages of leaves that are torn out.
   *
   * @param heard called with work that was done in tearing, J
   *
   * @internal
   */
  protected tearOwner(heard: (work: number) => void): TearOwner {
    return {
      mayTear: (pages) => this.ask("tear", { pages }),
      takeOut: (pages, moved) => this.#torn?.takeOut(pages, moved) ?? null,
      heard,
    };
  }

  /**
   * Call it when a book is open.
   *
   * @internal
   */
  protected tearOpened(source: PageList): void {
    this.#torn?.opened(source);
    this.allowTearing();
  }

  /**
   * Allows tearing or forbids it, as the attribute says: call it when that has changed.
   *
   * @internal
   */
  protected allowTearing(): void {
    this.#allowed = this.#allow();
  }

  /** Loads what tears leaves out and what keeps their pages, where they may be torn. */
  async #allow(): Promise<void> {
    if (this.tearable === "none") return this.book?.viewer.sheets.allowTearing(null);
    if (!this.book) return;
    this.#loadingTears++;
    try {
      this.#loadingTorn ??= this.#loadTornPages();
      await this.#loadingTorn;
      await this.book?.viewer.sheets.allowTearing(this.#line);
    } finally {
      this.#loadingTears--;
    }
  }

  /** How leaves are bound; null if none may be torn out, as before what keeps their pages is there. */
  get #line(): TearLine | null {
    const { tearable } = this;
    return this.#torn && tearable !== "none" ? tearable : null;
  }

  async #loadTornPages(): Promise<void> {
    try {
      const { TornPages } = await loadPart(import("./torn_pages.ts"));
      const element = this;
      this.#torn = new TornPages({
        get lists() {
          return element.lists;
        },
        set lists(lists) {
          element.lists = lists;
        },
        book: () => this.book,
        torn: (pages) => this.emit("torn", { pages }),
        changed: () => this.pagesChanged(),
        faceOf: (page) => (this.shownLayout === "spread" ? this.pageFaces()(page) % 2 : null),
        show: (page) => void this.turnTo(page, { motion: false }),
      });
      if (this.book) this.#torn.opened(this.book.source);
    } catch (error) {
      this.reportMissingPart(error);
    }
  }
}
