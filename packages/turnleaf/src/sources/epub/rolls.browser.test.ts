/** EPUBs that ask to be scrolled: which pages hang together, and what is on them. */

import { expect, test } from "vitest";
import { expectConformance } from "../../for_tests/source_conformance.ts";
import { openSource } from "../open.ts";
import type { PageSource } from "../page_source.ts";
import { prose, type TinyEpub, tinyEpub } from "./tiny_epub.ts";

const never = new AbortController().signal;

/** Returns a source all of whose pages are known. */
async function laidOut(epub: TinyEpub): Promise<PageSource> {
  const source = await openSource(tinyEpub(epub));
  await source.settle?.();
  return source;
}

/** Returns a chapter of fixed layout, all red. */
const fixed = (width: number, height: number): string =>
  `<html xmlns="http://www.w3.org/1999/xhtml"><head><title>t</title><meta name="viewport" content="width=${width}, height=${height}"/><style>body { margin: 0; background: #f00 }</style></head><body></body></html>`;

/** Returns a page as it is drawn, one pixel for each of its unit. */
async function drawn(source: PageSource, index: number): Promise<OffscreenCanvas> {
  const { width, height } = await source.size(index);
  const canvas = new OffscreenCanvas(width, height);
  const picture = await source.draw(index, width, never);
  canvas.getContext("2d")?.drawImage(picture, 0, 0);
  return canvas;
}

const colourAt = (canvas: OffscreenCanvas, x: number, y: number): string =>
  [...(canvas.getContext("2d")?.getImageData(x, y, 1, 1).data ?? [])].slice(0, 3).join();

test("an EPUB that is scrolled fulfils the contract of a source", async () => {
  const chapters = [prose(20), prose(3)];
  const metadata = '<meta property="rendition:flow">scrolled-continuous</meta>';
  await expectConformance(() => openSource(tinyEpub({ chapters, metadata })));
});

test("chapters are scrolled where they ask for it: in parts, or in one roll; fixed layout is turned", async () => {
  const rolls = async (flow: string, properties: Record<number, string> = {}) => {
    const source = await laidOut({
      chapters: [prose(12), fixed(600, 800), prose(1), prose(1)],
      properties: { 1: "rendition:layout-pre-paginated", ...properties },
      metadata: `<meta property="rendition:flow">${flow}</meta>`,
    });
    const found = Array.from({ length: source.pageCount }, (_, k) => source.roll?.(k));
    const places = found.map((_, k) => source.inSpread?.(k));
    expect(places).toEqual(found.map((roll) => (typeof roll === "number" ? "single" : undefined)));
    source.close();
    return found.filter((roll, k) => k === 0 || roll !== found[k - 1]);
  };
  expect(await rolls("paginated")).toEqual([undefined]);
  expect(await rolls("scrolled-doc")).toEqual([0, null, 1, 2]);
  expect(await rolls("scrolled-continuous")).toEqual([0, null, 1]);
  const own = { 2: "rendition:flow-scrolled-doc", 3: "rendition:flow-paginated" };
  expect(await rolls("auto", own)).toEqual([null, 0, null]);
});

test("a chapter is cut into pages anywhere: what is cut goes on, and every word is on one page", async () => {
  const band = '<div style="height: 1700px; background: #0f0"></div>';
  const source = await laidOut({
    chapters: [band + prose(12)],
    metadata: '<meta property="rendition:flow">scrolled-doc</meta>',
  });
  expect(source.pageCount).toBeGreaterThan(3);
  const words: string[] = [];
  let green = 0;
  for (let index = 0; index < source.pageCount; index++) {
    const runs = (await source.text?.(index, never)) ?? [];
    const text = runs.map((run) => run.text + (run.end ? " " : "")).join("");
    words.push(...text.split(/\W+/).filter(Boolean));
    const { width, height } = await source.size(index);
    expect([width, Math.abs(height - 748) < 374]).toEqual([488, true]);
    const canvas = await drawn(source, index);
    for (let y = 0; y < canvas.height; y++) {
      if (colourAt(canvas, 244, y) === "0,255,0") green += 1;
    }
  }
  expect(green).toBe(1700);
  const all = Array.from({ length: 12 * 60 }, (_, k) => `word${Math.floor(k / 60)}x${k % 60}`);
  expect(words).toEqual(all);
  const sizes = new Set<number>();
  for (let k = 0; k < source.pageCount; k++) sizes.add((await source.size(k)).height);
  expect(sizes.size).toBe(1);
  source.close();
});

test("upright lines stay on pages of their own, one beneath the other", async () => {
  const source = await laidOut({
    chapters: [prose(12)],
    css: "html { writing-mode: vertical-rl }",
    metadata: '<meta property="rendition:flow">scrolled-continuous</meta>',
  });
  expect(source.pageCount).toBeGreaterThan(1);
  expect(await source.size(1)).toEqual({ width: 488, height: 748 });
  expect(source.roll?.(1)).toBe(0);
  source.close();
});

test("of layout roll all is one roll, and a picture is a page as large as itself", async () => {
  const canvas = new OffscreenCanvas(200, 900);
  const pen = canvas.getContext("2d") as OffscreenCanvasRenderingContext2D;
  pen.fillStyle = "#0f0";
  pen.fillRect(0, 0, 200, 900);
  const source = await laidOut({
    chapters: [fixed(400, 300)],
    // A roll has no layouts of its chapters' own.
    properties: { 0: "rendition:layout-reflowable page-spread-left" },
    metadata: '<meta property="rendition:layout">roll</meta>',
    raw: { "OEBPS/b.png": new Uint8Array(await (await canvas.convertToBlob()).arrayBuffer()) },
    items: '<item id="b" href="b.png" media-type="image/png"/>',
    itemrefs: '<itemref idref="b"/>',
  });
  expect([0, 1].map((index) => source.roll?.(index))).toEqual([0, 0]);
  expect(await source.size(0)).toEqual({ width: 400, height: 300 });
  expect(await source.size(1)).toEqual({ width: 200, height: 900 });
  const page = await drawn(source, 1);
  expect([colourAt(page, 0, 0), colourAt(page, 199, 899)]).toEqual(["0,255,0", "0,255,0"]);
  expect(colourAt(await drawn(source, 0), 399, 299)).toBe("255,0,0");
  source.close();
});
