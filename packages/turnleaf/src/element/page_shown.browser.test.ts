import { expect, test } from "vitest";
import type { TurnleafBook } from "../element.ts";
import { clock } from "../for_tests/clock.ts";
import { book, happens } from "../for_tests/element_books.ts";
import { eventually } from "../for_tests/eventually.ts";
import { prose, tinyEpub } from "../sources/epub/tiny_epub.ts";
import type { PageList } from "../sources/page_list.ts";
import { paperback } from "../sources/typeset/page_measures.ts";

/** Opens a book of prose in an element of some size. */
async function open(
  place: readonly [number, number],
  attributes: Record<string, string> = {},
): Promise<TurnleafBook> {
  return await openChapters([prose(40), prose(40)], place, attributes);
}

async function openChapters(
  chapters: string[],
  place: readonly [number, number],
  attributes: Record<string, string> = {},
): Promise<TurnleafBook> {
  const element = book(tinyEpub({ chapters }), { duration: "0", page: "8", ...attributes });
  resize(element, place);
  await happens(element, "load");
  await clock.until(() => element.settled);
  return element;
}

function resize(element: TurnleafBook, [width, height]: readonly [number, number]): void {
  element.style.cssText = `width: ${width}px; height: ${height}px`;
}

/** Returns the pages of the open book. */
const sourceOf = (element: TurnleafBook): PageList =>
  (element as unknown as { readonly source: PageList }).source;

/** Returns how high a line of type is on the screen, CSS pixels. */
async function lineOf(element: TurnleafBook): Promise<number> {
  const size = await sourceOf(element).size(element.page - 1);
  const runs = await sourceOf(element).text(element.page - 1, new AbortController().signal);
  const { height = 0 } = runs[0] ?? {};
  const { width } = element.bookBounds as DOMRect;
  const across = width / (element.shownLayout === "spread" ? 2 : 1);
  return (height * across) / size.width;
}

test("type is as large on the screen as it is asked for, however large the book is", async () => {
  const lines: number[] = [];
  for (const size of [
    [1280, 700],
    [1920, 980],
    [390, 744],
  ] as const) {
    const element = await open(size);
    lines.push(await lineOf(element));
    element.remove();
  }
  const span = document.createElement("span");
  span.style.cssText = 'font: 16px Georgia, "Liberation Serif", "Times New Roman", serif';
  span.append("word");
  document.body.append(span);
  const { height } = span.getBoundingClientRect();
  span.remove();
  for (const line of lines) expect(Math.abs(line / height - 1)).toBeLessThan(1 / 32);
});

test("a size that stays sets the book anew in steps, at the text where the reader was", async () => {
  const element = await open([1280, 700]);
  const before = element.pageCount;
  const signal = new AbortController().signal;
  const textOf = async (page: number): Promise<string> =>
    (await sourceOf(element).text(page - 1, signal)).map(({ text }) => text).join(" ");
  const first = (await textOf(element.page)).split(" ")[0] as string;
  let changes = 0;
  element.addEventListener("pageschange", () => changes++);
  await eventually(() => element.estimated).toBe(false);
  await clock.pass(100);
  const counted = changes;
  // Dragged, and by less than a step.
  for (const width of [1290, 1300, 1300]) {
    resize(element, [width, 710]);
    await clock.pass(100);
  }
  await clock.pass(1000);
  expect(changes).toBe(counted);
  resize(element, [1280, 500]);
  await eventually(() => changes).toBeGreaterThan(counted);
  await clock.until(() => element.settled);
  expect(element.pageCount).toBeGreaterThan(before);
  const { left, right } = element.spread;
  const texts = await Promise.all([left, right].map((page) => (page ? textOf(page) : "")));
  expect(texts.join(" ")).toContain(first);
  element.remove();
});

