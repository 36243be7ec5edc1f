/** The open book as something to read: its text, which comes a moment after it, and its contents. */

import { loaded } from "../sources/loaded.ts";
import type { OutlineEntry } from "../sources/page_source.ts";
import type { SearchHit } from "../text/searching.ts";
import type { TextOver, Under } from "./text_over.ts";

/** What an open book has to read. */
export class Reading {
  readonly #under: Under;
  readonly #ended = new AbortController();
  /** Rejects with a `BookError` where it cannot be loaded. */
  readonly #text: Promise<TextOver>;

  /** @param failed told that there will be no text, once */
  constructor(under: Under, failed: (error: unknown) => void) {
    this.#under = under;
    const { signal } = this.#ended;
    this.#text = loaded(import("./text_over.ts")).then(({ TextOver }) => {
      signal.throwIfAborted();
      return new TextOver(under, signal);
    });
    this.#text.catch((error: unknown) => signal.aborted || failed(error));
  }

  /** As the element's own. */
  async search(query: string, signal?: AbortSignal): Promise<readonly SearchHit[]> {
    const ended = this.#ended.signal;
    const either = signal ? AbortSignal.any([signal, ended]) : ended;
    return (await this.#text).search(query, either);
  }

  /** Marks a hit and every other place of its query wherever they come in sight; null takes the marks away. */
  mark(hit: SearchHit | null): void {
    this.#withText((text) => text.mark(hit));
  }

  /** The book has other pages than before: all that was read of them is read anew. */
  changed(): void {
    this.#withText((text) => text.changed());
  }

  /** As the element's own. */
  async outline(): Promise<readonly OutlineEntry[]> {
    return (await this.#under.source.outline?.(this.#ended.signal)) ?? [];
  }

  /** Takes the text away and ends every search. */
  destroy(): void {
    this.#ended.abort();
  }

  /** Does something once the text is there. Where it cannot be loaded, that has been said. */
  #withText(act: (text: TextOver) => void): void {
    this.#text.then(
      (text) => this.#ended.signal.aborted || act(text),
      () => {},
    );
  }
}
