/** A page's script and the book: the script's calls and the book's events, in real Chromium. */

import { afterEach, expect, test } from "vitest";
import type { TurnDetail } from "./element/events.ts";
import type { TurnleafBook } from "./element.ts";
import { clock } from "./for_tests/clock.ts";
import { book, happens, scan, scans, settled } from "./for_tests/element_books.ts";
import { eventually } from "./for_tests/eventually.ts";
import { DrawnBook } from "./webgl/drawn_book.ts";

const pose = DrawnBook.prototype.pose;

afterEach(() => {
  DrawnBook.prototype.pose = pose;
  document.body.replaceChildren();
});

async function opened(count: number, attributes: Record<string, string>): Promise<TurnleafBook> {
  const element = book(scans(count), attributes);
  await happens(element, "load");
  await settled(element);
  return element;
}

/** Collects the details of an event. */
function heard<T>(element: TurnleafBook, name: string): T[] {
  const details: T[] = [];
  element.addEventListener(name, (event) => details.push((event as CustomEvent<T>).detail));
  return details;
}

/** Keeps a page's own number in step with the book, as React's controlled components do. */
function control(element: TurnleafBook): void {
  element.addEventListener("pagechange", ({ detail }) => {
    element.page = detail.to;
  });
}

const pressKey = (element: TurnleafBook, key: string, repeat = false) =>
  element.dispatchEvent(new KeyboardEvent("keydown", { key, repeat }));

test("a page number kept in step with the book stops no jump, and changes once a jump", async () => {
  const element = await opened(40, { duration: "100" });
  const changes = heard<TurnDetail>(element, "pagechange");
  control(element);
  expect(await element.goTo(10)).toBe(true);
  expect(element.page).toBe(10);
  expect(await element.goTo(40)).toBe(true);
  expect(await element.goTo(1)).toBe(true);
  const reports = changes.map(({ from, to, direction }) => `${from} ${to} ${direction}`);
  expect(reports).toEqual(["1 10 forward", "10 40 forward", "40 1 backward"]);
  // Sent elsewhere halfway, and back.
  const far = element.goTo(30);
  await eventually(() => element.page).toBeGreaterThan(1);
  expect(await element.goTo(1)).toBe(true);
  expect(await far).toBe(false);
  expect(changes.length).toBe(3);
  await settled(element);
});

test("a closed back without a page of its own is kept in step with", async () => {
  // The back of the board has no page: the last page there is lies within.
  const element = await opened(11, { duration: "60", page: "11" });
  control(element);
  const changes = heard<TurnDetail>(element, "pagechange");
  expect(await element.next()).toBe(true);
  expect(element.spread).toEqual({ left: null, right: null });
  await settled(element);
  expect(changes.length).toBe(1);
  expect(element.turning).toBe(false);
});

test("a page number that comes late calls no turn back, and another one does", async () => {
  const element = await opened(40, { cover: "none", duration: "300", page: "4" });
  expect(await element.next()).toBe(true);
  expect(element.page).toBe(6);
  // The reader has turned further by the time a framework sets the page of an earlier event.
  pressKey(element, "ArrowRight");
  element.page = 6;
  await settled(element);
  expect(element.page).toBe(8);
  pressKey(element, "ArrowRight");
  element.page = 6;
  await settled(element);
  expect(element.page).toBe(6);
  // An explicit request is a command, also if it was requested before.
  element.page = 20;
  element.page = 6;
  await settled(element);
  expect(element.page).toBe(6);
});

test("every call of next and previous counts", async () => {
  const element = await opened(200, { cover: "none", duration: "100", page: "2" });
  const changes = heard<TurnDetail>(element, "pagechange");
  const five = Array.from({ length: 5 }, () => element.next());
  expect(await Promise.all(five)).toEqual(Array(5).fill(true));
  expect(element.page).toBe(12);
  const sixty = Array.from({ length: 60 }, () => element.next());
  expect(await Promise.all(sixty)).toEqual(Array(60).fill(true));
  expect(element.page).toBe(132);
  const back = Array.from({ length: 70 }, () => element.previous());
  // From page 132 there are 66 leaves back.
  expect((await Promise.all(back)).filter((done) => done).length).toBe(66);
  expect(element.page).toBe(1);
  expect(changes.map(({ to }) => to)).toEqual([12, 132, 1]);
  await settled(element);
});

test("what a held key repeats waits three leaves at most; each press of its own counts, also within one frame", async () => {
  const element = await opened(200, {
    cover: "none",
    duration: "60",
    controls: "",
    layout: "spread",
    page: "2",
  });
  const button = (): HTMLElement | undefined =>
    [...(element.shadowRoot?.querySelectorAll("button") ?? [])].find(
      ({ ariaLabel, title }) => (ariaLabel ?? title) === "Next page",
    );
  await eventually(button).toBeDefined();
  let page = 2;
  for (const [press, leaves] of [
    [() => pressKey(element, "ArrowRight", true), 3],
    [() => pressKey(element, " ", true), 3],
    [() => pressKey(element, "ArrowRight"), 10],
    [() => pressKey(element, " "), 10],
    [() => button()?.click(), 10],
  ] as const) {
    await settled(element);
    for (let k = 0; k < 10; k++) press();
    await settled(element);
    page += 2 * leaves;
    expect(element.page).toBe(page);
  }
  for (let k = 0; k < 4; k++) pressKey(element, "ArrowRight");
  for (let k = 0; k < 6; k++) pressKey(element, "ArrowLeft");
  await settled(element);
  expect(element.page).toBe(page - 4);
});

