/** What is drawn of a page is what was laid out: ink stands where its words are, and nowhere else. */

import { expect, test } from "vitest";
import { closeBooks, laidOut, pagesOf } from "../../for_tests/laid_out_books.ts";
import type { PageSource } from "../page_source.ts";
import { prose, type TinyEpub, tinyEpub } from "./tiny_epub.ts";

const never = new AbortController().signal;

closeBooks();

const laidOutEpub = (epub: TinyEpub): Promise<PageSource> => laidOut(tinyEpub(epub));
const letters = (text: string): string => text.replace(/\s+/g, "");

/** Returns whether a place is that of the running head or of the number of a page of a paperback's size. */
function isInMargins(x: number, y: number): boolean {
  return Math.abs(x - 244) < 60 && ((y >= 26 && y < 42) || (y >= 708 && y < 725));
}

/**
 * Expects every word in its place: under each is ink, and none is anywhere else but what stands in the margins.
 *
 * @param isApart whether ink at a place of a page (from 0) is no word's
 */
async function expectDrawnAsLaid(
  source: PageSource,
  isApart = (_page: number, _x: number) => false,
): Promise<void> {
  const { width, height } = await source.size(0);
  for (let index = 0; index < source.pageCount; index++) {
    const picture = (await source.draw(index, Math.round(width), never)) as ImageBitmap;
    const pen = new OffscreenCanvas(picture.width, picture.height).getContext("2d")!;
    pen.drawImage(picture, 0, 0);
    const { data } = pen.getImageData(0, 0, picture.width, picture.height);
    // 1 where there is ink; dense and of one type, as a picture has half a million pixels.
    const inked = new Uint8Array(picture.width * picture.height);
    for (let k = 0; k < inked.length; k++) {
      // Most is paper.
      if ((data[4 * k] as number) >= 128) continue;
      const x = k % picture.width;
      const isWord = !isInMargins(x, Math.floor(k / picture.width)) && !isApart(index, x);
      if (isWord) inked[k] = 1;
    }
    const runs = (await source.text?.(index, never)) ?? [];
    for (const run of runs) {
      const where = `"${run.text}" on page ${index + 1}`;
      expect(run.x >= 0 && run.x + run.width <= width + 1, where).toBe(true);
      expect(run.y >= 0 && run.y + run.height <= height + 1, where).toBe(true);
      let ink = 0;
      const left = Math.max(Math.floor(run.x) - 2, 0);
      const right = Math.min(Math.floor(run.x + run.width) + 3, picture.width);
      const bottom = Math.min(Math.floor(run.y + run.height) + 2, picture.height);
      for (let y = Math.max(Math.floor(run.y) - 1, 0); y < bottom; y++) {
        const row = inked.subarray(y * picture.width + left, y * picture.width + right);
        for (const one of row) ink += one;
        row.fill(0);
      }
      if (/[a-z]/i.test(run.text)) expect(ink, where).toBeGreaterThan(0);
    }
    expect(inked.includes(1), `ink beside the words of page ${index + 1}`).toBe(false);
  }
}

const document = (head: string, body: string): string =>
  `<?xml version="1.0"?><html xmlns="http://www.w3.org/1999/xhtml" xmlns:epub="http://www.idpf.org/2007/ops"><head><title>t</title>${head}</head><body>${body}</body></html>`;

test("rules by namespace hold in every sheet of a chapter, as laid out so as drawn", async () => {
  const namespace = '@namespace epub "http://www.idpf.org/2007/ops";';
  const files = {
    "one.css": `@charset "utf-8"; @import url("three.css") screen; @import "four.css" print; ${namespace} [epub|type~="a"] { margin-left: 200px }`,
    "two.css": `@namespace e url(http://www.idpf.org/2007/ops); @layer low { [e|type~="b"] { font-size: 30px } }`,
    "three.css": `${namespace} [epub|type~="c"] { text-transform: uppercase }`,
    "four.css": `p { display: none }`,
  };
  const head = Object.keys(files)
    .slice(0, 2)
    .map((name) => `<link rel="stylesheet" href="${name}" media="all"/>`)
    .join("");
  const off = '<link rel="stylesheet" disabled="" href="four.css"/>';
  const body = `<p epub:type="a">moved</p><p epub:type="b">large</p><p epub:type="c">capital</p>${prose(12, 40)}`;
  const source = await laidOutEpub({ chapters: [document(head + off, body)], files });
  const runs = (await source.text?.(0, never)) ?? [];
  const [moved, large, capital] = runs;
  expect(moved?.x).toBeGreaterThan(220);
  expect(large?.height).toBeGreaterThan(28);
  expect(capital?.width).toBeGreaterThan(62);
  await expectDrawnAsLaid(source);
});

test("a drawing without a viewBox that is larger than a page is smaller, and nothing of it is cut", async () => {
  const drawing = (size: string, x: number, y: number, word: string): string =>
    `<svg xmlns="http://www.w3.org/2000/svg" ${size}><text x="${x}" y="${y}" font-size="60">${word}</text></svg>`;
  const source = await laidOutEpub({
    chapters: [
      `<p>A</p>${drawing('width="1000" height="200"', 700, 100, "far")}<p>B</p>`,
      `<p>C</p>${drawing('width="300" height="2000"', 10, 1900, "low")}<p>D</p>`,
      `<p>E</p>${drawing('style="width: 900px; height: 100px"', 700, 60, "set")}${drawing('width="100%" height="100"', 10, 60, "own")}`,
    ],
  });
  const pages = await pagesOf(source);
  const words = pages.join(" ");
  for (const word of ["far", "low", "set", "own"]) expect(words).toContain(word);
  const runs = await Promise.all(pages.map((_, k) => source.text?.(k, never) ?? []));
  const own = runs.flat().find(({ text }) => text === "own");
  // What has room stays as large as it is.
  expect(own?.height).toBeGreaterThan(55);
  await expectDrawnAsLaid(source);
});

