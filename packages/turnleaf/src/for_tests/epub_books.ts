/** EPUBs that tests write, opened and all of their pages known, and what is seen on these. */

import { afterEach, expect } from "vitest";
import { type TinyEpub, tinyEpub } from "../sources/epub/tiny_epub.ts";
import { openSource } from "../sources/open.ts";
import type { PageSource } from "../sources/page_source.ts";

const never = new AbortController().signal;
const opened: PageSource[] = [];

/** Closes after each test of a file the EPUBs that it has opened, none of which leaves a frame in the page. */
export function closeEpubs(): void {
  afterEach(() => {
    for (const source of opened.splice(0)) source.close();
    expect(document.querySelectorAll("iframe").length).toBe(0);
  });
}

/** Opens an EPUB. */
export async function openEpub(epub: TinyEpub): Promise<PageSource> {
  const source = await openSource(tinyEpub(epub));
  opened.push(source);
  return source;
}

/** Opens an EPUB and waits until its pages are counted. */
export async function laidOutEpub(epub: TinyEpub): Promise<PageSource> {
  const source = await openEpub(epub);
  await source.settle?.();
  return source;
}

/** Returns a page's text (from 0), a line break after each of its lines. */
export async function textOf(source: PageSource, index: number): Promise<string> {
  const runs = (await source.text?.(index, never)) ?? [];
  return runs.map(({ text, end }) => text + (end ? "\n" : "")).join("");
}

/** Returns the colours of a page's pixels but for the margin at its foot, in a line. */
export async function pixelsOf(source: PageSource, index: number): Promise<string> {
  const { width } = await source.size(index);
  const bitmap = (await source.draw(index, width, never)) as ImageBitmap;
  const pen = new OffscreenCanvas(bitmap.width, bitmap.height).getContext("2d");
  pen?.drawImage(bitmap, 0, 0);
  return pen?.getImageData(0, 0, bitmap.width, bitmap.height * 0.8).data.join() ?? "";
}

/** Returns the colour of a place of a page, fractions of its size, as "r,g,b". */
export async function colourAt(
  source: PageSource,
  index: number,
  x: number,
  y: number,
): Promise<string> {
  const picture = (await source.draw(index, 200, never)) as ImageBitmap;
  const pen = new OffscreenCanvas(picture.width, picture.height).getContext("2d")!;
  pen.drawImage(picture, 0, 0);
  const [left, top] = [Math.floor(x * picture.width), Math.floor(y * picture.height)];
  return [...pen.getImageData(left, top, 1, 1).data.slice(0, 3)].join(",");
}

/** Returns a PNG of one colour. */
export async function png(colour: string, width = 40, height = 60): Promise<Uint8Array> {
  const canvas = new OffscreenCanvas(width, height);
  const pen = canvas.getContext("2d")!;
  pen.fillStyle = colour;
  pen.fillRect(0, 0, width, height);
  return new Uint8Array(await (await canvas.convertToBlob()).arrayBuffer());
}
