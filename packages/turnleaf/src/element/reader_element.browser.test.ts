/**
 * What the element does for a reader besides turning: its place kept,
 * slide-show, print, download.
 */

import { afterEach, beforeEach, expect, test } from "vitest";
import { clock } from "../for_tests/clock.ts";
import { book, happens, scans, settled } from "../for_tests/element_books.ts";
import { eventually } from "../for_tests/eventually.ts";
import type { TurnDetail } from "./events.ts";
import { printPages } from "./print_pages.ts";

beforeEach(() => {
  localStorage.clear();
  history.replaceState(null, "", "#");
});
afterEach(() => document.body.replaceChildren());

const small = { duration: "80" };

test("page, zoom and bookmarks outlive the element, for the same book alone", async () => {
  const first = book(scans(12), { ...small, remember: "" });
  await happens(first, "load");
  first.toggleBookmark(5);
  first.bookmarks = [9, 5, 5, 0, 2.5];
  expect(first.bookmarks).toEqual([5, 9]);
  first.toggleBookmark(9);
  expect(first.bookmarks).toEqual([5]);
  await first.goTo(6);
  await settled(first);
  first.zoom = 2;
  await eventually(() => first.zoom).toBe(2);
  first.remove();

  const again = book(scans(12), { ...small, remember: "" });
  await happens(again, "load");
  expect(again.page).toBe(6);
  expect(again.bookmarks).toEqual([5]);
  await eventually(() => again.zoom).toBe(2);
  // Another book in the same element starts afresh.
  const loaded = happens(again, "load");
  again.pages = scans(10);
  await loaded;
  expect([again.page, again.bookmarks.length]).toEqual([1, 0]);
  again.remove();

  const other = book(scans(12), small);
  await happens(other, "load");
  expect([other.page, other.bookmarks.length]).toEqual([1, 0]);
});

test("the offset is shifted in the middle of a book, back again, and remembered", async () => {
  const first = book(scans(12), { ...small, remember: "", page: "6", layout: "spread" });
  await happens(first, "load");
  expect(first.spread).toEqual({ left: 6, right: 7 });
  first.toggleShift();
  await eventually(() => first.spread).toEqual({ left: null, right: 6 });
  await first.next();
  expect(first.spread).toEqual({ left: 7, right: 8 });
  first.toggleShift(6);
  await eventually(() => first.spread).toEqual({ left: 6, right: 7 });
  first.shifts = [6, 6, 0];
  expect(first.shifts).toEqual([6]);
  first.remove();

  const again = book(scans(12), { ...small, remember: "", layout: "spread" });
  await happens(again, "load");
  await eventually(() => again.shifts).toEqual([6]);
  await again.goTo(7);
  await eventually(() => again.spread).toEqual({ left: 7, right: 8 });
  // It stays with its page, and where one page is shown it has no effect.
  await again.insertPages(1, scans(1));
  expect(again.shifts).toEqual([7]);
  again.layout = "single";
  await eventually(() => again.shownLayout).toBe("single");
  await again.goTo(6);
  await again.next();
  expect(again.page).toBe(7);
  again.pages = scans(10);
  await happens(again, "load");
  expect(again.shifts).toEqual([]);
});

test("the address is of the first book that asks for it, and of the next one once that is gone", async () => {
  history.replaceState(null, "", "#page=4");
  const first = book(scans(12), { ...small, address: "" });
  await happens(first, "load");
  const second = book(scans(12), { ...small, address: "" });
  await happens(second, "load");
  await Promise.all([settled(first), settled(second)]);
  expect([first.page, second.page]).toEqual([4, 1]);
  await second.goTo(8);
  expect(location.hash).toBe("#page=4");
  history.replaceState(null, "", "#page=6");
  dispatchEvent(new PopStateEvent("popstate"));
  await eventually(() => first.page).toBe(6);
  expect(second.page).toBe(8);
  first.remove();
  await second.goTo(10);
  expect(location.hash).toBe("#page=10");
});

test("the address says the page, and the page follows the address", async () => {
  history.replaceState(null, "", "#chapter&page=7");
  const element = book(scans(12), { ...small, address: "" });
  await happens(element, "load");
  expect(element.page).toBe(6);
  const steps = history.length;
  await element.next();
  expect(location.hash).toBe("#chapter&page=8");
  expect(history.length).toBe(steps);
  const changed = happens<{ to: number }>(element, "pagechange");
  location.hash = "#page=2";
  expect((await changed).to).toBe(2);
  // A fragment without a page turns nothing, and stays.
  location.hash = "#elsewhere";
  await new Promise((resolve) => addEventListener("hashchange", resolve, { once: true }));
  expect(element.page).toBe(2);
  expect(location.hash).toBe("#elsewhere");
  element.remove();
  location.hash = "#page=9";
  await new Promise((resolve) => addEventListener("hashchange", resolve, { once: true }));
  document.body.append(element);
  await happens(element, "load");
  expect(element.page).toBe(8);
});

test("a slide-show turns page after page until the last, and leaves no timer", async () => {
  const element = book(scans(6), small);
  await happens(element, "load");
  const reports: boolean[] = [];
  element.addEventListener("playchange", (event) => {
    reports.push((event as CustomEvent<{ playing: boolean }>).detail.playing);
  });
  element.play(1);
  element.play(1);
  expect(element.playing).toBe(true);
  await eventually(() => element.playing).toBe(false);
  expect(element.page).toBe(6);
  expect(reports).toEqual([true, false]);
  await element.goTo(1);
  element.play(3600);
  element.remove();
  expect(reports).toEqual([true, false, true, false]);
});

