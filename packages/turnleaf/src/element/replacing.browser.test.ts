/** One book after another in one element: what is shown stays until the next one can be. */

import { expect, test, vi } from "vitest";
import { book, happens, scans, settled } from "../for_tests/element_books.ts";
import { eventually } from "../for_tests/eventually.ts";

/** A file that is no book. */
const broken = () => new File([new Uint8Array([1, 2, 3, 4])], "broken.bin");

/** A book that opens once `go` is called; whether it was asked for, and is closed. */
function lateBook(count: number) {
  let go = (): void => {};
  const gate = new Promise<void>((resolve) => {
    go = resolve;
  });
  const state = { isAsked: false, isClosed: false };
  const pages = async () => {
    state.isAsked = true;
    await gate;
    return {
      ...bare(count),
      close: () => {
        state.isClosed = true;
      },
    };
  };
  return { pages, go, state };
}

function bare(count: number) {
  return {
    title: `A book of ${count}`,
    language: "en",
    direction: "ltr" as const,
    kind: "scan" as const,
    pageCount: count,
    size: async () => ({ width: 90, height: 120 }),
    label: (index: number) => String(index + 1),
    draw: async (_: number, width: number) => {
      const canvas = new OffscreenCanvas(width, Math.round((width * 4) / 3));
      canvas.getContext("2d")?.fillRect(0, 0, 9, 9);
      return canvas.transferToImageBitmap();
    },
    close: () => {},
  };
}

const messageOf = (element: Element) =>
  element.shadowRoot?.querySelector('[part="message"]') as HTMLElement;
const canvasesOf = (element: Element) => element.shadowRoot?.querySelectorAll("canvas").length;

test.each([
  ["a file that is no book", broken, "broken.bin"],
  ["images that are not there", () => [{ src: "none.png" }], "none.png"],
  ["a list of no images", () => [], "no pages"],
])("%s leaves the open book as it lies", async (_name, input, sentence) => {
  const element = book(scans(12), { page: "6", duration: "80" });
  element.style.width = "500px";
  await happens(element, "load");
  await settled(element);
  element.bookmarks = [3];
  element.zoom = 2;
  const failed = happens<{ message: string }>(element, "error");
  element.pages = input();
  expect((await failed).message).toContain(sentence);
  expect([element.pageCount, element.page, element.zoom]).toEqual([12, 6, 2]);
  expect(element.bookmarks).toEqual([3]);
  expect(canvasesOf(element)).toBe(1);
  // The sentence stands beside the book until the reader goes on.
  expect(messageOf(element).textContent).toContain(sentence);
  expect(messageOf(element).role).toBe("alert");
  const { bottom, height } = messageOf(element).getBoundingClientRect();
  expect(height).toBeLessThan(element.clientHeight / 2);
  expect(bottom).toBeLessThanOrEqual(element.getBoundingClientRect().bottom);
  expect(await element.next()).toBe(true);
  expect(element.page).toBe(8);
  expect(messageOf(element).hidden).toBe(true);
  await settled(element);
});

test("an address that fails leaves the open book, and the next one replaces it", async () => {
  const element = book(null);
  element.setAttribute("duration", "80");
  const loaded = happens(element, "load");
  element.pages = scans(8);
  await loaded;
  element.pages = null;
  expect(element.pageCount).toBe(0);
  const file = URL.createObjectURL(new Blob([JSON.stringify({ pages: scans(6) })]));
  const first = happens(element, "load");
  element.src = file;
  await first;
  const failed = happens(element, "error");
  element.src = "/no-such-book.pdf";
  await failed;
  expect(element.pageCount).toBe(6);
  expect(await element.next()).toBe(true);
  const second = happens(element, "load");
  element.src = file;
  await second;
  expect(element.page).toBe(1);
  expect(messageOf(element).hidden).toBe(true);
});