test("a table beside a float that ends before it leaves no page empty", async () => {
  const float = `<div style="float: left; width: 50%">${prose(3)}</div>`;
  const source = await laidOutEpub({
    chapters: [
      `${float}<table><tr><td>${prose(12)}</td><td>${prose(3)}</td></tr></table><p>end</p>`,
    ],
  });
  const pages = await pagesOf(source);
  expect(pages.filter((text) => letters(text) === "")).toEqual([]);
  expect(pages.at(-1)).toContain("end");
});

test.each([
  ["a float of most of a line", '<div style="float: left; width: 88%">side</div>'],
  ["a picture of most of a line", '<svg style="float: left" width="320" height="60"></svg>'],
  ["a box of no width", '<div style="width: 0">considerable words</div>'],
])("words are whole beside %s, or in it", async (_, box) => {
  const word = "incomprehensibilities";
  const source = await laidOutEpub({
    chapters: [`${box}<p>${`${word} `.repeat(20)}</p><div>${word}<b>${word}</b> ${word}</div>`],
  });
  const lines = (await source.text?.(0, never)) ?? [];
  const words = lines.flatMap(({ text }) => text.trim().split(" "));
  const all = new Set(["side", "considerable", "words", word, word + word]);
  expect(words.filter((one) => !all.has(one))).toEqual([]);
  await expectDrawnAsLaid(source);
});

test.each(["display: grid; grid-template-columns: 200px 1fr", "display: flex"])(
  "items of which a float would leave no room for lie on nothing: %s",
  async (style) => {
    const float = `<div style="float: right; width: 60%">${prose(3)}</div>`;
    const items = `<div style="min-width: 200px">${prose(9)}</div><div style="min-width: 60px">${prose(2)}</div>`;
    const source = await laidOutEpub({
      chapters: [`${float}<p>beside</p><div style="${style}">${items}</div><p>end</p>`],
    });
    for (let page = 0; page < source.pageCount; page++) {
      const lines = (await source.text?.(page, never)) ?? [];
      for (const [k, line] of lines.entries()) {
        const upon = lines
          .slice(k + 1)
          .find(
            (other) =>
              Math.min(line.x + line.width, other.x + other.width) - Math.max(line.x, other.x) >
                1 && Math.abs(line.y - other.y) < 8,
          );
        expect(upon?.text, `${line.text} on page ${page + 1}`).toBe(undefined);
      }
    }
    await expectDrawnAsLaid(source);
  },
);

test.each([
  [
    "a cell over many rows",
    `<table><tr><td rowspan="60">side</td><td>one</td></tr>${"<tr><td>row</td></tr>".repeat(59)}</table>`,
  ],
  [
    "an item beside many pages",
    `<div style="display: flex"><p style="flex: 1; margin: 0">${"word ".repeat(500)}</p><p style="flex: 1; margin: 0; padding: 10px">side</p></div>`,
  ],
  [
    "an item over many rows",
    `<div style="display: grid; grid-template-columns: 1fr 1fr"><p style="grid-row: span 60; padding: 10px">side</p>${"<div>row</div>".repeat(60)}</div>`,
  ],
])("%s ends no page beside its own rows", async (_, rows) => {
  const source = await laidOutEpub({ chapters: [`${rows}<p>end</p>`] });
  const pages = await pagesOf(source);
  expect(pages.length).toBeLessThan(5);
  expect(pages.filter((text) => letters(text) === "")).toEqual([]);
  // Its last words stand on the last page of the rows.
  expect(letters(pages.at(-1) ?? "")).toMatch(/(?:row|word|one)end$/);
  await expectDrawnAsLaid(source);
});

test("rules of scopes, containers, properties and animations hold, as laid out so as drawn", async () => {
  const css = `@property --wide { syntax: "<length>"; inherits: false; initial-value: 200px }
    @keyframes come { from { opacity: 0 } to { opacity: 1 } }
    @keyframes slide { from { margin-left: 0 } to { margin-left: 200px } }
    @scope (.outer) to (.inner) { p { margin-left: 200px } }
    @container box (min-width: 100px) { .boxed { margin-left: 200px } }
    @container (min-width: 9000px) { p { display: none } }
    .box { container: box / inline-size }
    .typed { margin-left: var(--wide) }
    .coming { opacity: 0; animation: come 1s 1s forwards }
    .sliding { animation: slide 3s infinite both }
    .coming::before { content: "and"; opacity: 0; animation: come 1s both }`;
  const source = await laidOutEpub({
    chapters: [
      `<div class="outer"><p>scoped</p><div class="inner"><p>beyond</p></div></div><div class="box"><p class="boxed">boxed</p></div><p class="typed">typed</p><p class="coming">coming</p><p class="sliding">sliding</p>`,
    ],
    css,
  });
  const runs = (await source.text?.(0, never)) ?? [];
  const moved = runs.filter(({ x }) => x > 240).map(({ text }) => text.trim());
  expect(moved).toEqual(["scoped", "boxed", "typed", "sliding"]);
  expect(letters(runs.map(({ text }) => text).join(""))).toContain("coming");
  await expectDrawnAsLaid(source, (_page, x) => x < 90);
});

test.each([
  ["page-break-before: always", 2],
  ["break-before: page", 2],
  ["break-before: left", 2],
  ["break-before: recto", 2],
  ["page-break-after: right", 2],
  ["break-after: always", 2],
  ["-webkit-column-break-before: always", 2],
  ["--new: recto; break-before: var(--new)", 2],
  ["break-before: var(--none, page)", 2],
  ["--new: always; page-break-before: var(--new)", 2],
  ["--new: avoid; break-before: var(--new)", 1],
  ["break-before: auto", 1],
])("%s begins a page, in a sheet and in an element's own style", async (rule, pages) => {
  const body = (own: string): string => `<h1>one</h1><h2 ${own}>two</h2>`;
  const after = /after/.test(rule) ? "<p>three</p>" : "";
  const source = await laidOutEpub({
    chapters: [body("") + after, `${body(`style="${rule}"`)}${after}`],
    css: `.never {} h2 { ${rule} }`,
  });
  expect(source.pageCount).toBe(2 * pages);
  await expectDrawnAsLaid(source);
});

