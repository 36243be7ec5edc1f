/** The tab of thumbnails. */

import type { ControlledBook } from "./book.ts";
import { make } from "./make.ts";
import type { PanelTab } from "./panel.ts";
import { ThumbnailCache } from "./thumbnail_cache.ts";
import { namePage, type Wording } from "./wording.ts";

/** A row of two pages, CSS pixels; the style sheet draws it so high. */
const rowHeight = 192;
const perRow = 2;
/** Rows kept ready above and below the visible ones. */
const spare = 2;

/** A page in the list. */
interface Cell {
  readonly button: HTMLButtonElement;
  readonly removed: AbortController;
}

/** A list as long as the book, of which only the visible part exists. */
export class ThumbnailsTab implements PanelTab {
  readonly element: HTMLElement = make("div", { class: "view thumbnails", tabindex: -1 });
  readonly #book: ControlledBook;
  readonly #wording: Wording;
  readonly #picked: () => void;
  readonly #list: HTMLElement;
  readonly #pictures: ThumbnailCache;
  readonly #cells = new Map<number, Cell>();
  /** On which face each page lies. */
  #faceOf: (page: number) => number = (page) => page;
  readonly #observer = new ResizeObserver(() => this.#fill());
  /** The page that has the keyboard focus. */
  #at = 1;
  #isShown = false;

  /** @param picked called when the reader went to a page */
  constructor(book: ControlledBook, wording: Wording, picked: () => void) {
    this.#book = book;
    this.#wording = wording;
    this.#picked = picked;
    this.#pictures = new ThumbnailCache(book);
    this.#list = make("ol", { class: "sheet", "aria-label": wording.texts.thumbnails });
    this.element.append(this.#list);
    this.element.addEventListener("scroll", () => this.#fill(), { passive: true });
    this.#list.addEventListener("keydown", (event) => this.#key(event));
  }

  show(): void {
    this.#isShown = true;
    this.#observer.observe(this.element);
    this.#at = this.#book.page;
    this.#list.dir = this.#book.direction;
    this.#place();
    this.#reveal(this.#at);
    this.refresh();
  }

  hide(): void {
    this.#isShown = false;
    this.#observer.disconnect();
    for (const page of [...this.#cells.keys()]) this.#remove(page);
  }

  /** Clears the list for another book. */
  forget(): void {
    for (const page of [...this.#cells.keys()]) this.#remove(page);
    this.#pictures.clear();
    if (this.#isShown) this.show();
  }

  refresh(): void {
    if (!this.#isShown) return;
    this.#place();
    const { page } = this.#book;
    if (!this.element.contains((this.element.getRootNode() as ShadowRoot).activeElement)) {
      this.#at = page;
      this.#reveal(page);
    }
    this.#fill();
  }

  /** Marks the open pages. */
  #mark(): void {
    const { page } = this.#book;
    const { left, right } = this.#book.spread;
    for (const [at, { button }] of this.#cells) {
      button.classList.toggle("seen", at === left || at === right);
      if (at === page) button.setAttribute("aria-current", "page");
      else button.removeAttribute("aria-current");
    }
  }

  focus(): void {
    this.#focusPage(this.#book.page);
  }

  /** Places the cells as the pages lie now. */
  #place(): void {
    this.#faceOf = this.#book.pageFaces();
    this.#list.style.height = `${(this.#rowOf(this.#book.pageCount) + 1) * rowHeight}px`;
    for (const [page, { button }] of this.#cells) this.#placeCell(page, button.parentElement);
  }

  #placeCell(page: number, item: HTMLElement | null): void {
    if (item === null) return;
    item.style.top = `${this.#rowOf(page) * rowHeight}px`;
    const column = (this.#faceOf(page) + 1) % perRow;
    item.style.insetInlineStart = `${(column * 100) / perRow}%`;
  }

  /** Returns the row of a page, from 0: pages that face each other are in one. */
  #rowOf(page: number): number {
    const row = (of: number): number => Math.floor((this.#faceOf(of) + 1) / perRow);
    return row(page) - row(1);
  }

  /** Returns the first page that is in a row or after it; the one after the last if none is. */
  #firstFrom(row: number): number {
    let [low, high] = [1, this.#book.pageCount + 1];
    while (low < high) {
      const middle = (low + high) >> 1;
      if (this.#rowOf(middle) < row) low = middle + 1;
      else high = middle;
    }
    return low;
  }

  /** Scrolls the row of a page into view. */
  #reveal(page: number): void {
    const top = this.#rowOf(page) * rowHeight;
    const { scrollTop, clientHeight } = this.element;
    if (top < scrollTop || top + rowHeight > scrollTop + clientHeight) {
      this.element.scrollTop = top - Math.max((clientHeight - rowHeight) / 2, 0);
    }
  }

  /** Creates the visible cells, and removes the others. */
  #fill(): void {
    if (!this.#isShown) return;
    const { scrollTop, clientHeight } = this.element;
    const above = Math.floor(scrollTop / rowHeight) - spare;
    const below = Math.ceil((scrollTop + clientHeight) / rowHeight) + spare;
    const [first, last] = [this.#firstFrom(above), this.#firstFrom(below) - 1];
    for (const page of [...this.#cells.keys()]) {
      if ((page < first || page > last) && page !== this.#at) this.#remove(page);
    }
    for (let page = first; page <= last; page++) this.#cellOf(page);
    for (const [page, { button }] of this.#cells) button.tabIndex = page === this.#at ? 0 : -1;
    this.#mark();
  }

  #cellOf(page: number): Cell {
    const there = this.#cells.get(page);
    if (there) return there;
    const { pageCount } = this.#book;
    const picture = make("canvas", { class: "small", "aria-hidden": "true" });
    const button = make(
      "button",
      { type: "button", "aria-label": namePage(this.#wording, this.#book, page) },
      picture,
      make("span", { "aria-hidden": "true" }, this.#book.label(page)),
    );
    button.addEventListener("click", () => {
      this.#at = page;
      void this.#book.turnTo(page, { jump: true });
      this.#picked();
    });
    const item = make("li", { "aria-setsize": pageCount, "aria-posinset": page }, button);
    this.#placeCell(page, item);
    const cell = { button, removed: new AbortController() };
    this.#cells.set(page, cell);
    // In the book's order, for screen readers.
    const after = [...this.#cells.keys()].filter((other) => other > page).sort((a, b) => a - b)[0];
    const next = after === undefined ? null : this.#cells.get(after)?.button.parentElement;
    this.#list.insertBefore(item, next ?? null);
    void this.#pictures.paint(page, picture, cell.removed.signal);
    return cell;
  }

  #remove(page: number): void {
    const cell = this.#cells.get(page);
    cell?.removed.abort();
    cell?.button.parentElement?.remove();
    this.#cells.delete(page);
  }

  #focusPage(page: number): void {
    this.#at = page;
    this.#reveal(page);
    this.#fill();
    this.#cellOf(page).button.focus({ preventScroll: true });
  }

  #key(event: KeyboardEvent): void {
    const { direction, pageCount } = this.#book;
    const across = direction === "rtl" ? -1 : 1;
    const steps: Record<string, number> = {
      ArrowRight: across,
      ArrowLeft: -across,
      ArrowDown: perRow,
      ArrowUp: -perRow,
      PageDown: 3 * perRow,
      PageUp: -3 * perRow,
      Home: -pageCount,
      End: pageCount,
    };
    const step = steps[event.key];
    if (step === undefined) return;
    event.preventDefault();
    this.#focusPage(Math.min(Math.max(this.#at + step, 1), pageCount));
  }
}