test("few pages are printed at 300 dots an inch on A4, many at half as many", async () => {
  const observer = new MutationObserver(() => {
    const inside = document.querySelector("iframe")?.contentWindow;
    if (inside) inside.print = () => inside.dispatchEvent(new Event("afterprint"));
  });
  observer.observe(document.body, { childList: true });
  let widths: number[] = [];
  const draw = (_: number, width: number): Promise<ImageBitmap> => {
    widths.push(width);
    return createImageBitmap(new ImageData(1, 1));
  };
  const widthsOf = async (pageCount: number): Promise<number[]> => {
    widths = [];
    await printPages({ title: "A Book", pageCount, draw }, {});
    expect(widths.length).toBe(pageCount);
    return [...new Set(widths)];
  };
  expect(await widthsOf(40)).toEqual([2480]);
  expect(await widthsOf(41)).toEqual([1240]);
  await eventually(() => document.querySelector("iframe")).toBe(null);
  observer.disconnect();
});

test("printing draws a sheet a page in a frame of its own, and takes it away", async () => {
  const element = book(scans(6), small);
  expect(await element.print()).toBe(false);
  await happens(element, "load");
  let images = 0;
  let frame: HTMLIFrameElement | null = null;
  const observer = new MutationObserver(() => {
    frame = document.querySelector("iframe");
    const inside = frame?.contentWindow;
    if (inside) {
      inside.print = () => {
        images = inside.document.images.length;
        inside.dispatchEvent(new Event("afterprint"));
      };
    }
  });
  observer.observe(document.body, { childList: true });
  const pages: number[] = [];
  expect(await element.print({ from: 2, to: 4, onPage: (page) => pages.push(page) })).toBe(true);
  expect(pages).toEqual([2, 3, 4]);
  expect(images).toBe(3);
  expect(frame).not.toBe(null);
  await eventually(() => document.querySelector("iframe")).toBe(null);
  // Aborted half-way, nothing is left either.
  const ended = new AbortController();
  const printing = element.print({ signal: ended.signal, onPage: () => ended.abort() });
  await expect(printing).rejects.toThrow();
  // No dialog without pages.
  for (const none of [{ from: Number.NaN }, { from: 3, to: 2 }, { from: 1.2, to: 1.8 }]) {
    await expect(element.print(none)).rejects.toThrow(/^There are no pages .* to print/);
  }
  expect(document.querySelector("iframe")).toBe(null);
  observer.disconnect();
});

test("a page that is set before its pages is that of the book that opens", async () => {
  // In a document already, as frameworks set properties.
  const element = book(null, small);
  element.page = 3;
  element.pages = scans(8);
  expect(element.page).toBe(3);
  await happens(element, "load");
  expect(element.page).toBe(2);
  // In place of an open book too, at the page that it has reported.
  await element.goTo(6, { motion: false });
  await eventually(() => element.page).toBe(6);
  element.page = 6;
  element.pages = scans(10);
  await happens(element, "load");
  expect(element.page).toBe(6);
  // One that was set before belongs to the book that was open then.
  element.page = 4;
  await clock.task();
  element.pages = scans(6);
  await happens(element, "load");
  expect(element.page).toBe(1);
});

test("an offset by which another page is the first visible is a change of page", async () => {
  const element = book(scans(8), { ...small, page: "5" });
  await happens(element, "load");
  await settled(element);
  const changes: TurnDetail[] = [];
  element.addEventListener("pagechange", ({ detail }) => changes.push(detail));
  expect(element.page).toBe(4);
  element.offset = 0;
  await settled(element);
  expect(element.page).toBe(5);
  expect(changes).toEqual([{ from: 4, to: 5, direction: "forward" }]);
  element.offset = 1;
  await settled(element);
  expect(changes[1]).toEqual({ from: 5, to: 4, direction: "backward" });
  // Pages that are inserted before it report themselves.
  await element.insertPages(1, scans(2));
  expect(changes.length).toBe(2);
});

test("what cannot be drawn or given says so", async () => {
  const element = book(scans(4), small);
  await expect(element.drawPage(1, 50)).rejects.toThrow("There is no page 1");
  await happens(element, "load");
  expect(element.allows).toEqual({ print: true, download: false });
  expect(await element.download()).toBe(false);
  const picture = await element.drawPage(2, 60);
  expect(picture.width).toBe(60);
  await expect(element.drawPage(5, 60)).rejects.toThrow("There is no page 5");
  await expect(element.drawPage(Number.NaN, 60)).rejects.toThrow();
});

test("the controls come with their attribute, leave the book its room, and go with it", async () => {
  const element = book(scans(6), small);
  element.style.cssText = "width: 500px; height: 400px";
  await happens(element, "load");
  const root = element.shadowRoot as ShadowRoot;
  const stage = root.querySelector<HTMLElement>("[part=stage]") as HTMLElement;
  expect(stage.clientHeight).toBe(400);
  element.controls = true;
  await eventually(() => root.querySelector("[role=toolbar]")).not.toBe(null);
  expect(stage.clientHeight).toBe(300);
  // A key in the controls turns no page; one on the book does.
  const slider = root.querySelector("input[type=range]");
  slider?.dispatchEvent(
    new KeyboardEvent("keydown", { key: "ArrowRight", bubbles: true, composed: true }),
  );
  root
    .querySelector("[role=toolbar] button")
    ?.dispatchEvent(
      new KeyboardEvent("keydown", { key: "PageDown", bubbles: true, composed: true }),
    );
  await settled(element);
  expect(element.page).toBe(1);
  const changed = happens(element, "pagechange");
  element.dispatchEvent(new KeyboardEvent("keydown", { key: " " }));
  await changed;
  expect(root.querySelector<HTMLInputElement>("input[type=range]")?.value).toBe("2");
  element.controls = false;
  expect(root.querySelector("[role=toolbar]")).toBe(null);
  expect(stage.clientHeight).toBe(400);
});