test.each([
  ["the break of a line", (rule: string) => `<p>one</p><br style="${rule}"/><p>two</p>`],
  ["that of Word", (rule: string) => `<p>one<span><br style="${rule}"/></span>two</p>`],
  [
    "a drawing",
    (rule: string) =>
      `<p>one</p><svg xmlns="http://www.w3.org/2000/svg" style="${rule}" viewBox="0 0 9 9" width="9"></svg><p>two</p>`,
  ],
  [
    "a box in one that does not break",
    (rule: string) => `<div class="box"><p>one</p><p style="${rule}">two</p></div>`,
  ],
])("a page is begun at %s", async (_, made) => {
  for (const box of ["display: inline-block", "overflow: hidden", "position: absolute"]) {
    const source = await laidOutEpub({
      chapters: [made("page-break-before: always")],
      css: `.box { ${box} }`,
    });
    expect((await pagesOf(source)).map(letters)).toEqual(["one", "two"]);
  }
});

test.each([
  [
    "a box as high as the view, and its padding",
    '<div class="high">one</div><div class="high">two</div>',
  ],
  ["a box of any height", '<p>one</p><div style="height: 5000px"></div><p>two</p>'],
  ["a box of at least some height", '<div style="min-height: 5000px">one</div><p>two</p>'],
  ...[
    "padding-top",
    "padding-bottom",
    "margin-top",
    "border-top: solid transparent; border-top-width",
  ].map((name) => [
    `${name} of pages`,
    /bottom/.test(name)
      ? `<p style="${name}: 3000px">one</p><p>two</p>`
      : `<p>one</p><p style="${name}: 3000px">two</p>`,
  ]),
  ["room in per cent of the line", '<p>one</p><p style="padding-top: 500%">two</p>'],
  ["room in a cell", '<p>one</p><table><td style="padding-top: 3000px">two</td></table>'],
  ["room between rows", '<p>one</p><table style="border-spacing: 0 3000px"><td>two</td></table>'],
  ["room in a line", '<p>one <b style="display: inline-block; padding: 3000px 0 0">two</b></p>'],
  [
    "room in room",
    '<div style="padding-top: 400px"><p style="padding-top: 400px">one</p></div><p class="new">two</p>',
  ],
  ["what a style sheet puts before a box", '<p>one</p><p class="far">two</p>'],
  [
    "a picture under a margin",
    `<p>one</p><figure style="break-before: page"><svg xmlns="http://www.w3.org/2000/svg" width="300" height="900"><rect width="300" height="900"/></svg></figure><p>two</p>`,
  ],
])("no page is empty because of %s", async (_, body) => {
  const css = `.high { min-height: 100vh; margin: 0; padding: 20px } .new { break-before: page }
    .far::before { content: ""; display: block; height: 3000px }`;
  const source = await laidOutEpub({ chapters: [body], css });
  const pages = (await pagesOf(source)).map(letters);
  expect(pages).toEqual(body.includes("<svg") ? ["one", "", "two"] : ["one", "two"]);
});

test.each([
  [
    "for screen readers alone",
    "position: absolute; width: 1px; height: 1px; overflow: hidden; clip: rect(0, 0, 0, 0); margin: -1px; white-space: nowrap",
  ],
  ["by a clip", "position: absolute; clip: rect(1px, 1px, 1px, 1px)"],
  ["by a path", "clip-path: inset(50%)"],
  ["by no height", "height: 0; overflow: hidden"],
  ["before the page", "position: absolute; left: -9999px"],
  ["above the page", "position: absolute; top: -9999px; white-space: nowrap"],
  ["from layout", "content-visibility: hidden"],
  [
    "before lines that run to the left",
    "position: absolute; right: -9999px; font-size: 2em",
    "rtl",
  ],
])("words that are hidden %s are on no page", async (_, style, direction = "ltr") => {
  // Fewer than fill a line, and more.
  for (const hidden of ["not", "not one of them ".repeat(8)]) {
    const body = `${prose(2)}<h2 style="page-break-before: always">seen</h2><p style="${style}">${hidden}</p>`;
    const source = await laidOutEpub({
      chapters: [document("", body).replace("<html", `<html dir="${direction}"`)],
    });
    expect((await pagesOf(source)).map(letters).at(-1), hidden).toBe("seen");
    await expectDrawnAsLaid(source);
  }
});

test.each([
  ["", "p { margin-left: 60px } .z::before { content: ']]>' }"],
  ["", "a:link { padding-left: 60px } a:any-link { font-size: 30px } a:visited { display: none }"],
  ["<style type='text/x-other'>p { display: none }</style>", ""],
  [
    "<style title='one'>p { margin-left: 60px }</style><style title='two'>p { display: none }</style>",
    "",
  ],
])("what holds where a chapter is laid out holds where it is drawn: %s %s", async (head, css) => {
  const style = `<style><![CDATA[${css.replace("]]>", "]]]]><![CDATA[>")}]]></style>`;
  const body = '<p><a href="#x" id="x">words</a></p>';
  const source = await laidOutEpub({ chapters: [document(head + style, body)] });
  expect((await pagesOf(source)).map(letters)).toEqual(["words"]);
  await expectDrawnAsLaid(source);
});

