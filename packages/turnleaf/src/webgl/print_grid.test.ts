import { expect, test } from "vitest";
import { layPrint, placeOfPrint } from "./print_grid.ts";

test("a bitmap begins with a whole pixel, next to where its page is seen", () => {
  const { corner, size } = layPrint(415, 636.1, [820.3, 350.2], [612, 350], [1, 0]);
  expect(size).toEqual([415, 636.1]);
  expect(corner).toEqual([613, 32]);
});

test("its texels are pixels, but where the page rises out of the gutter: they end at the spine", () => {
  const sides = [
    { spine: [620, 350], outward: [1, 0], edge: 0, far: 415 },
    { spine: [1010, 350], outward: [-1, 0], edge: 415, far: 0 },
  ] as const;
  for (const { spine, outward, edge, far } of sides) {
    const grid = layPrint(415, 636, [815.5, 350], spine, outward);
    const [left, top] = grid.corner;
    expect(grid.shortened).toBeCloseTo(Math.abs(spine[0] - (left + edge)), 9);
    expect(placeOfPrint(grid, [edge, 10])[0]).toBeCloseTo(spine[0], 9);
    // From a sixteenth of the page on nothing is bent.
    for (const fraction of [0.06, 0.5, 1]) {
      const x = edge + fraction * (far - edge);
      expect(placeOfPrint(grid, [x, 10])).toEqual([left + x, top + 10]);
    }
    // Nothing runs back, and nothing is stretched.
    let before: number = spine[0];
    for (let k = 1; k <= 100; k++) {
      const [x] = placeOfPrint(grid, [edge + (k / 100) * (far - edge), 10]);
      const step = outward[0] * (x - before);
      expect(step).toBeGreaterThan(0);
      expect(step).toBeLessThan(4.15 + 1e-9);
      before = x;
    }
  }
});

test("bound at the top it is bent along the other axis", () => {
  const grid = layPrint(600, 400, [500, 560], [500, 366], [0, 1]);
  expect(placeOfPrint(grid, [300, 0])).toEqual([500, expect.closeTo(366, 9)]);
  expect(placeOfPrint(grid, [300, 100])).toEqual([500, 460]);
});
