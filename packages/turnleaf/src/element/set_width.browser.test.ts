import { expect, test } from "vitest";
import type { TurnleafBook } from "../element.ts";
import { clock } from "../for_tests/clock.ts";
import { book, happens } from "../for_tests/element_books.ts";
import { eventually } from "../for_tests/eventually.ts";
import { prose, tinyEpub } from "../sources/epub/tiny_epub.ts";
import type { PageList } from "../sources/page_list.ts";

/** Opens a book of prose in an element of some size. */
async function open(
  [width, height]: readonly [number, number],
  attributes: Record<string, string> = {},
): Promise<TurnleafBook> {
  const element = book(tinyEpub({ chapters: [prose(40), prose(40)] }), {
    duration: "0",
    page: "8",
    ...attributes,
  });
  resize(element, [width, height]);
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
  element.fontSize = 1.5;
  await eventually(() => element.shownLayout).toBe("single");
  element.setAttribute("layout", "spread");
  await eventually(() => element.shownLayout).toBe("spread");
  element.remove();
});