test("a letter after a hyphen is on its own line", async () => {
  const source = await laidOutEpub({
    chapters: [`<p>${"extra\u00adordi\u00adnarily ".repeat(30)}</p>`],
    css: "p { text-align: justify }",
  });
  const runs = (await source.text?.(0, never)) ?? [];
  const broken = runs.filter(({ text }) => text.endsWith("\u00ad"));
  expect(broken.length).toBeGreaterThan(2);
  for (const { text } of broken) expect(text).toMatch(/(extra|ordi)\u00ad$/);
  await expectDrawnAsLaid(source);
});

test.each([
  "initial-letter: 3",
  "initial-letter: 2.5 1",
  "-webkit-initial-letter: 3",
  "float: left; font-size: 60px; line-height: 50px",
])("a first letter over several lines is where it is drawn: %s", async (rule) => {
  const source = await laidOutEpub({
    chapters: [`<p>“Words ${"in a paragraph ".repeat(30)}</p><p>after</p>`],
    css: `p:first-child::first-letter { ${rule} }`,
  });
  const [letter, next, second] = (await source.text?.(0, never)) ?? [];
  expect([letter?.text, letter?.end]).toEqual(["“W", false]);
  expect(next?.text).toMatch(/^ords/);
  expect(letter?.height).toBeGreaterThan(50);
  // The line beside it and those beneath that begin after it.
  expect(second?.x).toBeGreaterThanOrEqual(rule.includes("2.5 1") ? 53 : (next?.x ?? 0) - 1);
  await expectDrawnAsLaid(source);
});

test("a mark over a letter of another element is text with it", async () => {
  const source = await laidOutEpub({
    chapters: ["<p>a <b>b</b><i>\u0303moon</i> e\u0301 n<span>\u0303</span>o</p>"],
  });
  expect((await pagesOf(source)).map(letters)).toEqual(["ab\u0303moone\u0301n\u0303o"]);
});

test("words of the controls of forms are text, where they are drawn, and no others", async () => {
  const source = await laidOutEpub({
    chapters: [
      `<p>a <input value="value"/> <textarea rows="2" style="height: 2em">${"some words\n".repeat(6)}</textarea>
      <select><option>first</option><option selected="">second</option></select> <button>push</button>
      <input type="submit" value="send"/> <input placeholder="place"/> <input type="checkbox" value="box"/>
      <input type="hidden" value="hidden"/> <input type="password" value="secret"/> <input/></p>`,
    ],
    css: "p :not(option) { border: 0; background: none } [type=checkbox], [type=password] { opacity: 0 }",
  });
  expect(letters((await pagesOf(source)).join(""))).toBe(
    `avalue${"somewords".repeat(6)}secondpushsendplace`,
  );
  await expectDrawnAsLaid(source);
});

test("what waits to be found is there, as nothing on paper finds it", async () => {
  const source = await laidOutEpub({
    chapters: ['<p>before</p><div hidden="until-found">found</div><p hidden="">hidden</p>'],
  });
  expect((await pagesOf(source)).map(letters)).toEqual(["beforefound"]);
  await expectDrawnAsLaid(source);
});

test.each([
  ["words", `<mtext>${"long words of a formula ".repeat(8)}</mtext>`],
  [
    "a table",
    `<mtable>${`<mtr><mtd>${"<mi>a</mi><mo>+</mo>".repeat(30)}</mtd><mtd>${"<mi>b</mi><mo>=</mo>".repeat(30)}</mtd></mtr><mtr><mtd><mi>c</mi></mtd></mtr>`.repeat(2)}</mtable>`,
  ],
  [
    "a table in rows",
    `<mi>x</mi><mo>=</mo><mrow><mtable><mtr><mtd><mtext>${"if it is so and ".repeat(12)}</mtext></mtd></mtr></mtable></mrow>`,
  ],
])("a formula with %s wider than a line is broken within", async (_, parts) => {
  const source = await laidOutEpub({
    chapters: [
      `<p>before</p><math xmlns="http://www.w3.org/1998/Math/MathML" display="block">${parts}</math><p>after</p>`,
    ],
  });
  const runs = (await source.text?.(0, never)) ?? [];
  const { width } = await source.size(0);
  const formula = runs.find(({ math }) => math);
  expect((formula?.x ?? width) + (formula?.width ?? 0)).toBeLessThan(width);
  expect(formula?.height).toBeGreaterThan(20);
  await expectDrawnAsLaid(source);
});

test.each([20, 80])(
  "a formula of %d terms, wider than a line, is smaller, or broken",
  async (terms) => {
    const sum = `<math xmlns="http://www.w3.org/1998/Math/MathML" display="block"><mrow>${"<mi>a</mi><mo>+</mo>".repeat(terms)}</mrow></math>`;
    for (const chapter of [
      `<p>before</p>${sum}<p>after</p>`,
      // What is around it goes on from page to page, or is as wide as its text.
      `${prose(8)}${sum}${prose(8)}`,
      `<div>${prose(8)}<p><span><b>${sum}</b></span></p>${prose(8)}</div>`,
    ]) {
      const source = await laidOutEpub({ chapters: [chapter] });
      for (let index = 0; index < source.pageCount; index++) {
        const { width } = await source.size(index);
        const runs = (await source.text?.(index, never)) ?? [];
        for (const run of runs) expect(run.x + run.width, run.text).toBeLessThan(width);
      }
    }
  },
);

test.each([
  ["sideways-lr", "", prose(8)],
  ["vertical-rl", 'dir="rtl"', prose(8)],
  ["vertical-rl", "", `<div style="writing-mode: vertical-lr">${prose(8)}</div>`],
  [
    "horizontal-tb",
    "",
    `<table><tr><th style="writing-mode: vertical-rl">head</th></tr></table>${prose(8)}`,
  ],
  [
    "horizontal-tb",
    "",
    `<p>a <span style="writing-mode: vertical-rl; display: inline-block">turned</span> word</p>${prose(8)}`,
  ],
])(
  "lines of any direction are on their pages, where they are laid: %s %s",
  async (mode, root, body) => {
    const style = `<style>body { writing-mode: ${mode} }</style>`;
    const chapter = document(style, body).replace("<html", `<html ${root}`);
    const source = await laidOutEpub({ chapters: [chapter] });
    const meant = new DOMParser().parseFromString(body, "text/html").body.textContent ?? "";
    expect(letters((await pagesOf(source)).join("")).length).toBe(letters(meant).length);
    await expectDrawnAsLaid(source);
  },
);

