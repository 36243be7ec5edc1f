/** Corners folded over: seen, bookmarked, kept, turned with their leaves and opened. */

import { afterEach, beforeEach, expect, test } from "vitest";
import type { TurnleafBook } from "../element.ts";
import { clock } from "../for_tests/clock.ts";
import {
  bookOverDark,
  drawRoughly,
  happens,
  keepWhatIsDrawn,
  settled,
} from "../for_tests/element_books.ts";
import { eventually } from "../for_tests/eventually.ts";

keepWhatIsDrawn();
drawRoughly();

beforeEach(() => localStorage.clear());
afterEach(() => document.body.replaceChildren());

/** Returns what is drawn around the upper corner of the right page away from the spine, in grey. */
function cornerOf(element: TurnleafBook): number[] {
  const drawn = element.shadowRoot?.querySelector("canvas") as HTMLCanvasElement;
  const bounds = element.bookBounds as DOMRect;
  const host = element.getBoundingClientRect();
  const copy = document.createElement("canvas");
  const side = 40;
  copy.width = copy.height = side;
  const pen = copy.getContext("2d") as CanvasRenderingContext2D;
  const scale = drawn.width / host.width;
  const from = [bounds.right - 30, bounds.top - 2].map((x) => x * scale);
  pen.drawImage(drawn, from[0], from[1], 30 * scale, 30 * scale, 0, 0, side, side);
  const { data } = pen.getImageData(0, 0, side, side);
  return Array.from({ length: side * side }, (_, k) => data[4 * k]);
}

/** Returns the greatest difference of two pictures, of 255. */
const difference = (a: readonly number[], b: readonly number[]): number =>
  Math.max(...a.map((grey, k) => Math.abs(grey - b[k])));

/** Returns the fraction of two pictures' pixels that clearly differ. */
const differing = (a: readonly number[], b: readonly number[]): number =>
  a.filter((grey, k) => Math.abs(grey - b[k]) > 50).length / a.length;

test("a corner is folded and seen, bookmarks its page, and is opened again", async () => {
  const element = await bookOverDark();
  // Seen aslant, as how far a corner stands off its page is not seen from right above.
  element.tilt = 12;
  await settled(element);
  const flat = cornerOf(element);
  const changed = happens(element, "dogearchange");
  expect(await element.dogEar(5, "head", 0.3)).toBe(true);
  expect(await changed).toEqual({ dogEars: [{ page: 5, corner: "head", size: 0.3 }] });
  await settled(element);
  expect(element.bookmarks).toEqual([5]);
  expect(element.state).toBe("resting");
  const folded = differing(flat, cornerOf(element));
  expect(folded).toBeGreaterThan(0.1);
  expect(await element.unfold(5)).toBe(true);
  expect([element.dogEars, element.bookmarks]).toEqual([[], []]);
  await eventually(() => element.state).toBe("resting");
  await settled(element);
  await eventually(() => differing(flat, cornerOf(element))).toBeLessThan(folded / 4);
  // It stands off its page a little, and its line stays.
  expect(difference(flat, cornerOf(element))).toBeGreaterThan(8);
});

test("a corner that is opened while it is folded is opened, and one whose page is left stays folded", async () => {
  const element = await bookOverDark();
  const flat = cornerOf(element);
  expect(await Promise.all([element.dogEar(5, "head", 0.3), element.unfold(5)])).toEqual([
    true,
    true,
  ]);
  expect(element.dogEars).toEqual([]);
  await settled(element);
  await eventually(() => differing(flat, cornerOf(element))).toBeLessThan(0.05);
  const page = element.page;
  const folded = element.dogEar(5, "head", 0.3);
  await clock.pass(100);
  expect(await element.goTo(page + 6, { motion: false })).toBe(true);
  expect(await folded).toBe(true);
  expect(await element.goTo(page, { motion: false })).toBe(true);
  await settled(element);
  await eventually(() => differing(flat, cornerOf(element))).toBeGreaterThan(0.1);
});
