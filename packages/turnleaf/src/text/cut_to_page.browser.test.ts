/** Boxes that a book claims beyond its pages, over an open book. */

import { afterEach, expect, test } from "vitest";
import type { TurnleafBook } from "../element.ts";
import { book, happens, scans, settled } from "../for_tests/element_books.ts";
import { eventually } from "../for_tests/eventually.ts";
import { tinyEpub } from "../sources/epub/tiny_epub.ts";
import { tinyPdf } from "../sources/tiny_pdf.ts";

afterEach(() => document.body.replaceChildren());

const far = { x: -9000, y: -9000, width: 18_000, height: 18_000 };
const web = "https://elsewhere.invalid/";

/** A manifest whose third page of six has boxes far beyond it. */
function manifest(): TurnleafBook["pages"] {
  const pages = scans(6).map(({ src }) => ({ src, width: 90, height: 120 }));
  const hostile = { links: [{ ...far, href: web }], text: [{ ...far, text: "All over" }] };
  return { pages: pages.map((page, k) => (k === 2 ? { ...page, ...hostile } : page)) };
}

/** A PDF of six pages, each with a link and a field far beyond it. */
function pdf(): File {
  const rect = "/Rect [-9000 -9000 9000 9000]";
  const bytes = tinyPdf({
    pages: Array.from({ length: 6 }, () => ""),
    resources: ">> /Annots [10 0 R 11 0 R] /Ignored <<",
    objects: [
      `<< /Type /Annot /Subtype /Link ${rect} /A << /S /URI /URI (${web}) >> >>`,
      `<< /Type /Annot /Subtype /Widget /FT /Tx /T (name) ${rect} >>`,
    ],
    catalog: "/AcroForm << /Fields [11 0 R] >>",
  });
  return new File([bytes], "far.pdf");
}

/** An EPUB of fixed layout, on each page of which a link is three hundred times as large. */
function epub(): Uint8Array<ArrayBuffer> {
  const large = `<p style="margin: 0; font: 1px/1 serif; transform: scale(300); transform-origin: 0 0"><a href="${web}">A link.</a></p>`;
  const viewport = '<meta name="viewport" content="width=400, height=600"/>';
  return tinyEpub({
    chapters: Array.from(
      { length: 6 },
      () =>
        `<html xmlns="http://www.w3.org/1999/xhtml"><head><title>t</title>${viewport}</head><body>${large}</body></html>`,
    ),
    metadata: '<meta property="rendition:layout">pre-paginated</meta>',
  });
}

test.each([
  ["a manifest", manifest],
  ["a PDF", pdf],
  ["an EPUB", epub],
])("links, fields and text of %s lie on their page alone", async (_, pages) => {
  const element = book(null, { cover: "none", page: "3", duration: "0" });
  element.style.cssText = "position: fixed; left: 0; top: 0; width: 640px; height: 460px";
  const loaded = happens(element, "load");
  element.pages = pages();
  await loaded;
  await settled(element);
  const root = element.shadowRoot as ShadowRoot;
  const group = (): HTMLElement | undefined =>
    [...root.querySelectorAll<HTMLElement>(".text [role=group]")].at(-1);
  const laid = (): HTMLElement[] => [
    ...(group()?.querySelectorAll<HTMLElement>("a, span, .field") ?? []),
  ];
  await eventually(() => laid().length).toBeGreaterThan(1);
  const around = element.getBoundingClientRect();
  for (const one of laid()) {
    const { left, right, top, bottom } = one.getBoundingClientRect();
    // The third page is the right one of two.
    expect(left).toBeGreaterThan(around.left + around.width / 2 - 2);
    expect(right).toBeLessThan(around.right);
    expect(top).toBeGreaterThan(around.top);
    expect(bottom).toBeLessThan(around.bottom);
  }
});
