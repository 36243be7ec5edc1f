/**
 * Every binding, layout and offset: each page has exactly one place, and
 * reading passes all of them in order.
 */

import { expect, test } from "vitest";
import { fuzz, Random, seed } from "../for_tests/random_numbers.ts";
import { edgeFor, faceIn, layoutFor, pagesNamed, placePages } from "./layout.ts";
import {
  type Binding,
  type BindOptions,
  bind,
  type CoverKind,
  clampSpread,
  type Edge,
  forward,
  leafCount,
  leftPage,
  pageOf,
  pagesAt,
  paperLeaves,
  paperOnLeft,
  rightPage,
  spineOf,
  spreadOf,
  waypoints,
} from "./spreads.ts";

const edges: Edge[] = ["left", "right", "top", "bottom"];
const covers: CoverKind[] = ["hard", "soft", "none"];

/** Each way to bind `pages` pages. */
function* bindings(pages: number): Generator<[Binding, string]> {
  for (const cover of covers) {
    for (const edge of edges) {
      for (const layout of ["spread", "single"] as const) {
        for (const offset of [0, 1] as const) {
          const options: BindOptions = { edge, layout, offset };
          yield [bind(pages, cover, options), `${pages} ${cover} ${JSON.stringify(options)}`];
        }
      }
    }
  }
}

/** The spreads in the order of reading. */
function inOrder(book: Binding): number[] {
  const way = Array.from({ length: book.last - book.first + 1 }, (_, k) => book.first + k);
  return book.reversed ? way.reverse() : way;
}

test("reading from the first spread to the last passes every page once, in order", () => {
  for (let pages = 1; pages < 30; pages++) {
    for (const [book, how] of bindings(pages)) {
      const seen = inOrder(book).flatMap((s) => pagesAt(book, s));
      expect(seen, how).toEqual(Array.from({ length: pages }, (_, k) => k + 1));
      const most = book.layout === "single" ? 1 : 2;
      for (const s of inOrder(book)) {
        expect(pagesAt(book, s).length, how).toBeLessThanOrEqual(most);
        // Only the outside of boards, and their inside, may be without a page.
        if (!book.hardCover) expect(pagesAt(book, s).length, how).toBeGreaterThan(0);
      }
    }
  }
});

test("every page is shown by its spread, and is what its spread is called or beside it", () => {
  for (let pages = 1; pages < 30; pages++) {
    for (const [book, how] of bindings(pages)) {
      for (let page = 1; page <= pages; page++) {
        const s = spreadOf(book, page);
        expect(s, how).toBe(clampSpread(book, s));
        expect(pagesAt(book, s), how).toContain(page);
        expect([page, page - 1], how).toContain(pageOf(book, s));
      }
      for (const s of inOrder(book)) expect(spreadOf(book, pageOf(book, s)), how).toBeDefined();
    }
  }
});

test("page 1 stands alone, or beside page 2", () => {
  for (const cover of covers) {
    for (const edge of edges) {
      const alone = bind(20, cover, { edge });
      expect(pagesAt(alone, spreadOf(alone, 1))).toEqual([1]);
      expect(pagesAt(alone, spreadOf(alone, 2))).toEqual([2, 3]);
      expect(pagesAt(alone, spreadOf(alone, 20))).toEqual([20]);
      const facing = bind(20, cover, { edge, offset: 0 });
      expect(pagesAt(facing, spreadOf(facing, 1))).toEqual([1, 2]);
      expect(pagesAt(facing, spreadOf(facing, 20))).toEqual([19, 20]);
    }
  }
  // Boards without pages of their own can be shut over it all.
  const bare = bind(4, "hard", { offset: 0 });
  expect([0, 1, 2, 3, 4, 5].map((s) => pagesAt(bare, s))).toEqual([[], [], [1, 2], [3, 4], [], []]);
  expect([bare.first, bare.last, leafCount(bare), paperLeaves(bare)]).toEqual([0, 5, 5, 3]);
});

test("boards without pages stay so where page 1 is shifted to have nothing beside it", () => {
  const places = placePages(4, { offset: 0, shifts: [1] });
  const bare = bind(4, "hard", places);
  expect([0, 1, 2, 3, 4, 5].map((s) => pagesAt(bare, s))).toEqual([[], [1], [2, 3], [4], [], []]);
  expect([1, 2, 3, 4].map((page) => faceIn(places, page))).toEqual([0, 1, 2, 3]);
  expect(paperLeaves(bare)).toBe(2);
});

test("bound on the right, the second page lies left of the third, and on goes to the right", () => {
  const book = bind(8, "hard", { edge: "right" });
  expect(leafCount(book)).toBe(4);
  expect(forward(book)).toBe(-1);
  expect([spreadOf(book, 1), spreadOf(book, 2), spreadOf(book, 8)]).toEqual([4, 3, 0]);
  expect([4, 3, 2, 1, 0].map((s) => pageOf(book, s))).toEqual([1, 2, 4, 6, 8]);
  expect(waypoints(book, 4, 0)).toEqual([3, 2, 1, 0]);
});