test("a view's lengths are those of the type area", async () => {
  const source = await laidOutEpub({
    chapters: [
      "<div style=\"height: 100vh; background: url('10vh')\"></div><p>second</p>",
      '<p style="margin-left: 50vw; margin-top: calc(10vmin + 1dvh)">half</p>',
    ],
  });
  expect(source.pageCount).toBe(3);
  expect((await pagesOf(source)).map(letters)).toEqual(["", "second", "half"]);
  const [half] = (await source.text?.(2, never)) ?? [];
  const { width } = await source.size(0);
  expect(half?.x).toBeCloseTo(53 + (width - 106) / 2, 0);
});

test.each([
  "width: 100vw; padding: 1em; height: 60vh",
  "width: 120%; height: 60vh",
  "width: 100%; height: 60vh; border: 9px solid #000; margin-left: 1px",
  "width: 900px; height: 200vh",
])("a box in which nothing is keeps its background, however wide: %s", async (style) => {
  const chapters = [`<div style="${style}; background: #000"></div><p>after</p>`];
  const source = await laidOutEpub({ chapters });
  const picture = (await source.draw(0, 100, never)) as ImageBitmap;
  const pen = new OffscreenCanvas(picture.width, picture.height).getContext("2d")!;
  pen.drawImage(picture, 0, 0);
  expect(pen.getImageData(50, 60, 1, 1).data[0]).toBeLessThan(9);
  expect(letters((await pagesOf(source)).join(""))).toBe("after");
});

test.each(["horizontal-tb", "vertical-rl"])(
  "lines with ruby are where they are laid, %s",
  async (mode) => {
    // The readings, which take room and are no text of their own, are not drawn.
    const source = await laidOutEpub({
      chapters: ["<p><ruby>base<rt>reading</rt></ruby> and the rest</p>".repeat(60)],
      css: `html { writing-mode: ${mode} } p { margin: 0; line-height: 1.5 } rt { visibility: hidden }`,
    });
    expect(letters((await pagesOf(source)).join(""))).toBe("baseandtherest".repeat(60));
    await expectDrawnAsLaid(source);
  },
);

test("a book's style of drawings and boxes is not that of the page's own", async () => {
  const source = await laidOutEpub({
    chapters: [prose(12, 40)],
    css: "svg, foreignObject { width: 10px; opacity: 0.5; display: none } div { margin: 40px }",
  });
  await expectDrawnAsLaid(source);
});

test("text that is hidden is not read", async () => {
  const source = await laidOutEpub({
    chapters: [
      '<p>seen <span style="visibility: hidden">hidden <b style="visibility: visible">again</b></span></p>',
    ],
  });
  expect((await pagesOf(source)).map(letters)).toEqual(["seenagain"]);
  await expectDrawnAsLaid(source);
});

const long = prose(7, 60);
test("a section is set as most of its text is written", async () => {
  const source = await laidOutEpub({
    chapters: [
      `<p>head</p>${`<div style="writing-mode: vertical-rl; direction: ltr">${prose(2)}</div>`.repeat(5)}`,
      `<div style="writing-mode: vertical-rl">tail</div>${prose(8)}`,
    ],
    spine: 'page-progression-direction="rtl"',
  });
  const pages = await pagesOf(source);
  const runs = (await source.text?.(1, never)) ?? [];
  expect(runs.every(({ vertical }) => vertical)).toBe(true);
  const words = `<p>head</p>${prose(2).repeat(5)}tail${prose(8)}`.replace(/<[^>]*>/g, "");
  expect(letters(pages.join("")).length).toBe(letters(words).length);
  await expectDrawnAsLaid(source);
});

