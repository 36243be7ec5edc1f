/** Which page of which section each page of a book of flowing text is. */

/** A page of a section. */
export interface SectionPage {
  readonly section: number;
  /** From 0. */
  readonly page: number;
}

/** The pages of a book, from each section's number of them. */
export class PageNumbers {
  readonly pageCount: number;
  /** Whether some sections are still to be counted. */
  readonly isEstimated: boolean;
  /** The index of each section's first page. */
  readonly #first: readonly number[];
  readonly #counts: readonly number[];
  readonly #known: readonly boolean[];

  /**
   * @param counts each section's number of pages, at least 1
   * @param known whether each is counted, and not estimated
   * @param isEstimated whether some are still to be counted
   */
  constructor(counts: readonly number[], known: readonly boolean[], isEstimated: boolean) {
    let next = 0;
    this.#counts = counts;
    this.#known = known;
    this.isEstimated = isEstimated;
    this.#first = counts.map((count) => {
      const first = next;
      next += count;
      return first;
    });
    this.pageCount = Math.max(next, 1);
  }

  /** Returns which page a page (from 0) is. */
  at(index: number): SectionPage {
    const section = Math.max(
      this.#first.findLastIndex((first) => first <= index),
      0,
    );
    return { section, page: index - (this.#first[section] ?? 0) };
  }

  /** Returns the index of a section's page; of its last one if it has no such page. */
  indexOf(section: number, page: number): number {
    const count = this.#counts[section] ?? 1;
    return (this.#first[section] ?? 0) + Math.min(Math.max(page, 0), count - 1);
  }

  /** Returns a section's number of pages. */
  countOf(section: number): number {
    return this.#counts[section] ?? 0;
  }

  /** Returns whether a section's number of pages is counted, and not estimated. */
  isKnown(section: number): boolean {
    return this.#known[section] ?? false;
  }
}
