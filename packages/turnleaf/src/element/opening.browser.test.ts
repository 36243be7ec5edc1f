/** What happens at the same time while a book opens. */

import { afterEach, expect, test } from "vitest";
import { book, happens, scans, settled } from "../for_tests/element_books.ts";
import { eventually } from "../for_tests/eventually.ts";
import { openSource } from "../sources/open.ts";
import type { PageSource } from "../sources/page_source.ts";

afterEach(() => document.body.replaceChildren());

const canvasOf = (element: Element): HTMLCanvasElement | null =>
  element.shadowRoot?.querySelector("canvas") ?? null;

/** Returns an element whose book is being read, once it is, and what ends that. */
async function reading() {
  const source = Promise.withResolvers<PageSource>();
  const began = Promise.withResolvers<void>();
  const element = book(() => {
    began.resolve();
    return source.promise;
  });
  await began.promise;
  return { element, source };
}

const isLoaded = (file: string): boolean =>
  performance.getEntriesByType("resource").some(({ name }) => name.includes(file));

// The first of this file, as modules are loaded once.
test("what draws a book is loaded while the book is read, and its canvas goes if that fails", async () => {
  const { element, source } = await reading();
  await eventually(() => isLoaded("/webgl_stage.ts")).toBe(true);
  const canvas = canvasOf(element);
  const failed = happens(element, "error");
  source.reject(new Error("No."));
  await failed;
  expect(canvasOf(element)).toBeNull();
  expect(canvas?.getContext("webgl2")?.isContextLost()).toBe(true);
});

test("a book is drawn on the canvas that waited for it", async () => {
  const { element, source } = await reading();
  await eventually(() => canvasOf(element)).not.toBeNull();
  const canvas = canvasOf(element);
  source.resolve(await openSource(scans(4)));
  await settled(element);
  expect(canvasOf(element)).toBe(canvas);
});

test("an element that is removed before its book is read gets no canvas", async () => {
  const { element } = await reading();
  element.remove();
  expect(canvasOf(element)).toBeNull();
  const other = book(scans(4));
  other.remove();
  const { element: later } = await reading();
  await eventually(() => canvasOf(later)).not.toBeNull();
  expect(canvasOf(other)).toBeNull();
});

test("a page that is requested while a book opens is no page once the element is to show none", async () => {
  for (const close of ["pages", "src"]) {
    const { element } = await reading();
    const asked = element.goTo(3);
    if (close === "pages") element.pages = null;
    else {
      element.src = "book.pdf";
      element.pages = null;
      element.src = "";
    }
    expect(await asked).toBe(false);
    element.remove();
  }
});
