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

// The list of requests is full with the modules that this file imports, and would have none after these.
performance.setResourceTimingBufferSize(2000);

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

test("a page that is requested after a book could not be opened is none; the next book opens there", async () => {
  const element = book(() => Promise.reject(new Error("No.")));
  await happens(element, "error");
  expect(await element.goTo(3)).toBe(false);
  expect(await element.goTo(4)).toBe(false);
  element.pages = scans(6);
  await happens(element, "load");
  expect(element.page).toBe(4);
});

test("an address that names a page opens there, unless the element names another", async () => {
  const pages = scans(8).map(({ src }) => ({ src }));
  const manifest = URL.createObjectURL(new Blob([JSON.stringify(pages)]));
  const opened = async (fragment: string, page = ""): Promise<number> => {
    const element = document.createElement("turnleaf-book");
    element.setAttribute("src", manifest + fragment);
    if (page !== "") element.setAttribute("page", page);
    document.body.append(element);
    await happens(element, "load");
    return element.page;
  };
  expect(await opened("#page=4")).toBe(4);
  expect(await opened("#zoom=50&page=6")).toBe(6);
  expect(await opened("#page=4", "2")).toBe(2);
  expect(await opened("#page=900")).toBe(8);
  expect(await opened("#page=x")).toBe(1);
});
