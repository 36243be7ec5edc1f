/** Pages added to an open book, taken from it and replaced. */

import { type BookInput, openSource } from "../sources/open.ts";
import type { OpenBook } from "./life.ts";

/** Changes the pages of one element's book, one change after the other, in the order they are asked for. */
export class PageChanges {
  #last: Promise<unknown> = Promise.resolve();

  /**
   * Puts pages in place of `count` pages from `at` (from 1) on. Resolves, once
   * they are there, to whether they are: not where the book went away before.
   * Rejects with a `BookError`, and changes nothing then.
   *
   * @param book the book that lies open when it is this change's turn
   * @param input what the pages come from; null for none
   */
  change(
    book: () => OpenBook | null,
    at: number,
    count: number,
    input: BookInput | null,
  ): Promise<boolean> {
    const changed = this.#last.then(() => apply(book(), at, count, input));
    this.#last = changed.catch(() => {});
    return changed;
  }
}

async function apply(
  book: OpenBook | null,
  at: number,
  count: number,
  input: BookInput | null,
): Promise<boolean> {
  if (book === null) return false;
  const added = input === null ? null : await openSource(input);
  let isDone = false;
  try {
    isDone = await book.viewer.changePages(() => book.source.splice(at - 1, count, added));
  } finally {
    if (isDone) book.reading.changed();
    else added?.close();
  }
  return isDone;
}