test.each([
  ["overflow: hidden", `<div style="overflow: hidden; border: 1px solid #fff">${long}</div>`],
  ["overflow: auto of some height", `<div style="overflow: auto; height: 200px">${long}</div>`],
  [
    "overflow: scroll in another",
    `<div style="overflow: scroll"><div style="overflow: auto; max-height: 300px">${long}</div></div>`,
  ],
  ["an inline block", `<div style="display: inline-block">${long}</div>`],
  ["an inline table", `<div style="display: inline-table">${long}</div>`],
  ["an inline flex box", `<div style="display: inline-flex"><div>${long}</div></div>`],
  ["a height that it outgrows", `<div style="height: 100px">${long}</div>`],
  ["a flex item", `<div style="display: flex"><div>${long}</div></div>`],
  ["a grid", `<div style="display: grid; grid-template-columns: 700px">${long}</div>`],
  ["an absolute box", `<div style="position: absolute; top: 0">${long}</div>`],
  ["a float", `<div style="float: left; width: 60%">${long}</div>`],
  ["a fixed width", `<div style="width: 900px">${long}</div>`],
  ["a preformatted line", `<pre style="white-space: pre">${"word ".repeat(100)}</pre>`],
  [
    "blanks over the end of a line",
    `<pre style="white-space: pre-wrap">${`word${" ".repeat(200)}\n`.repeat(60)}</pre>`,
  ],
  ["a line that does not break", `<p style="white-space: nowrap">${"word ".repeat(60)}</p>`],
  [
    "a table of six columns",
    `<table><tr>${"Temperature Concentration Measurement Uncertainty Laboratory Remarks"
      .split(" ")
      .map((word) => `<th>${word}</th>`)
      .join("")}</tr></table>`,
  ],
  [
    "a box put to the left of the next page",
    '<p style="position: relative; left: 600px">moved</p>',
  ],
  ["an open dialog", `${prose(2)}<dialog open="" style="border: 0">asked</dialog>${prose(4)}`],
  ["a box put far below its page", '<p style="position: absolute; top: 3000px">far below</p>'],
  ["a box put far beside its page", '<p style="position: absolute; left: 2000px">far beside</p>'],
  [
    "a box put beside another",
    '<div style="position: relative; height: 200px"><p style="position: absolute; right: -300px; bottom: 0">beside</p></div>',
  ],
  ["a box that is moved", '<p style="transform: translate(300px)">moved</p>'],
  ["a margin out of the page", `<p style="margin-left: -300px">${"word ".repeat(80)}</p>`],
  [
    "a margin of more than all of a line",
    '<p style="margin-left: 700px">words behind a margin</p>',
  ],
  ["a margin wider than a line", '<p style="margin: 0 400px">words between margins</p>'],
  [
    "an indent of more than all of a line",
    '<p style="text-indent: 120%">words after an indent</p>',
  ],
  [
    "a hanging indent in a margin that is negative",
    `<p style="margin-left: -30pt; text-indent: -36pt">${"word ".repeat(80)}</p>`,
  ],
  [
    "an indent from the right into the page before",
    `<p dir="rtl" style="margin-right: -30pt; text-indent: -36pt">${"word ".repeat(8)}</p>`,
  ],
  ["an indent wider than a line", '<p style="text-indent: 900px">words after an indent</p>'],
  ["room at the left wider than a line", '<p style="padding-left: 600px">words beside room</p>'],
  [
    "quotations within each other",
    `${"<blockquote>".repeat(30)}deep words${"</blockquote>".repeat(30)}`,
  ],
  ["a running text", "<marquee>running words</marquee>"],
  ["a button", `<button style="border: 0">${long}</button>`],
  ["a legend", `<fieldset style="border: 0"><legend>${long}</legend>in the set</fieldset>`],
  ["a field of lines", `<textarea style="border: 0">${"some words\n".repeat(80)}</textarea>`],
  [
    "a list of options",
    `<select multiple="" style="border: 0">${Array.from({ length: 90 }, (_, k) => `<option>option${k}</option>`).join("")}</select>`,
  ],
  ["a letter", '<p style="font-size: 1500px; margin: 0">Mg</p>'],
  ["a letter in a line", '<p>words <b style="font-size: 60em">Mg</b> and more</p>'],
  ["a letter in a box that is zoomed", '<p style="zoom: 60">Mg</p>'],
  ["a first letter", '<p class="first-type">Words after it.</p>'],
  ["a letter over a hundred lines", `<p class="first-lines">${"Words after it. ".repeat(9)}</p>`],
  ["a line", '<p style="line-height: 100">first<br/>second</p>'],
  ["a line with a raised word", '<p>a <i style="vertical-align: 3000px"><b>high</b></i> word</p>'],
  [
    "a word that may not be broken",
    `<p style="white-space: nowrap; overflow-wrap: normal !important">${"x".repeat(300)}</p>`,
  ],
  ["a box apart from what is around it", `<div style="contain: strict">${long}</div>`],
  ["a container", `<div style="container-type: size; height: 50px">${long}</div>`],
  ["what is laid out when it is seen", `<div style="content-visibility: auto">${long}</div>`],
  [
    "a heading over columns that are none",
    `${long}<h2 style="column-span: all">over</h2>${prose(2)}`,
  ],
  [
    "a table that is scrolled as a box",
    `<table style="display: block; overflow-x: scroll; white-space: nowrap"><tr>${"<td>a cell</td>".repeat(20)}</tr></table>`,
  ],
  [
    "pages on which all is placed",
    Array.from({ length: 3 }, (_, page) => {
      const words = [0, 1, 2].map(
        (k) =>
          `<span style="position: absolute; left: ${250 * k}px; top: ${300 * k}px">page${page}line${k}</span>`,
      );
      return `<div style="position: relative; width: 600px; height: 800px">${words.join("")}</div>`;
    }).join(""),
  ],
  [
    "a table of fixed columns",
    `<table style="width: 2000px; table-layout: fixed"><tr>${Array.from({ length: 20 }, (_, k) => `<td>column${k}</td>`).join("")}</tr></table>`,
  ],
  [
    "a table in a box that is turned",
    `<div style="transform: rotate(90deg)"><table><tr>${Array.from({ length: 12 }, (_, k) => `<td>column${k}</td>`).join("")}</tr></table></div>`,
  ],
  [
    "a table of thirty columns",
    `<table><tr>${Array.from({ length: 30 }, (_, k) => `<td>column${k}</td>`).join("")}</tr></table>`,
  ],
])("%s larger than the page loses nothing and lies on nothing", async (_, box) => {
  const css = `.first-type::first-letter { float: left; font-size: 1500px; line-height: 1 }
    .first-lines::first-letter { initial-letter: 100 }`;
  const source = await laidOutEpub({ chapters: [`<p>before</p>${box}<p>after</p>`], css });
  const text = new DOMParser().parseFromString(`<p>before</p>${box}<p>after</p>`, "text/html").body;
  const drawn = letters((await pagesOf(source)).join(""));
  const lost = letters(text.textContent ?? "").length - drawn.length;
  expect(lost, drawn.slice(-500)).toBe(0);
  await expectDrawnAsLaid(source);
});

/** Words of as many columns, each as wide as it is, and rows of numbers beneath. */
const wideTable = (columns: number, rows: number): string =>
  `<table><caption>Figures</caption><tr>${Array.from({ length: columns }, (_, k) => `<th>Measurement${k}</th>`).join("")}</tr>${Array.from({ length: rows }, (_, row) => `<tr>${Array.from({ length: columns }, (_, k) => `<td>${row}x${k}</td>`).join("")}</tr>`).join("")}</table>`;

