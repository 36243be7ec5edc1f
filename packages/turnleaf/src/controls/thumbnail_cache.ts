/** Thumbnails of pages: few drawn at once, few kept. */

import type { PagePicture } from "../sources/page_source.ts";
import type { ControlledBook } from "./book.ts";

/**
 * Width of a thumbnail, CSS pixels, and the maximum of those kept: 60 of A4 are
 * 11 MB on a high-density screen.
 */
const width = 104;
const mostKept = 60;

/**
 * Draws one page at a time, the last request first: the pages that the book
 * itself needs have priority.
 */
export class ThumbnailCache {
  readonly #book: ControlledBook;
  /** By page, oldest first. */
  readonly #kept = new Map<number, HTMLCanvasElement>();
  #waiting: { page: number; canvas: HTMLCanvasElement; signal: AbortSignal }[] = [];
  #isDrawing = false;

  constructor(book: ControlledBook) {
    this.#book = book;
  }

  /** Paints a page on a canvas as soon as it is drawn, unless the signal aborts first. */
  paint(page: number, canvas: HTMLCanvasElement, signal: AbortSignal): void {
    const kept = this.#kept.get(page);
    if (kept) {
      copy(kept, canvas);
      return;
    }
    this.#waiting.push({ page, canvas, signal });
    void this.#draw();
  }

  /** Forgets every thumbnail, for another book. */
  clear(): void {
    this.#kept.clear();
    this.#waiting = [];
  }

  async #draw(): Promise<void> {
    if (this.#isDrawing) return;
    this.#isDrawing = true;
    for (let next = this.#waiting.pop(); next; next = this.#waiting.pop()) {
      const { page, canvas, signal } = next;
      if (signal.aborted) continue;
      try {
        const across = Math.ceil(width * Math.min(devicePixelRatio, 2));
        const picture = await this.#book.drawPage(page, across, signal);
        if (!signal.aborted) this.#keep(page, picture, canvas);
        if ("close" in picture) picture.close();
      } catch {
        // A page that cannot be drawn stays an empty sheet here; the book gives
        // the reason where it is opened.
      }
    }
    this.#isDrawing = false;
  }

  #keep(page: number, picture: PagePicture, canvas: HTMLCanvasElement): void {
    copy(picture, canvas);
    const kept = document.createElement("canvas");
    copy(picture, kept);
    this.#kept.set(page, kept);
    const [oldest] = this.#kept.keys();
    if (this.#kept.size > mostKept && oldest !== undefined) this.#kept.delete(oldest);
  }
}

function copy(from: PagePicture, to: HTMLCanvasElement): void {
  to.width = from.width;
  to.height = from.height;
  to.getContext("2d")?.drawImage(from, 0, 0);
  to.classList.add("drawn");
}
