import { expect, test } from "vitest";
import {
  bind,
  isBoard,
  leafCount,
  leftPage,
  pageOf,
  paperLeaves,
  paperOnLeft,
  rightPage,
  spreadOf,
  waypoints,
} from "./spreads.ts";

test("a book of eight pages has two boards and two leaves of paper", () => {
  const book = bind(8, "hard");
  expect(leafCount(book)).toBe(4);
  expect(paperLeaves(book)).toBe(2);
  expect([0, 1, 2, 3].map((k) => isBoard(book, k))).toEqual([true, false, false, true]);
  expect([0, 1, 2, 3, 4].map((s) => [leftPage(book, s), rightPage(book, s)])).toEqual([
    [null, 1],
    [2, 3],
    [4, 5],
    [6, 7],
    [8, null],
  ]);
  expect([0, 1, 2, 3, 4].map((s) => paperOnLeft(book, s))).toEqual([0, 0, 1, 2, 2]);
});

test("an odd last page has nothing on its back", () => {
  const book = bind(7, "none");
  expect(leafCount(book)).toBe(4);
  expect([leftPage(book, 4), rightPage(book, 4)]).toEqual([null, null]);
  expect(rightPage(book, 3)).toBe(7);
  expect(pageOf(book, 4)).toBe(7);
});

test("a book too thin for boards has none", () => {
  for (const pages of [1, 2, 3, 4]) expect(bind(pages, "hard").hardCover).toBe(false);
  expect(bind(5, "hard").hardCover).toBe(true);
});

test("every page is shown by its spread", () => {
  for (let pages = 1; pages < 40; pages++) {
    const book = bind(pages, "hard");
    for (let page = 1; page <= pages; page++) {
      const s = spreadOf(book, page);
      expect([leftPage(book, s), rightPage(book, s)]).toContain(page);
    }
  }
});

test("page numbers outside the book are clamped, nonsense is the first page", () => {
  const book = bind(20, "hard");
  expect(spreadOf(book, 999)).toBe(10);
  expect(spreadOf(book, -5)).toBe(0);
  expect(spreadOf(book, Number.NaN)).toBe(0);
  expect(pageOf(book, 0)).toBe(1);
  expect(pageOf(book, 3)).toBe(6);
});

test("a short way turns every leaf, a long one a few that stand for many", () => {
  const book = bind(400, "none");
  expect(waypoints(book, 3, 7)).toEqual([4, 5, 6, 7]);
  expect(waypoints(book, 7, 3)).toEqual([6, 5, 4, 3]);
  expect(waypoints(book, 5, 5)).toEqual([]);
  expect(waypoints(book, 0, 12).length).toBe(12);
  for (const [from, to] of [
    [0, 13],
    [0, 200],
    [170, 31],
  ]) {
    const way = waypoints(book, from, to);
    expect(way.length).toBe(9);
    expect(way.at(-1)).toBe(to);
    const steps = way.map((spread, k) => Math.abs(spread - (way[k - 1] ?? from)));
    expect(Math.max(...steps) - Math.min(...steps)).toBeLessThanOrEqual(1);
  }
});

test("boards turn by themselves", () => {
  const book = bind(40, "hard");
  expect(waypoints(book, 0, 4)).toEqual([1, 2, 3, 4]);
  expect(waypoints(book, 1, 0)).toEqual([0]);
  expect(waypoints(book, 18, 20)).toEqual([19, 20]);
  const through = waypoints(book, 20, 0);
  expect([through[0], through.at(-2), through.at(-1)]).toEqual([19, 1, 0]);
  expect(through.length).toBe(2 + 9);
});
