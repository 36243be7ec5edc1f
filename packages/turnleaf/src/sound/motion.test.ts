import { expect, test } from "vitest";
import type { Surface } from "../engine/shapes.ts";
import type { BookPose } from "../stage/book_pose.ts";
import { MotionMeter } from "./motion.ts";

const [columns, rows] = [9, 9];
const positions = new Float32Array(3 * columns * rows);

/**
 * Returns a leaf that leaves the spine at an angle and curls by `curl` radians
 * over its width, `height` metres up.
 */
function pose(angle: number, curl: number, height = 0): BookPose {
  const normals = new Float32Array(3 * columns * rows);
  for (let at = 0; at < columns * rows; at++) {
    const turn = angle + (curl * (at % columns)) / (columns - 1);
    normals.set([-Math.sin(turn), 0, Math.cos(turn)], 3 * at);
    positions[3 * at + 2] = height;
  }
  const leaf: Surface = { columns, rows, positions, normals, version: 0 };
  return { left: null, right: null, leaves: [leaf], lean: 0, frontBoard: Math.PI, backBoard: 0 };
}

const frame = 1 / 60;

test("a leaf that turns stiffly is silent; one that bends sounds as fast as it bends", () => {
  const speed = (angle: number, curl: number) => {
    const meter = new MotionMeter();
    meter.measure(pose(0, 0), frame);
    return meter.measure(pose(angle, curl), frame).bending;
  };
  expect(speed(0.3, 0)).toBeLessThan(1e-3);
  // Four places from the spine on, each a quarter of the curl further.
  expect(speed(0.3, 0.08)).toBeCloseTo(0.02 / frame, 3);
  expect(speed(0, 0.16)).toBeCloseTo(0.04 / frame, 3);
});

test("a leaf is silent in the frame in which it is taken up", () => {
  expect(new MotionMeter().measure(pose(1, 2), frame)).toEqual({
    bending: 0,
    impact: 0,
    tearing: 0,
  });
});

test("what falls is heard when it is stopped, and not before", () => {
  const meter = new MotionMeter();
  const at = (height: number) => meter.measure(pose(0, 0, height), frame).impact;
  at(0.05);
  expect([at(0.04), at(0.03), at(0.02)]).toEqual([0, 0, 0].map((zero) => expect.closeTo(zero, 4)));
  expect(at(0.02)).toBeCloseTo(0.01 / frame, 3);
  expect(at(0.02)).toBe(0);
  // Picked up again.
  expect([at(0.03), at(0.05)]).toEqual([0, 0]);
});

test("a board is heard when it stops", () => {
  const meter = new MotionMeter();
  const at = (frontBoard: number) =>
    meter.measure({ ...pose(0, 0), leaves: [], frontBoard }, frame).impact;
  expect([at(2), at(2.1), at(2.2)]).toEqual([0, 0, 0]);
  expect(at(2.2)).toBeCloseTo((0.15 * 0.1) / frame, 5);
});