test.each([
  ["in text", `<p>before</p>${wideTable(9, 6)}<p>after</p>`, [false, true, false]],
  ["in a box", `<p>before</p><div>${wideTable(9, 6)}</div><p>after</p>`, [false, true, false]],
  ["alone in its chapter", wideTable(9, 6), [true]],
  ["after another", `${wideTable(9, 6)}${wideTable(9, 6)}`, [true, true]],
  ["that scaled down would fit", `<p>before</p>${wideTable(5, 3)}<p>after</p>`, [false]],
])(
  "a table that is too wide even at its smallest is turned onto a page of its own: %s",
  async (_, body, turned) => {
    const source = await laidOutEpub({ chapters: [body], css: "td, th { padding: 0 3px }" });
    const pages = await pagesOf(source);
    const meant = new DOMParser().parseFromString(body, "text/html").body.textContent ?? "";
    expect(letters(pages.join("")).length).toBe(letters(meant).length);
    const isTurned = async (index: number): Promise<boolean> => {
      const runs = ((await source.text?.(index, never)) ?? []).filter(({ text }) =>
        /^Meas/.test(text),
      );
      return runs.length > 0 && runs.every(({ vertical }) => vertical);
    };
    expect(await Promise.all(pages.map((__, index) => isTurned(index)))).toEqual(turned);
    // Its words are whole.
    if (turned.includes(true)) expect(pages.join(" ")).toContain("Measurement8");
    await expectDrawnAsLaid(source);
  },
);

test.each([
  ["in its first row", (table: string) => table],
  [
    "that says so, under columns and before a foot",
    (table: string) =>
      table
        .replace(
          /<tr>(<th.*?)<\/tr>/,
          '<colgroup><col/></colgroup><thead id="h"><tr>$1</tr></thead>',
        )
        .replace("</table>", "<tfoot><tr><td>foot</td></tr></tfoot></table>"),
  ],
  [
    "of a table with cells over rows",
    (table: string) =>
      [...Array(19).keys()].reduce(
        (text, k) =>
          text
            .replace(`<td>${3 * k}x0<`, `<td rowspan="3">${3 * k}x0<`)
            .replace(`<td>${3 * k + 1}x0</td>`, "")
            .replace(`<td>${3 * k + 2}x0</td>`, ""),
        table,
      ),
  ],
])(
  "a turned table longer than a page is split between rows, with its head on each: %s",
  async (_, made) => {
    const body = `<p>before</p>${made(wideTable(9, 60))}<p>after</p>`;
    const source = await laidOutEpub({ chapters: [body], css: "td, th { padding: 0 3px }" });
    const pages = await pagesOf(source);
    const meant = new DOMParser().parseFromString(body, "text/html").body.textContent ?? "";
    // Every word once, and whole.
    expect(letters(pages.join(""))).toBe(letters(meant));
    expect(pages.length).toBeGreaterThan(4);
    const runs = (await source.text?.(1, never)) ?? [];
    const head = runs.find(({ text }) => text.includes("Measurement8"));
    expect(head?.vertical).toBe(true);
    expect(runs.find(({ text }) => /^0x8/.test(text))?.y).toBeCloseTo(head?.y ?? 0, -1);
    // On later pages the head is drawn above their rows, in the same columns, and is no text of the book.
    const later = [...pages.keys()].slice(2, -1);
    const rows = await Promise.all(
      pages.map(async (_, page) => (await source.text?.(page, never)) ?? []),
    );
    const ends = rows.map((own) => Math.max(...own.map(({ x, width }) => x + width)));
    const heads = new Set<number>();
    await expectDrawnAsLaid(source, (page, x) => {
      const isHead = later.includes(page) && x > (ends[page] ?? 0) + 2;
      if (isHead) heads.add(page);
      return isHead;
    });
    expect([...heads]).toEqual(later);
    const columns = later.map(
      (page) => rows[page]?.find(({ text }) => /^\d+x1$/.test(text))?.y ?? 0,
    );
    for (const y of columns) expect(y).toBeCloseTo(columns[0] ?? 0, 0);
  },
);

test("a table that has no room turned either has its words broken, and loses none", async () => {
  const body = `<p>before</p>${wideTable(30, 6)}<p>after</p>`;
  const source = await laidOutEpub({ chapters: [body] });
  const meant = new DOMParser().parseFromString(body, "text/html").body.textContent ?? "";
  expect(letters((await pagesOf(source)).join("")).length).toBe(letters(meant).length);
  await expectDrawnAsLaid(source);
});

test("a small box of vertical lines among horizontal ones has its lines whole", async () => {
  const source = await laidOutEpub({
    chapters: [
      '<p>before all of them</p><div style="writing-mode: vertical-rl; height: 200px">first line<br/>second</div><p>after</p>',
    ],
  });
  const runs = (await source.text?.(0, never)) ?? [];
  expect(runs.map(({ text, vertical = false }) => [text.trim(), vertical])).toEqual([
    ["before all of them", false],
    ["first line", true],
    ["second", true],
    ["after", false],
  ]);
  await expectDrawnAsLaid(source);
});

test.each([
  ["transform: scale(300)", ""],
  ["transform: scale(300) !important", "p { transform: none !important }"],
  ["", "p { transform: scale(300) }"],
  ["", "body { transform: translate(200000px) }"],
  ["", "p { scale: 300 !important; translate: 100000px }"],
  ["", 'p { offset: path("M 90000 0 L 90001 0") }'],
])("what is moved out of its page adds none: %s %s", async (style, css) => {
  const head = `<style>${css}</style>`;
  const body = (count: number) => `<p style="${style}">A line.</p>${"<p>Here.</p>".repeat(count)}`;
  for (const count of [0, 100]) {
    const plain = await laidOutEpub({
      chapters: [document("", `<p>A line.</p>${"<p>Here.</p>".repeat(count)}`)],
    });
    const moved = await laidOutEpub({ chapters: [document(head, body(count))] });
    expect(moved.pageCount).toBe(plain.pageCount);
  }
});