test("one page is shown as soon as lines of two would have less than 38 letters", async () => {
  const element = await open([1280, 700]);
  expect(element.shownLayout).toBe("spread");
  // As by a browser's zoom of 200 %.
  resize(element, [640, 400]);
  await eventually(() => element.shownLayout).toBe("single");
  resize(element, [1280, 700]);
  await eventually(() => element.shownLayout).toBe("spread");
  // Two pages as wide as their place have too few letters a line.
  element.fontSize = 2;
  await eventually(() => element.shownLayout).toBe("single");
  element.setAttribute("layout", "spread");
  await eventually(() => element.shownLayout).toBe("spread");
  element.remove();
});

const sentence =
  "Call me Ishmael. Some years ago, never mind how long precisely, having little or no money in my purse, and nothing particular to interest me on shore, I thought I would sail about a little. ";
const ishmael = `<p>${sentence.repeat(40)}</p>`;

/** Returns how many letters the longest line of the open page has, and how large a page is shown. */
async function linesOf(element: TurnleafBook): Promise<{ letters: number; page: DOMRect }> {
  const runs = await sourceOf(element).text(element.page - 1, new AbortController().signal);
  const lines = new Map<number, number>();
  for (const { y, text } of runs) lines.set(y, (lines.get(y) ?? 0) + text.length);
  const { x, y, width, height } = element.bookBounds as DOMRect;
  const across = width / (element.shownLayout === "spread" ? 2 : 1);
  return { letters: Math.max(...lines.values()), page: new DOMRect(x, y, across, height) };
}

test("a page is wider than a paperback where its place is too low for good lines", async () => {
  for (const [place, layout] of [
    [[844, 390], "spread"],
    [[844, 290], "spread"],
    [[740, 360], "single"],
    [[932, 430], "spread"],
    [[500, 300], "single"],
  ] as const) {
    const element = await openChapters([ishmael, ishmael], place);
    expect(element.shownLayout).toBe(layout);
    const { letters, page } = await linesOf(element);
    expect(letters).toBeGreaterThanOrEqual(38);
    expect(page.width / page.height).toBeGreaterThan(0.9);
    // With the boards' edges.
    expect(page.height / place[1]).toBeGreaterThan(0.85);
    element.remove();
  }
});

test("turned over, a phone has pages of another shape, at the text where the reader was", async () => {
  const element = await open([390, 844]);
  const isWide = (): boolean => {
    const { width, height } = sourceOf(element).leaf as DOMRect;
    return width / height > 0.7;
  };
  expect(isWide()).toBe(false);
  // While pages are counted, a number is that of another page from one moment to the next.
  await eventually(() => element.estimated).toBe(false);
  await element.goTo(5);
  const signal = new AbortController().signal;
  const textOf = async (): Promise<string> => {
    const { left, right } = element.spread;
    const open = [left, right].filter((page) => page !== null);
    const runs = await Promise.all(open.map((page) => sourceOf(element).text(page - 1, signal)));
    return runs.flatMap((page) => page.map(({ text }) => text)).join(" ");
  };
  const first = (await textOf()).split(" ").slice(0, 3).join(" ");
  resize(element, [844, 390]);
  await eventually(isWide).toBe(true);
  await clock.until(() => element.settled && !element.estimated);
  expect(element.shownLayout).toBe("spread");
  expect(await textOf()).toContain(first);
  resize(element, [390, 844]);
  await eventually(isWide).toBe(false);
  await eventually(() => element.shownLayout).toBe("single");
  element.remove();
});

test("a miniature is a paperback seen from afar", async () => {
  const element = await open([150, 100]);
  expect(sourceOf(element).leaf).toEqual(paperback);
  element.remove();
});

test("an element whose height the page leaves open is as high as for a paperback, whatever pages it shows", async () => {
  const element = await open([600, 0]);
  element.style.cssText = "width: 600px";
  await clock.pass(1000);
  await clock.until(() => element.settled);
  const { clientHeight } = element;
  expect(clientHeight / 600).toBeCloseTo(paperback.height / (2 * paperback.width), 1);
  await clock.pass(1000);
  expect(element.clientHeight).toBe(clientHeight);
  element.remove();
});
