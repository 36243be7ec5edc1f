/** Notes, stamps and forms of PDFs that say how they look only by what they are. */

import { afterEach, expect, test } from "vitest";
import { openSource } from "./open.ts";
import type { PageSource } from "./page_source.ts";
import { type TinyPdf, tinyPdf } from "./tiny_pdf.ts";

const never = new AbortController().signal;
const opened: PageSource[] = [];

afterEach(() => {
  for (const source of opened.splice(0)) source.close();
});

async function open(pdf: TinyPdf): Promise<PageSource> {
  const source = await openSource(new File([tinyPdf(pdf)], "book.pdf"));
  opened.push(source);
  return source;
}

const annotated = (objects: readonly string[], more: Partial<TinyPdf> = {}): TinyPdf => ({
  pages: [""],
  resources: `>> /Annots [${objects.map((_, k) => `${10 + k} 0 R`).join(" ")}] /Ignored <<`,
  objects: objects.map((one) => `<< /Type /Annot ${one} >>`),
  ...more,
});

/** Returns how much of a box of a page (points from its upper left corner) is ink. */
async function inkIn(source: PageSource, x: number, y: number, width: number, height: number) {
  const picture = await source.draw(0, 400, never);
  const pen = new OffscreenCanvas(picture.width, picture.height).getContext("2d")!;
  pen.drawImage(picture, 0, 0);
  const { data } = pen.getImageData(2 * x, 2 * y, 2 * width, 2 * height);
  let ink = 0;
  for (let k = 0; k < data.length; k += 4) {
    if (Math.min(data[k] ?? 255, data[k + 1] ?? 255, data[k + 2] ?? 255) < 200) ink++;
  }
  return ink / (data.length / 4);
}

test("notes and stamps without an appearance are drawn where they stand, and their text is read there", async () => {
  const source = await open(
    annotated([
      "/Subtype /Text /Rect [20 250 40 270] /Contents (Look here.) /T (Ahab)",
      "/Subtype /Text /Rect [20 250 40 270] /Contents (I did.) /IRT 10 0 R",
      "/Subtype /Stamp /Rect [100 100 180 140] /Contents (PAID)",
      "/Subtype /Stamp /Rect [100 20 180 60] /F 2 /Contents (HIDDEN)",
    ]),
  );
  expect(await inkIn(source, 20, 30, 22, 22)).toBeGreaterThan(0.3);
  expect(await inkIn(source, 100, 160, 80, 40)).toBeGreaterThan(0.1);
  expect(await inkIn(source, 100, 240, 80, 40)).toBe(0);
  expect(await source.links?.(0, never)).toEqual([
    {
      x: 20,
      y: 30,
      width: 22,
      height: 22,
      title: "Ahab",
      to: { page: 1 },
      note: "Look here.\nI did.",
    },
    { x: 100, y: 160, width: 80, height: 40, title: "", to: { page: 1 }, note: "PAID" },
  ]);
});

test("text upon a page that has no appearance is broken within its box, and is there if it has styles alone", async () => {
  const style = "/DA (/Helv 12 Tf 1 0 0 rg)";
  const long =
    "A long text of a comment that has to be broken into several lines as the box is not as wide as it";
  const rich = '<body xmlns="http://www.w3.org/1999/xhtml"><p>Rich <b>only</b></p></body>';
  const source = await open(
    annotated([
      `/Subtype /FreeText /Rect [10 250 190 290] /Contents (${long}) ${style}`,
      `/Subtype /FreeText /Rect [10 200 90 240] /RC (${rich}) ${style}`,
    ]),
  );
  // In each third of the height of the box is a line.
  for (const y of [10, 23, 37]) expect(await inkIn(source, 10, y, 100, 12)).toBeGreaterThan(0.05);
  expect(await inkIn(source, 10, 60, 60, 20)).toBeGreaterThan(0.03);
});

test("frames of a page that have no appearance are drawn, unless their width is 0", async () => {
  const frame = (kind: string, x: number, more: string): string =>
    `/Subtype /${kind} /Rect [${x} 100 ${x + 40} 130] /C [1 0 0] ${more}`;
  const source = await open(
    annotated([
      frame("Square", 10, ""),
      frame("Circle", 60, ""),
      frame("Square", 110, "/BS << /W 0 >>"),
    ]),
  );
  expect(await inkIn(source, 10, 170, 40, 30)).toBeGreaterThan(0.05);
  expect(await inkIn(source, 60, 170, 40, 30)).toBeGreaterThan(0.05);
  expect(await inkIn(source, 110, 170, 40, 30)).toBe(0);
});

test("what a page of a PDF would play, and lines of its contents that lead nowhere, are listed", async () => {
  const source = await open(
    annotated(["/Subtype /Movie /Rect [20 20 90 90] /Contents (Whale)"], {
      catalog: "/Outlines << /First 11 0 R /Last 11 0 R /Count 1 >>",
      objects: [
        "<< /Type /Annot /Subtype /Movie /Rect [20 20 90 90] /Contents (Whale) >>",
        "<< /Title (Lost) /Dest [9 /Fit] >>",
      ],
    }),
  );
  expect(source.warnings).toEqual([]);
  await source.links?.(0, never);
  await source.outline?.(never);
  expect(source.warnings?.map(({ code, source: about, page }) => [code, about, page])).toEqual([
    ["medium", "Whale", 1],
    ["contents", "“Lost”", undefined],
  ]);
});

test("a form of XFA alone says what it is; one with fields of its own is shown", async () => {
  const xfa = "/XFA [(template) 10 0 R]";
  const template = "<< /Length 3 >>\nstream\n<x>\nendstream";
  await expect(
    open({
      pages: [""],
      catalog: `/NeedsRendering true /AcroForm << /Fields [] ${xfa} >>`,
      objects: [template],
    }),
  ).rejects.toThrow("book.pdf is a form of XFA, whose pages only Adobe's programs make");
  const field = "<< /Type /Annot /Subtype /Widget /FT /Tx /T (a) /Rect [10 10 50 30] >>";
  const both = await open({
    pages: [""],
    catalog: `/AcroForm << /Fields [11 0 R] ${xfa} >>`,
    objects: [template, field],
  });
  expect(both.pageCount).toBe(1);
});
