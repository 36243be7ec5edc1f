/** The size of a book's leaves. */

import type { PageSize, PageSource } from "../sources/page_source.ts";

/** Proportions that a leaf may have, width over height. */
const [narrowest, widest] = [0.25, 4];

/**
 * Returns a leaf's size in the source's unit: as the source says, or that of an inner page, because
 * covers often have another size, or of another page if that one cannot be
 * read.
 */
export async function leafSize(source: PageSource, signal: AbortSignal): Promise<PageSize> {
  if (source.leaf) return source.leaf;
  let failure: unknown;
  for (const index of [2, 3, 1, 0, 4].filter((index) => index < source.pageCount)) {
    try {
      const { width, height } = await source.size(index, signal);
      return { width: Math.min(Math.max(width, narrowest * height), widest * height), height };
    } catch (error) {
      signal.throwIfAborted();
      failure = error;
    }
  }
  throw failure;
}
