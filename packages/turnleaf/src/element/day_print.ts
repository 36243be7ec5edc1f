/**
 * What is printed of a book in a dark theme with its web page: its open pages as they are by day, each where
 * it is seen. Nothing can be drawn once a browser prints, so they are drawn while the book lies at rest and
 * nothing else is to be done.
 */

import { pagesAt } from "../book/spreads.ts";
import type { PageList } from "../sources/page_list.ts";
import { idle } from "../sources/typeset/idle.ts";
import type { Viewer } from "../viewer/viewer.ts";

/** Milliseconds at rest after which pages are drawn, even where the browser is busy. */
const longestWait = 2000;

/** The open book, as far as its pages are drawn by day. */
export interface NightBook {
  readonly source: PageList;
  readonly viewer: Viewer;
  /** What is printed otherwise; in the stage. */
  readonly canvas: HTMLCanvasElement;
  /** Whether the open pages are scrolled. */
  readonly isScrolled: () => boolean;
}

/** The pages that are printed, in the place of the book's canvas. */
export class DayPrint {
  readonly #book: NightBook;
  readonly #pages: HTMLElement = document.createElement("div");
  #drawing = new AbortController();

  /** @param ended its abort removes the pages */
  constructor(book: NightBook, ended: AbortSignal) {
    this.#book = book;
    this.#pages.className = "by-day";
    this.#pages.ariaHidden = "true";
    book.canvas.after(this.#pages);
    const stop = book.viewer.onViewChange((rests) => this.update(rests));
    ended.addEventListener("abort", () => {
      stop();
      this.#drawing.abort();
      this.#pages.remove();
    });
    this.update();
  }

  /** Draws the open pages if the book rests in a dark theme. What was drawn before is removed. */
  update(rests = true): void {
    this.#drawing.abort();
    this.#pages.replaceChildren();
    if (!rests || !this.#book.source.colours?.isDark) return;
    this.#drawing = new AbortController();
    const { signal } = this.#drawing;
    // A page that cannot be drawn says so where it would be seen.
    this.#draw(signal).catch(() => {});
  }

  async #draw(signal: AbortSignal): Promise<void> {
    const { source, viewer, isScrolled } = this.#book;
    await idle(longestWait);
    const open = pagesAt(viewer.binding, viewer.turning.spread);
    const isElement = open.some((page) => source.element(page - 1) !== null);
    if (signal.aborted || isElement || isScrolled()) return;
    const drawn: HTMLElement[] = [];
    for (const page of open) {
      const size = await source.size(page - 1, signal);
      const { x, y, width, height } = viewer.placeOf(page, size);
      const [from, to] = [viewer.project(page, x, y), viewer.project(page, x + width, y + height)];
      if (from === null || to === null) return;
      const across = Math.round((to.x - from.x) * window.devicePixelRatio);
      if (across < 1) return;
      const picture = await source.draw(page - 1, across, signal, undefined, null);
      const canvas = document.createElement("canvas");
      [canvas.width, canvas.height] = [picture.width, picture.height];
      canvas.getContext("2d")?.drawImage(picture, 0, 0);
      if ("close" in picture) picture.close();
      Object.assign(canvas.style, {
        left: `${from.x}px`,
        top: `${from.y}px`,
        width: `${to.x - from.x}px`,
        height: `${to.y - from.y}px`,
      });
      drawn.push(canvas);
    }
    if (!signal.aborted) this.#pages.replaceChildren(...drawn);
  }
}
