import { afterAll, beforeAll, expect, test } from "vitest";
import { cleanCss, cssOf } from "../markup/clean_css.ts";
import { type LayoutFrame, openFrame } from "./frame.ts";
import { paintingOf } from "./paint_cost.ts";
import { boxesIn, StyleMentions } from "./style_mentions.ts";

let frame: LayoutFrame;
beforeAll(async () => {
  frame = await openFrame(600, 800);
});
afterAll(() => frame.close());

/** Puts a body's content into the frame; returns its element. */
function laid(content: string): HTMLElement {
  const html = frame.document.createElement("html");
  html.append(frame.document.createElement("body"));
  (html.firstElementChild as Element).innerHTML = content;
  frame.root.replaceChildren(html);
  return html;
}

const namesOf = (elements: Iterable<Element>): string[] =>
  [...elements].map(({ localName }) => localName);

test.each([
  ["a style sheet", "p { transform: rotate(1deg); }", "<p>a</p>"],
  ["a rule within others", "@media all { div { & p { transform: none } } }", "<p>a</p>"],
  ["a prefixed property", "p { -webkit-transform: none }", "<p>a</p>"],
  ["an escaped property", "p { tr\\61nsform: none }", "<p>a</p>"],
  ["an inline style", "", '<p style="transform: none">a</p>'],
  ["an attribute of a drawing", "", '<svg><g transform="scale(2)"/></svg>'],
])("a property is found in %s", async (_, css, content) => {
  const sheets = [cssOf(await cleanCss(css, async () => null))];
  expect(new StyleMentions(sheets, laid(content)).has(["scale", "transform"])).toBe(true);
});

test.each([
  ["another property", "p { text-transform: uppercase; --transform: none }"],
  ["a value", 'p { content: "a; transform" }'],
  ["data", 'p { background: url("data:image/png;base64,transform:") }'],
])("%s is no mention of a property", async (_, css) => {
  const sheets = [cssOf(await cleanCss(css, async (address) => address))];
  const mentions = new StyleMentions(sheets, laid('<p style="text-transform: none">a</p>'));
  expect(mentions.has(["scale", "transform"])).toBe(false);
});

test("style sheets are searched without the data of their pictures and fonts", async () => {
  const css =
    'p { background: url("data:image/png;base64,shadow"); color: red } @font-face { font-family: a; src: url("data:font/woff2;base64,shadow") }';
  const sheets = [cssOf(await cleanCss(css, async (address) => address))];
  const mentions = new StyleMentions(sheets, laid("<p>a</p>"));
  expect(sheets.join().match(/shadow/g)).toHaveLength(2);
  expect(mentions.sheets.join()).not.toContain("shadow");
  expect(mentions.sheets.join()).toContain("color: red");
});

test("a frame reads a style sheet again only where another one was, and keeps its fonts", async () => {
  const own = await openFrame(600, 800);
  const adopted = (): readonly CSSStyleSheet[] => [...own.document.adoptedStyleSheets];
  const font = '@font-face { font-family: a; src: url("data:font/woff2;base64,AAAA"); }';
  try {
    own.adopt([font, "p { color: red; }"]);
    const [before, faces] = [adopted(), own.fonts()];
    own.adopt([font, "p { color: blue; }", "i { color: red; }"]);
    const after = adopted();
    expect(faces).toHaveLength(1);
    expect(own.fonts()[0]).toBe(faces[0]);
    expect(after.map((sheet, k) => sheet === before[k])).toEqual([true, true, false, false]);
    expect(after.at(-2)?.cssRules[0]?.cssText).toContain("blue");
    own.adopt([]);
    expect(own.fonts()).toEqual([]);
    expect(adopted()).toHaveLength(1);
  } finally {
    own.close();
  }
});

test("a style set later is found", () => {
  const html = laid("<p>a</p>");
  const mentions = new StyleMentions([], html);
  expect(mentions.has(["visibility"])).toBe(false);
  (html.querySelector("p") as HTMLElement).style.visibility = "hidden";
  expect(mentions.has(["visibility"])).toBe(true);
});

test("elements of text are left out where nothing gives them a property, and ends of lines always", () => {
  const { firstElementChild: body } = laid("<p>a<br>b <i>c</i></p><hr><img>");
  const [none, some] = [new StyleMentions([], body as Element), ["i { overflow: hidden }"]];
  expect(namesOf(boxesIn(body as Element))).toEqual(["p", "i", "hr", "img"]);
  expect(namesOf(none.boxesWith(body as Element, ["overflow"]))).toEqual(["hr", "img"]);
  const mentions = new StyleMentions(some, body as Element);
  expect(namesOf(mentions.boxesWith(body as Element, ["overflow"]))).toEqual([
    ...["p", "i", "hr", "img"],
  ]);
});

test("no painting is measured of thousands of elements of text, as of as many shapes", () => {
  const measured = (content: string): number => {
    const flow = { stepX: 0, stepY: 0, isVertical: false };
    return paintingOf(laid(content), [], { width: 600, height: 800 }, flow);
  };
  expect(measured("<i>a</i> ".repeat(3000))).toBe(0);
  const shape = '<rect width="9" height="9"/>';
  expect(measured(`<svg>${shape.repeat(3000)}</svg>`)).toBeGreaterThan(0);
});
