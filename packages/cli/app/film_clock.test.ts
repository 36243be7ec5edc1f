import { afterEach, beforeEach, expect, test, vi } from "vitest";
import { FilmClock } from "./film_clock.ts";

beforeEach(() => {
  vi.stubGlobal("window", {});
});
afterEach(() => {
  vi.unstubAllGlobals();
});

/** Returns a clock that advances on command alone. */
function heldClock(): FilmClock {
  const clock = new FilmClock();
  clock.free = false;
  return clock;
}

test("a page whose picture comes after a motion asks for a frame, and moves nothing", () => {
  const clock = heldClock();
  let drawn = 0;
  window.requestAnimationFrame(() => {
    if (!clock.isSkipped) drawn += 1;
  });
  expect(clock.isAsked).toBe(true);
  expect(clock.isMoving()).toBe(false);
  expect(drawn).toBe(1);
});

test("what moves asks for a frame in every one, while no time passes too", () => {
  const clock = heldClock();
  const times: number[] = [];
  const move = (now: number): void => {
    times.push(now);
    if (now < 1100) window.requestAnimationFrame(move);
  };
  window.requestAnimationFrame(move);
  let frames = 0;
  for (clock.begin(); clock.isMoving(); frames++) clock.pass(50);
  expect(frames).toBe(2);
  expect(Math.max(...times)).toBe(1100);
});
