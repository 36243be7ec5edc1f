/** What of leaves lies on other paper, and how it shades it. */

import { expect, test } from "vitest";
import type { PaperMesh } from "../paper_mesh.ts";
import { leafPapers } from "./leaf_papers.ts";
import { outlinesOf } from "./part_outlines.ts";
import type { Surface } from "./shapes.ts";

/** A square whose corner at (1, 0) can be folded along the line from (0.7, 0) to (1, 0.3). */
const mesh: PaperMesh = {
  places: Float32Array.from([0, 0, 0.7, 0, 1, 0, 1, 0.3, 1, 1, 0, 1]),
  triangles: Uint32Array.from([0, 1, 3, 0, 3, 4, 0, 4, 5, 1, 2, 3]),
  parts: Uint16Array.from([0, 0, 0, 1]),
};

/** Returns the square with the corner turned up by degrees toward the recto. */
function folded(degrees: number): Surface {
  const positions = new Float32Array(18);
  for (let k = 0; k < 6; k++) positions.set(mesh.places.subarray(2 * k, 2 * k + 2), 3 * k);
  const away = 0.3 / Math.SQRT2;
  const angle = (degrees / 180) * Math.PI;
  const [along, up] = [away * Math.cos(angle), away * Math.sin(angle)];
  // The middle of the crease, and from there outward.
  positions.set([0.85 + along / Math.SQRT2, 0.15 - along / Math.SQRT2, up], 6);
  const leaf = { columns: 3, rows: 2, normals: positions, version: 1, creased: mesh };
  return { ...leaf, positions, papers: leafPapers };
}

test.each([
  ["to the recto", 160, 1, 0],
  ["to the verso", -160, 0, 1],
  ["to the recto, but not past a right angle", 80, 0, 0],
])("a corner that is folded %s shades that side alone", (_, degrees, recto, verso) => {
  const leaf = folded(degrees);
  expect(leafPapers.flapsOn(leaf, 1)).toHaveLength(recto);
  expect(leafPapers.flapsOn(leaf, -1)).toHaveLength(verso);
  expect(leafPapers.flapsOf(leaf)).toHaveLength(recto + verso);
  for (const { data, low, high, top } of leafPapers.flapsOf(leaf)) {
    expect(low[0]).toBeCloseTo(0.7, 6);
    expect(high[1]).toBeCloseTo(0.3, 6);
    expect(top).toBeCloseTo(Math.max(0, leaf.positions[8]), 6);
    // Three edges, and a plane that is seen from above.
    expect(data[7]).toBe(3);
    expect(data[2]).toBeCloseTo(Math.cos((20 / 180) * Math.PI), 6);
  }
});

test("a flap has no edge at its crease as its own leaf sees it, and one as others do", () => {
  const leaf = folded(160);
  const inward = (data: Float32Array) =>
    [0, 1, 2].filter((edge) => data.subarray(8 + 12 * edge, 11 + 12 * edge).some((x) => x !== 0));
  expect(inward(leafPapers.flapsOn(leaf, 1)[0].data)).toHaveLength(2);
  expect(inward(leafPapers.flapsOf(leaf)[0].data)).toHaveLength(3);
});

test("the outline of a page without a corner has five edges, and one of them is the crease", () => {
  const [page, corner] = outlinesOf(folded(160));
  expect(page.edges).toHaveLength(5);
  expect(page.edges.filter(({ beyond }) => beyond === 1)).toHaveLength(1);
  expect(corner.edges.map(({ beyond }) => beyond).sort()).toEqual([-1, -1, 0]);
});

/** Returns a sheet of 5 x 5 points, two metres wide and long, at heights. */
function sheet(height: (x: number, y: number) => number): Surface {
  const at = [...Array(25).keys()].map((k) => [(k % 5) / 2, Math.floor(k / 5) / 2]);
  const positions = Float32Array.from(at.flatMap(([x, y]) => [x, y, height(x, y)]));
  return { columns: 5, rows: 5, positions, normals: positions, version: 1 };
}

test("what is bent far from its plane shades less, and what stands shades nothing that it does not lie on", () => {
  const strength = (height: (x: number, y: number) => number, lies = false) =>
    -1 - leafPapers.papersOf(sheet(height), lies)[0].data[4];
  expect(strength(() => 0.01)).toBeCloseTo(1, 6);
  const bent = strength((x) => 0.3 * x * (2 - x));
  expect(bent).toBeGreaterThan(0.05);
  expect(bent).toBeLessThan(0.95);
  expect(strength((x) => x * (2 - x))).toBe(0);
  expect(strength((x) => 1.5 * x)).toBeCloseTo(1, 6);
  expect(strength((x) => 1.5 * x, true)).toBe(0);
});

test("what is crumpled shades as far out as it is", () => {
  const flat = sheet(() => 0.01);
  const facets = {
    places: Float32Array.from(flat.positions.filter((_, k) => k % 3 < 2)),
    triangles: Uint32Array.from([...Array(48).keys()].map((k) => k % 25)),
    parts: Uint16Array.from([...Array(16).keys()]),
  };
  const [ball, ...others] = leafPapers.papersOf({ ...flat, creased: facets });
  expect(others).toHaveLength(0);
  expect(ball.low[0]).toBeCloseTo(-0.1, 5);
  expect(ball.high[0]).toBeCloseTo(2.1, 5);
  expect(ball.top).toBeCloseTo(0.01, 6);
});
