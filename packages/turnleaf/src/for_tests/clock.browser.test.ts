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
