/**
 * The text over a resting book, in a real browser: where it lies, and what a
 * reader does with it.
 */

import { afterEach, beforeEach, expect, test } from "vitest";
import { userEvent } from "vitest/browser";
import type { TurnleafBook } from "../element.ts";
import { clock } from "../for_tests/clock.ts";
import { happens, scans, settled } from "../for_tests/element_books.ts";
import { eventually } from "../for_tests/eventually.ts";
import { finger, moveFinger } from "../for_tests/real_finger.ts";
import { clickMouse, dragMouse, toolSession } from "../for_tests/real_mouse.ts";
import { awayAndBack, boxIn, fonts, line, openedWhale, spansOf } from "../for_tests/text_books.ts";
import { tinyEpub } from "../sources/epub/tiny_epub.ts";
import { openSource } from "../sources/open.ts";
import { tinyPdf } from "../sources/tiny_pdf.ts";
import { layMarks } from "./page_marks.ts";

let element: TurnleafBook;

beforeEach(async () => {
  element = await openedWhale();
});

afterEach(() => {
  clock.run();
  getSelection()?.removeAllRanges();
  element.remove();
});

const root = (): ShadowRoot => element.shadowRoot as ShadowRoot;
const boxOf = (text: string): DOMRect => boxIn(element, text);
const spans = (): HTMLElement[] => spansOf(element);

test("a drag with the mouse selects, and what is copied has words and lines", async () => {
  await dragMouse(edgeOf(boxOf("Call me"), 0), edgeOf(boxOf("years ago"), 1));
  expect(String(getSelection())).toBe("Call me\nIshmael. Some\nyears ago");
  expect(element.page).toBe(2);
  let copied = "";
  document.addEventListener("copy", () => (copied = String(getSelection())), { once: true });
  // As a reader does: a script's own copy would need a recent press.
  await userEvent.keyboard("{Control>}c{/Control}");
  await eventually(() => copied).toBe("Call me\nIshmael. Some\nyears ago");
});

test("a selection stays while the text of the page beside it comes, and while all is laid anew", async () => {
  const pages = ["One", "Two", "Three"].map((word) => line(word, 230));
  const file = new File([tinyPdf({ pages, resources: fonts })], "three.pdf");
  const source = await openSource(file);
  const text = source.text?.bind(source) ?? expect.fail("A PDF has text.");
  let comes = (): void => {};
  const beside = new Promise<void>((resolve) => (comes = resolve));
  Object.assign(source, {
    text: async (...[index, ...rest]: Parameters<typeof text>) => {
      if (index === 2) await beside;
      return text(index, ...rest);
    },
  });
  const loaded = happens(element, "load");
  element.pages = source;
  await loaded;
  await element.goTo(2);
  await settled(element);
  await eventually(() => spans().length).toBeGreaterThan(0);
  const [span] = spans();
  getSelection()?.selectAllChildren(span);
  const selected = String(getSelection());
  expect(selected).not.toBe("");
  const before = spans().length;
  comes();
  await eventually(() => spans().length).toBeGreaterThan(before);
  expect(String(getSelection())).toBe(selected);
  const { left } = span.getBoundingClientRect();
  element.style.width = "500px";
  await settled(element);
  await eventually(() => span.getBoundingClientRect().left).not.toBe(left);
  expect(String(getSelection())).toBe(selected);
  expect(spans()[0]).toBe(span);
});

test("a click beside the text ends its selection", async () => {
  const last = edgeOf(boxOf("years ago"), 1);
  await dragMouse(edgeOf(boxOf("Call me"), 0), last);
  expect(String(getSelection())).not.toBe("");
  await clickMouse({ x: last.x, y: last.y + 40 });
  expect(String(getSelection())).toBe("");
  expect(element.page).toBe(2);
});

/** Returns where the middle of a word in a piece of text is, given by the fraction of the piece before it. */
const within = (text: string, fraction: number): { x: number; y: number } => {
  const box = boxOf(text);
  return { x: box.left + fraction * box.width, y: box.top + box.height / 2 };
};

