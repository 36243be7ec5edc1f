import { expect, test } from "vitest";
import type { Pile } from "../engine/shapes.ts";
import type { BookShape } from "./book_pose.ts";
import { areStapled, showsStaples, stapleLegs } from "./staples.ts";

/** Returns a pile of some height. */
const pile = (height: number): Pile => ({
  columns: 2,
  layers: 1,
  curves: Float32Array.of(0, 0, 0.1, height),
});

test("a thin set of whole sheets without boards is stapled, and no single sheet", () => {
  const set = { cover: "none", leaves: 6, thickness: 0.0006 } as const;
  expect(areStapled(set)).toBe(true);
  expect(areStapled({ ...set, cover: "hard" })).toBe(false);
  expect(areStapled({ ...set, thickness: 0.02 })).toBe(false);
  for (const leaves of [1, 2, 5]) expect(areStapled({ ...set, leaves })).toBe(false);
});

test("staples are seen where the set lies open in its middle, and while a leaf leaves that or comes there", () => {
  const shape = { isStapled: true, thickness: 0.0006, leaves: 6 } as BookShape;
  const seen = (left: number, right: number): boolean =>
    showsStaples(shape, {
      left: left > 0 ? pile(left * 1e-4) : null,
      right: right > 0 ? pile(right * 1e-4) : null,
    });
  expect(seen(3, 3)).toBe(true);
  expect([seen(3, 2), seen(2, 3)]).toEqual([true, true]);
  expect([seen(2, 4), seen(4, 2), seen(0, 6), seen(6, 0), seen(2, 2)]).toEqual(
    Array(5).fill(false),
  );
  expect(
    showsStaples({ ...shape, isStapled: false }, { left: pile(3e-4), right: pile(3e-4) }),
  ).toBe(false);
});

test("each staple has two legs of equal length", () => {
  const legs = stapleLegs(0.2);
  const ends = legs.map(([from, to]) => [from, to].map((at) => Math.round(at * 1e4) / 10));
  expect(ends).toEqual([
    [44, 49.5],
    [50.5, 56],
    [144, 149.5],
    [150.5, 156],
  ]);
});