test("a short text of horizontal lines among vertical ones stays so, and lies on nothing", async () => {
  const note = `<div style="writing-mode: horizontal-tb"><p>${"note ".repeat(60)}</p><p>last</p></div>`;
  const source = await laidOutEpub({
    chapters: [`<div>${prose(6)}</div>${note}<div>${prose(2)}</div>`],
    css: "div { writing-mode: vertical-rl }",
  });
  const pages = await Promise.all(
    Array.from({ length: source.pageCount }, (_, k) => source.text?.(k, never) ?? []),
  );
  const notes = pages.flat().filter(({ text }) => /note|last/.test(text));
  expect(notes.length).toBeGreaterThan(2);
  expect(notes.filter(({ vertical }) => vertical)).toEqual([]);
  await expectDrawnAsLaid(source);
});

test.each(["horizontal-tb", "vertical-rl", "vertical-lr"])(
  "a text of %s lines longer than a page, among others, is on several pages and lies on nothing",
  async (mode) => {
    const items = Array.from({ length: 12 }, (_, k) => `<li>item${k} ${"words ".repeat(30)}</li>`);
    const long = `<p id="long">${"note ".repeat(600)}</p><ol>${items.join("")}</ol><p>last</p>`;
    const other = mode === "horizontal-tb" ? "vertical-rl" : "horizontal-tb";
    const source = await laidOutEpub({
      chapters: [
        `<div>${prose(20)}</div><div class="other">${long}</div><div>${prose(2)}after</div>`,
      ],
      css: `div { writing-mode: ${other} } .other { writing-mode: ${mode} } ol { list-style: none }`,
    });
    const runs = await Promise.all(
      Array.from({ length: source.pageCount }, (_, k) => source.text?.(k, never) ?? []),
    );
    const others = runs.map((page) => page.filter(({ text }) => /note|words|last/.test(text)));
    expect(others.filter(({ length }) => length > 0).length).toBeGreaterThan(2);
    const isVertical = mode !== "horizontal-tb";
    expect(others.flat().filter(({ vertical = false }) => vertical !== isVertical)).toEqual([]);
    const text = letters((await pagesOf(source)).join(""));
    expect(text.match(/note/g)?.length).toBe(600);
    expect(text.match(/words/g)?.length).toBe(360);
    expect(text).toContain("after");
    await expectDrawnAsLaid(source);
  },
);

const wideSvg = (attributes: string): string =>
  `<svg xmlns="http://www.w3.org/2000/svg" ${attributes}><rect width="900" height="300" fill="#ddd"/><text x="820" y="280" font-size="40">end</text></svg>`;

test.each<[string, string]>([
  ["a drawing without a viewBox in a quotation", wideSvg('width="900" height="300"')],
  [
    "a drawing in a quotation",
    wideSvg('viewBox="0 0 900 300" width="900" height="300" style="max-width: none"'),
  ],
  ["a box of a width of its own", '<div style="width: 370px; padding: 9px">end</div>'],
  ["a box of a least width", '<div style="min-width: 370px">end</div>'],
  [
    "a box as wide as its words",
    `<figure style="width: max-content">${"word ".repeat(40)}end</figure>`,
  ],
  [
    "a table",
    `<table><tr>${'<td style="min-width: 90px">a</td>'.repeat(4)}<td>end</td></tr></table>`,
  ],
])("%s that is indented ends where lines do", async (_, box) => {
  const quotation = `<blockquote style="margin: 1em 3em"><ul><li>${box}</li></ul></blockquote>`;
  for (const direction of ["ltr", "rtl"]) {
    const body = `<div dir="${direction}">${quotation}</div><p>after</p>`;
    const source = await laidOutEpub({ chapters: [body] });
    const runs = (await source.text?.(0, never)) ?? [];
    const end = runs.find(({ text }) => text.endsWith("end"));
    expect(runs.at(-1)?.text).toBe("after");
    expect(end && end.x + end.width).toBeLessThan(488 - 53 + 2);
    expect(end?.x).toBeGreaterThan(53 - 2);
  }
});

test("a box that is to reach into both margins does", async () => {
  const box = `<div style="margin: 0 -30px; text-align: justify">${"word ".repeat(90)}</div>`;
  const source = await laidOutEpub({ chapters: [`${box}<p>after</p>`] });
  const [first] = (await source.text?.(0, never)) ?? [];
  expect(first?.x).toBeCloseTo(53 - 30, 0);
  expect(first && first.x + first.width).toBeCloseTo(488 - 53 + 30, 0);
});

test("a picture that is meant to stand in the margin does", async () => {
  const bled = wideSvg('viewBox="0 0 900 300" style="width: 420px; margin: 0 -20px"');
  const source = await laidOutEpub({ chapters: [`${bled}<p>after</p>`] });
  const [end] = (await source.text?.(0, never)) ?? [];
  expect(end?.text).toBe("end");
  expect(end && end.x + end.width).toBeGreaterThan(435);
});

test("rows that are collapsed leave no room", async () => {
  const heights = await Promise.all(
    ["visibility: collapse", "display: none"].map(async (style) => {
      const row = "<tr><td>row</td><td>words</td></tr>";
      const rows = row.repeat(5) + row.replace("<tr>", `<tr style="${style}">`) + row.repeat(50);
      const source = await laidOutEpub({ chapters: [`<table>${rows}</table><p>end</p>`] });
      const runs = (await source.text?.(source.pageCount - 1, never)) ?? [];
      return [source.pageCount, runs.at(-1)?.y];
    }),
  );
  expect(heights[0]).toEqual(heights[1]);
});
