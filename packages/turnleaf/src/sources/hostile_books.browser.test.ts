/**
 * Books that would take any time and memory are opened or rejected within 10 s and 1 GB; others beside
 * them are read.
 */

import { expect, test } from "vitest";
import { commands } from "vitest/browser";
import { hostileBooks } from "../for_tests/hostile_books.ts";
import { messageOf } from "../for_tests/source_pages.ts";
import { openSource } from "./open.ts";
import { BookError, type PageSource } from "./page_source.ts";

const never = new AbortController().signal;

/** Draws and reads the first page, as a reader does who opens a book. */
async function readFirst(source: PageSource): Promise<void> {
  await source.size(0);
  const picture = await source.draw(0, 900, never);
  if ("close" in picture) picture.close();
  await source.text?.(0, never);
  await source.links?.(0, never);
}

/** What a book may take: seconds of processors, as those on the wall are other tests' too, and bytes. */
const most = { seconds: 10, bytes: 1_000_000_000 };

test.each(hostileBooks())("$name is opened or rejected", async ({ make, isRefused, firstPage }) => {
  const file = make();
  await commands.processUse();
  const source = await openSource(file).catch((error: unknown) => {
    expect(error).toBeInstanceOf(BookError);
    return error as BookError;
  });
  const said = source instanceof BookError ? source.message : await messageOf(readFirst(source));
  if (isRefused) expect(said).toMatch(/a\.\w+.* takes more time or memory than a page may: .*\.$/);
  else if (firstPage) expect(said).toMatch(firstPage);
  else expect(said).toBe("");
  if (!(source instanceof BookError)) {
    // The rest of the book is read.
    const last = source.pageCount - 1;
    if (last > 0 && !firstPage) {
      const picture = await source.draw(last, 60, never);
      if ("close" in picture) picture.close();
    }
    source.close();
  }
  const { seconds, bytes } = await commands.processUse();
  expect(seconds).toBeLessThan(most.seconds);
  // Other systems than Linux do not say it.
  expect(bytes ?? 0).toBeLessThan(most.bytes);
});