test("a finger that rests on a word selects it, and then words up to where it moves; no leaf does", async () => {
  const states = new Set<string>();
  element.addEventListener("statechange", ({ detail }) => states.add(detail.state));
  const on = within("Ishmael. Some", 0.85);
  clock.holdTimers();
  // The browser selects the word too, by a clock of its own.
  document.addEventListener("selectstart", (event) => event.preventDefault(), { once: true });
  await finger("touchStart", on);
  await clock.pass(400);
  expect(String(getSelection())).toBe("");
  await clock.pass(100);
  expect(String(getSelection())).toBe("Some");
  // To the margin beside the next line, and then before the word, into a gap between two lines.
  const below = { x: boxOf("years ago").right + 15, y: within("years ago", 0).y };
  await moveFinger(on, below);
  expect(String(getSelection())).toBe("Some\nyears ago");
  const above = { x: within("Call me", 0.8).x, y: boxOf("Call me").bottom + 1 };
  await moveFinger(below, above);
  expect(String(getSelection())).toBe("me\nIshmael. Some");
  await finger("touchEnd");
  await clock.pass(500);
  expect(String(getSelection())).toBe("me\nIshmael. Some");
  expect([...states]).toEqual([]);
  expect(element.page).toBe(2);
});

test("a finger that rests on a page beside its text selects nothing, and turns the leaf when it moves", async () => {
  const beside = { x: boxOf("never mind how").right - 5, y: boxOf("long Ishmael").bottom + 60 };
  clock.holdTimers();
  await finger("touchStart", beside);
  await clock.pass(600);
  await moveFinger(beside, { x: beside.x - 60, y: beside.y });
  expect(String(getSelection())).toBe("");
  expect(element.state).toBe("dragged");
  await finger("touchEnd");
  clock.run();
  await settled(element);
});

test("a finger that moves at once turns the leaf, though text lies under it", async () => {
  const on = within("never mind how", 0.8);
  clock.holdTimers();
  await finger("touchStart", on);
  await moveFinger(on, { x: on.x - 60, y: on.y });
  await clock.pass(600);
  expect(String(getSelection())).toBe("");
  expect(element.state).toBe("dragged");
  await finger("touchEnd");
  clock.run();
  await settled(element);
});

/** Shows the second page and the third by themselves. Returns what is found on each once a divided word is. */
async function eachAlone<T>(find: () => T[]): Promise<T[][]> {
  element.setAttribute("layout", "single");
  await settled(element);
  const found: T[][] = [];
  for (const page of [2, 3]) {
    await element.goTo(page);
    await settled(element);
    await eventually(() => find().join()).toMatch(/y\d/);
    found.push(find());
  }
  return found;
}

/** Opens a book of one chapter whose words are divided. */
async function openDivided(chapter: string): Promise<void> {
  const loaded = happens(element, "load");
  element.setAttribute("hyphens", "auto");
  element.setAttribute("lang", "en");
  element.pages = new File([tinyEpub({ chapters: [chapter] })], "flow.epub");
  await loaded;
  await settled(element);
}

test("what is copied of a book of flowing text has its paragraphs, without the ends of their lines and their hyphens", async () => {
  const paragraph =
    "Considerations of extraordinary <i>responsibilities</i> notwithstanding, administrators characteristically misunderstand constitutional <b>recommendations</b>.";
  const japanese = "吾輩は猫である名前はまだ無い".repeat(4);
  const chapter = `<h6>Of <i>things</i><br/>and others</h6><h6>Of none</h6><p>${paragraph}</p><p lang="ja">${japanese}</p><p>One<br/>two</p><pre>a\nb</pre>`;
  await openDivided(chapter);
  await element.goTo(1);
  await settled(element);
  await eventually(() => spans().length).toBeGreaterThan(10);
  getSelection()?.selectAllChildren(root().querySelector(".text") as HTMLElement);
  const read = paragraph.replace(/<.*?>/g, "");
  expect(String(getSelection()).trim().split("\n")).toEqual([
    ...["Of things", "and others", "Of none", read, japanese, "One", "two", "a", "b"],
  ]);
  // Screen readers find its headings.
  const headings = [...root().querySelectorAll<HTMLElement>(".text [role=heading]")];
  expect(headings.map(({ textContent, ariaLevel }) => [textContent, ariaLevel])).toEqual([
    ["Of thingsand others", "6"],
    ["Of none", "6"],
  ]);
  element.removeAttribute("hyphens");
});

