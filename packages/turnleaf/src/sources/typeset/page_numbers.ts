/** Which page of which section each page of a book of flowing text is. */

import type { FlowSection } from "./flow_book.ts";

/** A page of a section; one before its first is blank. */
export interface SectionPage {
  readonly section: number;
  /** From 0; -1 for a blank page. */
  readonly page: number;
}

/** The pages of a book, from each section's number of them. */
export class PageNumbers {
  readonly pageCount: number;
  /** The index of each section's first page. */
  readonly #first: readonly number[];
  readonly #counts: readonly number[];

  /** @param direction which side of a spread the first page is on: the right one for "ltr" */
  constructor(
    sections: readonly FlowSection[],
    counts: readonly number[],
    direction: "ltr" | "rtl",
  ) {
    let next = 0;
    this.#counts = counts;
    this.#first = counts.map((count, section) => {
      const side = sections[section]?.side;
      // Pages with an even index are on the side where a book begins.
      const parity =
        side === undefined ? next % 2 : Number((side === "left") === (direction === "ltr"));
      const first = next + Math.abs((next % 2) - parity);
      next = first + count;
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
    const page = index - (this.#first[section] ?? 0);
    // Before the next section there may be a blank one.
    return page >= 0 && page < (this.#counts[section] ?? 0)
      ? { section, page }
      : { section, page: -1 };
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
}