test("the spine lies at the inner edge of a page, whichever way the book is bound", () => {
  for (const [edge, second, third] of [
    ["left", "right", "left"],
    ["right", "left", "right"],
    ["top", "bottom", "top"],
    ["bottom", "top", "bottom"],
  ] as const) {
    const book = bind(8, "hard", { edge });
    expect([4, 5].map((page) => spineOf(book, page))).toEqual([second, third]);
    expect([1, 2, 7, 8].map((page) => spineOf(book, page))).toEqual(Array(4).fill("board"));
    const single = bind(8, "none", { edge, layout: "single" });
    expect([1, 2, 8].map((page) => spineOf(single, page))).toEqual(Array(3).fill(third));
  }
});

test("random books: the leaves on both sides are all there are, and hard pages are two to a leaf", () => {
  const seed = Math.floor(Math.random() * 2 ** 31);
  let state = seed;
  const random = (below: number): number => {
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    return Math.floor((state / 2 ** 32) * below);
  };
  for (let round = 0; round < 300; round++) {
    const pages = 1 + random(600);
    const cover = covers[random(3)];
    const hardPages = Array.from({ length: random(4) }, () => random(pages + 20) - 5);
    const options: BindOptions = {
      edge: edges[random(4)],
      layout: random(2) ? "single" : "spread",
      offset: random(2) ? 0 : 1,
      hardPages,
    };
    const book = bind(pages, cover, options);
    const how = `seed ${seed}: ${pages} ${cover} ${JSON.stringify(options)}`;
    const s = book.first + random(book.last - book.first + 1);
    expect(paperOnLeft(book, s), how).toBeLessThanOrEqual(paperLeaves(book));
    expect(2 * leafCount(book), how).toBeGreaterThanOrEqual(pages);
    const to = spreadOf(book, 1 + random(pages));
    const way = waypoints(book, s, to);
    expect(way.at(-1) ?? s, how).toBe(to);
    for (const page of hardPages.filter((page) => page >= 1 && page <= pages)) {
      const at = spreadOf(book, page);
      const leaf = [at - 1, at].some((k) => book.hardLeaves.has(k));
      expect(leaf, how).toBe(true);
    }
    expect(book.hardLeaves.size, how).toBeLessThanOrEqual(hardPages.length);
  }
});

test("the edge follows the direction unless one is asked for", () => {
  expect(edgeFor("auto", { direction: "ltr" })).toBe("left");
  expect(edgeFor("auto", { direction: "rtl" })).toBe("right");
  expect(edgeFor("top", { direction: "rtl" })).toBe("top");
  expect(edgeFor("auto", { direction: "ltr", edge: "bottom" })).toBe("bottom");
});

/** Returns the pages of every spread, in the order of reading; 0 for a bare side. */
function spreadsOf(
  pages: number,
  options: Parameters<typeof placePages>[1],
  edge: Edge,
  want = {},
) {
  const places = placePages(pages, options, (index) => Reflect.get(want, index + 1));
  const book = bind(pages, "none", { edge, ...places });
  const spreads = Array.from({ length: book.leaves + 1 }, (_, s) => {
    const sides = [leftPage(book, s) ?? 0, rightPage(book, s) ?? 0];
    return (book.reversed ? sides.reverse() : sides).join(" ");
  });
  return book.reversed ? spreads.reverse() : spreads;
}

test.each<Edge>(["left", "right", "top", "bottom"])("%s: a shift leaves a side bare", (edge) => {
  const plain = { offset: 1, shifts: [] } as const;
  expect(spreadsOf(5, plain, edge)).toEqual(["0 1", "2 3", "4 5", "0 0"]);
  const shifted = spreadsOf(6, { offset: 1, shifts: [3, 4] }, edge);
  expect(shifted).toEqual(["0 1", "2 0", "3 0", "4 5", "6 0"]);
  expect(spreadsOf(3, { offset: 1, shifts: [1] }, edge)).toEqual(["0 0", "1 2", "3 0"]);
  expect(spreadsOf(3, { offset: 0, shifts: [1] }, edge)).toEqual(["0 1", "2 3", "0 0"]);
});

