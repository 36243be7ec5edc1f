/** Formulas of MathML: drawn as they are, one piece of text each, read as mathematics. */

import { expect, test } from "vitest";
import { closeBooks, laidOut } from "../../for_tests/laid_out_books.ts";
import { layText } from "../../text/page_text.ts";
import { tinyEpub } from "../epub/tiny_epub.ts";

const never = new AbortController().signal;
const math = (inner: string, more = ""): string =>
  `<math xmlns="http://www.w3.org/1998/Math/MathML" ${more}>${inner}</math>`;
const half = "<mfrac><mi>a</mi><mrow><mi>b</mi><mo>+</mo><mn>1</mn></mrow></mfrac>";

closeBooks();

test("a formula is one run: its TeX, what its author says of it, or its signs on a line", async () => {
  const formulas = [
    math(
      `<semantics>${half}<annotation encoding="application/x-tex">\\frac{a}{b+1}</annotation></semantics>`,
    ),
    math(
      `<semantics><apply><divide/><ci>a</ci></apply><annotation-xml encoding="MathML-Presentation">${half}</annotation-xml></semantics>`,
    ),
    math(half, 'alttext="a over b plus one"'),
    math(
      `<msup><mi>x</mi><mn>2</mn></msup><mo>=</mo><msqrt><mi>y</mi><mo>+</mo><mi>z</mi></msqrt>`,
    ),
    math(
      "<munderover><mo>∑</mo><mrow><mi>i</mi><mo>=</mo><mn>1</mn></mrow><mi>n</mi></munderover><mi>i</mi><mo>\u2062</mo><mi>j</mi>",
      'display="block"',
    ),
    math(
      "<mtable><mtr><mtd><mn>1</mn></mtd><mtd><mn>0</mn></mtd></mtr><mtr><mtd><mn>0</mn></mtd><mtd><mn>1</mn></mtd></mtr></mtable>",
    ),
  ];
  const source = await laidOut(
    tinyEpub({ chapters: [formulas.map((one) => `<p>so ${one} is</p>`).join("")] }),
  );
  const runs = (await source.text?.(0, never)) ?? [];
  const found = runs.filter(({ math }) => math !== undefined);
  expect(found.map(({ text }) => text)).toEqual([
    "\\frac{a}{b+1}",
    "a/(b + 1)",
    "a over b plus one",
    "x^2 = √(y + z)",
    "∑_(i = 1)^nij",
    "[1, 0; 0, 1]",
  ]);
  // The words around it are runs of their own, and nothing of it is said twice.
  expect(runs.map(({ text }) => text.trim()).filter((text) => /^(so|is)$/.test(text)).length).toBe(
    12,
  );
  expect(runs.length).toBe(18);
  for (const { width, height } of found) expect(width * height).toBeGreaterThan(50);
  expect(found[0]?.math).toContain("<mfrac>");
  expect(found[0]?.math).not.toContain("annotation");
});

test("what is said of several formulas alike is said of none", async () => {
  const said = 'alttext="Not available"';
  const formulas = [
    math("<mi>x</mi>", said),
    math("<mi>y</mi><mo>+</mo><mi>z</mi>", said),
    math("<mi>a</mi>", 'alttext="the letter"'),
    math("<mi>a</mi>", 'alttext="the letter"'),
  ];
  const source = await laidOut(tinyEpub({ chapters: [`<p>${formulas.join(" ")}</p>`] }));
  const runs = (await source.text?.(0, never)) ?? [];
  expect(runs.filter((run) => run.math).map(({ text }) => text)).toEqual([
    "x",
    "y + z",
    "the letter",
    "the letter",
  ]);
});

test("over the page it is MathML to screen readers, and its text to a reader who copies it", () => {
  const hostile = math(
    '<mi onclick="alert(1)" href="javascript:alert(1)">x</mi><script xmlns="http://www.w3.org/1999/xhtml">1</script><mtext><img xmlns="http://www.w3.org/1999/xhtml" src="x"/>y</mtext>',
  );
  const run = {
    text: "x^2",
    x: 0,
    y: 0,
    width: 40,
    height: 20,
    angle: 0,
    end: true,
    math: hostile,
  };
  const [pieces, formula] = layText([run], (x, y) => ({ x, y })) as HTMLElement[];
  const names = (element?: HTMLElement): string[] =>
    [...(element?.children ?? [])].map(({ localName }) => localName);
  expect([pieces?.textContent, pieces?.ariaHidden]).toEqual(["x^2", "true"]);
  expect(names(pieces)).toEqual(["span", "br"]);
  expect(formula?.outerHTML.replace(/ (class|style)="[^"]*"/g, "")).toBe(
    "<math><mi>x</mi><mtext>y</mtext></math>",
  );
  const [plain, own] = layText([{ ...run, math: "<p>no" }], (x, y) => ({ x, y })) as HTMLElement[];
  expect([plain?.dataset.text, plain?.ariaHidden]).toEqual(["x^2", null]);
  expect(names(own)).toEqual(["span", "br"]);
});
