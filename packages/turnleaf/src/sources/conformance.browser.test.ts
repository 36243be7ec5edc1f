import { expect, test } from "vitest";
// @ts-expect-error: examples are plain JavaScript
import { PolygonBook } from "../../../../examples/13-polygons.js";
import { png, sampleBooks } from "../for_tests/format_samples.ts";
import { expectConformance } from "../for_tests/source_conformance.ts";
import { fileIn } from "./book_file.ts";
import { formats, sniff } from "./formats.ts";
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

const image = async (width: number, height: number) => new Blob([await png(width, height)]);

async function withText(): Promise<BookInput> {
  const text = [{ ...box, text: "Here" }];
  const links = [{ ...box, page: 1 }];
  const first = { src: await image(40, 60), width: 40, height: 60, text, links, label: "iv" };
  return { ...manifest, pages: [first, await image(50, 50)] };
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

const inputs: readonly [name: string, () => BookInput | Promise<BookInput>][] = [
  ["images", async () => [await image(40, 60), await image(90, 30), await image(40, 60)]],
  ["a manifest with text", withText],
  ["elements", async () => elements(3)],
  ["the source of the examples", () => new PolygonBook(60)],
  ["a function that returns a source", () => async () => new PolygonBook(2)],
];

test.each(inputs)("%s fulfils the contract of a source", async (_, input) => {
  await expectConformance(async () => openSource(await input()));
});

test.each(sampleBooks)(
  "%s is found to be of kind %s, and fulfils the contract",
  async (_, kind, make) => {
    const file = new Blob([await make()]);
    const isInZip = !formats.some((format) => format.kind === kind && format.is);
    expect(sniff(await fileIn(file, "a book"))).toBe(isInZip ? "zip" : kind);
    await expectConformance(() => openSource(file));
  },
);

test("a list of pages of several sources fulfils it", async () => {
  await expectConformance(async () => {
    const list = await openList(await withText(), {});
    list.splice(1, 0, await openSource(tinyPdf({ pages: [line], resources: font })));
    list.splice(0, 1, await openSource([await image(20, 20)]));
    return list;
  });
});

test("a source that draws another width than it is asked for does not", async () => {
  const source: PageSource = new PolygonBook(3);
  source.draw = async () => Object.assign(document.createElement("canvas"), { width: 100 });
  await expect(expectConformance(async () => source)).rejects.toThrow("width of draw()");
});
