import { expect, test } from "vitest";
import type { TextRun } from "../sources/page_source.ts";
import { boundsOf, cutBoxes, cutRuns } from "./cut_to_page.ts";

const page = boundsOf({ width: 200, height: 300 }, false);
const run = (box: Partial<TextRun>): TextRun => ({
  x: 20,
  y: 30,
  width: 100,
  height: 10,
  text: "abcd",
  angle: 0,
  end: true,
  ...box,
});

test("boxes end at their page, and those beyond it are left out", () => {
  const boxes = [
    { x: -9000, y: -9000, width: 18_000, height: 18_000 },
    { x: 190, y: 10, width: 20, height: 20 },
    { x: 10, y: 10, width: 20, height: 20 },
    { x: 201, y: 10, width: 20, height: 20 },
    { x: Number.NaN, y: 10, width: 20, height: 20 },
  ];
  expect(cutBoxes(boxes, page)).toEqual([
    { x: 0, y: 0, width: 200, height: 300 },
    { x: 190, y: 10, width: 10, height: 20 },
    { x: 10, y: 10, width: 20, height: 20 },
  ]);
});

test("a box of a scrolled page reaches into those before and after it", () => {
  const [box] = cutBoxes([{ x: -5, y: 290, width: 20, height: 9000 }], boundsOf(page, true));
  expect(box).toEqual({ x: 0, y: 290, width: 15, height: 310 });
});

test("text on its page stays as it is", () => {
  const runs = [run({}), run({ angle: 1 }), run({ vertical: true, width: 10, height: 100 })];
  for (const [k, cut] of cutRuns(runs, page).entries()) expect(cut).toBe(runs[k]);
});

test("text is cut where its page ends, and letters that are left stay in their places", () => {
  const [cut] = cutRuns([run({ x: -50, y: -5 })], page);
  expect(cut).toMatchObject({ x: 0, y: 0, width: 50, height: 5, text: "abcd" });
  expect(cut?.places).toEqual([0, 0, 0, 0.5]);
  const [tall] = cutRuns([run({ vertical: true, x: 10, width: 10, y: 250, height: 100 })], page);
  expect(tall).toMatchObject({ x: 10, width: 10, y: 250, height: 50, places: [0, 0.5, 1, 1] });
  const [turned] = cutRuns([run({ x: 30, y: 250, angle: Math.PI / 2 })], page);
  expect(turned?.width).toBeCloseTo(50);
  expect(turned?.height).toBeCloseTo(10);
});

test("text beyond its page has no size, and is counted", () => {
  const runs = [run({ x: 500 }), run({ y: -100, angle: 0.1 }), run({ width: 0 })];
  for (const { width, height } of cutRuns(runs, page)) expect(width * height).toBe(0);
});
