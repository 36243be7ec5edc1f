/** Inserts, removes and replaces pages of an open book. */

import { loadPart } from "../sources/load_part.ts";
import type { BookInput } from "../sources/open.ts";
import type { PageSource } from "../sources/page_source.ts";
import type { OpenBook } from "./open_book.ts";

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
   * are there, to whether they are: false if the book was closed before. Rejects
   * with a `BookError`, and changes nothing then.
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
  ): Promise<boolean> {
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
): Promise<boolean> {
  if (book === null) return false;
  const { openSource } = await loadPart(import("../sources/open.ts"));
  const added = input === null ? null : await openSource(input, { pdfWorker });
  let isMade = false;
  try {
    if (added !== null) {
      await book.elements.adopt(added);
      await check(added);
    }
    isMade = await book.changePages(() => book.source.splice(at - 1, count, added));
  } finally {
    if (!isMade) {
      added?.close();
      book.elements.refresh();
    }
  }
  return isMade;
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
