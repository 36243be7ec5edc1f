import { expect, test } from "vitest";
import {
  foldAt,
  isFoldOut,
  isTrimmed,
  type PrintedOn,
  panelsOf,
  placeOnLeaf,
} from "./page_place.ts";

const leaf = { width: 400, height: 600 };
const onLeaf = (width: number, height: number, on: PrintedOn = "left", isTrue = true) =>
  placeOnLeaf({ width, height }, leaf, isTrue, on);

test("a page of the book's size covers its leaf, and so does one of nearly its size", () => {
  for (const on of ["left", "right", "top", "bottom", "board"] as const) {
    expect(onLeaf(400, 600, on)).toEqual({ x: 0, y: 0, width: 1, height: 1 });
    expect(onLeaf(402, 600, on)).toEqual({ x: 0, y: 0, width: 1, height: 1 });
  }
  // The number of pixels of a scan says nothing about its size.
  expect(onLeaf(1600, 2400, "left", false)).toEqual({ x: 0, y: 0, width: 1, height: 1 });
});

test("a smaller page lies at the spine, as small as it is", () => {
  expect(onLeaf(300, 450)).toEqual({ x: 0, y: 0.125, width: 0.75, height: 0.75 });
  expect(onLeaf(300, 450, "right")).toEqual({ x: 0.25, y: 0.125, width: 0.75, height: 0.75 });
  expect(onLeaf(300, 450, "top")).toEqual({ x: 0.125, y: 0, width: 0.75, height: 0.75 });
  expect(onLeaf(300, 450, "bottom")).toEqual({ x: 0.125, y: 0.25, width: 0.75, height: 0.75 });
  expect(isTrimmed(onLeaf(300, 450))).toBe(true);
  // A little narrower: a margin.
  expect(isTrimmed(onLeaf(380, 600))).toBe(false);
  // A stamp would not be readable.
  const stamp = onLeaf(20, 30);
  expect([stamp.width, stamp.height]).toEqual([0.5, 0.5]);
});

test("nothing is stretched", () => {
  for (const isTrue of [true, false]) {
    for (const on of ["left", "right", "top", "bottom", "board"] as const) {
      for (const [width, height] of [
        [100, 900],
        [300, 500],
        [420, 600],
        [700, 600],
        [5000, 600],
        [401, 590],
      ]) {
        const place = onLeaf(width, height, on, isTrue);
        const shape = (place.width * leaf.width) / (place.height * leaf.height);
        expect(Math.abs(shape / (width / height) - 1)).toBeLessThan(0.02);
        if (on !== "board") expect(place.height).toBeLessThanOrEqual(1);
        if (on !== "board" && !isFoldOut(place)) expect(place.width).toBeLessThanOrEqual(1);
      }
    }
  }
});

test("a page clearly wider than the book folds out at the fore-edge, never at head or foot", () => {
  const right = onLeaf(600, 600);
  expect(right).toEqual({ x: 0, y: 0, width: 1.5, height: 1 });
  expect(isFoldOut(right)).toBe(true);
  expect(onLeaf(600, 600, "right")).toEqual({ x: -0.5, y: 0, width: 1.5, height: 1 });
  // No panel is wider than the page that it lies on.
  expect(panelsOf(right)).toEqual({ panels: 1, across: 1.5 - foldAt });
  for (const [width, panels] of [
    [780, 1],
    [784, 2],
    [1168, 2],
    [1172, 3],
    [9000, 3],
  ]) {
    const found = panelsOf(onLeaf(width, 600));
    expect(found.panels, `${width}`).toBe(panels);
    expect(found.across).toBeLessThan(foldAt);
  }
  expect(onLeaf(9000, 600).width).toBeCloseTo(3.89);
  expect(isFoldOut(onLeaf(440, 600))).toBe(false);
  expect(isFoldOut(onLeaf(800, 600, "top"))).toBe(false);
});

test("a scan folds out where it is as high as others and wider, and fits where it is as wide", () => {
  expect(isFoldOut(onLeaf(800, 600, "left", false))).toBe(true);
  const square = onLeaf(400, 400, "left", false);
  expect([square.width, square.height]).toEqual([1, expect.closeTo(2 / 3)]);
});

test("a cover is cut to its board, or lies upon it whole where it is quite another shape", () => {
  const wide = onLeaf(440, 600, "board");
  expect([wide.width, wide.height]).toEqual([1.1, 1].map((n) => expect.closeTo(n)));
  const tall = onLeaf(400, 660, "board");
  expect([tall.width, tall.height]).toEqual([1, 1.1].map((n) => expect.closeTo(n)));
  const square = onLeaf(600, 600, "board");
  expect([square.width, square.height]).toEqual([1, 2 / 3].map((n) => expect.closeTo(n)));
  const narrow = onLeaf(200, 600, "board");
  expect([narrow.width, narrow.height]).toEqual([0.5, 1].map((n) => expect.closeTo(n)));
});
