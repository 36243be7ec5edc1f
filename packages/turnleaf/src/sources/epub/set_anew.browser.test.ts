/** EPUBs whose text is set anew while they are open, in another size or face. */

import { describe, expect, test } from "vitest";
import { closeEpubs, laidOutEpub, textOf } from "../../for_tests/epub_books.ts";
import type { NewIndex, PageSource, Typography } from "../page_source.ts";
import { ownTypography } from "../typeset/typography.ts";
import { prose } from "./tiny_epub.ts";

const never = new AbortController().signal;

closeEpubs();

describe("text that is set anew", () => {
  /** Returns what a change of the typography does to the pages. */
  const change = async (source: PageSource, typography: Partial<Typography>): Promise<NewIndex> => {
    const changed = new Promise<NewIndex>((resolve) => {
      source.watchPages?.((apply) => resolve(apply()));
    });
    await source.typeset?.({ ...ownTypography, ...typography });
    return await changed;
  };

  test("has another number of pages, and each place is on the page that has its words", async () => {
    const source = await laidOutEpub({ chapters: [prose(30), prose(10)] });
    const before = source.pageCount;
    const height = (await source.text?.(0, never))?.[0]?.height ?? 0;
    const first = await Promise.all(
      Array.from(
        { length: before },
        async (_, index) => (await textOf(source, index)).split(" ")[1],
      ),
    );
    const larger = await change(source, { size: 1.5 });
    await source.draw(source.pageCount - 1, 50, never);
    for (let index = 0; index < 3; index++) {
      const now = larger.placeOf?.(index) ?? -1;
      expect(larger(index)).toBeNull();
      expect(await textOf(source, now)).toContain(first[index]);
    }
    expect(source.pageCount).toBeGreaterThan(1.5 * before);
    // The paper stays as large as it was, the type on it is larger.
    expect(await source.size(0)).toEqual({ width: 488, height: 748 });
    expect((await source.text?.(0, never))?.[0]?.height).toBeCloseTo(1.5 * height, 0);
  });

  test("keeps the places in chapters that are set later", async () => {
    const source = await laidOutEpub({ chapters: [prose(20), prose(20), prose(20)] });
    // The last words of the first chapter, while only the third is in sight.
    let page = 0;
    while (!(await textOf(source, page)).includes("word19x59")) page++;
    const [start] = (await textOf(source, page)).split(/\s/);
    for (const index of [4, 3, 2, 1]) await source.draw(source.pageCount - index, 50, never);
    const changes: NewIndex[] = [];
    const settled = new Promise<void>((resolve) => {
      source.watchPages?.((apply) => {
        changes.push(apply());
        if (changes.length > 1) resolve();
      });
    });
    await source.typeset?.({ ...ownTypography, size: 1.7 });
    await settled;
    for (const change of changes) page = change.placeOf?.(page) ?? -1;
    expect(await textOf(source, page)).toContain(start);
  });

  test("comes back to the page where the reader was", async () => {
    const source = await laidOutEpub({ chapters: [prose(30)] });
    let page = 3;
    for (const size of [1.3, 0.8, 2, 0.6, 1])
      page = (await change(source, { size })).placeOf?.(page) ?? -1;
    expect(page).toBe(3);
  });

  test("has the typeface, lines and margins that are chosen", async () => {
    const source = await laidOutEpub({ chapters: [prose(2)], css: "p { color: #f00; margin: 0 }" });
    const before = (await source.text?.(0, never)) ?? [];
    await change(source, { font: "sans-serif", lineHeight: 2, margins: 2 });
    const after = (await source.text?.(0, never)) ?? [];
    expect((after[1]?.y ?? 0) - (after[0]?.y ?? 0)).toBe(32);
    expect(after[0]?.x).toBeCloseTo(2 * (before[0]?.x ?? 0), -1);
  });

  test("is that of the last choice, however many are made at once", async () => {
    const source = await laidOutEpub({ chapters: [prose(10)] });
    const before = (await source.text?.(0, never))?.[0]?.height ?? 0;
    const changed = new Promise<void>((resolve) => {
      source.watchPages?.((apply) => {
        apply();
        resolve();
      });
    });
    const all = [0.5, 2, 0.7, 3].map((size) => source.typeset?.({ ...ownTypography, size }));
    await Promise.all(all);
    await changed;
    const height = (await source.text?.(0, never))?.[0]?.height ?? 0;
    expect(height / before).toBeCloseTo(3, 1);
  });
});
