import { expect, test } from "vitest";
import { caseSizes } from "../stage/case_sizes.ts";
import { lidHeight, placeCase, restingCase } from "./case_shape.ts";

const [thickness, hinge] = [0.02, 0.006];
const bottom = -caseSizes.sink;

function placed(middle: number, front: number, back: number) {
  const shape = restingCase();
  placeCase(shape, thickness, middle, front, back, hinge);
  return shape;
}

test("an open case lies flat, with the spine under the block", () => {
  const shape = placed(0.003, Math.PI, 0);
  expect(shape.c[0]).toBeCloseTo(0.013, 12);
  expect(shape.d[0]).toBeCloseTo(-0.007, 12);
  expect(shape.frontHinge[0]).toBeCloseTo(-0.013, 12);
  expect(shape.backHinge[0]).toBeCloseTo(0.019, 12);
  for (const point of [shape.c, shape.d, shape.frontHinge, shape.backHinge]) {
    expect(point[1]).toBeCloseTo(bottom, 12);
  }
});

test("closed over the right block the spine stands up and the front board lies on top", () => {
  const shape = placed(0.01, 0, 0);
  expect(shape.c[0]).toBeCloseTo(0, 12);
  expect(shape.d[1]).toBeCloseTo(bottom + thickness, 12);
  expect(shape.frontHinge[1]).toBeCloseTo(bottom + thickness, 12);
  expect(shape.frontHinge[0]).toBeCloseTo(shape.backHinge[0], 12);
});

test("closing over the left mirrors closing over the right", () => {
  for (let k = 0; k <= 10; k++) {
    const angle = (Math.PI * k) / 10;
    const right = placed(0.01, angle, 0);
    const left = placed(-0.01, Math.PI, Math.PI - angle);
    expect(left.d[0]).toBeCloseTo(-right.c[0], 12);
    expect(left.backHinge[0]).toBeCloseTo(-right.frontHinge[0], 12);
    expect(left.backHinge[1]).toBeCloseTo(right.frontHinge[1], 12);
  }
});

test("no part of the case goes through the table, and the spine keeps its length", () => {
  for (let k = 0; k <= 100; k++) {
    const shape = placed(0.01, (Math.PI * k) / 100, 0);
    for (const point of [shape.c, shape.d, shape.frontHinge]) {
      expect(point[1]).toBeGreaterThanOrEqual(bottom - 1e-12);
    }
    expect(Math.hypot(shape.d[0] - shape.c[0], shape.d[1] - shape.c[1])).toBeCloseTo(thickness, 12);
  }
});

test("pages lie no higher than a board closed over them", () => {
  const shape = placed(0.01, 0, 0);
  expect(lidHeight(shape, 1, 0.1)).toBeCloseTo(bottom + thickness, 12);
  expect(lidHeight(shape, 1, 0)).toBeLessThan(thickness);
  expect(lidHeight(placed(0.01, Math.PI, 0), 1, 0.1)).toBe(Infinity);
});
