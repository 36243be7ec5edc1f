/** The clock of the browser tests itself. */

import { afterEach, expect, test } from "vitest";
import { clock } from "./clock.ts";

afterEach(() => clock.run());

/** Resolves once a frame that was requested has been drawn. */
const aFrame = (): Promise<number> => new Promise((resolve) => requestAnimationFrame(resolve));

test("frames are drawn when they are requested after calls that overlapped, whichever ended first", async () => {
  let isOver = false;
  const waited = clock.until(() => isOver);
  const passed = clock.pass(100);
  isOver = true;
  await waited;
  await passed;
  await aFrame();

  const long = clock.pass(200);
  const short = clock.pass(50);
  await short;
  await long;
  await aFrame();
});

test("a clock that is held draws no frame by itself, until it runs, whatever drew its own meanwhile", async () => {
  clock.hold();
  let drawn = 0;
  requestAnimationFrame(() => drawn++);
  await clock.task();
  expect(drawn).toBe(0);
  await clock.pass(10);
  expect(drawn).toBe(1);
  requestAnimationFrame(() => drawn++);
  await clock.task();
  expect(drawn).toBe(1);
  const passed = clock.pass(100);
  clock.run();
  await passed;
  await aFrame();
  expect(drawn).toBe(2);
});

test("while time passes a timer ends by frames alone, however long these take on the machine", async () => {
  let isOver = false;
  // biome-ignore lint/plugin: the timers of the clock are what is tested.
  setTimeout(() => (isOver = true), 50);
  const passed = clock.pass(33);
  const end = Date.now() + 60;
  while (Date.now() < end) {
    // The machine is busy.
  }
  await passed;
  expect(isOver).toBe(false);
  await clock.pass(33);
  expect(isOver).toBe(true);
});

test("while timers are held none ends before time passes, however late that is on the machine", async () => {
  clock.holdTimers();
  let isOver = false;
  // biome-ignore lint/plugin: the timers of the clock are what is tested.
  setTimeout(() => (isOver = true), 5);
  const end = Date.now() + 20;
  while (Date.now() < end) {
    // The machine is busy.
  }
  await clock.task();
  expect(isOver).toBe(false);
  await clock.pass(10);
  expect(isOver).toBe(true);
});
