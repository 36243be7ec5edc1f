/** The text of a book's pages, read on request, with a bounded cache. */

import type { TextPage, TextRun } from "../sources/page_source.ts";

/** Maximum of characters kept: those of some five hundred full pages. */
const mostLetters = 1_500_000;

/** Cost of a run besides its letters, in letters. */
const runCost = 40;

/** Text of pages, by what identifies it. */
export class PageTexts {
  /** In the order in which they were last requested. */
  readonly #kept = new Map<unknown, readonly TextRun[]>();
  #cost = 0;
  #mayHaveText = false;

  /** Whether a page that was read has text, or one could not be read. */
  get mayHaveText(): boolean {
    return this.#mayHaveText;
  }

  /**
   * Returns the runs of a page; none if it has no text or cannot be
   * read. Rejects only with the signal's reason.
   */
  async of(page: TextPage, signal: AbortSignal): Promise<readonly TextRun[]> {
    const { key } = page;
    const kept = this.#kept.get(key);
    if (kept) {
      this.#kept.delete(key);
      this.#kept.set(key, kept);
      return kept;
    }
    try {
      const runs = await page.text(signal);
      signal.throwIfAborted();
      this.#keep(key, runs);
      return runs;
    } catch {
      // A page that cannot be read is reported where it would be seen.
      signal.throwIfAborted();
      this.#mayHaveText = true;
      return [];
    }
  }

  #keep(key: unknown, runs: readonly TextRun[]): void {
    if (this.#kept.has(key)) return;
    this.#kept.set(key, runs);
    this.#mayHaveText ||= runs.some(({ text }) => text.trim() !== "");
    this.#cost += costOf(runs);
    for (const [oldest, old] of this.#kept) {
      if (this.#cost <= mostLetters || oldest === key) break;
      this.#kept.delete(oldest);
      this.#cost -= costOf(old);
    }
  }
}

function costOf(runs: readonly TextRun[]): number {
  return runs.reduce((sum, { text }) => sum + text.length + runCost, runCost);
}
