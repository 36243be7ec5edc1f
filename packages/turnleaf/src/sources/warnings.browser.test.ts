/** What a book lists and cannot be shown: each is a page with a sentence, or an entry of `warnings`. */

import { expect, test } from "vitest";
import { closeBooks, laidOut, wordsOf } from "../for_tests/laid_out_books.ts";
import { tinyEpub } from "./epub/tiny_epub.ts";
import type { PageSource } from "./page_source.ts";

closeBooks();

const listed = (
  source: PageSource,
): (readonly [string, string | undefined, number | undefined])[] =>
  (source.warnings ?? []).map(({ code, source: about, page }) => [code, about, page] as const);

test("says what only a script would draw, and shows what stands there for it", async () => {
  const source = await laidOut(
    tinyEpub({
      chapters: [
        '<script src="first.js"></script><p>Drawn:</p><canvas id="w"></canvas><canvas><p>As a picture</p></canvas>',
        '<div id="scene"></div><script src="lib.js"></script><script src="scene.js"></script><script>start()</script>',
        "<div><b> </b></div><script>start()</script>",
        '<p>Text</p><script src="more.js"></script>',
        '<div></div><script src="scene.js"></script>',
      ],
    }),
  );
  expect(listed(source)).toEqual([
    ["embedded", "OEBPS/c1.xhtml (OEBPS/first.js)", 1],
    ["embedded", "OEBPS/c2.xhtml (OEBPS/scene.js)", 2],
    ["embedded", "OEBPS/c3.xhtml (script)", 3],
    ["embedded", "OEBPS/c5.xhtml (OEBPS/scene.js)", 5],
  ]);
  expect(await wordsOf(source, 0)).toBe("Drawn: As a picture");
});

test("an EPUB's missing and damaged parts of every kind, with their files and pages", async () => {
  const source = await laidOut(
    tinyEpub({
      chapters: [
        '<p style="font-family: Lost; background: url(inline.png)">x</p><p style="page-break-before: always"><img src="gone.png" alt="a"/></p><p><img src="bad.png"/></p>',
        '<link rel="stylesheet" href="none.css"/><audio controls="" src="a/none.mp3"></audio><iframe src="https://example.org/"></iframe><object data="game.bin"></object><p><svg xmlns="http://www.w3.org/2000/svg"><image href="../deep.png"/></svg></p>',
        '<p>See <a epub:type="noteref" href="#n1">1</a>, <a epub:type="noteref" href="#n2">2</a>, <a epub:type="noteref" href="#n3">3</a>.</p><aside epub:type="footnote" id="n1"><p>Here.</p></aside><aside epub:type="footnote" id="n2"><p> <a role="doc-backlink" href="#x"/></p></aside>',
      ],
      css: "@font-face { font-family: Lost; src: url(lost.woff2) } h6 { background: url(back.png) }",
      files: { "bad.png": "no picture" },
      toc: '<li><a href="c1.xhtml">One</a></li><li><a href="nowhere.xhtml">Gone</a></li><li><a href="c2.xhtml#none">Part</a></li><li><span>Heading</span></li>',
      items:
        '<item id="spare" href="spare.jpg" media-type="image/jpeg"/><item id="lost" href="lost.xhtml" media-type="application/xhtml+xml"/>',
      itemrefs: '<itemref idref="lost"/>',
    }),
  );
  expect(listed(source).sort()).toEqual([
    ["chapter", "lost.xhtml", 5],
    ["contents", "“Gone”", undefined],
    ["contents", "“Part”", 3],
    ["embedded", "OEBPS/game.bin", 3],
    ["embedded", "https://example.org/", 3],
    ["font", "Lost", 1],
    ["image", "OEBPS/back.png", 1],
    ["image", "OEBPS/bad.png", 2],
    ["image", "OEBPS/gone.png", 2],
    ["image", "OEBPS/inline.png", 1],
    ["image", "OEBPS/spare.jpg", undefined],
    ["image", "deep.png", 3],
    ["medium", "OEBPS/a/none.mp3", 3],
    ["note", "#n2", 4],
    ["note", "#n3", 4],
    ["style", "OEBPS/none.css", 3],
  ]);
  expect(source.warnings?.find(({ source }) => source === "OEBPS/gone.png")?.message).toBe(
    "OEBPS/gone.png, an image of this book, is missing or cannot be shown.",
  );
});

test("a book whose parts are all there has none, and one of thousands of faults a bounded number", async () => {
  const whole = await laidOut(
    tinyEpub({
      chapters: ['<p>x <img src="p.svg" alt=""/></p>'],
      files: { "p.svg": '<svg xmlns="http://www.w3.org/2000/svg"/>' },
    }),
  );
  expect(whole.warnings).toEqual([]);
  const images = Array.from({ length: 3000 }, (_, k) => `<img src="${k}.png" alt=""/>`).join("");
  const faulty = await laidOut(tinyEpub({ chapters: [images] }));
  expect(faulty.warnings?.length).toBe(200);
});
