import { expect, test } from "vitest";
import { facetsOf } from "./facets.ts";

test("facets cover the sheet once, four to a cell, each with a part of its own", () => {
  const [columns, rows] = [7, 5];
  const { places, triangles, parts } = facetsOf(columns, rows);
  const areas = new Map<number, number>();
  for (const [k, part] of parts.entries()) {
    const [a, b, c] = [0, 1, 2].map((corner) => {
      const point = triangles[3 * k + corner];
      return [places[2 * point], places[2 * point + 1]];
    });
    const twice = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    // Around as u to v does, each within one side of a cell.
    expect(twice).toBeGreaterThan(0);
    areas.set(part, (areas.get(part) ?? 0) + twice / 2);
  }
  expect(areas.size).toBe(4 * 3 * 2);
  expect(Math.min(...areas.keys())).toBe(1);
  for (const area of areas.values()) expect(area).toBeCloseTo(1 / 24, 6);
});
