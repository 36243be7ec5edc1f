import { expect, test } from "vitest";
import { coverFor, faceIn, placePages } from "./layout.ts";
import { bind, pageOf, pagesAt, spineOf, spreadOf } from "./spreads.ts";

const plain = { offset: 1, shifts: [] } as const;

/** Returns the pages at each spread of a book with boards that show something. */
function spreadsOf(pageCount: number, boards: "picture" | "stamped", layout?: "single") {
  const places = placePages(pageCount, plain, undefined, boards);
  const binding = bind(pageCount, "hard", { ...places, ...(layout ? { layout } : {}) });
  const all = Array.from({ length: binding.last + 1 }, (_, s) => pagesAt(binding, s));
  return { all, binding, places };
}

test("a document has no boards unless it is asked to, and then its title is on them", () => {
  expect(coverFor("auto", "none", 20)).toEqual({ cover: "none", boards: undefined });
  expect(coverFor("hard", "none", 20)).toEqual({ cover: "hard", boards: "stamped" });
  expect(coverFor("soft", "none", 20)).toEqual({ cover: "soft", boards: undefined });
});

test("a book is in boards: with its picture, its title, or its pages on them", () => {
  expect(coverFor("auto", "picture", 20)).toEqual({ cover: "hard", boards: "picture" });
  expect(coverFor("auto", "stamped", 20)).toEqual({ cover: "hard", boards: "stamped" });
  expect(coverFor("auto", undefined, 20)).toEqual({ cover: "hard", boards: undefined });
  // Too thin for boards.
  expect(coverFor("auto", "stamped", 4)).toEqual({ cover: "none", boards: undefined });
});

test("a cover's picture is alone on the boards, and the back board is bare", () => {
  const { all, binding, places } = spreadsOf(6, "picture");
  expect(all).toEqual([[1], [2], [3, 4], [5, 6], [], []].slice(0, all.length));
  expect(all.length).toBeGreaterThan(4);
  expect(spineOf(binding, 1)).toBe("board");
  for (let page = 2; page <= 6; page++) expect(spineOf(binding, page)).not.toBe("board");
  expect(pageOf(binding, binding.last)).toBe(6);
  expect([1, 2, 3, 4].map((page) => faceIn(places, page))).toEqual([0, 2, 3, 4]);
});

test("no page is on stamped boards, which shut over all pages", () => {
  const { all, binding } = spreadsOf(6, "stamped");
  expect(all[0]).toEqual([]);
  expect(all.slice(1, 5)).toEqual([[1], [2, 3], [4, 5], [6]]);
  expect(all.at(-1)).toEqual([]);
  for (let page = 1; page <= 6; page++) expect(spineOf(binding, page)).not.toBe("board");
});

test("shown page by page, a stamped book has each page once between its boards", () => {
  const { all, binding } = spreadsOf(6, "stamped", "single");
  // After the last page lie the back board's inside, and the closed book.
  expect(all).toEqual([[], [1], [2], [3], [4], [5], [6], [], []]);
  expect(spreadOf(binding, 6)).toBe(binding.last - 2);
  const { all: covered } = spreadsOf(6, "picture", "single");
  expect(covered).toEqual([[1], [2], [3], [4], [5], [6], [], []]);
  // Boards that are pages are the last ones.
  const bound = bind(6, "hard", { layout: "single" });
  expect(pagesAt(bound, bound.last)).toEqual([6]);
});
