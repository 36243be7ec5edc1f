/** The text and the contents of an open book, and search in it. */

import { loadPart } from "../sources/load_part.ts";
import type { OutlineEntry } from "../sources/page_source.ts";
import type { SearchHit } from "../text/searching.ts";
import type { BookTextOverlay, TextTarget } from "./book_text_overlay.ts";

/** The text and the contents of an open book. */
export class ReadableBook {
  readonly #under: TextTarget;
  readonly #ended = new AbortController();
  /** Rejects with a `BookError` if it cannot be loaded. */
  readonly #text: Promise<BookTextOverlay>;
  /** It, once it is loaded. */
  #overlay: BookTextOverlay | null = null;

  /** @param failed called once if there will be no text */
  constructor(under: TextTarget, failed: (error: unknown) => void) {
    this.#under = under;
    const { signal } = this.#ended;
    this.#text = loadPart(import("./book_text_overlay.ts")).then(({ BookTextOverlay }) => {
      signal.throwIfAborted();
      this.#overlay = new BookTextOverlay(under, signal);
      return this.#overlay;
    });
    this.#text.catch((error: unknown) => signal.aborted || failed(error));
  }

  /** As the element's own. */
  async search(
    query: string,
    signal?: AbortSignal,
    found?: (hits: readonly SearchHit[]) => void,
  ): Promise<readonly SearchHit[]> {
    const ended = this.#ended.signal;
    const either = signal ? AbortSignal.any([signal, ended]) : ended;
    return (await this.#text).search(query, either, found);
  }

  /** Whether a page that was read has text, or one could not be read: after a search, whether the book may. */
  get mayHaveText(): boolean {
    return this.#overlay?.mayHaveText ?? false;
  }

  /**
   * Marks a hit and every other place of its query when they become visible;
   * null removes the marks.
   */
  mark(hit: SearchHit | null): void {
    this.#withText((text) => text.mark(hit));
  }

  /** As `BookTextOverlay` has it; null while that is not loaded. */
  columnAt(
    ...place: Parameters<BookTextOverlay["columnAt"]>
  ): ReturnType<BookTextOverlay["columnAt"]> {
    return this.#overlay?.columnAt(...place) ?? null;
  }

  /** As `BookTextOverlay` has it; none while that is not loaded. */
  columnsOf(page: number): ReturnType<BookTextOverlay["columnsOf"]> {
    return this.#overlay?.columnsOf(page) ?? [];
  }

  /** As `BookTextOverlay` has it; null while that is not loaded. */
  selectWord(
    ...place: Parameters<BookTextOverlay["selectWord"]>
  ): ReturnType<BookTextOverlay["selectWord"]> {
    return this.#overlay?.selectWord(...place) ?? null;
  }

  /** Reads the pages again after a change of the book. */
  changed(): void {
    this.#withText((text) => text.changed());
  }

  /** As the element's own. */
  async outline(): Promise<readonly OutlineEntry[]> {
    return (await this.#under.source.outline?.(this.#ended.signal)) ?? [];
  }

  /** Removes the text and ends every search. */
  destroy(): void {
    this.#ended.abort();
  }

  /** Calls `act` once the text is loaded. If it cannot be loaded, `failed` has reported that. */
  #withText(act: (text: BookTextOverlay) => void): void {
    this.#text.then(
      (text) => this.#ended.signal.aborted || act(text),
      () => {},
    );
  }
}
