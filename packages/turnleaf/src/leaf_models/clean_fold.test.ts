import { expect, test } from "vitest";
import { cleanFold } from "./clean_fold.ts";

const columns = Float32Array.from({ length: 9 }, (_, k) => k / 8);
const rows = 5;
const height = 0.2;

/**
 * Returns a leaf whose outer half is folded over on the line of its middle; the
 * width is negative if it lay on the left.
 */
function folded(width: number): Float32Array {
  const points = new Float32Array(3 * columns.length * rows);
  for (let row = 0; row < rows; row++) {
    for (const [column, u] of columns.entries()) {
      const x = width * (u > 0.5 ? 1 - u : u);
      points.set([x, (height * row) / 4, 0], 3 * (row * columns.length + column));
    }
  }
  return points;
}

test.for([0.15, -0.15])(
  "of a leaf %f m wide the fold is a line, and light sees the side that shows",
  (width) => {
    const points = folded(width);
    const normals = cleanFold(points, columns, width, height);
    const recto = width > 0 ? -1 : 1;
    let onFold = 0;
    for (let at = 0; at < columns.length * rows; at++) {
      const u = columns[at % columns.length];
      const [x, , z] = points.subarray(3 * at, 3 * at + 3);
      if (Math.abs(u - 0.5) < 0.01) {
        onFold++;
        expect(x).toBeCloseTo(width / 2, 6);
        const normal = normals.get(at) ?? [0, 0, 0];
        expect(Math.hypot(...normal)).toBeCloseTo(1, 6);
        // The visible side faces up and, at the fold, outward.
        expect(Math.sign(normal[2])).toBe(recto);
        expect(Math.sign(normal[0]) * recto).toBe(Math.sign(width));
      }
      if (u > 0.6) expect(z).toBeGreaterThan(0);
      if (u < 0.4) expect(normals.has(at)).toBe(false);
    }
    expect(onFold).toBe(rows);
  },
);

test("a leaf that is not folded has no fold", () => {
  const points = folded(0.15);
  for (let at = 0; at < points.length / 3; at++) points[3 * at] = columns[at % 9] * 0.15;
  const before = points.slice();
  expect(cleanFold(points, columns, 0.15, height).size).toBe(0);
  expect(points).toEqual(before);
});
