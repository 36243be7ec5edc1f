/** Places in flowing text are found again, in whatever size it is set meanwhile. */

import { afterEach, expect, test } from "vitest";
import { holdCounting } from "../../for_tests/held_counting.ts";
import { tinyEpub } from "../epub/tiny_epub.ts";
import { openSource } from "../open.ts";
import { type NewIndex, placeOf, type Typography } from "../page_source.ts";
import type { FlowSource } from "./flow_source.ts";
import { ownTypography } from "./typography.ts";

const never = new AbortController().signal;
const open: FlowSource[] = [];

afterEach(() => {
  for (const source of open.splice(0)) source.close();
});

/** Opens a book whose words are all different. */
async function opened(chapters = 1): Promise<FlowSource> {
  const words = Array.from({ length: 3000 }, (_, k) => `word${k}`);
  const chapter = `<p>${words.join(" ")}</p>`;
  const source = (await openSource(
    tinyEpub({ chapters: Array(chapters).fill(chapter) }),
  )) as FlowSource;
  open.push(source);
  return source;
}

/** The word at the head of a page. */
async function headOf(source: FlowSource, index: number): Promise<string | undefined> {
  const [line] = await source.text(index, never);
  return line?.text.split(" ")[0];
}

const phone: Typography = { ...ownTypography, width: 300 };

test("a book that is opened in one size and then set in that in which it was left shows the same pages", async () => {
  const before = await opened();
  await before.typeset?.(phone);
  await before.settle();
  const pages = [2, 5];
  const anchors = pages.map((page) => before.anchor(page));
  const heads = await Promise.all(pages.map((page) => headOf(before, page)));
  const found: (string | undefined)[] = [];
  for (const anchor of anchors) {
    const source = await opened();
    let [index = null] = await source.findAnchors([anchor]);
    // Until it is set, the address says the same.
    expect(source.anchor(index ?? 0)).toBe(anchor);
    source.watchPages((change) => {
      index = placeOf(change(), index ?? 0);
    });
    await source.typeset?.(phone);
    found.push(await headOf(source, index ?? 0));
  }
  expect(found).toEqual(heads);
});

test("a reader stays at one place when pages are counted while the book is being set anew", async () => {
  holdCounting();
  const source = await opened(3);
  const changes: (() => NewIndex)[] = [];
  source.watchPages((change) => changes.push(change));
  let index = 5;
  source.keepOpen([index]);
  const anchor = source.anchor(index);
  const head = await headOf(source, index);
  // Another chapter is laid out, and counted while nothing is set yet.
  await source.findAnchors(["2:5"]);
  const setting = source.typeset?.(phone);
  index = placeOf(changes[0]?.() as NewIndex, index);
  expect([source.anchor(index), await headOf(source, index)]).toEqual([anchor, head]);
  await setting;
  index = placeOf(changes.at(-1)?.() as NewIndex, index);
  expect(source.anchor(index)).toBe(anchor);
  expect(index).toBeGreaterThan(5);
});

test("set back and forth, the book stays at what stood at the head of a page that was turned to meanwhile", async () => {
  const source = await opened();
  await source.typeset?.(phone);
  await source.settle();
  let change: (() => NewIndex) | null = null;
  source.watchPages((due) => {
    change = due;
  });
  const set = async (typography: Typography, index: number): Promise<number> => {
    source.keepOpen([index]);
    await source.typeset?.(typography);
    return placeOf((change as unknown as () => NewIndex)(), index);
  };
  for (const read of [1, 2, 3]) {
    const wide = (await set(ownTypography, 3)) + read;
    source.keepOpen([wide]);
    const head = await headOf(source, wide);
    const narrow = await set(phone, wide);
    const words = (await source.text(narrow, never)).map(({ text }) => text).join(" ");
    expect(words).toContain(head);
    expect(await headOf(source, await set(ownTypography, narrow))).toBe(head);
    await set(phone, wide);
  }
});
