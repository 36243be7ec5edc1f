/** The proportions of a book's leaves. */

import type { PageSource } from "../sources/page_source.ts";

/**
 * A leaf's width over its height: that of an inner page, as covers often have
 * another size; of another page where that one cannot be read.
 */
export async function leafAspect(source: PageSource, signal: AbortSignal): Promise<number> {
  let failure: unknown;
  for (const index of [2, 3, 1, 0, 4].filter((index) => index < source.pageCount)) {
    try {
      const { width, height } = await source.size(index, signal);
      return Math.min(Math.max(width / height, 0.25), 4);
    } catch (error) {
      signal.throwIfAborted();
      failure = error;
    }
  }
  throw failure;
}
