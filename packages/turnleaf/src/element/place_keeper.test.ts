import { afterEach, expect, it, vi } from "vitest";
import { pageOfHash } from "../sources/page_hash.ts";
import { cleanPages } from "./page_numbers.ts";
import { anchorOfHash, hashWithPage, loadPlace, savePlace } from "./place_keeper.ts";

afterEach(() => vi.unstubAllGlobals());

/** Returns a storage that holds `text`. */
function storage(text: string | null = null): { text: string | null } {
  const held = { text };
  vi.stubGlobal("localStorage", {
    getItem: () => held.text,
    setItem: (_key: string, value: string) => {
      held.text = value;
    },
  });
  return held;
}

/** A place in a book with nothing on its pages. */
const plain = { page: 3, zoom: 1, bookmarks: [], shifts: [], folds: [], pageFolds: [], seen: {} };

it("keeps a book's place and gives it back", () => {
  storage();
  expect(loadPlace("a")).toBe(null);
  const place = { ...plain, page: 7, zoom: 1.5, bookmarks: [2, 9], shifts: [4] };
  savePlace("a", place);
  savePlace("c", { ...plain, seen: { tilt: "6", theme: "night", class: "x" } });
  expect(loadPlace("c")?.seen).toEqual({ tilt: "6", theme: "night" });
  savePlace("b", plain);
  expect(loadPlace("a")).toEqual(place);
  savePlace("a", { ...plain, page: 8 });
  expect(loadPlace("a")).toEqual({ ...plain, page: 8 });
  expect(loadPlace("b")?.page).toBe(3);
});

it("keeps the size of pages for which text is set, unless it is none", () => {
  storage();
  const text = { anchors: ["1:20"], typography: {}, size: { width: 343, height: 525.5 } };
  savePlace("a", { ...plain, text });
  expect(loadPlace("a")?.text).toEqual(text);
  for (const size of [[0, 10], [343], "343", [1e9, 500], [null, 500]]) {
    storage(JSON.stringify([["a", 3, 1, [], [], [["1:20"], {}, size]]]));
    expect(loadPlace("a")?.text).toEqual({ anchors: ["1:20"], typography: {} });
  }
});

it("keeps the numbers of pages of flowing text, with the size or without", () => {
  storage();
  const size = { width: 343, height: 525.5 };
  for (const known of [{ counts: "1abc.3.12" }, { size, counts: "1abc.3.12" }]) {
    const text = { anchors: ["1:20"], typography: {}, ...known };
    savePlace("a", { ...plain, text });
    expect(loadPlace("a")?.text).toEqual(text);
  }
});

it("forgets the books read longest ago where all are more than is read", () => {
  const held = storage();
  const text = { anchors: ["1:20"], typography: {}, counts: "1".repeat(9000) };
  for (let i = 1; i <= 60; i++) savePlace(`${i}`, { ...plain, page: i, text });
  expect(held.text?.length).toBeLessThan(400_001);
  expect(loadPlace("60")?.page).toBe(60);
  expect(loadPlace("30")?.page).toBe(30);
  expect(loadPlace("1")).toBe(null);
});

it("keeps a hundred books, the last read", () => {
  const held = storage();
  for (let i = 1; i <= 150; i++) savePlace(`${i}`, { ...plain, page: i });
  expect(loadPlace("50")).toBe(null);
  expect(loadPlace("51")?.page).toBe(51);
  expect(JSON.parse(held.text ?? "").length).toBe(100);
});

it("takes nothing from a storage that somebody else wrote", () => {
  const texts = [
    "",
    "{",
    "null",
    "{}",
    '"turnleaf"',
    "[[]]",
    '[["a"]]',
    '[[1,2,3,4],null,"a",{"0":"a"}]',
    `[["a",1,1,[]]${" ".repeat(500_000)}]`,
  ];
  for (const text of texts) {
    storage(text);
    expect(loadPlace("a")).toBe(null);
  }
  const rows: [string, number, number, number[]][] = [
    ['["a","7",99,["x",2,2,1,0,-1,1.5,1e9]]', 1, 1, [1, 2]],
    ['["a",1e300,null,{}]', 1, 1, []],
    ['["a",5,0.5,null]', 5, 1, []],
  ];
  for (const [row, page, zoom, bookmarks] of rows) {
    storage(`[${row}]`);
    expect(loadPlace("a")).toEqual({
      page,
      zoom,
      bookmarks,
      shifts: [],
      folds: [],
      pageFolds: [],
      seen: {},
    });
  }
});

