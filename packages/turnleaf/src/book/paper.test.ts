import { expect, test } from "vitest";
import { scaleOf } from "./paper.ts";

const page = { width: 0.14, height: 0.21, quarterTurned: false };

test("a book is as many times as large as it is drawn as its page is wider", () => {
  expect(scaleOf(0.21, page)).toBeCloseTo(1.5);
  // Bound at its head, the engine's book is as high as its page is wide.
  expect(scaleOf(0.42, { ...page, quarterTurned: true })).toBeCloseTo(2);
});

test("a width that is not known, or that no page has, is that of the drawn page", () => {
  for (const none of [undefined, 0, -1, Number.NaN, 6, 1e-9]) expect(scaleOf(none, page)).toBe(1);
});
