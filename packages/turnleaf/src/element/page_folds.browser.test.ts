/** Pages folded along lines: seen, listed, kept, turned with their leaves, opened and rejected. */

import { afterEach, beforeEach, expect, test, vi } from "vitest";
import type { TurnleafBook } from "../element.ts";
import { bookOverDark } from "../for_tests/element_books.ts";
import { eventually } from "../for_tests/eventually.ts";

beforeEach(() => localStorage.clear());
afterEach(() => {
  document.body.replaceChildren();
  vi.restoreAllMocks();
});

const at = (x: number, y: number) => ({ x, y });

const upright = [at(0.6, 0), at(0.6, 1)] as const;

test("a letter is folded in three, at once or one after the other, and turns as a leaf", async () => {
  const element = await bookOverDark();
  const [outer, inner] = [
    element.fold(5, at(0.7, 0), at(0.7, 1), 175),
    element.fold(5, at(0.4, 0), at(0.4, 1)),
  ];
  expect(await Promise.all([outer, inner])).toEqual([true, true]);
  expect(element.folds.map(({ angle }) => angle)).toEqual([175, 160]);
  await eventually(() => element.state).toBe("resting");
  expect(await element.next()).toBe(true);
  expect(await element.previous()).toBe(true);
  expect([element.page, element.folds.length]).toEqual([4, 2]);
});

test("a second fold of a page is seen to be made, once the first lies", async () => {
  const element = await bookOverDark();
  expect(await element.fold(5, at(0.7, 0), at(0.7, 1), 175)).toBe(true);
  expect(element.state).toBe("resting");
  const begun = performance.now();
  expect(await element.fold(5, at(0.4, 0), at(0.4, 1))).toBe(true);
  // Half a second of its own, without the frames before the first tick.
  expect(performance.now() - begun).toBeGreaterThan(400);
});

test("lines that no page can be folded along are rejected in one sentence", async () => {
  const element = await bookOverDark();
  expect(await element.fold(5, ...upright)).toBe(true);
  const rejected = [
    [element.fold(5, at(0, 0.5), at(1, 0.5)), "meets its spine"],
    [element.fold(5, at(0.62, 0), at(0.62, 1)), "too near"],
    [element.fold(5, at(0.5, 0.5), at(0.5, 0.5)), "two places"],
    [element.fold(5, at(0.5, 0), at(Number.NaN, 1)), "two places"],
    [element.fold(5, at(0.5, 0), at(0.5, 1), 181), "180 degrees"],
    [element.fold(5, at(0.5, 0), at(0.5, 1), Number.NaN), "180 degrees"],
  ] as const;
  for (const [folded, reason] of rejected) {
    await expect(folded).rejects.toThrow(reason);
    await expect(folded).rejects.toThrow(/^[^\n]+\.$/);
  }
  expect(await element.fold(99, ...upright)).toBe(false);
  expect(element.folds).toHaveLength(1);
});

test("folds that a leaf does not take are not listed, and later ones are made", async () => {
  const element = await bookOverDark();
  const fits = { page: 7, from: at(0.5, 0), to: at(0.5, 1), angle: 160 };
  const near = [0.6, 0.62].map((x) => ({ page: 5, from: at(x, 0), to: at(x, 1), angle: 160 }));
  element.folds = [...near, fits];
  expect(element.folds).toHaveLength(3);
  await eventually(() => element.folds).toEqual([fits]);
  expect(await element.fold(5, ...upright)).toBe(true);
  expect(element.folds).toHaveLength(2);
});

test("folds stay over a reload, on both sides of a leaf, and what is no fold is left out", async () => {
  const first = await bookOverDark({ remember: "" });
  const folds = [
    { page: 5, from: at(0.6, 0), to: at(0.7, 1), angle: 160 },
    { page: 4, from: at(0.3, 0), to: at(0.3, 1), angle: -150 },
  ];
  const wrong = [null, {}, { ...folds[0], page: 0 }, { ...folds[0], angle: Number.NaN }];
  first.folds = [...wrong, ...folds] as unknown as TurnleafBook["folds"];
  expect(first.folds).toEqual(folds);
  first.remove();
  const again = await bookOverDark({ remember: "" });
  expect(again.folds).toEqual(folds);
  again.folds = [];
  again.remove();
  expect((await bookOverDark({ remember: "" })).folds).toEqual([]);
});
