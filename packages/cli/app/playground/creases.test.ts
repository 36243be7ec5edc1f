import { expect, test } from "vitest";
import { endsOf, isSameLine, readCreases, writeCreases } from "./creases.ts";

test("creases come back as they were written", () => {
  const creases = [
    { through: [62, 0, 100, 27], angle: 150 },
    { through: [50, 0, 50, 100], angle: -175 },
  ] as const;
  expect(readCreases(writeCreases(creases))).toEqual(creases);
  expect(readCreases(writeCreases([]))).toEqual([]);
});

test("a line goes on to the page's edges", () => {
  const near = (through: Parameters<typeof endsOf>[0], ends: readonly number[]) => {
    for (const [k, end] of endsOf(through).entries()) expect(end).toBeCloseTo(ends[k], 9);
  };
  near([50, 40, 50, 60], [50, 0, 50, 100]);
  near([60, 50, 40, 50], [100, 50, 0, 50]);
  near([70, 10, 90, 30], [60, 0, 100, 40]);
  near([90, 30, 70, 10], [100, 40, 60, 0]);
});

test("creases lie on the same line whatever their angles", () => {
  const line = { through: [62, 0, 100, 27], angle: 150 } as const;
  expect(isSameLine(line, { ...line, angle: 20 })).toBe(true);
  expect(isSameLine(line, { ...line, through: [62, 0, 100, 28] })).toBe(false);
});
