/** What stands in the margins of pages of flowing text. */

import { afterEach, expect, test } from "vitest";
import { prose, tinyEpub } from "../epub/tiny_epub.ts";
import { openSource } from "../open.ts";
import type { FlowSource } from "./flow_source.ts";
import { paperback } from "./page_measures.ts";
import { ownTypography } from "./typography.ts";

const never = new AbortController().signal;
const open: FlowSource[] = [];

afterEach(() => {
  for (const source of open.splice(0)) source.close();
});

async function opened(chapters: readonly string[]): Promise<FlowSource> {
  const source = (await openSource(tinyEpub({ chapters }))) as FlowSource;
  open.push(source);
  return source;
}

/** Returns how much ink is in the margin at a page's head, and at its foot: parts of 100,000. */
async function inkIn(source: FlowSource, index: number): Promise<[head: number, foot: number]> {
  const picture = (await source.draw(index, paperback.width, never)) as ImageBitmap;
  const { width, height } = picture;
  const pen = new OffscreenCanvas(width, height).getContext(
    "2d",
  ) as OffscreenCanvasRenderingContext2D;
  pen.drawImage(picture, 0, 0);
  picture.close();
  const ink = (top: number): number => {
    const { data } = pen.getImageData(0, top, width, 50);
    let sum = 0;
    for (let k = 0; k < data.length; k += 4) sum += 255 - (data[k] ?? 255);
    return Math.round((100_000 * sum) / (255 * width * 50));
  };
  return [ink(5), ink(height - 55)];
}

test("pages have a running head and a number, the first of a chapter a number alone, a picture neither", async () => {
  const picture = '<svg width="300" height="500"><rect width="300" height="500"/></svg>';
  const source = await opened([picture, prose(40), "<p>For Ann</p>", prose(20)]);
  await source.settle();
  const chapter = (await source.outline())[1]?.page ?? 0;
  expect(await inkIn(source, 0)).toEqual([0, 0]);
  const [first, second, third] = await Promise.all(
    [0, 1, 2].map((k) => inkIn(source, chapter - 1 + k)),
  );
  expect(first?.[0]).toBe(0);
  expect(first?.[1]).toBeGreaterThan(0);
  expect(Math.min(...(second ?? []), ...(third ?? []))).toBeGreaterThan(0);
  // The book's title on one, the chapter's on the other.
  expect(second?.[0]).not.toBe(third?.[0]);
  const dedication = (await source.outline())[2]?.page ?? 0;
  expect(await inkIn(source, dedication - 1)).toEqual([0, 0]);
});

test("pages of a table whose caption and foot are written first have numbers", async () => {
  const rows = "<tr><td>row</td><td>of a table</td></tr>".repeat(90);
  const foot = "<tfoot><tr><td>foot</td></tr></tfoot>";
  const caption = '<caption style="caption-side: bottom">below</caption>';
  const source = await opened([`<table>${caption}${foot}${rows}</table>`]);
  await source.settle();
  expect(source.pageCount).toBeGreaterThan(2);
  for (let page = 0; page < source.pageCount - 1; page++) {
    expect((await inkIn(source, page))[1]).toBeGreaterThan(0);
  }
});

test("they are as large whatever the size of the type, and absent from margins without room", async () => {
  const source = await opened([prose(60)]);
  const usual = await inkIn(source, 2);
  const set = async (change: Partial<typeof ownTypography>): Promise<[number, number]> => {
    await source.typeset?.({ ...ownTypography, ...change });
    await source.settle();
    return await inkIn(source, 2);
  };
  const larger = await set({ size: 1.5 });
  expect(Math.abs(larger[1] - usual[1])).toBeLessThan(0.3 * usual[1]);
  expect(await set({ margins: 0.3 })).not.toEqual(usual);
});

test("a page that has another number is drawn anew", async () => {
  const spaced = `<div style="line-height: 4">${prose(60)}</div>`;
  const source = await opened([prose(60), spaced, prose(60)]);
  let change: (() => unknown) | null = null;
  source.watchPages((due) => {
    change = due;
  });
  const outdated: number[] = [];
  source.watchDrawings((index) => outdated.push(index));
  const before = source.pageCount;
  const last = before - 1;
  await source.draw(last, 100, never);
  await source.settle();
  (change as (() => unknown) | null)?.();
  await Promise.resolve();
  expect(source.pageCount).not.toBe(before);
  expect(outdated).toContain(last + source.pageCount - before);
});
