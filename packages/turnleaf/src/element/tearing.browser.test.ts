/** Leaves torn out by command and by hand: their pages leave the book, lie beside it, and are put back. */

import { afterEach, expect, test, vi } from "vitest";
import { CreasableBook } from "../engine/creasable_book.ts";
import { clock } from "../for_tests/clock.ts";
import { settled } from "../for_tests/element_books.ts";
import { eventually } from "../for_tests/eventually.ts";
import { pull, tearableBook, tearOutPage5 } from "../for_tests/tearable_books.ts";
import { TestPointer } from "../for_tests/test_pointer.ts";

afterEach(() => {
  vi.restoreAllMocks();
  document.body.replaceChildren();
});

test("pages that are put back are bookmarked as they were", async () => {
  const element = await tearableBook();
  element.bookmarks = [2, 6, 9];
  expect(await element.tearOut(5)).toBe(true);
  expect(element.bookmarks).toEqual([2, 7]);
  expect(await element.putBack()).toBe(true);
  expect(element.bookmarks).toEqual([2, 6, 9]);
});

test("a leaf on the left is torn out too, and several are put back from the last one on", async () => {
  const element = await tearableBook({ page: "7", tearable: "stapled" });
  expect(element.spread).toEqual({ left: 6, right: 7 });
  expect(await element.tearOut(6)).toBe(true);
  await settled(element);
  expect(element.spread).toEqual({ left: 4, right: 5 });
  expect(await element.tearOut(5)).toBe(true);
  await settled(element);
  expect([element.pageCount, element.tornLeaves]).toEqual([8, 2]);
  await element.putBack();
  await element.putBack();
  await settled(element);
  expect([element.pageCount, element.tornLeaves]).toEqual([12, 0]);
  expect(await element.goTo(7, { motion: false })).toBe(true);
  expect(element.spread).toEqual({ left: 6, right: 7 });
});

test("a listener keeps the leaf whole", async () => {
  const element = await tearableBook();
  element.addEventListener("tear", (event) => event.preventDefault());
  expect(await element.tearOut(5)).toBe(false);
  await eventually(() => element.state).toBe("resting");
  await settled(element);
  expect([element.pageCount, element.tornLeaves]).toEqual([12, 0]);
  expect(element.spread).toEqual({ left: 4, right: 5 });
});

test("nothing is torn without the attribute, and no page that does not lie open", async () => {
  const element = await tearableBook({ tearable: "glued" });
  expect(element.tearable).toBe("none");
  expect(await element.tearOut(5)).toBe(false);
  const pointer = await pull(element, 30);
  pointer.point("pointerup", 700, 100);
  await eventually(() => element.state).toBe("resting");
  expect(element.pageCount).toBe(12);
  element.tearable = "sewn";
  expect(element.tearable).toBe("sewn");
  // Of the leaves beside 4 and 5 their other pages are not in sight.
  for (const page of [9, 3, 6]) expect(await element.tearOut(page)).toBe(false);
  expect(element.pageCount).toBe(12);
});

test("what is out goes back after the page before it, or after what has that one's place", async () => {
  const element = await tearableBook();
  expect(await element.tearOut(5)).toBe(true);
  expect(await element.removePages(4)).toBe(true);
  expect([element.tornLeaves, element.pageCount]).toEqual([1, 9]);
  expect(await element.putBack()).toBe(true);
  expect([element.page, element.pageCount]).toEqual([4, 11]);
});

test("a loose sheet is moved and comes to rest in a book whose pages are folded after it was torn", async () => {
  const element = await tearableBook();
  expect(await element.tearOut(5)).toBe(true);
  await settled(element);
  expect(await element.dogEar(5, "foot", 0.2)).toBe(true);
  expect(await element.crumple()).toBe(true);
  await settled(element);
  expect(element.dogEars).toEqual([{ page: 5, corner: "foot", size: 0.2 }]);
});

test("a book whose folded leaf is torn out, or put back, is bound with the folds that its pages have then", async () => {
  const bound: number[][] = [];
  const { another } = CreasableBook.prototype;
  vi.spyOn(CreasableBook.prototype, "another").mockImplementation(function (
    this: CreasableBook,
    size,
  ) {
    const engine = another.call(this, size);
    const creased: number[] = [];
    bound.push(creased);
    const { creases } = engine;
    const crease = creases?.crease;
    if (creases && crease) {
      Object.assign(creases, {
        crease: (...of: Parameters<typeof crease>) => {
          creased.push(of[0]);
          return crease(...of);
        },
      });
    }
    return engine;
  });
  const element = await tearableBook();
  expect(await element.dogEar(5, "head", 0.3)).toBe(true);
  await settled(element);
  clock.hold();
  await tearOutPage5(element);
  expect(bound.at(-1)).toEqual([]);
  const before = bound.length;
  expect(await element.putBack()).toBe(true);
  await clock.until(() => element.settled);
  expect(bound.slice(before).map((leaves) => leaves[0])).toEqual([2]);
});

