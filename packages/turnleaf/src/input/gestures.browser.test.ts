/** Which gestures act on the book, by its attributes `gestures` and `swipe-distance`. */

import { afterEach, expect, test } from "vitest";
import type { BookState } from "../book/turning.ts";
import type { TurnleafBook } from "../element.ts";
import { clock } from "../for_tests/clock.ts";
import { book, happens, scans, settled } from "../for_tests/element_books.ts";
import { eventually } from "../for_tests/eventually.ts";
import { TestPointer } from "../for_tests/test_pointer.ts";

afterEach(() => document.body.replaceChildren());

/** Opens a book at page 6, with simulated pointers. */
async function opened(attributes: Record<string, string>) {
  const element = book(scans(12), { page: "6", cover: "none", duration: "120", ...attributes });
  await happens(element, "load");
  await settled(element);
  return { element, pointer: new TestPointer(element) };
}

/** Records the states of a book. */
function watchStates(element: TurnleafBook): BookState[] {
  const states: BookState[] = [];
  element.addEventListener("statechange", ({ detail }) => states.push(detail.state));
  return states;
}

/** Drags the right page over to the left. */
async function drag(pointer: TestPointer): Promise<void> {
  pointer.point("pointerdown", 205, 110);
  await pointer.move([205, 110], [60, 100]);
  // The leaf comes after the pointer.
  await settled(pointer.element);
  pointer.wait(1000);
  pointer.point("pointerup", 60, 100);
}

/** Returns a place near the foot of the right page's fore-edge. */
function cornerOf(element: TurnleafBook): [x: number, y: number] {
  const { right, bottom } = element.bookBounds as DOMRect;
  return [right - 5, bottom - 5];
}

/** Waits for what should not come. */
const wait = () => clock.pass(80);

test("without the attribute every gesture acts, and each is a state", async () => {
  const { element, pointer } = await opened({});
  const states = watchStates(element);
  await drag(pointer);
  await eventually(() => element.page).toBe(8);
  await settled(element);
  expect(states).toEqual(["dragged", "turning", "resting"]);
  expect(element.state).toBe("resting");
});

test("`none` leaves keys and commands alone", async () => {
  const { element, pointer } = await opened({ gestures: "none" });
  const states = watchStates(element);
  await drag(pointer);
  pointer.click(280, 110);
  pointer.click(...cornerOf(element));
  pointer.point("pointermove", ...cornerOf(element));
  expect(pointer.roll(0, 120)).toBe(true);
  expect(pointer.roll(0, 120, { ctrlKey: true })).toBe(true);
  for (const _ of [1, 2]) pointer.click(200, 110);
  await wait();
  expect(element.zoom).toBe(1);
  expect(states).toEqual([]);
  pointer.key("ArrowRight");
  await eventually(() => element.page).toBe(8);
});

test.each([
  { gestures: "drag", drags: true, clicks: false, lifts: false, rolls: false },
  { gestures: "click", drags: false, clicks: true, lifts: false, rolls: false },
  { gestures: "corner", drags: false, clicks: false, lifts: true, rolls: false },
  { gestures: "wheel zoom", drags: false, clicks: false, lifts: false, rolls: true },
])("`$gestures` alone", async ({ gestures, drags, clicks, lifts, rolls }) => {
  const { element, pointer } = await opened({ gestures });
  await drag(pointer);
  await wait();
  await settled(element);
  expect(element.page).toBe(drags ? 8 : 6);
  await element.goTo(6);
  pointer.click(280, 110);
  await wait();
  await settled(element);
  expect(element.page).toBe(clicks ? 8 : 6);
  await element.goTo(6);
  const states = watchStates(element);
  pointer.point("pointermove", ...cornerOf(element));
  await wait();
  if (lifts) await eventually(() => states).toEqual(["lifting"]);
  else expect(states).toEqual([]);
  pointer.point("pointermove", 150, 20);
  await settled(element);
  pointer.roll(0, 120);
  await wait();
  await settled(element);
  expect(element.page).toBe(rolls ? 8 : 6);
  pointer.roll(0, -60, { ctrlKey: true });
  expect(element.zoom > 1).toBe(rolls);
});

test("a flick shorter than the swipe distance turns nothing", async () => {
  const { element, pointer } = await opened({ "swipe-distance": "80" });
  const touch = { pointerType: "touch", pointerId: 7 };
  const flick = (length: number): void => {
    pointer.point("pointerdown", 200, 110, touch);
    pointer.flick([200, 110], [200 - length, 112], touch);
    pointer.point("pointerup", 200 - length, 112, touch);
  };
  flick(60);
  await wait();
  await settled(element);
  expect(element.page).toBe(6);
  flick(90);
  await eventually(() => element.page).toBe(8);
  expect(element.swipeDistance).toBe(80);
});
