/** Contents of EPUBs, however they are written. */

import { expect, test } from "vitest";
import { closeBooks, laidOut } from "../../for_tests/laid_out_books.ts";
import { tinyEpub } from "./tiny_epub.ts";

const never = new AbortController().signal;

closeBooks();

const one = '<a href="c1.xhtml">One</a>';
const two = '<a href="c2.xhtml">Two</a>';

test.each([
  [
    "lists without numbers",
    `<nav epub:type="toc"><ul><li>${one}<ul><li>${two}</li></ul></li></ul></nav>`,
  ],
  [
    "lists and lines within other elements",
    `<nav epub:type="toc"><h1>x</h1><div><ol><li><p>${one}</p><section><ol><li><b>${two}</b></li></ol></section></li></ol></div></nav>`,
  ],
  ["no type", `<nav><ol><li>${one}<ol><li>${two}</li></ol></li></ol></nav>`],
  [
    "another element that has the type",
    `<div epub:type="toc"><ol><li>${one}<ol><li>${two}</li></ol></li></ol></div>`,
  ],
])("%s", async (_, nav) => {
  const page = `<html xmlns="http://www.w3.org/1999/xhtml" xmlns:epub="http://www.idpf.org/2007/ops"><body>${nav}</body></html>`;
  const chapters = ["<p>one</p>", "<p>two</p>"];
  const source = await laidOut(tinyEpub({ chapters, raw: { "OEBPS/nav.xhtml": page } }));
  expect(await source.outline?.(never)).toEqual([
    { title: "One", page: 1, children: [{ title: "Two", page: 2, children: [] }] },
  ]);
});

test("lines that lead nowhere keep their words, and the lines beneath them", async () => {
  const toc = `<li>Part <i>A</i><ol><li><a href="c1.xhtml"><img src="x.png" alt="One"/></a></li></ol></li>`;
  const source = await laidOut(tinyEpub({ chapters: ["<p>one</p>"], toc }));
  expect(await source.outline?.(never)).toEqual([
    { title: "Part A", page: null, children: [{ title: "One", page: 1, children: [] }] },
  ]);
});

test("a line of an NCX that names no place loses none of the others", async () => {
  const point = (label: string, more: string): string =>
    `<navPoint><navLabel><text>${label}</text></navLabel>${more}</navPoint>`;
  const ncx = `<ncx xmlns="http://www.daisy.org/z3986/2005/ncx/"><navMap>${point("Part", point("One", '<content src="c1.xhtml"/>'))}</navMap></ncx>`;
  const opf =
    '<package xmlns="http://www.idpf.org/2007/opf" version="2.0"><metadata/><manifest><item id="a" href="c1.xhtml" media-type="application/xhtml+xml"/><item id="n" href="toc.ncx" media-type="application/x-dtbncx+xml"/></manifest><spine toc="n"><itemref idref="a"/></spine></package>';
  const raw = { "OEBPS/package.opf": opf, "OEBPS/toc.ncx": ncx };
  const source = await laidOut(tinyEpub({ chapters: ["<p>one</p>"], raw }));
  expect(await source.outline?.(never)).toEqual([
    { title: "Part", page: null, children: [{ title: "One", page: 1, children: [] }] },
  ]);
});
