/** Ticks and quality from frame to frame, whatever times the browser reports. */

import { expect, test } from "vitest";
import { FrameQuality, stepSheets, TickCounter } from "./frame_timing.ts";

const tick = 1 / 120;

/** Steps sheets by the ticks of a frame, each two of which take so many ms. Returns the parts. */
function stepped(ticks: number, took: number): number[] {
  const parts: number[] = [];
  const step = (some: number): boolean => {
    parts.push(some);
    return parts.length < 3;
  };
  const goesOn = stepSheets(ticks, step, () => parts.length * took);
  expect(goesOn).toBe(parts.length < 3);
  return parts;
}

test("sheets are stepped by all ticks of a frame, up to twelve, while there is time", () => {
  expect(stepped(0, 1)).toEqual([0]);
  expect(stepped(1, 1)).toEqual([1]);
  expect(stepped(5, 1)).toEqual([2, 2, 1]);
  expect(stepped(100, 1)).toEqual([2, 2, 2, 2, 2, 2]);
});

test("where steps take longer than they step, a frame has no more than one at 30 Hz", () => {
  expect(stepped(100, 20)).toEqual([2, 2]);
  expect(stepped(4, 1000)).toEqual([2, 2]);
  expect(stepped(100, 7)).toEqual([2, 2, 2]);
});

const best = { pixels: 1, roughly: false };

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
    expect(Number.isInteger(passed) && passed >= 0 && passed <= 121, `seed ${seed}, ${k}`).toBe(
      true,
    );
  }
});

test("a movement takes a fifth of a second of lateness as its own, and then leaps over what is late", () => {
  const ticks = new TickCounter(tick);
  const times = [1000, 1400, 1800, 2200, 2250];
  expect(times.map((now) => ticks.count(now))).toEqual([0, 24, 48, 48, 6]);
  // However late frames come, a turn of 0.8 s takes no more than 0.2 s and a frame longer.
  ticks.stop();
  ticks.count(3000);
  let [late, passed] = [0, 0];
  while (passed < 0.8) {
    late += 250;
    passed += ticks.count(3000 + late) * tick;
  }
  expect(late).toBeLessThanOrEqual(800 + 200 + 250);
});

test("a page that was hidden comes back to a movement that has gone on by a second at most", () => {
  const ticks = new TickCounter(tick);
  ticks.count(1000);
  expect(ticks.count(61_000)).toBe(96);
});

test("where drawing is slow, even the first frames have fewer pixels", () => {
  const governor = new FrameQuality(true);
  expect(governor.quality.pixels).toBe(0.75);
  // It is drawn better where there is time.
  move(governor, 600, () => 1000 / 60);
  expect(governor.quality).toEqual(best);
});

/**
 * Runs a movement of some frames, each as long after the previous one as `cost`
 * says. Returns the fractions of pixels.
 */
function move(
  governor: FrameQuality,
  frames: number,
  cost: (quality: { pixels: number; roughly: boolean }) => number,
  start = 1000,
): number[] {
  const seen: number[] = [];
  let now = start;
  for (let k = 0; k < frames; k++) {
    governor.frame(now);
    seen.push(governor.quality.pixels);
    now += cost(governor.quality);
  }
  governor.rest();
  return seen;
}

test("frames in time are drawn as well as can be, whatever the screen's rate", () => {
  for (const rate of [60, 90, 120, 144]) {
    const governor = new FrameQuality();
    move(governor, 600, () => 1000 / rate);
    expect(governor.quality).toEqual(best);
  }
});

test("single late frames, pauses and the time between movements count for nothing", () => {
  const governor = new FrameQuality();
  let frame = 0;
  move(governor, 600, () => (++frame % 4 === 0 ? 60 : 16));
  for (let k = 0; k < 30; k++) move(governor, 5, () => 16, 1000 + 5000 * k);
  // The page was hidden for long, again and again.
  move(governor, 600, () => (++frame % 20 === 0 ? 4000 : 16));
  expect(governor.quality).toEqual(best);
});

test("on a machine that draws a few frames a second it is lowest after four of the first turn", () => {
  const governor = new FrameQuality();
  const seen = move(governor, 12, ({ pixels }) => 700 * pixels ** 2);
  expect(seen.slice(0, 5)).toEqual([1, 1, 1, 0.55, 0.55]);
  // It stays so for the next turns.
  expect(new Set(move(governor, 12, ({ pixels }) => 700 * pixels ** 2, 50_000))).toEqual(
    new Set([0.55]),
  );
});

test("late frames lower it until they come in time, and no further", () => {
  const governor = new FrameQuality();
  // A graphics card limited by pixels: 40 ms at full, 22 ms at three quarters.
  const slow = ({ pixels }: { pixels: number }) => Math.max(40 * pixels ** 2, 16.7);
  const seen = move(governor, 80, slow);
  expect(seen[0]).toBe(1);
  expect(governor.quality.pixels).toBeLessThan(1);
  expect(slow(governor.quality)).toBeLessThan(23);
  expect(Math.min(...seen)).toBeGreaterThanOrEqual(0.55);
});

test("shadows go first: where they were too much, no pixel is lost", () => {
  const governor = new FrameQuality();
  const seen = move(governor, 60, ({ roughly }) => (roughly ? 16 : 30));
  expect(Math.min(...seen)).toBe(1);
  expect(governor.quality).toEqual({ pixels: 1, roughly: true });
});

test("it comes back by itself when there is time again", () => {
  const governor = new FrameQuality();
  move(governor, 60, ({ pixels }) => 45 * pixels ** 2);
  expect(governor.quality.pixels).toBeLessThan(1);
  move(governor, 400, () => 16);
  expect(governor.quality).toEqual(best);
});

test("it does not go up and down all the time: tries in vain become rare", () => {
  const governor = new FrameQuality();
  const seen = move(governor, 6000, ({ pixels }) => (pixels > 0.7 ? 30 : 16));
  const changes = seen.filter((pixels, k) => k > 0 && pixels !== seen[k - 1]).length;
  const late = seen.slice(600).filter((pixels) => pixels > 0.7).length;
  expect(changes).toBeLessThan(40);
  expect(late / seen.length).toBeLessThan(0.05);
});

test("where nothing helps, as on a screen that is held to 30 frames, nothing is given up", () => {
  const governor = new FrameQuality();
  move(governor, 400, () => 33.3);
  expect(governor.quality).toEqual(best);
  // It still waits longer.
  move(governor, 60, ({ pixels }) => 33.3 + 60 * (pixels - 0.5));
  expect(governor.quality.pixels).toBeLessThan(1);
});

test("the time between two movements is counted once, at the first frame of the second", () => {
  const ticks = new TickCounter(tick);
  expect(ticks.rested(500)).toBe(0);
  ticks.count(1000);
  ticks.count(1050);
  expect(ticks.rested(1050)).toBe(0);
  ticks.stop();
  expect([ticks.rested(61_050), ticks.rested(61_100)]).toEqual([60, 0]);
});