test("what crosses a page is copied as one paragraph, its divided word too, and is one heading", async () => {
  const words = Array.from({ length: 160 }, (_, k) => `incomprehensibility${k}`).join(" ");
  const style = "<style>h1 { break-inside: auto; font-size: 1em; font-weight: normal }</style>";
  const chapter = `${style}<h1>${words}</h1><h1>Another</h1>`;
  element.setAttribute("layout", "spread");
  await openDivided(chapter);
  const layer = (): Element => root().querySelector(".text") as Element;
  const texts = (): (string | null)[] => [...layer().children].map((page) => page.textContent);
  await element.goTo(2);
  await settled(element);
  await eventually(() => texts().filter((text) => text?.includes("incomp")).length).toBe(2);
  const [, right] = texts();
  // The page ends within a word.
  expect(right).toMatch(/^[a-z]*y\d/);
  expect(right).not.toMatch(/^incomprehensibility/);
  getSelection()?.selectAllChildren(layer());
  const copied = String(getSelection()).trim();
  expect(words.includes(copied)).toBe(true);
  const headings = layer().querySelectorAll("[role=heading]");
  expect(headings.length).toBe(1);
  const rest = root().getElementById(headings[0]?.getAttribute("aria-owns") ?? "");
  expect(rest?.textContent).toBe(right);
  // Screen readers hear the word whole where it begins, on pages that are open together or alone.
  const said = (): string[] =>
    [...root().querySelectorAll<HTMLElement>(".text .spoken")].map(
      ({ dataset }) => dataset.text?.trim() ?? "",
    );
  const isWhole = (texts: string[]): boolean =>
    words.includes(texts.join(" ")) && texts.every((text) => /^incomprehensibility\d/.test(text));
  expect(said()).toHaveLength(2);
  expect(isWhole(said())).toBe(true);
  const alone = await eachAlone(said);
  expect(isWhole(alone.flat())).toBe(true);
  element.setAttribute("layout", "spread");
  await settled(element);
  // Beside other text than its beginning it is a heading of its own.
  await element.goTo(element.pageCount);
  await settled(element);
  await eventually(() => layer()?.textContent).toMatch(/Another/);
  const levels = [...layer().querySelectorAll("[role=heading]")].map(
    ({ textContent, ariaLevel }) => [textContent?.slice(-7), ariaLevel],
  );
  expect(levels.at(-1)).toEqual(["Another", "1"]);
  expect(levels.length).toBe(2);
  for (const name of ["hyphens", "layout", "lang"]) element.removeAttribute(name);
});

test("a phrase that crosses a page is found there, and marked on both pages, together or alone", async () => {
  const loaded = happens(element, "load");
  const words = Array.from({ length: 160 }, (_, k) => `incomprehensibility${k}`).join(" ");
  element.setAttribute("hyphens", "auto");
  element.setAttribute("lang", "en");
  element.setAttribute("layout", "spread");
  element.pages = new File([tinyEpub({ chapters: [`<p>${words}</p>`] })], "flow.epub");
  await loaded;
  await settled(element);
  const texts = (): string[] =>
    [...root().querySelectorAll(".text > div")].map(({ textContent }) => textContent ?? "");
  const here = (): number[] =>
    [...root().querySelectorAll(".mark.here")].map((mark) => mark.getBoundingClientRect().left);
  await element.goTo(2);
  await settled(element);
  await eventually(() => texts().filter((text) => text.includes("incomp")).length).toBe(2);
  const query = texts()
    .map((text, k) => (k === 0 ? text.slice(-12) : text.slice(0, 12)))
    .join("");
  const hits = await element.search(query);
  expect(hits.map(({ page, text }) => [page, text])).toEqual([[2, query]]);
  await element.showHit(hits[0] ?? null);
  await settled(element);
  await eventually(() => here().filter((left) => left < 320).length).toBeGreaterThan(0);
  expect(here().filter((left) => left > 320).length).toBeGreaterThan(0);
  // Alone, either page is marked up to its edge.
  const alone = (await eachAlone(texts)).map((found) => found.join(""));
  const crossing = `${alone[0]?.slice(-12)}${alone[1]?.slice(0, 12)}`;
  const [hit] = await element.search(crossing);
  expect([hit?.page, hit?.text]).toEqual([2, crossing]);
  await element.showHit(hit ?? null);
  await settled(element);
  await eventually(() => here().length).toBeGreaterThan(0);
  await element.goTo(3);
  await settled(element);
  await eventually(() => here().length).toBeGreaterThan(0);
  for (const name of ["hyphens", "layout", "lang"]) element.removeAttribute(name);
});

