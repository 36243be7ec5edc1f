/** What tests of page sources look at: the text of pages, their red, and why a book is rejected. */

import { expect } from "vitest";
import { BookError, type PageSource } from "../sources/page_source.ts";

const never = new AbortController().signal;

/** Returns the text of every page, its runs with `between` between them. */
export async function textsOf(source: PageSource, between: string): Promise<string[]> {
  const pages: string[] = [];
  for (let index = 0; index < source.pageCount; index++) {
    const runs = (await source.text?.(index, never)) ?? [];
    pages.push(runs.map(({ text }) => text).join(between));
  }
  return pages;
}

/** Returns the part of a page's pixels that are red. */
export async function redness(source: PageSource, index: number): Promise<number> {
  const picture = await source.draw(index, 100, never);
  const canvas = new OffscreenCanvas(picture.width, picture.height);
  const pen = canvas.getContext("2d") as OffscreenCanvasRenderingContext2D;
  pen.drawImage(picture, 0, 0);
  const { data } = pen.getImageData(0, 0, picture.width, picture.height);
  let red = 0;
  for (let at = 0; at < data.length; at += 4) {
    if ((data[at] ?? 0) > 200 && (data[at + 1] ?? 0) < 60) red += 1;
  }
  return (4 * red) / data.length;
}

/** Returns the sentence with which a book is rejected; empty if it is not. */
export const messageOf = (promise: Promise<unknown>): Promise<string> =>
  promise.then(
    () => "",
    (error: unknown) => {
      expect(error).toBeInstanceOf(BookError);
      return (error as Error).message;
    },
  );
