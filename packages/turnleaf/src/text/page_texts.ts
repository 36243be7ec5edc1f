/** The text of a book's pages, read on request, with a bounded cache. */

import type { PageSource, TextRun } from "../sources/page_source.ts";

/** Maximum of characters kept: those of some five hundred full pages. */
const mostLetters = 1_500_000;

/** Cost of a run besides its letters, in letters. */
const runCost = 40;

/** Text of pages, by page number. */
export class PageTexts {
  readonly #source: PageSource;
  /** In the order in which they were last requested. */
  #kept = new Map<number, readonly TextRun[]>();
  #cost = 0;

  constructor(source: PageSource) {
    this.#source = source;
  }

  /**
   * Returns the runs of a page (from 1); none if it has no text or cannot be
   * read. Rejects only with the signal's reason.
   */
  async of(page: number, signal: AbortSignal): Promise<readonly TextRun[]> {
    const all = this.#kept;
    const kept = all.get(page);
    if (kept) {
      all.delete(page);
      all.set(page, kept);
      return kept;
    }
    try {
      const runs = (await this.#source.text?.(page - 1, signal)) ?? [];
      signal.throwIfAborted();
      // A request from before the pages changed is not this page's any more.
      if (all === this.#kept) this.#keep(page, runs);
      return runs;
    } catch {
      // A page that cannot be read is reported where it would be seen.
      signal.throwIfAborted();
      return [];
    }
  }

  /** Forgets all texts, after a change of the pages. */
  clear(): void {
    this.#kept = new Map();
    this.#cost = 0;
  }

  #keep(page: number, runs: readonly TextRun[]): void {
    if (this.#kept.has(page)) return;
    this.#kept.set(page, runs);
    this.#cost += costOf(runs);
    for (const [oldest, old] of this.#kept) {
      if (this.#cost <= mostLetters || oldest === page) break;
      this.#kept.delete(oldest);
      this.#cost -= costOf(old);
    }
  }
}

function costOf(runs: readonly TextRun[]): number {
  return runs.reduce((sum, { text }) => sum + text.length + runCost, runCost);
}
