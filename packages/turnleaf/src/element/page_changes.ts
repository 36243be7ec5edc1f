/** Inserts, removes and replaces pages of an open book. */

import { loadPart } from "../sources/load_part.ts";
import type { BookInput } from "../sources/open.ts";
import type { NewIndex, PageSource } from "../sources/page_source.ts";
import type { OpenBook } from "./book_lifecycle.ts";

/** How many pages of an addition are drawn before it is inserted, and how wide, pixels. */
const checkedPages = 8;
const checkedWidth = 64;

/**
 * Changes the pages of one element's book, one change after the other, in the
 * order of the calls.
 */
export class PageChanges {
  #last: Promise<unknown> = Promise.resolve();

  /**
   * Replaces `count` pages from `at` (from 1) on by others. Resolves, once they
   * are there, to a function that returns where the others lie now; to null if
   * the book was closed before. Rejects with a `BookError`, and changes nothing
   * then.
   *
   * @param book the open book when it is this change's turn
   * @param input the source of the pages; null for none
   * @param pdfWorker address of pdf.js's workers, if they may not be blobs
   */
  change(
    book: () => OpenBook | null,
    at: number,
    count: number,
    input: BookInput | null,
    pdfWorker?: string,
  ): Promise<NewIndex | null> {
    const changed = this.#last.then(() => apply(book(), at, count, input, pdfWorker));
    this.#last = changed.catch(() => {});
    return changed;
  }
}

async function apply(
  book: OpenBook | null,
  at: number,
  count: number,
  input: BookInput | null,
  pdfWorker: string | undefined,
): Promise<NewIndex | null> {
  if (book === null) return null;
  const { openSource } = await loadPart(import("../sources/open.ts"));
  const added = input === null ? null : await openSource(input, { pdfWorker });
  let moved = null as NewIndex | null;
  try {
    if (added !== null) {
      await book.elements.adopt(added);
      await check(added);
    }
    await book.viewer.changePages(() => {
      moved = book.elements.after(() => book.source.splice(at - 1, count, added));
      return moved;
    });
  } finally {
    if (moved) book.reading.changed();
    else {
      added?.close();
      book.elements.refresh();
    }
  }
  return moved;
}

/**
 * Draws the first pages of an addition once, because a list may name missing
 * files. Rejects with a `BookError` if one of them cannot be drawn.
 */
async function check(source: PageSource): Promise<void> {
  const ended = new AbortController();
  const draw = async (index: number): Promise<void> => {
    const picture = await source.draw(index, checkedWidth, ended.signal);
    if ("close" in picture) picture.close();
  };
  const indices = Array.from({ length: Math.min(source.pageCount, checkedPages) }, (_, k) => k);
  try {
    await Promise.all(indices.map(draw));
  } finally {
    ended.abort();
  }
}
