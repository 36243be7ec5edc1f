import { zipSync } from "fflate";
import { expect, test } from "vitest";
// @ts-expect-error: examples are plain JavaScript
import { PolygonBook } from "../../../../examples/13-polygons.js";
import { expectConformance } from "../for_tests/source_conformance.ts";
import { rar4, rar5, sevenZip } from "../for_tests/stored_archives.ts";
import { tinyFb2 } from "./fb2/tiny_fb2.ts";
import { tinyKf8, tinyMobi } from "./kindle/tiny_kindle.ts";
import { type BookInput, openList, openSource } from "./open.ts";
import type { PageSource } from "./page_source.ts";
import { tinyPdf } from "./tiny_pdf.ts";

const box = { x: 4, y: 4, width: 20, height: 6 };
const manifest = {
  title: "Atlas",
  language: "la",
  direction: "rtl",
  outline: [{ title: "Terra", page: 2 }],
} as const;
const line = "BT /F0 20 Tf 20 250 Td (Call me Ishmael.) Tj ET";
const font = "/Font << /F0 << /Type /Font /Subtype /Type1 /BaseFont /Helvetica >> >>";

async function png(width: number, height: number): Promise<Blob> {
  const canvas = new OffscreenCanvas(width, height);
  canvas.getContext("2d");
  return await canvas.convertToBlob();
}

async function withText(): Promise<BookInput> {
  const text = [{ ...box, text: "Here" }];
  const links = [{ ...box, page: 1 }];
  const first = { src: await png(40, 60), width: 40, height: 60, text, links, label: "iv" };
  return { ...manifest, pages: [first, await png(50, 50)] };
}

async function comic(
  names: readonly string[],
  pack: (files: Record<string, Uint8Array>) => Uint8Array = zipSync,
): Promise<Blob> {
  const files = names.map(async (name, index) => {
    const image = await png(index % 2 ? 80 : 40, 60);
    return [name, new Uint8Array(await image.arrayBuffer())];
  });
  const bytes = pack(Object.fromEntries(await Promise.all(files)));
  return new Blob([bytes as Uint8Array<ArrayBuffer>]);
}

/** Returns elements that are laid out in the document. */
function elements(count: number): HTMLElement[] {
  return Array.from({ length: count }, (_, index) => {
    const page = document.createElement("section");
    page.style.cssText = `width: ${200 + 20 * index}px; height: 300px; overflow: hidden`;
    page.innerHTML = `<h2>Page ${index + 1}</h2><p>Call me Ishmael.</p>`;
    document.body.append(page);
    return page;
  });
}

const svg = '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 30 40"><circle r="9"/></svg>';

const books: readonly [name: string, () => BookInput | Promise<BookInput>][] = [
  ["a PDF", () => tinyPdf({ pages: [line, line, line], resources: font })],
  ["images", async () => [await png(40, 60), await png(90, 30), await png(40, 60)]],
  ["one image", () => png(400, 300)],
  ["an SVG", () => new Blob([svg])],
  ["a manifest", withText],
  ["a comic", async () => comic(["1.png", "2.png", "3.png", "4.png"])],
  ["a comic in RAR 4", async () => comic(["1.png", "2.png", "3.png", "4.png"], rar4)],
  ["a comic in RAR 5", async () => comic(["1.png", "2.png", "3.png", "4.png"], rar5)],
  ["a comic in 7-Zip", async () => comic(["1.png", "2.png", "3.png", "4.png"], sevenZip)],
  ["a MOBI", () => new Blob([tinyMobi({ text: "<h1>One</h1><mbp:pagebreak/><p>Two</p>" })])],
  ["a KF8", () => new Blob([tinyKf8({ text: ["<h1>One</h1>", "<p>Two</p>", "<p>Three</p>"] })])],
  ["a FictionBook", () => new Blob([tinyFb2("<section><p>One</p></section><section/>")])],
  ["elements", async () => elements(3)],
  ["the source of the examples", () => new PolygonBook(60)],
  ["a function that returns a source", () => async () => new PolygonBook(2)],
];

test.each(books)("%s fulfils the contract of a source", async (_, input) => {
  await expectConformance(async () => openSource(await input()));
});

test("a list of pages of several sources fulfils it", async () => {
  await expectConformance(async () => {
    const list = await openList(await withText(), {});
    list.splice(1, 0, await openSource(tinyPdf({ pages: [line], resources: font })));
    list.splice(0, 1, await openSource([await png(20, 20)]));
    return list;
  });
});

test("a source that draws another width than it is asked for does not", async () => {
  const source: PageSource = new PolygonBook(3);
  source.draw = async () => Object.assign(document.createElement("canvas"), { width: 100 });
  await expect(expectConformance(async () => source)).rejects.toThrow("width of draw()");
});
