/** Pages folded along lines: seen, listed, kept, turned with their leaves, opened and rejected. */

import { afterEach, beforeEach, expect, test, vi } from "vitest";
import type { TurnleafBook } from "../element.ts";
import { clock } from "../for_tests/clock.ts";
import {
  book,
  bookOverDark,
  drawRoughly,
  happens,
  keepWhatIsDrawn,
  scans,
  settled,
} from "../for_tests/element_books.ts";
import { eventually } from "../for_tests/eventually.ts";

keepWhatIsDrawn();
drawRoughly();

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
