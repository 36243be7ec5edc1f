import { expect, test } from "vitest";
import { FrameQuality } from "./frame_quality.ts";

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

const best = { pixels: 1, roughly: false };

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
  move(governor, 40, () => 400);
  expect(governor.quality).toEqual(best);
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
