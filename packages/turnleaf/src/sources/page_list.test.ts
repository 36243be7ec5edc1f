import { expect, test } from "vitest";
import { PageList } from "./page_list.ts";
import { BookError, type NewIndex, type PageSource, placeOf } from "./page_source.ts";

/**
 * Returns a source whose pages are labelled by where they come from, and which
 * reports when it is closed.
 */
function source(name: string, pageCount: number, closed: string[] = [], labels = ""): PageSource {
  return {
    title: name,
    language: "en",
    direction: "rtl",
    kind: "typeset",
    pageCount,
    size: async (index) => ({ width: index + 1, height: 1 }),
    label: (index) => (labels ? labels[index] : String(index + 1)),
    draw: async (index) => `${name}${index + 1}` as never,
    links: async () => [
      { x: 0, y: 0, width: 1, height: 1, title: "", to: { page: pageCount } },
      { x: 0, y: 0, width: 1, height: 1, title: "", to: { href: "https://example.org" } },
    ],
    outline: async () => [
      { title: "Begin", page: 1, children: [{ title: "End", page: pageCount, children: [] }] },
    ],
    file: async () => new Blob(),
    close: () => closed.push(name),
  };
}

const signal = new AbortController().signal;

/** Returns which page lies at every place. */
const pages = async (list: PageList) =>
  await Promise.all(
    Array.from({ length: list.pageCount }, (_, index) => list.draw(index, 1, signal) as unknown),
  );

test("pages are put in, taken out and replaced, and others keep theirs", async () => {
  const list = new PageList(source("a", 4));
  const inserted = list.splice(1, 0, source("b", 2));
  expect(await pages(list)).toEqual(["a1", "b1", "b2", "a2", "a3", "a4"]);
  expect([0, 1, 3].map(inserted)).toEqual([0, 3, 5]);
  const removed = list.splice(2, 2, null);
  expect(await pages(list)).toEqual(["a1", "b1", "a3", "a4"]);
  expect([0, 1, 2, 3, 4, 5].map(removed)).toEqual([0, 1, null, null, 2, 3]);
  const replaced = list.splice(0, 1, source("c", 1));
  expect(await pages(list)).toEqual(["c1", "b1", "a3", "a4"]);
  expect([0, 1, 3].map(replaced)).toEqual([null, 1, 3]);
  expect((await list.size(2)).width).toBe(3);
  expect([list.title, list.direction, list.kind]).toEqual(["a", "rtl", "typeset"]);
});

test("pages that are not there are rejected, and nothing changes", async () => {
  const list = new PageList(source("a", 2));
  for (const [at, count] of [
    [3, 0],
    [-1, 1],
    [1, 2],
    [0.5, 1],
    [Number.NaN, 0],
    [0, Number.NaN],
    [0, -1],
  ]) {
    expect(() => list.splice(at, count, source("b", 1))).toThrow("a has pages 1 to 2 alone");
  }
  expect(await pages(list)).toEqual(["a1", "a2"]);
  list.splice(2, 0, source("b", 1));
  expect(await pages(list)).toEqual(["a1", "a2", "b1"]);
  await expect(list.draw(4, 1, signal)).rejects.toThrow("a has no page 5");
});

test("pages that are merely counted are counted anew, labels stay", () => {
  const list = new PageList(source("a", 3, [], "iv5"));
  list.splice(1, 0, source("b", 1));
  expect([0, 1, 2, 3].map((index) => list.label(index))).toEqual(["i", "2", "v", "5"]);
});

test("links and contents follow their pages; those to pages that are gone lead nowhere", async () => {
  const list = new PageList(source("a", 3));
  const targets = async () => (await list.links(1, signal)).map(({ to }) => to);
  list.splice(0, 0, source("b", 1));
  expect(await targets()).toEqual([{ page: 4 }, { href: "https://example.org" }]);
  const [begin] = await list.outline(signal);
  expect([begin.page, begin.children[0].page]).toEqual([2, 4]);
  list.splice(3, 1, null);
  expect(await targets()).toEqual([{ href: "https://example.org" }]);
  expect((await list.outline(signal))[0].children[0].page).toBeNull();
});

test("the book's own file is given for as long as it is the book", () => {
  const list = new PageList(source("a", 3));
  expect(list.file).toBeDefined();
  list.splice(3, 0, source("b", 1));
  expect(list.file).toBeUndefined();
  list.splice(3, 1, null);
  expect(list.file).toBeDefined();
});

test("a source is closed when its last page goes; the book's own stays for its title", () => {
  const closed: string[] = [];
  const list = new PageList(source("a", 2, closed));
  list.splice(0, 0, source("b", 2, closed));
  list.splice(0, 1, null);
  expect(closed).toEqual([]);
  list.splice(0, 3, source("c", 1, closed));
  expect(closed).toEqual(["b"]);
  list.close();
  expect(closed.sort()).toEqual(["a", "b", "c"]);
});

test("a book keeps a page", async () => {
  const list = new PageList(source("a", 2));
  expect(() => list.splice(0, 2, null)).toThrow(BookError);
  expect(await pages(list)).toEqual(["a1", "a2"]);
});