test("the open book can be turned while the next one is read, and is let go once that is shown", async () => {
  const before = lateBook(10);
  before.go();
  const element = book(before.pages, { duration: "80" });
  await happens(element, "load");
  const late = lateBook(4);
  const loaded = happens(element, "load");
  element.pages = late.pages;
  expect(await element.next()).toBe(true);
  expect(await element.press(1)).toBe(true);
  expect([element.pageCount, element.page]).toEqual([10, 4]);
  expect(before.state.isClosed).toBe(false);
  // Its reader's turns are of the open book, a script's request is for the next one.
  expect(await element.turnTo(9)).toBe(true);
  const asked = element.goTo(3);
  expect(element.page).toBe(8);
  late.go();
  await loaded;
  expect(await asked).toBe(true);
  expect([element.pageCount, element.page]).toEqual([4, 2]);
  expect(before.state.isClosed).toBe(true);
  expect(late.state.isClosed).toBe(false);
  expect(canvasesOf(element)).toBe(1);
});

test("of two books in a row the last one is shown, whichever is read first", async () => {
  const element = book(scans(6));
  await happens(element, "load");
  const counts: number[] = [];
  element.addEventListener("load", ({ detail }) => counts.push(detail.pageCount));
  const [slow, quick] = [lateBook(8), lateBook(4)];
  element.pages = slow.pages;
  await eventually(() => slow.state.isAsked).toBe(true);
  element.pages = quick.pages;
  quick.go();
  await eventually(() => element.pageCount).toBe(4);
  slow.go();
  await eventually(() => slow.state.isClosed).toBe(true);
  expect([element.pageCount, counts]).toEqual([4, [4]]);

  // A failure that is no longer asked for is not reported.
  const errors: string[] = [];
  element.addEventListener("error", ({ detail }) => errors.push(detail.message));
  element.pages = broken();
  element.pages = scans(10);
  await eventually(() => element.pageCount).toBe(10);
  expect(errors).toEqual([]);
});

test("removing the element ends the open book and the one that is read", async () => {
  const [shown, late] = [lateBook(6), lateBook(8)];
  shown.go();
  const element = book(shown.pages);
  await happens(element, "load");
  element.pages = late.pages;
  await eventually(() => late.state.isAsked).toBe(true);
  const asked = element.goTo(3);
  element.destroy();
  expect(shown.state.isClosed).toBe(true);
  expect([element.pageCount, canvasesOf(element), await asked]).toEqual([0, 0, false]);
  late.go();
  await eventually(() => late.state.isClosed).toBe(true);
  expect(element.pageCount).toBe(0);
});

test("a remembered book keeps its place under its own address while another fails to open", async () => {
  localStorage.clear();
  const file = URL.createObjectURL(new Blob([JSON.stringify({ pages: scans(12) })]));
  const element = book(null, { remember: "", duration: "80" });
  let loaded = happens(element, "load");
  element.src = file;
  await loaded;
  const failed = happens(element, "error");
  element.src = "/no-such-book.pdf";
  await failed;
  await element.turnTo(7);
  element.toggleBookmark(7);
  element.remove();

  const again = book(null, { remember: "" });
  loaded = happens(again, "load");
  again.src = file;
  await loaded;
  expect([again.page, again.bookmarks]).toEqual([6, [7]]);
  localStorage.clear();
});

test("elements replace elements of which some are the same", async () => {
  const page = (text: string) => {
    const element = document.createElement("section");
    element.textContent = text;
    return element;
  };
  const [a, b, c] = [page("a"), page("b"), page("c")];
  const element = book([a, b]);
  await happens(element, "load");
  const loaded = happens(element, "load");
  element.pages = [b, c];
  await loaded;
  expect(element.pageCount).toBe(2);
  expect([a, b, c].map((one) => one.parentNode === element)).toEqual([false, true, true]);
});

test("another book in its place is drawn by the programs that are compiled", async () => {
  const element = book(scans(12), { page: "6" });
  await happens(element, "load");
  await settled(element);
  const context = element.shadowRoot?.querySelector("canvas")?.getContext("webgl2");
  const linked = vi.spyOn(context as WebGL2RenderingContext, "linkProgram");
  element.pages = scans(8);
  await happens(element, "load");
  await settled(element);
  expect([element.pageCount, canvasesOf(element)]).toEqual([8, 1]);
  expect(linked).not.toHaveBeenCalled();
});
