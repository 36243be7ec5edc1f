/** What names pages follows them: as leaves are torn out, others come and go, and the element is moved. */

import { afterEach, expect, test, vi } from "vitest";
import type { TurnleafBook } from "../element.ts";
import { WasmBook } from "../engine/wasm_book.ts";
import { clock } from "../for_tests/clock.ts";
import { happens, scan, scans, settled } from "../for_tests/element_books.ts";
import { tearableElement } from "../for_tests/tearable_books.ts";
import type { Viewer } from "../viewer/viewer.ts";

afterEach(() => {
  vi.restoreAllMocks();
  document.body.replaceChildren();
  localStorage.clear();
});

/** Scans with labels of their own: "p1" and so on. */
const labelled = (count: number) =>
  scans(count).map((page, index) => ({ ...page, label: `p${index + 1}` }));

async function opened(
  attributes: Record<string, string> = {},
  count = 12,
  lists: (element: TurnleafBook) => void = () => undefined,
): Promise<TurnleafBook> {
  const element = tearableElement(labelled(count), attributes);
  lists(element);
  await happens(element, "load");
  await settled(element);
  return element;
}

/** Tears the leaf of a page out by frames of a clock of its own. */
async function tearOut(element: TurnleafBook, page = 5): Promise<void> {
  clock.hold();
  const leaves = element.tornLeaves;
  const torn = element.tearOut(page);
  await clock.until(() => element.tornLeaves > leaves && element.settled);
  vi.restoreAllMocks();
  expect(await torn).toBe(true);
}

const labels = (element: TurnleafBook): string =>
  Array.from({ length: element.pageCount }, (_, k) => element.label(k + 1)).join(" ");

const viewerOf = (element: TurnleafBook): Viewer => Reflect.get(element, "book").viewer;

/** The leaves of board among the paper. */
const hardLeaves = (element: TurnleafBook): number[] =>
  [...viewerOf(element).binding.hardLeaves].sort((a, b) => a - b);

/** Returns the leaves of a stock of their own in a book that is bound from now on, when it is called. */
function watchStocks(): () => unknown {
  let runs: unknown[] = [];
  const { setStock, setLeafStock } = WasmBook.prototype;
  vi.spyOn(WasmBook.prototype, "setStock").mockImplementation(function (this: WasmBook, stock) {
    runs = [];
    return setStock.call(this, stock);
  });
  vi.spyOn(WasmBook.prototype, "setLeafStock").mockImplementation(function (
    this: WasmBook,
    ...run
  ) {
    runs.push(run);
    return setLeafStock.apply(this, run);
  });
  return () => runs;
}

test("of two open pages the one that was asked for stays in sight when others come between them", async () => {
  for (const duration of ["0", "0.2"]) {
    const element = await opened({ duration });
    await element.goTo(6);
    const { right } = element.spread;
    await element.goTo(1);
    await element.goTo(right as number);
    await element.insertPages(right as number, scans(4));
    expect(Object.values(element.spread)).toContain((right as number) + 4);
    element.remove();
  }
});

test("pages of board and leaves of a stock stay what they are as a leaf is torn out and put back", async () => {
  const element = await opened({ "hard-pages": "5-6,9-10", stocks: "coated 11-12, card 5-6" });
  expect(hardLeaves(element)).toEqual([2, 4]);
  await tearOut(element);
  expect(hardLeaves(element)).toEqual([3]);
  const stocks = watchStocks();
  // Another attribute changes nothing about that.
  element.setAttribute("cloth", "#123456");
  expect(hardLeaves(element)).toEqual([3]);
  expect(stocks()).toEqual([
    [3, 4, "board"],
    [4, 5, "coated"],
  ]);
  expect(await element.putBack()).toBe(true);
  await settled(element);
  expect(hardLeaves(element)).toEqual([2, 4]);
  expect(stocks()).toEqual([
    [2, 3, "card"],
    [4, 5, "board"],
    [5, 6, "coated"],
  ]);
  expect(element.hardPages).toBe("5-6,9-10");
});

test("a list of pages of board that is set after a tear names pages as they lie then", async () => {
  const element = await opened({ "hard-pages": "9-10" });
  await tearOut(element);
  element.hardPages = "3-4";
  expect(hardLeaves(element)).toEqual([1]);
  expect(await element.insertPages(1, [scan(98), scan(99)])).toBe(true);
  await settled(element);
  expect(hardLeaves(element)).toEqual([2]);
});

test("pages that are put back have their shift and their bookmark, and others keep their side", async () => {
  const element = await opened();
  element.shifts = [5, 9];
  element.bookmarks = [5, 9];
  await settled(element);
  expect(element.spread).toEqual({ left: 5, right: 6 });
  await tearOut(element);
  expect([element.spread, element.shifts]).toEqual([{ left: 4, right: 5 }, [8]]);
  await element.putBack();
  await settled(element);
  expect([element.shifts, element.bookmarks]).toEqual([
    [5, 9],
    [5, 9],
  ]);
});