test("what is no page number moves nothing, and goTo says so", async () => {
  const element = await opened(20, { cover: "none", duration: "60", page: "6" });
  const starts = heard(element, "turnstart");
  for (const nonsense of [Number.NaN, undefined, null, "x", "", {}, true]) {
    const value = nonsense as unknown as number;
    element.page = value;
    await expect(element.goTo(value)).rejects.toThrow(TypeError);
  }
  element.setAttribute("page", "x");
  element.removeAttribute("page");
  await settled(element);
  expect(element.page).toBe(6);
  expect(starts.length).toBe(0);
  element.page = "8" as unknown as number;
  await settled(element);
  expect(element.page).toBe(8);
  expect(await element.goTo(Number.POSITIVE_INFINITY)).toBe(true);
  expect(element.page).toBe(20);
  expect(await element.goTo(-1e9)).toBe(true);
  expect(element.page).toBe(1);
});

test("with a duration of 0 pages change without motion", async () => {
  const element = await opened(40, { duration: "0" });
  expect(element.duration).toBe(0);
  let drawn = 0;
  DrawnBook.prototype.pose = function (parts, ...more) {
    const isBoardUp = [parts.frontBoard, parts.backBoard].some((a) => a > 0 && a < Math.PI);
    if (parts.leaves.length > 0 || isBoardUp) drawn++;
    return pose.call(this, parts, ...more);
  };
  const changes = heard<TurnDetail>(element, "pagechange");
  const starts = heard(element, "turnstart");
  control(element);
  expect(await element.goTo(30)).toBe(true);
  expect(element.page).toBe(30);
  const promised = Array.from({ length: 4 }, () => element.next());
  expect(await Promise.all(promised)).toEqual([true, true, true, true]);
  expect(element.page).toBe(38);
  expect([await element.previous(), await element.first(), await element.previous()]).toEqual([
    true,
    true,
    false,
  ]);
  pressKey(element, "ArrowRight");
  expect(element.page).toBe(2);
  expect(changes.map(({ to }) => to)).toEqual([30, 32, 34, 36, 38, 36, 1, 2]);
  expect(starts.length).toBe(changes.length);
  await settled(element);
  expect(drawn).toBe(0);
  for (const [said, milliseconds] of [
    ["", 800],
    ["-1", 800],
    ["x", 800],
    ["70000", 800],
    ["0.0", 0],
    ["250", 250],
  ] as const) {
    element.setAttribute("duration", said);
    expect(element.duration, said).toBe(milliseconds);
  }
});

test("before a book is open, goTo waits for it, and it opens there", async () => {
  const element = book(scans(40), { duration: "60" });
  const promised = [element.goTo(7), element.goTo(20), element.goTo(21)];
  expect(await Promise.all(promised)).toEqual([false, true, true]);
  expect(element.page).toBe(20);
  element.pages = scans(12);
  const last = element.last();
  expect(await last).toBe(true);
  expect(element.page).toBe(12);
  expect(await element.next()).toBe(false);
});

test("a goTo that no book comes for resolves to false", async () => {
  const broken = book("/no-such-file.pdf");
  expect(await broken.goTo(3)).toBe(false);
  const removed = book(scans(4));
  const asked = removed.goTo(3);
  removed.remove();
  expect(await asked).toBe(false);
  // The request is not forgotten.
  document.body.append(removed);
  await happens(removed, "load");
  expect(removed.page).toBe(2);
});

test("pages go before src, whichever is set first, and null gives src its place", async () => {
  const element = book(scans(7), { src: scan(1) });
  expect(await happens(element, "load")).toMatchObject({ pageCount: 7 });
  const loads = heard(element, "load");
  element.src = scan(2);
  await settled(element);
  await clock.pass(100);
  expect([element.pageCount, loads.length]).toEqual([7, 0]);
  element.pages = null;
  expect(await happens(element, "load")).toMatchObject({ pageCount: 1 });
});

test("a page that cannot be had is one pageerror with its number and why", async () => {
  const pages = scans(12);
  pages[4] = { src: "/no-such-image.png" };
  const element = book(pages, { cover: "none", duration: "60" });
  const errors = heard<{ page: number; message: string }>(element, "pageerror");
  await happens(element, "load");
  await element.goTo(4);
  await settled(element);
  expect(errors.length).toBe(1);
  expect(errors[0].page).toBe(5);
  expect(errors[0].message).toMatch(/no-such-image\.png/);
});

test("pages that cannot be had are not put in", async () => {
  const element = await opened(8, { cover: "none" });
  const changes = heard(element, "pageschange");
  const missing = [{ src: scan(50) }, { src: "/no-such-image.png" }];
  await expect(element.insertPages(3, missing)).rejects.toThrow(/no-such-image\.png/);
  await expect(element.replacePage(3, missing)).rejects.toThrow(/no-such-image\.png/);
  expect([element.pageCount, changes.length]).toEqual([8, 0]);
  expect(await element.insertPages(3, [{ src: scan(50) }])).toBe(true);
  expect([element.pageCount, changes.length]).toEqual([9, 1]);
  await settled(element);
});