test("a phrase that begins two pages before is marked on the last of its pages, and on that between", () => {
  const run = { x: 0, y: 0, width: 100, height: 10, angle: 0, end: true };
  const texts = new Map([
    [3, [{ ...run, text: "I had seen", wraps: true }]],
    [4, [{ ...run, text: "little of", wraps: true }]],
    [5, [{ ...run, text: "Holmes" }]],
  ]);
  const query = "seen little of Holmes";
  const classes = (page: number, shown: number): string[] =>
    layMarks(texts, { query, page: shown, index: 0 }, page, (x, y) => ({ x, y })).map(
      ({ className }) => className,
    );
  for (const page of [3, 4, 5]) expect(classes(page, 3)).toEqual(["mark here"]);
  expect(classes(5, 5)).toEqual(["mark"]);
});

test("the text is away while a leaf turns, and another lies there afterwards", async () => {
  await awayAndBack(element, () => element.next());
  const groups = [...root().querySelectorAll(".text [role=group]")];
  expect(groups.map(({ ariaLabel }) => ariaLabel)).toEqual(["Page iv", "Page v"]);
  await eventually(() => groups.map(({ textContent }) => textContent)).toEqual([
    "Page number 4",
    "Page number 5",
  ]);
});

test("a link of the book turns it", async () => {
  const anchor = root().querySelector("a") as HTMLAnchorElement;
  expect(anchor.getAttribute("aria-label")).toBe("End");
  expect(anchor.title).toBe("Page vii");
  const print = boxOf("End");
  const box = anchor.getBoundingClientRect();
  expect(box.left).toBeLessThan(print.left);
  expect(box.bottom).toBeGreaterThan(print.bottom);
  const changed = happens(element, "pagechange");
  await clickMouse({ x: box.left + box.width / 2, y: box.top + box.height / 2 });
  await changed;
  expect(element.page).toBe(6);
});

test("a link is named by the whole words that are printed under it", async () => {
  const loaded = happens(element, "load");
  const text = line("Ill illicit WWW MMM", 100) + line("and more", 60);
  const links = ["[40 95 88 115]", "[20 50 196 115]"].map(
    (box) => `<< /Type /Annot /Subtype /Link /Rect ${box} /Dest [6 /Fit] >>`,
  );
  const bytes = tinyPdf({
    pages: Array.from({ length: 8 }, () => text),
    resources: `${fonts} >> /Annots [10 0 R 11 0 R] /Ignored <<`,
    objects: links,
  });
  element.pages = new File([bytes], "whale.pdf");
  await loaded;
  const names = (): (string | null)[] =>
    [...root().querySelectorAll(".text a")].slice(0, 2).map((a) => a.getAttribute("aria-label"));
  await eventually(names).toEqual(["illicit", "Ill illicit WWW MMM and more"]);
});

test("a page that turns under a focused link gives the focus to the book, whose keys go on", async () => {
  const anchor = root().querySelector("a") as HTMLAnchorElement;
  anchor.focus();
  await userEvent.keyboard("{ArrowRight}");
  await eventually(() => element.page).toBe(4);
  expect(document.activeElement).toBe(element);
  expect(root().activeElement).toBe(root().querySelector(".frame"));
  await userEvent.keyboard("{ArrowRight}");
  await eventually(() => element.page).toBe(6);
  // What else has taken the focus keeps it.
  await element.goTo(2);
  await eventually(() => root().querySelector("a")).not.toBeNull();
  root().querySelector("a")?.focus();
  const button = document.createElement("button");
  document.body.append(button);
  void element.next();
  button.focus();
  await settled(element);
  expect(document.activeElement).toBe(button);
  button.remove();
});

test("a zoom by key is announced", async () => {
  element.lang = "en";
  element.focus();
  await userEvent.keyboard("+");
  const said = root().querySelector(".live") as HTMLElement;
  expect(said.textContent).toBe("150%");
  await userEvent.keyboard("0");
  expect(said.textContent).toBe("100%");
});

