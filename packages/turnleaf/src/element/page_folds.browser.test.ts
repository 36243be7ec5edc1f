/** Pages folded along lines: seen, listed, kept, turned with their leaves, opened and rejected. */

import { afterEach, beforeEach, expect, test, vi } from "vitest";
import type { TurnleafBook } from "../element.ts";
import { clock, eventually } from "../for_tests/clock.ts";
import {
  book,
  bookOverDark,
  happens,
  keepWhatIsDrawn,
  scans,
  settled,
} from "../for_tests/element_books.ts";

keepWhatIsDrawn();

beforeEach(() => localStorage.clear());
afterEach(() => {
  document.body.replaceChildren();
  vi.restoreAllMocks();
});

const at = (x: number, y: number) => ({ x, y });
const upright = [at(0.6, 0), at(0.6, 1)] as const;

/** Returns what is drawn of the outer third of the open page on the right, in grey. */
const outerThird = (element: TurnleafBook): number[] => drawnOf(element, 1 / 3);

/** Returns what is drawn of so much of the open page on the right, from its fore-edge, in grey. */
function drawnOf(element: TurnleafBook, part: number): number[] {
  const drawn = element.shadowRoot?.querySelector("canvas") as HTMLCanvasElement;
  const { right, top, width, height } = element.bookBounds as DOMRect;
  const scale = drawn.width / element.getBoundingClientRect().width;
  const copy = document.createElement("canvas");
  const side = 40;
  copy.width = copy.height = side;
  const pen = copy.getContext("2d") as CanvasRenderingContext2D;
  const across = (part * width) / 2;
  const from = [right - across, top, across, height].map((x) => x * scale);
  pen.drawImage(drawn, from[0], from[1], from[2], from[3], 0, 0, side, side);
  const { data } = pen.getImageData(0, 0, side, side);
  return Array.from({ length: side * side }, (_, k) => data[4 * k]);
}

/** Returns the mean difference of two pictures, of 255. */
const difference = (a: readonly number[], b: readonly number[]): number =>
  a.reduce((sum, grey, k) => sum + Math.abs(grey - b[k]), 0) / a.length;

test("a page is folded along a line and seen, is listed, and is opened again", async () => {
  const element = await bookOverDark();
  const flat = outerThird(element);
  const changed = happens(element, "foldchange");
  expect(await element.fold(5, ...upright)).toBe(true);
  const fold = { page: 5, from: upright[0], to: upright[1], angle: 160 };
  expect(await changed).toEqual({ folds: [fold] });
  expect([element.folds, element.bookmarks]).toEqual([[fold], []]);
  await eventually(() => element.state).toBe("resting");
  await settled(element);
  const folded = difference(flat, outerThird(element));
  expect(folded).toBeGreaterThan(5);
  expect(await element.unfold(5)).toBe(true);
  expect(element.folds).toEqual([]);
  await eventually(() => element.state).toBe("resting");
  await settled(element);
  expect(difference(flat, outerThird(element))).toBeLessThan(folded / 2);
});

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

test("what lies under a fold is lit while the leaf is in flight as it is at rest", async () => {
  const element = book(scans(12), { page: "5", cover: "none", duration: "300" });
  await happens(element, "load");
  await settled(element);
  const mean = (): number => {
    const greys = outerThird(element);
    return greys.reduce((sum, grey) => sum + grey) / greys.length;
  };
  const greys: number[] = [];
  let isFolded = false;
  const folded = element.fold(5, ...upright).then(() => {
    isFolded = true;
  });
  while (!isFolded) {
    await new Promise(requestAnimationFrame);
    greys.push(mean());
  }
  await folded;
  await settled(element);
  // The last frames before it lies are those of a leaf that is folded already.
  expect(Math.min(...greys.slice(-3))).toBeGreaterThan(0.9 * mean());
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

test("folds that come into sight open while no leaf turns, and at rest nothing is drawn", async () => {
  const element = await bookOverDark();
  const flat = outerThird(element);
  element.folds = [{ page: 5, from: upright[0], to: upright[1], angle: 160 }];
  const isFolded = () => difference(flat, outerThird(element)) > 5;
  await eventually(isFolded).toBe(true);
  await settled(element);
  clock.hold();
  const lay = async (page: number) => {
    await element.goTo(page, { motion: false });
    await clock.until(() => clock.isAsked || element.settled);
    clock.frames(1);
  };
  await lay(9);
  await clock.until(() => element.settled);
  await lay(5);
  const pressed = drawnOf(element, 1);
  expect([element.state, element.settled, clock.isAsked]).toEqual(["resting", false, true]);
  let frames = 0;
  await clock.until(() => {
    frames++;
    return element.settled;
  });
  // It is folded from the first picture on, and opens: what lies shut is all in view.
  expect(frames).toBeGreaterThan(12);
  expect(element.state).toBe("resting");
  const opened = drawnOf(element, 1);
  expect(difference(flat, outerThird(element))).toBeGreaterThan(5);
  expect(difference(pressed, opened)).toBeGreaterThan(0.5);
  expect(clock.isAsked).toBe(false);
  clock.frames(10);
  expect(drawnOf(element, 1)).toEqual(opened);
});
