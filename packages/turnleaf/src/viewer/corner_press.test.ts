/** When a held corner is pressed, and where it lies then. */

import { expect, test } from "vitest";
import { Side } from "../engine/phases.ts";
import type { Ray } from "../engine/shapes.ts";
import { CornerPress } from "./corner_press.ts";

const shape = { width: 0.14, height: 0.21 };

/** A line of sight straight down upon a place. */
const over = (x: number, y: number): Ray => ({ origin: [x, y, 1], direction: [0, 0, -1] });

/** Steps frames of a tenth of a second over one place until something other than waiting comes. */
function press(corner: CornerPress | null, ray: Ray) {
  corner?.move({ x: 10, y: 10 });
  for (let frame = 1; frame <= 10; frame++) {
    const found = corner?.step(0.1, ray, 0);
    if (found !== null) return { found, frame };
  }
  return null;
}

test.each([
  { side: Side.right, v: 0.95, x: 0.107, y: 0.1805, corner: "head" },
  { side: Side.left, v: 0.05, x: -0.107, y: 0.0295, corner: "foot" },
])("a point near the $corner is folded to where it is held", ({ side, v, x, y, corner }) => {
  // 7 and 10.5 mm from the corner at first; 33 and 29.5 mm from it then: a fold at 45 degrees
  // that meets the edges 40 mm from the corner takes it there.
  const held = CornerPress.at(shape, side, 0.95, v);
  const pressed = press(held, over(x, y));
  // The first frame, in which the pointer came, does not count.
  expect(pressed?.frame).toBe(7);
  expect(pressed?.found?.corner).toBe(corner);
  const size = pressed?.found?.size ?? 0;
  expect(size * shape.width).toBeCloseTo(0.04, 6);
  const [foldedX, foldedY, up] = held?.folded(size, 0.002) ?? [];
  expect(foldedX).toBeCloseTo(Math.sign(x) * (0.14 - 0.0295), 6);
  expect(foldedY).toBeCloseTo(corner === "head" ? 0.21 - 0.033 : 0.033, 6);
  expect(up).toBeCloseTo(0.002 + (0.0225 / Math.SQRT2) * Math.sin(Math.PI / 9), 6);
});

test("a pointer that trembles rests, one that moves does not", () => {
  const corner = CornerPress.at(shape, Side.right, 1, 1);
  corner?.move({ x: 0, y: 0 });
  for (let frame = 0; frame < 5; frame++) {
    corner?.move({ x: frame % 2, y: 0 });
    expect(corner?.step(0.1, over(0.11, 0.18), 0)).toBeNull();
  }
  corner?.move({ x: 9, y: 0 });
  for (let frame = 0; frame < 6; frame++) {
    expect(corner?.step(0.1, over(0.11, 0.18), 0)).toBeNull();
  }
  expect(corner?.step(0.1, over(0.11, 0.18), 0)?.size).toBeCloseTo(0.03 / 0.14, 6);
});

test("one long frame is not taken for rest", () => {
  const corner = CornerPress.at(shape, Side.right, 1, 1);
  corner?.move({ x: 0, y: 0 });
  corner?.step(0.1, over(0.11, 0.18), 0);
  expect(corner?.step(5, over(0.11, 0.18), 0)).toBeNull();
});

test.each([
  ["along the spine", 0.139, 0.17],
  ["across the page", 0.08, 0.209],
  ["outward", 0.16, 0.23],
  ["farther than a corner is folded", 0.01, 0.08],
])("a pull %s folds nothing", (_, x, y) => {
  const corner = CornerPress.at(shape, Side.right, 1, 1);
  expect(press(corner, over(x, y))?.found).toBeUndefined();
});

test("only near a corner is one held", () => {
  for (const [u, v] of [
    [0.6, 1],
    [1, 0.5],
    [0.3, 0.05],
  ]) {
    expect(CornerPress.at(shape, Side.left, u, v)).toBeNull();
  }
});
