/** A test double of a book, which records what it was asked to do, under the controls. */

import type { ControlledBook, FoundPlace } from "../controls/book.ts";
import { addControls } from "../controls/controls.ts";
import type { WarningDetail } from "../element/events.ts";
import { followTab } from "../element/focus_keeper.ts";
import { addStyle, style } from "../element/shadow_tree.ts";
import type { BookDetail, OutlineEntry } from "../sources/page_source.ts";
import { clock } from "./clock.ts";

/** As the element, without a page to draw. */
export class FakeBook extends HTMLElement implements ControlledBook {
  page = 4;
  pageCount = 30;
  estimated = false;
  guessed = false;
  jumpedFrom: number | null = null;
  bookTitle = "A Book";
  direction: "ltr" | "rtl" = "ltr";
  spread = { left: 4, right: 5 };
  shownLayout: "spread" | "single" = "spread";
  scrolled = false;
  zoom = 1;
  fractionBeside = (_width: number): number => 1;
  bookmarks: readonly number[] = [];
  shifts: readonly number[] = [];
  playing = false;
  canReadAloud = false;
  mayHaveText = true;
  readingAloud = false;
  canTypeset = false;
  darkPagesNow: "" | "invert" | "dim" = "";
  allows = { print: true, download: true };
  readonly titleDirection = "auto" as const;
  details: readonly BookDetail[] = [];
  warnings: readonly WarningDetail[] = [];
  hits: readonly FoundPlace[] = [];
  /** The calls, in order. */
  readonly asked: string[] = [];
  /** Pages drawn at once: now, and the maximum. */
  drawing = 0;
  mostDrawing = 0;
  drawn = 0;

  label(page: number): string {
    return page <= 6 ? (["i", "ii", "iii", "iv", "v", "vi"][page - 1] ?? "") : String(page - 6);
  }

  pageFaces(): (page: number) => number {
    return (page) => page - 1 + this.shifts.filter((shift) => shift <= page).length;
  }