test("a leaf with one page is torn out of a book with boards, and all others keep their side", async () => {
  const element = await opened({ cover: "hard", offset: "0", page: "1" }, 9);
  expect(element.spread).toEqual({ left: 1, right: 2 });
  await tearOut(element, 1);
  expect(labels(element)).toBe("p2 p3 p4 p5 p6 p7 p8 p9");
  expect([element.spread, viewerOf(element).binding.hardCover]).toEqual([
    { left: null, right: 1 },
    true,
  ]);
  expect(element.shifts).toEqual([1]);
  expect(await element.goTo(2, { motion: false })).toBe(true);
  expect(element.spread).toEqual({ left: 2, right: 3 });
  expect(await element.putBack()).toBe(true);
  expect([element.spread, element.shifts]).toEqual([{ left: 1, right: 2 }, []]);
});

test("boards keep a leaf between them", async () => {
  const element = await opened({ cover: "hard", page: "3" }, 6);
  expect(await element.tearOut(3)).toBe(false);
  expect([element.pageCount, viewerOf(element).binding.hardCover]).toEqual([6, true]);
});

test("pages that are inserted into a leaf while it is torn out stay in the book", async () => {
  const element = await opened();
  element.bookmarks = [4, 9];
  clock.hold();
  const viewer = viewerOf(element);
  const changePages = viewer.changePages.bind(viewer);
  const waits = new Promise<void>((resolve) => {
    vi.spyOn(viewer, "changePages").mockImplementation((change) => {
      resolve();
      return changePages(change);
    });
  });
  const events: string[] = [];
  element.addEventListener("torn", ({ detail }) => events.push(`torn ${detail.pages}`));
  element.addEventListener("pageschange", ({ detail }) => events.push(`pages ${detail.pageCount}`));
  const torn = element.tearOut(5);
  await clock.until(() => element.state !== "resting");
  const inserted = [
    element.insertPages(6, [{ src: scan(98), label: "new" }]),
    element.insertPages(1, [{ src: scan(99), label: "first" }]),
  ];
  // The first waits for the book's rest, the second for the first.
  await waits;
  expect(element.pageCount).toBe(12);
  await clock.until(() => element.tornLeaves === 1);
  expect(await torn).toBe(true);
  await clock.until(() => element.pageCount === 12);
  expect(await Promise.all(inserted)).toEqual([true, true]);
  // Listeners have heard of no other numbers when the leaf comes off.
  expect(events).toEqual(["pages 11", "torn 5,6", "pages 11", "pages 12"]);
  await clock.until(() => element.settled);
  expect(labels(element)).toBe("first p1 p2 p3 p4 new p7 p8 p9 p10 p11 p12");
  expect(element.bookmarks).toEqual([5, 9]);
  expect(await element.putBack()).toBe(true);
  expect(labels(element)).toBe("first p1 p2 p3 p4 p5 new p6 p7 p8 p9 p10 p11 p12");
  expect(element.bookmarks).toEqual([5, 11]);
});

test("two leaves that are out go back where they were, whatever was inserted between them", async () => {
  const element = await opened({ page: "7" });
  await tearOut(element, 7);
  expect(await element.goTo(5, { motion: false })).toBe(true);
  await settled(element);
  await tearOut(element, 5);
  expect(labels(element)).toBe("p1 p2 p3 p4 p9 p10 p11 p12");
  expect(await element.insertPages(6, [{ src: scan(98), label: "new" }])).toBe(true);
  expect(labels(element)).toBe("p1 p2 p3 p4 p9 new p10 p11 p12");
  expect(await element.putBack()).toBe(true);
  expect(await element.putBack()).toBe(true);
  expect(labels(element)).toBe("p1 p2 p3 p4 p5 p6 p7 p8 p9 new p10 p11 p12");
});

test("an element that is moved in the document opens the whole book again, all lists by its pages", async () => {
  const element = await opened({ "hard-pages": "9-10" });
  element.bookmarks = [2, 6, 9];
  element.shifts = [11];
  element.folds = [{ page: 9, from: { x: 0.5, y: 0 }, to: { x: 0.5, y: 1 }, angle: 90 }];
  await settled(element);
  const [folds] = [element.folds];
  await tearOut(element);
  expect(await element.insertPages(1, [{ src: scan(98), label: "new" }])).toBe(true);
  expect(await element.goTo(8, { motion: false })).toBe(true);
  expect([element.label(8), element.bookmarks, element.shifts]).toEqual(["p9", [3, 8], [10]]);
  document.body.append(element);
  await happens(element, "load");
  await settled(element);
  expect([element.pageCount, element.tornLeaves]).toEqual([12, 0]);
  expect([element.bookmarks, element.shifts, element.folds]).toEqual([[2, 6, 9], [11], folds]);
  expect(Object.values(element.spread)).toContain(9);
  expect(hardLeaves(element)).toEqual([4]);
});

test("what is kept after a tear is found when the book is opened again", async () => {
  const kept = await opened({ remember: "" });
  kept.bookmarks = [2, 6, 9];
  await tearOut(kept);
  expect(kept.bookmarks).toEqual([2, 7]);
  kept.bookmarks = [2, 7, 10];
  expect(await kept.goTo(7, { motion: false })).toBe(true);
  kept.remove();
  const element = await opened({ remember: "", page: "" });
  expect(element.bookmarks).toEqual([2, 6, 9, 12]);
  expect(Object.values(element.spread)).toContain(9);
});