it("keeps the folds of pages, and takes none that another code wrote wrong", () => {
  const held = storage();
  const fold = { page: 5, from: { x: 0.4, y: 0 }, to: { x: 0.5, y: 1 }, angle: -160 };
  const place = {
    page: 1,
    zoom: 1,
    bookmarks: [],
    shifts: [],
    folds: [],
    pageFolds: [fold],
    seen: {},
  };
  savePlace("a", place);
  expect(loadPlace("a")).toEqual(place);
  const rows = [
    [5, 0.4, 0, 0.5, 1, -160],
    [5, 0.4, 0, 0.5, 1, 181],
    [5, 0.4, 0, 0.4, 0, 90],
    [5, 0.4, 0, 1.5, 1, 90],
    [0, 0.4, 0, 0.5, 1, 90],
    [5, "0.4", 0, 0.5, 1, 90],
    [5, null],
    {},
    null,
  ];
  held.text = JSON.stringify([["a", 1, 1, [], [], null, [], rows]]);
  expect(loadPlace("a")?.pageFolds).toEqual([fold]);
  const many = Array.from({ length: 5000 }, (_, k) => [k + 1, 0.4, 0, 0.5, 1, 90]);
  held.text = JSON.stringify([["a", 1, 1, [], [], null, [], many]]);
  expect(loadPlace("a")?.pageFolds).toHaveLength(500);
});

it("lives without a storage, and with one that is full", () => {
  const kept = { ...plain, page: 1 };
  expect(() => savePlace("a", kept)).not.toThrow();
  expect(loadPlace("a")).toBe(null);
  vi.stubGlobal("localStorage", {
    getItem: () => null,
    setItem: () => {
      throw new Error("full");
    },
  });
  expect(() => savePlace("a", kept)).not.toThrow();
});

it("bounds the bookmarks", () => {
  const many = Array.from({ length: 20_000 }, (_, i) => 20_000 - i);
  const kept = cleanPages(many);
  expect(kept.length).toBe(500);
  expect(cleanPages("1,2")).toEqual([]);
});

it("reads the page from a fragment, wherever it stands in it", () => {
  const pages = ["#page=12", "#a=1&page=3&b", "#page=0", "#page=", "", "#page=1e3", "#mypage=4"];
  expect(pages.map(pageOfHash)).toEqual([12, 3, null, null, null, null, null]);
  expect(pageOfHash("#page=12345678")).toBe(null);
});

it("writes the page and leaves all else of the fragment as it is", () => {
  expect(hashWithPage("", 5)).toBe("#page=5");
  expect(hashWithPage("#", 5)).toBe("#page=5");
  expect(hashWithPage("#page=4", 5)).toBe("#page=5");
  expect(hashWithPage("#a=%20&page=4&b", 5)).toBe("#a=%20&page=5&b");
  expect(hashWithPage("#chapter-2", 5)).toBe("#chapter-2&page=5");
  expect(hashWithPage("#mypage=4", 5)).toBe("#mypage=4&page=5");
});

it("writes the anchor of the text beside the page, once, and takes it out with it", () => {
  expect(hashWithPage("", 5, "3:120")).toBe("#page=5&at=3:120");
  expect(hashWithPage("#page=4&at=2:7", 5, "3:120-1")).toBe("#page=5&at=3:120-1");
  expect(hashWithPage("#at=2:7", 5, "3:~0.2500")).toBe("#page=5&at=3:~0.2500");
  expect(hashWithPage("#at=2:7&a=1", 5)).toBe("#a=1&page=5");
  expect(hashWithPage("#a=1&page=4&at=2:7&b", 5, "3:1")).toBe("#a=1&page=5&at=3:1&b");
  const anchors = ["#page=1&at=3:120-1", "#at=0:~0.5000&b", "#att=1:2", "#at=", "#at=a b", ""];
  expect(anchors.map(anchorOfHash)).toEqual(["3:120-1", "0:~0.5000", null, null, null, null]);
});
