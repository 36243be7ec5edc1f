/** Ticks from frame to frame, whatever times the browser reports. */

import { expect, test } from "vitest";
import { TickCounter } from "./tick_counter.ts";

const tick = 1 / 120;

test("a frame that came earlier than the last is no time, and time goes on from it", () => {
  const ticks = new TickCounter(tick);
  expect(ticks.count(1000)).toBe(0);
  expect(ticks.count(1050)).toBe(6);
  expect(ticks.count(1040)).toBe(0);
  expect(ticks.count(1090)).toBe(6);
  // The clock was set back by far.
  expect(ticks.count(5)).toBe(0);
  expect(ticks.count(55)).toBe(6);
});

test("a time that is no number is passed over", () => {
  const ticks = new TickCounter(tick);
  for (const now of [Number.NaN, Number.POSITIVE_INFINITY, 1000, Number.NaN]) {
    expect(ticks.count(now)).toBe(0);
  }
  expect(ticks.count(1050)).toBe(6);
  expect(ticks.count(Number.NEGATIVE_INFINITY)).toBe(0);
  expect(ticks.count(1100)).toBe(6);
});

test("a movement may begin at time 0, and the next owes nothing to it", () => {
  const ticks = new TickCounter(tick);
  expect([ticks.count(0), ticks.count(50)]).toEqual([0, 6]);
  ticks.stop();
  expect([ticks.count(1000), ticks.count(1050)]).toEqual([0, 6]);
});

test("of any times the ticks are whole, and no more than a long frame has", () => {
  const seed = 20260713;
  let state = seed;
  const random = (): number => {
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    return state / 2 ** 32;
  };
  const odd = [Number.NaN, Number.POSITIVE_INFINITY, -1e308, 1e308, -0, 5e-324];
  const ticks = new TickCounter(tick);
  for (let k = 0; k < 20_000; k++) {
    const now = random() < 0.1 ? odd[Math.floor(random() * odd.length)] : 1e6 * (random() - 0.5);
    const passed = ticks.count(now);
    expect(Number.isInteger(passed) && passed >= 0 && passed <= 13, `seed ${seed}, ${k}`).toBe(
      true,
    );
  }
});
