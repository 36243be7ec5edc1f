/** Books of flowing text whose pages are all known, for tests in a browser. */

import { afterEach } from "vitest";
import { openSource } from "../sources/open.ts";
import type { PageSource } from "../sources/page_source.ts";

const never = new AbortController().signal;
const opened: PageSource[] = [];

/** Closes after each test of a file what `laidOut` has opened in it. */
export function closeBooks(): void {
  afterEach(() => {
    for (const source of opened.splice(0)) source.close();
  });
}

/** Opens a book and waits until its pages are counted. */
export async function laidOut(book: Parameters<typeof openSource>[0]): Promise<PageSource> {
  const source = await openSource(book);
  opened.push(source);
  await source.settle?.();
  return source;
}

/** Returns a page's words, with a blank between lines. */
export async function wordsOf(source: PageSource, index: number): Promise<string> {
  return ((await source.text?.(index, never)) ?? [])
    .map(({ text, end }) => text + (end ? " " : ""))
    .join("")
    .replace(/\s+/g, " ")
    .trim();
}

/** Returns the words of all pages. */
export async function pagesOf(source: PageSource): Promise<string[]> {
  const pages: string[] = [];
  for (let index = 0; index < source.pageCount; index++) pages.push(await wordsOf(source, index));
  return pages;
}
