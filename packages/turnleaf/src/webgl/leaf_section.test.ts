import { expect, test } from "vitest";
import type { Surface } from "../engine/shapes.ts";
import { LeafSection } from "./leaf_section.ts";

const [columns, rows, width, height] = [9, 5, 0.14, 0.2];

/** Returns a flat leaf on the right, `above` the table. */
function flatLeaf(above: number): Surface {
  const positions = new Float32Array(3 * columns * rows);
  for (let row = 0; row < rows; row++) {
    for (let column = 0; column < columns; column++) {
      const x = (width * column) / (columns - 1);
      positions.set([x, (height * row) / (rows - 1), above], 3 * (row * columns + column));
    }
  }
  return { columns, rows, positions, normals: positions, version: 1 };
}

test("upright planes find the leaf in every row", () => {
  const section = new LeafSection(25, height);
  section.cut(flatLeaf(0.03), 1, 0, 0, 4);
  for (let row = 0; row < 25; row++) {
    expect(section.counts[row]).toBeGreaterThanOrEqual(6);
    const points = section.row(row).subarray(0, section.counts[row]);
    const xs = [...points].filter((_, k) => k % 2 === 0);
    expect(Math.max(...xs)).toBeCloseTo(width, 6);
    for (let k = 1; k < points.length; k += 2) expect(points[k]).toBeCloseTo(0.03, 6);
  }
});

test("the shadow of a raised leaf falls toward the foot, that of one at rest nowhere else", () => {
  const section = new LeafSection(25, height);
  section.cut(flatLeaf(0.04), 1, 0.5, 0, 4);
  // 0.02 m toward the foot: the two uppermost rows are free.
  expect(section.counts[24]).toBe(0);
  expect(section.counts[23]).toBe(0);
  expect(section.counts[21]).toBeGreaterThan(0);
  expect(section.counts[0]).toBeGreaterThan(0);
  section.cut(flatLeaf(0.04), 1, 0.5, 0.04, 4);
  expect(section.counts[24]).toBeGreaterThan(0);
});

test("the left side is mirrored", () => {
  const section = new LeafSection(25, height);
  section.cut(flatLeaf(0.01), -1, 0, 0, 4);
  const xs = [...section.row(3).subarray(0, section.counts[3])].filter((_, k) => k % 2 === 0);
  expect(Math.min(...xs)).toBeCloseTo(-width, 6);
});
