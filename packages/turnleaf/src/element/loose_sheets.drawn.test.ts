/** Loose sheets, torn out of a book: crumpled, torn across, and lying upon each other. */

import { expect, test } from "vitest";
import { clock } from "../for_tests/clock.ts";
import { drawRoughly, keepWhatIsDrawn, settled } from "../for_tests/element_books.ts";
import { eventually } from "../for_tests/eventually.ts";
import { besideBook, tearableInPlace, tearOutPage5 } from "../for_tests/tearable_books.ts";
import { TestPointer } from "../for_tests/test_pointer.ts";

keepWhatIsDrawn();
drawRoughly();
test("a loose sheet is crumpled by command, once, and its pages are put back whole", async () => {
  const element = await tearableInPlace();
  expect(element.crumple()).toBe(false);
  clock.hold();
  await tearOutPage5(element);
  const flat = besideBook(element);
  expect(element.crumple()).toBe(true);
  expect(element.crumple()).toBe(false);
  await clock.until(() => element.settled);
  // A ball of a little less than half of the width covers a fifth of the sheet.
  expect(besideBook(element)).toBeLessThan(0.5 * flat);
  expect(besideBook(element)).toBeGreaterThan(0.05 * flat);
  expect(await element.putBack()).toBe(true);
  await settled(element);
  expect([element.pageCount, element.tornLeaves]).toEqual([12, 0]);
  await eventually(() => besideBook(element)).toBe(0);
});

test("a double tap crumples a loose sheet", async () => {
  const element = await tearableInPlace();
  await element.tearOut(5);
  await settled(element);
  await eventually(() => besideBook(element)).toBeGreaterThan(0.2);
  const flat = besideBook(element);
  const pointer = new TestPointer(element);
  const x = (element.bookBounds as DOMRect).right + 60;
  for (let tap = 0; tap < 2; tap++) {
    pointer.point("pointerdown", x, 160);
    pointer.point("pointerup", x, 160);
  }
  await eventually(() => besideBook(element)).toBeLessThan(0.5 * flat);
  expect([element.zoom, element.tornLeaves]).toEqual([1, 1]);
});

test("a loose sheet is torn across by command; both pieces stay, and its pages are put back whole", async () => {
  const element = await tearableInPlace();
  const [from, to] = [
    { x: 0, y: 0.5 },
    { x: 1, y: 0.45 },
  ];
  expect(element.tearAcross(from, to)).toBe(false);
  clock.hold();
  await tearOutPage5(element);
  const whole = besideBook(element);
  // Along an edge, off the page, nowhere.
  expect(element.tearAcross(from, { x: 0, y: 0.9 })).toBe(false);
  expect(element.tearAcross(from, { x: 1.2, y: 0.5 })).toBe(false);
  expect(element.tearAcross(from, { x: Number.NaN, y: 0.5 })).toBe(false);
  expect(element.tearAcross(from, to)).toBe(true);
  // One that is torn is not torn again, nor crumpled.
  expect(element.tearAcross(from, to)).toBe(false);
  expect(element.crumple()).toBe(false);
  await clock.until(() => element.settled);
  expect(Math.abs(besideBook(element) / whole - 1)).toBeLessThan(0.1);
  expect([element.pageCount, element.tornLeaves]).toEqual([10, 1]);
  expect(await element.putBack()).toBe(true);
  await settled(element);
  expect([element.pageCount, element.tornLeaves]).toEqual([12, 0]);
  await eventually(() => besideBook(element)).toBe(0);
});

// It draws some hundreds of frames, which takes software half a minute on a quiet machine.
test("two fingers that pull a loose sheet apart tear it, and each carries its piece", async () => {
  const element = await tearableInPlace();
  clock.hold();
  await tearOutPage5(element);
  expect(besideBook(element)).toBeGreaterThan(0.2);
  const pointer = new TestPointer(element);
  const finger = (pointerId: number, name: string, y: number) =>
    pointer.point(name, x, y, { pointerId, pointerType: "touch", buttons: 1 });
  const x = (element.bookBounds as DOMRect).right + 60;
  finger(1, "pointerdown", 110);
  finger(2, "pointerdown", 200);
  // A second out, and held there until it is torn through.
  for (let k = 1; k <= 150; k++) {
    const away = Math.min(4 * k, 240);
    finger(1, "pointermove", 110 - away);
    finger(2, "pointermove", 200 + away);
    clock.frames(1);
  }
  for (const [id, y] of [
    [1, 60],
    [2, 260],
  ] as const) {
    finger(id, "pointermove", y);
  }
  const atRest = () => clock.until(() => element.settled);
  await atRest();
  finger(1, "pointerup", 60);
  await atRest();
  const both = besideBook(element);
  // The other is still held, half over the edge of the table; thrown out of sight it goes alone.
  finger(2, "pointermove", 1500);
  clock.frames(24);
  finger(2, "pointerup", 1500);
  await atRest();
  expect(besideBook(element)).toBeLessThan(0.9 * both);
  expect(element.zoom).toBe(1);
  expect(besideBook(element)).toBeGreaterThan(0.02);
  expect(await element.putBack()).toBe(true);
  expect(element.pageCount).toBe(12);
});
