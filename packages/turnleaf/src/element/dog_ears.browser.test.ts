/** Corners folded over: seen, bookmarked, kept, turned with their leaves and opened. */

import { afterEach, beforeEach, expect, test } from "vitest";
import type { TurnleafBook } from "../element.ts";
import { clock } from "../for_tests/clock.ts";
import { bookOverDark, settled } from "../for_tests/element_books.ts";
import { eventually } from "../for_tests/eventually.ts";
import { TestPointer } from "../for_tests/test_pointer.ts";

beforeEach(() => localStorage.clear());
afterEach(() => document.body.replaceChildren());

test("a folded leaf is turned, and folding is no turn", async () => {
  const element = await bookOverDark();
  const turns: string[] = [];
  for (const name of ["turnstart", "pagechange"]) {
    element.addEventListener(name, () => turns.push(name));
  }
  await element.dogEar(5);
  await settled(element);
  expect(turns).toEqual([]);
  expect(await element.next()).toBe(true);
  expect(await element.next()).toBe(true);
  expect(await element.previous()).toBe(true);
  expect(await element.previous()).toBe(true);
  await settled(element);
  expect(element.page).toBe(4);
  expect(turns.filter((name) => name === "pagechange")).toHaveLength(4);
  expect(element.dogEars).toHaveLength(1);
});

test("bookmarks fold corners where the page asks for it, and stay folded over a reload", async () => {
  const kept = { remember: "", "fold-bookmarks": "" };
  const first = await bookOverDark(kept);
  first.toggleBookmark(5);
  first.toggleBookmark(8);
  expect(first.dogEars.map(({ page }) => page)).toEqual([5, 8]);
  first.toggleBookmark(8);
  expect(first.dogEars.map(({ page }) => page)).toEqual([5]);
  first.remove();
  const again = await bookOverDark({ remember: "" });
  expect(again.bookmarks).toEqual([5]);
  expect(again.dogEars).toEqual([{ page: 5, corner: "head", size: 0.2 }]);
});

test("what is no folded corner is left out", async () => {
  const element = await bookOverDark();
  const wrong = [null, {}, { page: 0, corner: "head" }, { page: 3, corner: "middle" }];
  element.dogEars = [...wrong, { page: 3, corner: "foot", size: 9 }] as TurnleafBook["dogEars"];
  expect(element.dogEars).toEqual([{ page: 3, corner: "foot", size: 0.5 }]);
  expect(await element.dogEar(99)).toBe(false);
  expect(await element.dogEar(Number.NaN)).toBe(false);
  expect(element.dogEars).toHaveLength(1);
});

test("no corner of a board is folded", async () => {
  const element = await bookOverDark({ cover: "hard" });
  expect(await element.dogEar(1)).toBe(false);
  expect([element.dogEars, element.bookmarks]).toEqual([[], []]);
});

/** Draws the upper corner of the right page in over it, so many CSS pixels across and down. */
async function drawCornerIn(element: TurnleafBook, across: number, down: number) {
  const pointer = new TestPointer(element);
  const { right, top } = element.bookBounds as DOMRect;
  pointer.point("pointerdown", right - 4, top + 4);
  await pointer.move([right - 4, top + 4], [right - 4 - across, top + 4 + down]);
  return pointer;
}

test("a corner that is drawn in over its page and held still there is folded where it lies", async () => {
  const element = await bookOverDark({ "fold-bookmarks": "" });
  const turns: string[] = [];
  element.addEventListener("pagechange", () => turns.push("pagechange"));
  const pointer = await drawCornerIn(element, 30, 30);
  await eventually(() => element.dogEars).toHaveLength(1);
  const [{ page, corner, size }] = element.dogEars;
  expect([page, corner]).toEqual([5, "head"]);
  const width = (element.bookBounds as DOMRect).width / 2;
  // The eye does not look straight down.
  expect(size * width).toBeGreaterThan(24);
  expect(size * width).toBeLessThan(44);
  await eventually(() => element.state).toBe("resting");
  pointer.point("pointerup", 0, 0);
  await settled(element);
  expect([element.state, element.page, turns]).toEqual(["resting", 4, []]);
  expect(element.bookmarks).toEqual([5]);
});

test("a corner that is only drawn across, or in a book that does not ask for it, is not folded", async () => {
  for (const [attributes, down] of [
    [{ "fold-bookmarks": "" }, 2],
    [{}, 30],
  ] as const) {
    const element = await bookOverDark(attributes);
    const pointer = await drawCornerIn(element, 30, down);
    // Once its leaf lies still where it is held no more frames come, and nothing that could fold it.
    await settled(element);
    expect(element.dogEars).toEqual([]);
    pointer.point("pointerup", 0, 0);
    element.remove();
  }
});

test("a corner is folded by hand too in a book that asks for it only once it is open", async () => {
  const element = await bookOverDark();
  element.setAttribute("fold-bookmarks", "");
  const pointer = await drawCornerIn(element, 30, 30);
  await clock.pass(700);
  pointer.point("pointerup", 0, 0);
  // Pressed before what folds it was there, it would be held for ever.
  await eventually(() => element.state).toBe("resting");
  await eventually(async () => {
    if (element.dogEars.length > 0) return 1;
    const again = await drawCornerIn(element, 30, 30);
    await clock.pass(1500);
    again.point("pointerup", 0, 0);
    return element.dogEars.length;
  }).toBe(1);
});

test("of one leaf a corner is folded to one side", async () => {
  const element = await bookOverDark();
  expect(await element.dogEar(4)).toBe(true);
  expect(await element.dogEar(3)).toBe(true);
  expect(element.dogEars.map(({ page }) => page)).toEqual([3]);
});
