/** Places in flowing text are found again, in whatever size it is set meanwhile. */

import { afterEach, expect, test } from "vitest";
import { tinyEpub } from "../epub/tiny_epub.ts";
import { openSource } from "../open.ts";
import { placeOf, type Typography } from "../page_source.ts";
import type { FlowSource } from "./flow_source.ts";
import { ownTypography } from "./typography.ts";

const never = new AbortController().signal;
const open: FlowSource[] = [];

afterEach(() => {
  for (const source of open.splice(0)) source.close();
});

/** Opens a book whose words are all different. */
async function opened(): Promise<FlowSource> {
  const words = Array.from({ length: 3000 }, (_, k) => `word${k}`);
  const source = (await openSource(
    tinyEpub({ chapters: [`<p>${words.join(" ")}</p>`] }),
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
