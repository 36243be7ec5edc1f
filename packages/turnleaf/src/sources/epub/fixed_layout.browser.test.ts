/** EPUBs of fixed layout, and single pages of it among flowing text. */

import { describe, expect, test } from "vitest";
import { closeEpubs, colourAt, laidOutEpub } from "../../for_tests/epub_books.ts";
import { prose } from "./tiny_epub.ts";

const never = new AbortController().signal;

closeEpubs();

describe("pages of fixed layout", () => {
  const fixed = (body: string, width = 600, height = 800): string =>
    `<html xmlns="http://www.w3.org/1999/xhtml"><head><title>t</title><meta name="viewport" content="width=${width}, height=${height}"/><style>body { margin: 0 } p { position: absolute; left: 300px; top: 400px; width: 100px; height: 100px; background: #0f0 }</style></head><body>${body}</body></html>`;
  const metadata = '<meta property="rendition:layout">pre-paginated</meta>';

  test("have the sizes that they name, and what stands where", async () => {
    const source = await laidOutEpub({
      chapters: [fixed("<p>A</p>"), fixed("", 1000, 500)],
      metadata,
    });
    expect(source.pageCount).toBe(2);
    expect(source.typeset).toBeUndefined();
    expect(await source.size(0)).toEqual({ width: 600, height: 800 });
    expect(await source.size(1)).toEqual({ width: 1000, height: 500 });
    expect(await colourAt(source, 0, 0.6, 0.6)).toBe("0,255,0");
    expect(await colourAt(source, 0, 0.4, 0.6)).toBe("255,255,255");
    const [run] = (await source.text?.(0, never)) ?? [];
    expect(run?.x).toBeCloseTo(300, 0);
  });

  test.each([
    [
      ...["ltr", { 0: "page-spread-right", 1: "page-spread-right", 2: "page-spread-left" }],
      ["second", "second", "first"],
    ],
    ["ltr", { 0: "rendition:page-spread-left" }, ["first", undefined, undefined]],
    ["rtl", { 0: "page-spread-left", 1: "page-spread-right" }, ["second", "first", undefined]],
    [
      ...["ltr", { 0: "page-spread-center", 1: "rendition:page-spread-center" }],
      ["single", "single", undefined],
    ],
    ["rtl", { 1: "rendition:spread-none" }, [undefined, "single", undefined]],
  ] as [string, Record<number, string>, (string | undefined)[]][])(
    "lie on the side of a spread that they name, or by themselves, read %s: %j",
    async (way, properties, places) => {
      const source = await laidOutEpub({
        chapters: [fixed("<p>one</p>"), fixed("<p>two</p>"), fixed("<p>three</p>")],
        metadata,
        properties,
        spine: `page-progression-direction="${way}"`,
      });
      expect(source.pageCount).toBe(3);
      expect([0, 1, 2].map((index) => source.inSpread?.(index))).toEqual(places);
    },
  );

  test("begin on a side, and flowing text is not shown by itself", async () => {
    const source = await laidOutEpub({
      chapters: [prose(30), prose(1)],
      properties: { 0: "page-spread-left", 1: "page-spread-center" },
    });
    expect([0, 1, source.pageCount - 1].map((index) => source.inSpread?.(index))).toEqual([
      "first",
      undefined,
      undefined,
    ]);
  });

  test("may stand among flowing text", async () => {
    const source = await laidOutEpub({
      chapters: [fixed("<p>A</p>"), prose(10)],
      properties: { 0: "rendition:layout-pre-paginated" },
    });
    expect(await source.size(0)).toEqual({ width: 600, height: 800 });
    expect(await source.size(1)).toEqual({ width: 488, height: 748 });
  });
});
