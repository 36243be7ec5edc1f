import { expect, test } from "vitest";
import { book, happens, scan, settled } from "./for_tests/element_books.ts";
import { eventually } from "./for_tests/eventually.ts";
import { openSource } from "./sources/open.ts";
import type { NewIndex, PageSource } from "./sources/page_source.ts";

/** A book of 12 images that doubles when `announce` is called: each page is followed by another. */
async function doubling() {
  const images = Array.from({ length: 24 }, (_, k) => scan(k + 1));
  const source = await openSource(images);
  const state = { isDouble: false };
  let announce: (change: () => NewIndex) => void = () => {};
  const changing: PageSource = Object.create(source, {
    pageCount: { get: () => (state.isDouble ? 24 : 12) },
    warnings: { value: source.warnings },
    watchPages: { value: (listener: typeof announce) => (announce = listener) },
  });
  for (const name of [
    "size",
    "widthInMetres",
    "label",
    "inSpread",
    "draw",
    "text",
    "links",
    "alt",
    "outline",
    "watchWarnings",
    "close",
  ] as const) {
    Object.defineProperty(changing, name, { value: (source[name] as () => void).bind(source) });
  }
  const change = (): NewIndex => {
    state.isDouble = true;
    return Object.assign(() => null, { placeOf: (index: number) => 2 * index });
  };
  return { source: changing, announce: () => announce(change) };
}

test("a source that changes its pages keeps the reader's place and bookmarks", async () => {
  const { source, announce } = await doubling();
  const element = book(source, { page: "5", duration: "80" });
  await happens(element, "load");
  element.bookmarks = [2, 5];
  announce();
  expect(await happens(element, "pageschange")).toEqual({ pageCount: 24 });
  expect(element.page).toBe(8);
  expect([element.spread.left, element.spread.right]).toContain(9);
  expect(element.bookmarks).toEqual([3, 9]);
  await settled(element);
  element.remove();
});

test("the change waits until a leaf in flight has landed", async () => {
  const { source, announce } = await doubling();
  const element = book(source, { page: "5", duration: "80" });
  await happens(element, "load");
  const turned = element.next();
  announce();
  expect(element.pageCount).toBe(12);
  expect(await turned).toBe(true);
  await eventually(() => element.pageCount).toBe(24);
  // From pages 6 and 7 to those in their place.
  expect([element.spread.left, element.spread.right]).toContain(11);
  element.remove();
});