test("a theme of high contrast prints nothing over the page", async () => {
  const media = (value: string) =>
    toolSession().send("Emulation.setEmulatedMedia", {
      features: [{ name: "forced-colors", value }],
    });
  element.setAttribute("controls", "");
  const [span] = spans();
  const range = document.createRange();
  range.selectNodeContents(span);
  getSelection()?.addRange(range);
  await element.showHit((await element.search("Ishmael"))[0] ?? null);
  await settled(element);
  await eventually(() => root().querySelector(".mark")).not.toBeNull();
  const colours = (): readonly string[] => {
    const of = (at: Element, part?: string): CSSStyleDeclaration => getComputedStyle(at, part);
    const mark = root().querySelector(".mark") as Element;
    return [
      of(spans()[0]).color,
      of(spans()[0], "::selection").color,
      of(spans()[0], "::selection").backgroundColor,
      of(mark).backgroundColor,
    ];
  };
  const before = colours();
  await media("active");
  expect(matchMedia("(forced-colors: active)").matches).toBe(true);
  const active = colours();
  await media("none");
  expect(active).toEqual(before);
  expect(before[0]).toBe("rgba(0, 0, 0, 0)");
});

test("the tree of accessibility has the pages in order, each with its text, and no picture", async () => {
  const canvas = root().querySelector("canvas") as HTMLCanvasElement;
  expect(canvas.ariaHidden).toBe("true");
  expect((root().querySelector(".text") as HTMLElement).lang).toBe("en-GB");
  const said = await accessibleTexts();
  const from = said.indexOf("group: Page ii");
  expect(said.slice(from, from + 11)).toEqual([
    "group: Page ii",
    "StaticText: Call me",
    "StaticText: Ishmael. Some",
    "StaticText: years ago",
    "StaticText: End",
    "link: End",
    "group: Page iii",
    "StaticText: never mind how",
    "StaticText: long Ishmael",
    "link: Page vii",
    // The announcement of every spread for screen readers.
    "StaticText: Pages ii and iii of 8",
  ]);
});

test("the tree of accessibility has each paragraph of flowing text whole, over its words, and none twice", async () => {
  const paragraph =
    "Considerations of extraordinary <i>responsibilities</i>, notwithstanding <i>P</i>, administrators characteristically misunderstand constitutional <b>recommendations</b>.";
  const chapter = `<h6>Of <i>things</i>, <br/>and others</h6><p>${paragraph}</p><p>One <i>t</i>wo</p><p>So <math xmlns="http://www.w3.org/1998/Math/MathML"><mi>x</mi></math> is</p>`;
  await openDivided(chapter);
  await element.goTo(1);
  await settled(element);
  await eventually(() => spans().length).toBeGreaterThan(10);
  const read = paragraph.replace(/<.*?>/g, "");
  const said = (await accessibleTexts()).filter((text) =>
    /^(StaticText|heading|MathMLMath)/.test(text),
  );
  const from = said.indexOf("heading: Of things, and others");
  expect(said.slice(from, from + 8)).toEqual([
    "heading: Of things, and others",
    "StaticText: Of things,",
    "StaticText: and others",
    `StaticText: ${read}`,
    "StaticText: One two",
    "StaticText: So",
    "MathMLMath: ",
    "StaticText: is",
  ]);
  const spoken = [...root().querySelectorAll<HTMLElement>(".spoken")];
  const whole = spoken.find(({ dataset }) => dataset.text === read) as HTMLElement;
  const box = whole.getBoundingClientRect();
  const pieces = [...(whole.nextElementSibling?.querySelectorAll("span") ?? [])].map((piece) =>
    piece.getBoundingClientRect(),
  );
  expect(pieces.length).toBeGreaterThan(5);
  expect(Math.abs(box.top - Math.min(...pieces.map(({ top }) => top)))).toBeLessThan(2);
  expect(Math.abs(box.left - Math.min(...pieces.map(({ left }) => left)))).toBeLessThan(2);
  expect(Math.abs(box.bottom - Math.max(...pieces.map(({ bottom }) => bottom)))).toBeLessThan(2);
  for (const name of ["hyphens", "lang"]) element.removeAttribute(name);
});