test.each<Edge>(["left", "right"])("%s: pages lie where the book wants them", (edge) => {
  const plain = { offset: 1, shifts: [] } as const;
  const wide = { 3: "first", 4: "second" };
  expect(spreadsOf(5, plain, edge, wide)).toEqual(["0 1", "2 0", "3 4", "5 0"]);
  // Where it lies right already nothing is left bare, and a shift there is undone.
  expect(spreadsOf(5, { offset: 1, shifts: [2] }, edge, wide)).toEqual([
    "0 1",
    "0 2",
    "3 4",
    "5 0",
  ]);
  expect(spreadsOf(4, { offset: 1, shifts: [3] }, edge, wide)).toEqual([
    "0 1",
    "2 0",
    "3 4",
    "0 0",
  ]);
  expect(spreadsOf(3, plain, edge, { 1: "first" })).toEqual(["0 0", "1 2", "3 0"]);
  // An inserted leaf changes the places of no other page.
  expect(spreadsOf(6, plain, edge, { 3: "alone" })).toEqual(["0 1", "2 3", "0 4", "5 6", "0 0"]);
  expect(spreadsOf(6, plain, edge, { 4: "alone" })).toEqual(["0 1", "2 3", "4 0", "5 6", "0 0"]);
  // Nothing lies beside a page that is shown by itself; at the beginning nothing does anyway.
  expect(spreadsOf(5, plain, edge, { 2: "single" })).toEqual(["0 1", "2 0", "3 4", "5 0"]);
  expect(spreadsOf(5, plain, edge, { 3: "single" })).toEqual(["0 1", "2 0", "3 0", "4 5", "0 0"]);
  expect(spreadsOf(3, plain, edge, { 1: "single" })).toEqual(["0 1", "2 3", "0 0"]);
  expect(spreadsOf(3, { offset: 0, shifts: [] }, edge, { 1: "single" })).toEqual([
    "0 0",
    "1 0",
    "2 3",
    "0 0",
  ]);
  expect(spreadsOf(4, plain, edge, { 2: "single", 3: "second" })).toEqual([
    "0 1",
    "2 0",
    "0 3",
    "4 0",
  ]);
  expect(spreadsOf(3, plain, edge, { 2: "single", 3: "single" })).toEqual(["0 1", "2 0", "3 0"]);
  expect(spreadsOf(5, plain, edge, { 3: "alone", 4: "first", 5: "second" })).toEqual([
    "0 1",
    "2 3",
    "4 5",
    "0 0",
  ]);
});

test("whatever a book wants, every page is on one face and pages keep their order", () => {
  const numbers = new Random();
  const random = (below: number): number => numbers.below(below);
  for (let count = 0; count < 300 * fuzz; count++) {
    const pages = 1 + random(40);
    const want = Array.from(
      { length: pages },
      () => (["first", "second", "alone", "single"] as const)[random(12)],
    );
    const shifts = Array.from({ length: random(6) }, () => random(pages + 2));
    const options = { offset: random(2) as 0 | 1, shifts };
    const edge = (["left", "right"] as const)[random(2)];
    const cover = (["hard", "none"] as const)[random(2)];
    const places = placePages(pages, options, (index) => want[index]);
    const book = bind(pages, cover, { edge, ...places });
    const how = `seed ${seed}: ${JSON.stringify({ pages, want, options, edge, cover })}`;
    const read: number[] = [];
    for (let s = 0; s <= book.leaves; s++) {
      const at = book.reversed ? book.leaves - s : s;
      const open = pagesAt(book, at);
      for (const page of open) {
        read.push(page);
        expect(spreadOf(book, page), how).toBe(at);
        expect(pagesAt(book, spreadOf(book, page)), how).toContain(page);
        const place = want[page - 1];
        if (open.length === 2 && (place === "first" || place === "second")) {
          expect(open.indexOf(page) === 0, how).toBe(place === "first");
        }
      }
      if (!book.hardCover && at > book.first && at < book.last)
        expect(open.length, how).toBeGreaterThan(0);
    }
    expect(read, how).toEqual(Array.from({ length: pages }, (_, index) => index + 1));
  }
});

test("a page stands alone where it is much larger so, and does not flicker between", () => {
  const fit = (width: number, height: number, before: "spread" | "single" | null = null) =>
    layoutFor("auto", 2 / 3, false, width, height, before);
  expect(fit(1280, 800)).toBe("spread");
  expect(fit(390, 844)).toBe("single");
  expect(fit(600, 600)).toBe("spread");
  expect(fit(0, 0)).toBe("spread");
  expect(fit(0, 0, "single")).toBe("single");
  expect(layoutFor("single", 1, false, 1280, 800, null)).toBe("single");
  // One page above the other: a phone has space for both, a wide screen does not.
  expect(layoutFor("auto", 2 / 3, true, 390, 844, null)).toBe("spread");
  expect(layoutFor("auto", 3 / 2, true, 1280, 500, null)).toBe("single");
  for (let width = 300; width < 1200; width++) {
    const [spread, single] = [fit(width, 800, "spread"), fit(width, 800, "single")];
    if (spread === "single") expect(single).toBe("single");
  }
});

test("lists of pages are read, and nonsense names none", () => {
  expect(pagesNamed("1-2, 9", 20)).toEqual([1, 2, 9]);
  expect(pagesNamed("0-3,19-400", 20)).toEqual([1, 2, 3, 19, 20]);
  expect(pagesNamed("cover, 3-, -4, 1e3, 7-5", 20)).toEqual([]);
  expect(pagesNamed("1-99999999999999999999", 5)).toEqual([1, 2, 3, 4, 5]);
});