  async #turn(name: string, page: number): Promise<boolean> {
    this.asked.push(name);
    this.page = Math.min(Math.max(page, 1), this.pageCount);
    this.dispatchEvent(new CustomEvent("pagechange"));
    return true;
  }

  press = (by: 1 | -1): Promise<boolean> =>
    this.#turn(by === 1 ? "next" : "previous", this.page + 2 * by);
  canTurn(by: 1 | -1): boolean {
    return by === 1 ? this.page < this.pageCount : this.page > 1;
  }

  turnTo = (page: number, { top = 0 }: { readonly top?: number } = {}): Promise<boolean> =>
    this.#turn(`turnTo ${page}${top === 0 ? "" : ` at ${top}`}`, page);

  jumpBack(): void {
    this.asked.push("jumpBack");
  }

  async readAloud(): Promise<void> {
    this.asked.push("readAloud");
    this.readingAloud = true;
    this.dispatchEvent(new CustomEvent("readaloudchange"));
  }

  stopReadingAloud(): void {
    this.asked.push("stopReadingAloud");
    this.readingAloud = false;
    this.dispatchEvent(new CustomEvent("readaloudchange"));
  }

  announce(text: string): void {
    this.asked.push(`announce ${text}`);
  }

  announceZoom(): void {
    this.announce(`zoom ${this.zoom}`);
  }

  zoomTo(level: number): void {
    this.asked.push(`zoom ${level}`);
    this.zoom = level;
    this.dispatchEvent(new CustomEvent("zoomchange"));
  }

  async search(
    query: string,
    options?: { onHits?: (hits: readonly FoundPlace[]) => void },
  ): Promise<readonly FoundPlace[]> {
    this.asked.push(`search ${query}`);
    if (this.hits.length > 0) options?.onHits?.(this.hits);
    return this.hits;
  }

  async showHit(hit: FoundPlace | null): Promise<boolean> {
    this.asked.push(`hit ${hit?.page ?? "none"}`);
    return true;
  }

  async outline(): Promise<readonly OutlineEntry[]> {
    return [
      { title: "Loomings", page: 2, children: [] },
      {
        title: "The Carpet-Bag",
        page: 7,
        children: [{ title: "The Inn", page: 9, top: 0.25, children: [] }],
      },
      { title: "Elsewhere", page: null, href: "https://example.org/", children: [] },
      { title: "A trap", page: null, href: "javascript:alert(1)", children: [] },
    ];
  }

  async drawPage(_page: number, width: number, signal?: AbortSignal): Promise<HTMLCanvasElement> {
    this.mostDrawing = Math.max(++this.drawing, this.mostDrawing);
    await clock.task();
    this.drawing--;
    signal?.throwIfAborted();
    this.drawn++;
    const canvas = document.createElement("canvas");
    canvas.width = width;
    canvas.height = Math.round(width * 1.4);
    return canvas;
  }

  toggleBookmark(page: number = this.page): void {
    const others = this.bookmarks.filter((other) => other !== page);
    this.bookmarks =
      others.length < this.bookmarks.length ? others : [...others, page].sort((a, b) => a - b);
    this.dispatchEvent(new CustomEvent("bookmarkchange"));
  }

  toggleShift(page: number = this.page): void {
    this.shifts = this.shifts.includes(page) ? [] : [page];
    this.dispatchEvent(new CustomEvent("shiftchange"));
  }

  foldOut: "none" | "shut" | "open" = "none";
  toggleFoldOut(): boolean {
    this.asked.push("fold-out");
    return true;
  }

  tearablePage: number | null = null;
  async tearOut(page: number): Promise<boolean> {
    this.asked.push(`tear out ${page}`);
    return true;
  }

  tornLeaves = 0;
  wholeSheet: "flat" | "folded" | null = null;
  crumple(): boolean {
    this.asked.push("crumple");
    return true;
  }

  tearAcross(): boolean {
    this.asked.push("tear across");
    return true;
  }

  async putBack(): Promise<boolean> {
    this.asked.push("put back");
    return --this.tornLeaves >= 0;
  }

  async print(): Promise<boolean> {
    this.asked.push("print");
    return true;
  }

  async download(): Promise<boolean> {
    this.asked.push("download");
    return true;
  }

  override focus(options?: FocusOptions): void {
    this.shadowRoot?.querySelector<HTMLElement>(".frame")?.focus(options);
  }

  async toggleFullscreen(): Promise<boolean> {
    this.asked.push("fullscreen");
    return true;
  }

  play(): void {
    this.playing = true;
    this.dispatchEvent(new CustomEvent("playchange"));
  }

  pause(): void {
    this.playing = false;
    this.dispatchEvent(new CustomEvent("playchange"));
  }
}
customElements.define("stand-in", FakeBook);

/**
 * Adds a test double with controls to the document, `width` CSS pixels wide.
 * Returns it with a function that removes the controls.
 */
export function addFakeBook(
  width = 780,
  change: Partial<FakeBook> = {},
): { book: FakeBook; root: ShadowRoot; remove: () => void } {
  const book = new FakeBook();
  Object.assign(book, change);
  const root = book.attachShadow({ mode: "open", delegatesFocus: true });
  addStyle(root, style);
  const frame = document.createElement("div");
  frame.className = "frame";
  frame.tabIndex = 0;
  followTab(frame);
  frame.setAttribute("role", "group");
  const stage = document.createElement("div");
  stage.setAttribute("part", "stage");
  frame.append(stage);
  root.append(frame);
  book.attachInternals().role = "group";
  book.setAttribute("aria-label", "A Book");
  book.setAttribute("controls", "");
  book.style.cssText = `width: ${width}px; height: 560px`;
  document.body.append(book);
  return { book, root, remove: addControls(book, frame, stage) };
}
