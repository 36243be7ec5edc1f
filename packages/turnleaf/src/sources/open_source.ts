import { loadPart } from "./load_part.ts";
import type { BookInput, OpenOptions } from "./open.ts";
import type { PageSource } from "./page_source.ts";

/**
 * Opens a book without showing it, for programs that read its pages themselves:
 * draw them, take their text, convert them. Resolves to its pages, which the
 * caller closes. Rejects with a `BookError`, or with the signal's reason when
 * aborted.
 *
 * @param input what `pages` takes, or an address
 * @param options how it is opened
 */
export async function openSource(input: BookInput, options: OpenOptions = {}): Promise<PageSource> {
  const { openHandedOut } = await loadPart(import("./open.ts"));
  return await openHandedOut(input, options);
}