test("a book keeps its last leaf", async () => {
  const element = await tearableBook({ page: "1" }, 2);
  expect(await element.tearOut(1)).toBe(false);
  await eventually(() => element.state).toBe("resting");
  expect(element.pageCount).toBe(2);
});

test("a leaf that was pulled a little falls back whole", async () => {
  const element = await tearableBook({ tearable: "sewn" });
  const heard: Event[] = [];
  element.addEventListener("tear", (event) => heard.push(event));
  const pointer = await pull(element, 8, 1);
  pointer.point("pointerup", 500, 60);
  await eventually(() => element.state).toBe("resting");
  await settled(element);
  expect([heard.length, element.pageCount]).toEqual([0, 12]);
  expect(await element.next()).toBe(true);
});

test("a listener is asked again where nothing gave way before", async () => {
  const element = await tearableBook();
  const asked: Event[] = [];
  element.addEventListener("tear", (event) => {
    asked.push(event);
    event.preventDefault();
  });
  const pointer = await pull(element, 10, 2);
  pointer.point("pointerup", 500, 60);
  await eventually(() => element.state).toBe("resting");
  expect(await element.tearOut(5)).toBe(false);
  expect(asked).toHaveLength(1);
});

test("the leaf beside a board is not torn out in the board's place", async () => {
  const element = await tearableBook({ cover: "hard", page: "2" });
  expect(element.page).toBe(2);
  expect(await element.tearOut(2)).toBe(false);
  expect([element.page, element.pageCount]).toEqual([2, 12]);
});

test("a soft cover stays, and so no other leaf becomes one", async () => {
  const element = await tearableBook({ cover: "soft", page: "1" });
  expect(await element.tearOut(1)).toBe(false);
  const pointer = await pull(element, 40);
  pointer.point("pointerup", 700, 20);
  await eventually(() => element.settled).toBe(true);
  expect([element.tornLeaves, element.pageCount]).toEqual([0, 12]);
});

test("a leaf torn off while the one before it turns leaves the book open behind both", async () => {
  const element = await tearableBook({ page: "3", duration: "2000" });
  const pages: number[] = [];
  element.addEventListener("pagechange", ({ detail }) => pages.push(detail.to));
  clock.hold();
  void element.next();
  // It is over the left page, and not yet down.
  clock.frames(80);
  const pointer = new TestPointer(element);
  const { right, top } = element.bookBounds as DOMRect;
  pointer.point("pointerdown", right - 6, top + 8);
  for (let k = 1; element.tornLeaves === 0 && k <= 60; k++) {
    pointer.point("pointermove", right - 6 + 8 * k, top + 8, { buttons: 1 });
    clock.frames(1);
  }
  pointer.point("pointerup", 0, 0);
  await clock.until(() => element.settled);
  vi.restoreAllMocks();
  // Pages 5 and 6 are out: beside 4 lies what was 7.
  const { pageCount, spread } = element;
  expect([pageCount, spread, pages]).toEqual([10, { left: 4, right: 5 }, [4]]);
});

test("a leaf whose corner is lifted under a mouse is torn out by command", async () => {
  const element = await tearableBook();
  const pointer = new TestPointer(element);
  const { right, top } = element.bookBounds as DOMRect;
  clock.hold();
  pointer.point("pointermove", right - 5, top + 5);
  clock.frames(6);
  expect(element.state).toBe("lifting");
  const torn = element.tearOut(5);
  await clock.until(() => element.tornLeaves === 1 || element.settled);
  await clock.until(() => element.settled);
  vi.restoreAllMocks();
  expect([await torn, element.pageCount]).toEqual([true, 10]);
});

test("in a book of single pages a page is torn out by its outer edge, and elsewhere the one before it comes back", async () => {
  const element = await tearableBook({ layout: "single" });
  expect(element.spread).toEqual({ left: null, right: 5 });
  const { left, right, top } = element.bookBounds as DOMRect;
  clock.hold();
  const pointer = new TestPointer(element);
  /** Pulls from a place at the head of the page outward. */
  const pullFrom = (x: number): void => {
    pointer.point("pointerdown", x, top + 8);
    for (let k = 1; element.tornLeaves === 0 && k <= 60; k++) {
      pointer.point("pointermove", x + 6 * k, top + 8 - 1.8 * k, { buttons: 1 });
      clock.frames(1);
    }
  };
  pullFrom((left + right) / 2);
  pointer.wait(1000);
  expect([element.tornLeaves, element.state]).toEqual([0, "dragged"]);
  pointer.point("pointerup", 0, 0);
  await clock.until(() => element.settled);
  expect([element.page, element.pageCount]).toEqual([4, 12]);
  pullFrom(right - 6);
  pointer.point("pointerup", 0, 0);
  await clock.until(() => element.settled);
  expect([element.tornLeaves, element.pageCount]).toEqual([1, 11]);
});
