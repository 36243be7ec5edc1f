/** The peel's geometry, against what paper can do. */

import { expect, test } from "vitest";
import { beyond, foldLineOf, mirrored, type Point, partOf, withinReach } from "./fold_line.ts";

const [width, height] = [0.14, 0.21];
const page: Point[] = [
  [0, 0],
  [width, 0],
  [width, height],
  [0, height],
];

const area = (polygon: readonly Point[]): number =>
  Math.abs(
    polygon.reduce((sum, [x, y], k) => {
      const [x1, y1] = polygon[(k + 1) % polygon.length];
      return sum + x * y1 - x1 * y;
    }, 0) / 2,
  );

/** Places from well off one side of the book to well off the other. */
const places: Point[] = [];
for (let x = -0.3; x <= 0.31; x += 0.06) {
  for (let y = -0.15; y <= 0.4; y += 0.055) places.push([x, y]);
}

test("wherever it is pulled, a leaf stays at its spine", () => {
  for (const rest of [
    [width, 0],
    [width, height],
    [width, 0.1],
    [0.06, 0],
  ] as Point[]) {
    for (const place of places) {
      const line = foldLineOf(rest, withinReach(rest, place, height));
      if (line === null) continue;
      expect(beyond(line, [0, 0])).toBeLessThan(2e-4);
      expect(beyond(line, [0, height])).toBeLessThan(2e-4);
    }
  }
});

test("a point within reach is held where the pointer is, and lies under it", () => {
  const rest: Point = [width, 0];
  for (const place of [
    [0.1, 0.03],
    [0, 0.05],
    [-0.1, 0.02],
  ] as Point[]) {
    expect(withinReach(rest, place, height)).toEqual(place);
    const line = foldLineOf(rest, place);
    if (line === null) throw new Error("no line");
    const [x, y] = mirrored(line, rest);
    expect(x).toBeCloseTo(place[0], 12);
    expect(y).toBeCloseTo(place[1], 12);
  }
  expect(foldLineOf(rest, rest)).toBeNull();
});

test("a fold line cuts a leaf in two that make it up, and folding stretches nothing", () => {
  const rest: Point = [width, 0];
  for (const place of places) {
    const line = foldLineOf(rest, withinReach(rest, place, height));
    if (line === null) continue;
    const [lifted, flat] = [partOf(page, line, 1), partOf(page, line, -1)];
    expect(area(lifted) + area(flat)).toBeCloseTo(area(page), 9);
    const over = lifted.map((point) => mirrored(line, point));
    expect(area(over)).toBeCloseTo(area(lifted), 9);
    for (const point of over) expect(beyond(line, point)).toBeLessThan(1e-9);
  }
});

test("fully turned, the leaf is its own mirror image in the spine", () => {
  const line = foldLineOf([width, 0.03], withinReach([width, 0.03], [-width, 0.03], height));
  expect(line?.at[0]).toBeCloseTo(0, 9);
  expect(line?.normal[0]).toBeCloseTo(1, 9);
  if (line) expect(partOf(page, line, 1).length).toBe(4);
});