/** Returns the roles and names of what a screen reader meets in this document, in order. */
async function accessibleTexts(): Promise<string[]> {
  const { nodes } = (await toolSession().send("Accessibility.getFullAXTree", {
    frameId: await frameId(),
  })) as AXTree;
  const byId = new Map(nodes.map((node) => [node.nodeId, node]));
  const said: string[] = [];
  const read = (id: string): void => {
    const node = byId.get(id);
    const role = node?.role?.value;
    const isTold = /^(group|heading|StaticText|link|image|MathMLMath)$/.test(role ?? "");
    if (!node?.ignored && isTold) said.push(`${role}: ${node?.name?.value ?? ""}`);
    if (!/^(StaticText|link|MathMLMath)$/.test(role ?? "")) node?.childIds?.forEach(read);
  };
  read(nodes[0].nodeId);
  return said;
}

interface AXTree {
  readonly nodes: readonly {
    readonly nodeId: string;
    readonly childIds?: readonly string[];
    readonly ignored: boolean;
    readonly role?: { readonly value: string };
    readonly name?: { readonly value: string };
  }[];
}

/** Returns this document's frame among those of the test's page. */
async function frameId(): Promise<string> {
  interface Tree {
    readonly frame: { readonly id: string; readonly url: string };
    readonly childFrames?: readonly Tree[];
  }
  const { frameTree } = (await toolSession().send("Page.getFrameTree")) as { frameTree: Tree };
  const find = (tree: Tree): string | undefined =>
    tree.frame.url === location.href ? tree.frame.id : tree.childFrames?.map(find).find(Boolean);
  return find(frameTree) ?? frameTree.frame.id;
}

/** Returns where the middle of a box's left (0) or right (1) edge is. */
function edgeOf({ left, width, top, height }: DOMRect, side: 0 | 1): { x: number; y: number } {
  return { x: left + (side === 0 ? 1 : width - 1), y: top + height / 2 };
}

test("scans say what they show and what stands on them, from right to left too", async () => {
  const loaded = happens(element, "load");
  const line = { x: 10, y: 20, width: 70, height: 14 };
  const upright = { x: 60, y: 20, width: 14, height: 70, vertical: true };
  element.pages = {
    direction: "rtl",
    language: "ja",
    pages: scans(6).map(({ src }, i) => ({
      src,
      width: 90,
      height: 120,
      label: `p${i + 1}`,
      ...(i === 1 ? { alt: "A whale", text: [{ ...upright, text: "白鯨の話" }] } : {}),
      ...(i === 2 ? { text: [{ ...line, text: "שלום" }] } : {}),
    })),
  };
  await loaded;
  const groups = () => [...root().querySelectorAll<HTMLElement>(".text [role=group]")];
  await eventually(() => groups().map(({ textContent }) => textContent)).toEqual([
    "白鯨の話",
    "שלום",
  ]);
  const [first, second] = groups();
  expect([first.ariaLabel, second.ariaLabel]).toEqual(["Page p2", "Page p3"]);
  expect((root().querySelector(".text") as HTMLElement).lang).toBe("ja");
  expect(first.querySelector("[role=img]")?.ariaLabel).toBe("A whale");
  // It is laid over the pages once these are drawn.
  await settled(element);
  // The page that is read first lies on the right, and its letters stand below each other.
  const [one, two] = [first, second].map((group) => group.querySelector("span") as HTMLElement);
  const [high, wide] = [one.getBoundingClientRect(), two.getBoundingClientRect()];
  expect(high.left).toBeGreaterThan(wide.right);
  expect(high.height).toBeGreaterThan(2.5 * high.width);
  expect(wide.width).toBeGreaterThan(2.5 * wide.height);
  const [hit] = await element.search("鯨の");
  await element.showHit(hit);
  // Where the page curves a mark is laid in pieces.
  const marks = [...root().querySelectorAll(".here")].map((mark) => mark.getBoundingClientRect());
  const top = Math.min(...marks.map((mark) => mark.top));
  const bottom = Math.max(...marks.map((mark) => mark.bottom));
  expect(Math.abs((top + bottom) / 2 - (high.top + high.height / 2))).toBeLessThan(
    high.height / 16,
  );
  expect(Math.abs(bottom - top - high.height / 2)).toBeLessThan(high.height / 8);
});
