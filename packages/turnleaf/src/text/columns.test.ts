import { expect, test } from "vitest";
import type { TextRun } from "../sources/page_source.ts";
import { columnAt, columnsOf } from "./columns.ts";

const size = { width: 600, height: 800 };
const run = (x: number, y: number, width: number, text = "words"): TextRun => {
  return { text, x, y, width, height: 10, angle: 0, end: true };
};
/** Lines of a column, the last one short, each in two runs with a blank between them. */
const column = (x: number, width: number): TextRun[] =>
  Array.from({ length: 20 }, (_, k) => [
    run(x, 100 + 12 * k, width / 2 - 3),
    ...(k === 19 ? [] : [run(x + width / 2, 100 + 12 * k, width / 2)]),
  ]).flat();

test("the column of two in which a place lies is found, under a heading over both", () => {
  const runs = [run(50, 60, 500, "A heading"), ...column(50, 235), ...column(315, 235)];
  expect(columnAt(runs, size, { x: 0.2, y: 0.2 })).toEqual({ from: 50 / 600, to: 285 / 600 });
  expect(columnAt(runs, size, { x: 0.8, y: 0.3 })).toEqual({ from: 315 / 600, to: 550 / 600 });
  // At the foot of a column, where no line is near.
  expect(columnAt(runs, size, { x: 0.8, y: 0.95 })).toEqual({ from: 315 / 600, to: 550 / 600 });
});

test("text in one column, and a page without text, have none", () => {
  expect(columnAt(column(50, 500), size, { x: 0.2, y: 0.2 })).toBeNull();
  expect(columnAt([], size, { x: 0.5, y: 0.5 })).toBeNull();
});

test("the columns of a page are those that lines of it stand in, from left to right, without headings and captions", () => {
  const runs = [
    run(50, 60, 500, "A heading over both"),
    run(200, 75, 180, "An author"),
    ...column(315, 235),
    ...column(50, 235),
  ];
  expect(columnsOf(runs, size)).toEqual([
    { from: 50 / 600, to: 285 / 600 },
    { from: 315 / 600, to: 550 / 600 },
  ]);
  const three = [...column(40, 160), ...column(220, 160), ...column(400, 160)];
  expect(columnsOf(three, size)).toHaveLength(3);
  expect(columnsOf(column(50, 500), size)).toEqual([]);
  expect(columnsOf([], size)).toEqual([]);
});