test("pages that are taken out are put back, and their source stays open meanwhile", async () => {
  const closed: string[] = [];
  const list = new PageList(source("a", 3, closed));
  list.splice(1, 0, source("b", 2, closed));
  const taken = list.order.pagesAt([1, 2]);
  const moved = list.order.takeOut(taken);
  expect(await pages(list)).toEqual(["a1", "a2", "a3"]);
  expect([0, 1, 2, 3].map(moved)).toEqual([0, null, null, 1]);
  expect(closed).toEqual([]);
  const back = list.order.putBack(taken);
  expect(await pages(list)).toEqual(["a1", "b1", "b2", "a2", "a3"]);
  expect([0, 1].map(back)).toEqual([0, 3]);
  // Once.
  expect([0, 1, 2, 3, 4].map(list.order.putBack(taken))).toEqual([0, 1, 2, 3, 4]);
  expect(() => list.order.takeOut(list.order.pagesAt([0, 1, 2, 3, 4]))).toThrow(
    "A book needs a page",
  );
  expect(await pages(list)).toEqual(["a1", "b1", "b2", "a2", "a3"]);
  list.order.takeOut(taken);
  list.close();
  expect(closed.sort()).toEqual(["a", "b"]);
});

test("pages are taken out wherever they lie by then, and put back beside those that they were beside", async () => {
  const list = new PageList(source("a", 6));
  const [leaf, other] = [list.order.pagesAt([4, 5]), list.order.pagesAt([2, 3])];
  list.splice(5, 0, source("b", 1));
  list.order.takeOut(leaf);
  expect(await pages(list)).toEqual(["a1", "a2", "a3", "a4", "b1"]);
  list.order.takeOut(other);
  list.splice(2, 0, source("c", 1));
  expect(await pages(list)).toEqual(["a1", "a2", "c1", "b1"]);
  // What followed a page follows it, in and out; the last one that was removed counts no more.
  list.splice(1, 1, null);
  list.order.putBack(other);
  expect(await pages(list)).toEqual(["a1", "a3", "a4", "c1", "b1"]);
  list.order.putBack(leaf);
  expect(await pages(list)).toEqual(["a1", "a3", "a4", "a5", "c1", "b1", "a6"]);
  expect(leaf.map((page) => list.order.indexOf(page))).toEqual([3, 6]);
  list.splice(3, 1, null);
  list.order.takeOut(leaf);
  expect(await pages(list)).toEqual(["a1", "a3", "a4", "c1", "b1"]);
  expect(() => list.order.takeOut(leaf)).toThrow("These pages were removed");
});

test("pages that are out follow a source that sets its pages anew", async () => {
  let change: ((how: () => NewIndex) => void) | undefined;
  let count = 4;
  const set = Object.defineProperty(source("a", 4), "pageCount", { get: () => count });
  const list = new PageList(
    Object.assign(set, { watchPages: (tell: typeof change) => (change = tell) }),
  );
  list.watchPages((how) => how());
  const leaf = list.order.pagesAt([1, 2]);
  const still = list.order.pagesAt([3]);
  list.order.takeOut(leaf);
  // Each page becomes two.
  change?.(() => {
    count = 8;
    return (index) => 2 * index;
  });
  expect(await pages(list)).toEqual(["a1", "a2", "a4", "a6", "a7", "a8"]);
  expect(still.map((page) => list.order.indexOf(page))).toEqual([4]);
  list.order.putBack(leaf);
  expect(await pages(list)).toEqual(["a1", "a2", "a3", "a4", "a5", "a6", "a7", "a8"]);
});

test("a source that sets its pages anew keeps the places of its pages and of others", async () => {
  const growing = { ...source("a", 4) };
  let announce: ((change: () => NewIndex) => void) | undefined;
  growing.watchPages = (listener) => {
    announce = listener;
  };
  const list = new PageList(growing);
  list.splice(2, 0, source("b", 1));
  list.splice(1, 1, null);
  expect(await pages(list)).toEqual(["a1", "b1", "a3", "a4"]);
  const moves: NewIndex[] = [];
  list.watchPages((change) => moves.push(change()));
  // Each page becomes two, and the first stays what it was.
  announce?.(() => {
    Object.assign(growing, { pageCount: 8 });
    return Object.assign((index: number) => (index < 2 ? 2 * index : null), {
      placeOf: (index: number) => 2 * index,
    });
  });
  // What was taken out, a2, stays out.
  expect(await pages(list)).toEqual(["a1", "b1", "a2", "a4", "a5", "a6", "a7", "a8"]);
  const [moved] = moves;
  expect([0, 1, 2, 3].map((index) => moved?.(index))).toEqual([0, 1, null, null]);
  expect([0, 1, 2, 3].map((index) => moved?.placeOf?.(index))).toEqual([0, 1, 4, 6]);
});

test.each([
  ["a page's own", 3, 4],
  ["the one after the page before it", 2, 2],
  ["the first, if none is before it", 0, 0],
])("the place of a page after a change is %s", (_, index, place) => {
  const moved = (k: number): number | null => [null, 1, null, 4][k] ?? null;
  expect(placeOf(moved, index)).toBe(place);
});
