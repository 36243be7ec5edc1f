/**
 * What the issues of page-flip (github.com/Nodlik/StPageFlip) ask for, each by its number; the table in
 * docs/page-flip.md names these tests and says of the other issues why they have none.
 */

import { afterEach, expect, test, vi } from "vitest";
import { clock } from "../for_tests/clock.ts";
import { eventually } from "../for_tests/eventually.ts";
import {
  fillsRect,
  hasRead,
  htmlPages,
  make,
  opened as openedBy,
  pageSize,
} from "../for_tests/page_flips.ts";
import type { TurnleafBook } from "../index.ts";
import { PageFlip } from "./index.ts";

afterEach(() => {
  vi.restoreAllMocks();
  document.body.replaceChildren();
});

const opened = (options?: Parameters<typeof openedBy>[1], style?: string, count?: number) =>
  openedBy(PageFlip, options, style, count);
const elementOf = (book: PageFlip): TurnleafBook => book.getBook() as TurnleafBook;
const lies = (book: PageFlip) => eventually(() => elementOf(book).settled).toBe(true);

/** Clicks at a place of an element, without having moved. */
function click(target: Element, x: number, y: number): void {
  const at = { clientX: x, clientY: y, bubbles: true, composed: true, cancelable: true };
  target.dispatchEvent(new PointerEvent("pointerdown", { ...at, pointerId: 1 }));
  target.dispatchEvent(new MouseEvent("click", at));
}

test("#71, #34, #21: no frame is asked for at rest, nor after destroy()", async () => {
  const { book } = await opened();
  await lies(book);
  await clock.pass(500);
  const asked = vi.spyOn(window, "requestAnimationFrame");
  await clock.pass(300);
  expect(elementOf(book).state).toBe("resting");
  book.destroy();
  await clock.pass(300);
  expect(asked).not.toHaveBeenCalled();
});

test("#70, #66: at the last pages nothing comes next, and nothing throws", async () => {
  const { book, log } = await opened({ startPage: 6 });
  log.length = 0;
  book.turnToNextPage();
  book.flipNext();
  await clock.pass(300);
  expect([book.getCurrentPageIndex(), log]).toEqual([6, []]);
});

test("#69, #14: a book in a shadow tree, and pages given anew there", async () => {
  const outer = document.createElement("div");
  document.body.append(outer);
  const host = document.createElement("div");
  host.style.width = "400px";
  outer.attachShadow({ mode: "open" }).append(host);
  const book = new PageFlip(host, { ...pageSize, flippingTime: 200, startPage: 2 });
  const opens = new Promise((resolve) => book.on("init", resolve));
  book.loadFromHTML(htmlPages(6));
  await opens;
  expect(book.getCurrentPageIndex()).toBe(2);
  const updates = new Promise((resolve) => book.on("update", resolve));
  book.updateFromHtml(htmlPages(8));
  await updates;
  book.flipNext();
  await eventually(() => book.getCurrentPageIndex()).toBe(4);
});

test("#68, #27, #13: read from right to left by the property of the element", async () => {
  const { book, host } = await opened({ showPageCorners: false });
  elementOf(book).binding = "right";
  await lies(book);
  await eventually(() => elementOf(book).shownLayout).toBe("spread");
  book.flipNext();
  await eventually(() => book.getCurrentPageIndex()).toBe(2);
  expect(host.isConnected).toBe(true);
});

test("#59, #25: what lies in a link or a button keeps its click", async () => {
  const { book, pages } = await opened({ startPage: 2 });
  const inner = document.createElement("span");
  const button = document.createElement("button");
  button.append(inner);
  pages[3].replaceChildren(button);
  await lies(book);
  const { left, top } = inner.getBoundingClientRect();
  click(inner, left + 1, top + 1);
  await clock.pass(300);
  expect(book.getCurrentPageIndex()).toBe(2);
});

test("#51: loadFromHtml as the README spells it", async () => {
  const { book } = make(PageFlip);
  const opens = new Promise((resolve) => book.on("init", resolve));
  book.loadFromHtml(htmlPages(4));
  await opens;
  expect(book.getPageCount()).toBe(4);
});

test("#49, #44, #20, #11: covers and a last page alone are soft where the element says so", async () => {
  const { book, pages } = await opened({ showCover: true });
  elementOf(book).hardPages = "";
  await lies(book);
  expect(elementOf(book).hardPages).toBe("");
  expect(pages[0].classList.contains("stf__item")).toBe(true);
  book.flipNext();
  await eventually(() => book.getCurrentPageIndex()).toBe(1);
});

test("#29, #18, #17, #10: commands turn in a wide host, also where clicks do not", async () => {
  const options = { disableFlipByClick: true, autoSize: false, startPage: 2 };
  const { book, log } = await opened(options, "width: 700px; height: 200px");
  book.flipPrev();
  await hasRead(log, 0);
  expect(book.getCurrentPageIndex()).toBe(0);
  book.flipNext("bottom");
  await eventually(() => book.getCurrentPageIndex()).toBe(2);
});

test("#22: pages given anew are turned by clicks, and fit a host of another size", async () => {
  const { book, host, around } = await opened({ showPageCorners: false, size: "stretch" });
  const updates = new Promise((resolve) => book.on("update", resolve));
  book.updateFromHtml(htmlPages(6));
  await updates;
  around.style.width = "300px";
  await eventually(() => book.getBoundsRect().pageWidth).toBe(150);
  await fillsRect(book);
  const { left, top } = host.getBoundingClientRect();
  click(elementOf(book), left + 200, top + 50);
  await eventually(() => book.getCurrentPageIndex()).toBe(2);
});

test("#9: turns that are asked for one after the other are all made", async () => {
  const { book } = await opened({}, undefined, 10);
  book.flipNext();
  book.flipNext();
  book.flipNext();
  await eventually(() => book.getCurrentPageIndex()).toBe(6);
});

test("#2: after destroy() a click in the host turns nothing", async () => {
  const { book, host, pages } = await opened();
  const element = elementOf(book);
  book.destroy();
  const { left, top } = host.getBoundingClientRect();
  click(pages[1], left + 150, top + 5);
  await clock.pass(300);
  expect([book.getPageCount(), element.isConnected]).toEqual([0, false]);
});
