import { expect, test } from "vitest";
import {
  compass,
  compassToRadians,
  gapsOfRow,
  keyAngle,
  keyFraction,
  leftEndUnder,
  lightBetween,
  skyFraction,
} from "./light.ts";

const none = new Float32Array(0);

/** Returns the gaps, in radians, of a row given by its x and z on the right side. */
function gaps(
  points: [number, number][],
  opposite: [number, number][],
  next: [number, number][] = [],
): [number, number][] {
  const count = points.length;
  const [x, z] = [0, 1].map((k) => Float32Array.from(points, (p) => p[k]));
  const nx = new Float32Array(count);
  const nz = new Float32Array(count);
  for (let i = 0; i < count; i++) {
    const [a, b] = [Math.max(0, i - 1), Math.min(count - 1, i + 1)];
    const length = Math.hypot(x[b] - x[a], z[b] - z[a]);
    nx[i] = -(z[b] - z[a]) / length;
    nz[i] = (x[b] - x[a]) / length;
  }
  const out = new Float32Array(2 * count);
  const [pile, over] = [opposite, next].map((points) => Float32Array.from(points.flat()));
  gapsOfRow(x, z, nx, nz, count, 1, pile, over, out);
  return points.map((_, i) => [compassToRadians(out[2 * i]), compassToRadians(out[2 * i + 1])]);
}

const flat = Array.from({ length: 13 }, (_, i): [number, number] => [(0.14 * i) / 12, 0.01]);

test("a compass number turns back into its angle, all around", () => {
  for (let degrees = -179; degrees < 180; degrees++) {
    const angle = (degrees * Math.PI) / 180;
    const c = compass(Math.sin(angle), Math.cos(angle));
    expect(compassToRadians(c)).toBeCloseTo(angle, 6);
    expect(compassToRadians(c - 4)).toBeCloseTo(angle - 2 * Math.PI, 6);
  }
});

test("compass numbers rise with the angle", () => {
  let before = -Infinity;
  for (let degrees = -179; degrees < 180; degrees++) {
    const c = compass(Math.sin((degrees * Math.PI) / 180), Math.cos((degrees * Math.PI) / 180));
    expect(c).toBeGreaterThan(before);
    before = c;
  }
});

test("a flat page under an open sky receives exactly 1", () => {
  for (const [left, right] of gaps(flat, [])) {
    expect(skyFraction(left, right, 0)).toBe(1);
    expect(keyFraction(left, right)).toBe(1);
  }
});

test("a hump across the gutter takes sky from the page near it, and less farther off", () => {
  const seen = gaps(flat, [
    [-0.01, 0.02],
    [-0.05, 0.012],
  ]).map(([left, right]) => skyFraction(left, right, 0));
  expect(seen[1]).toBeLessThan(0.96);
  for (let i = 1; i < seen.length; i++) expect(seen[i]).toBeGreaterThan(seen[i - 1]);
  expect(seen[12]).toBeGreaterThan(0.99);
});

test("the fraction of the sky is the same on the left, mirrored", () => {
  for (let k = -8; k <= 8; k++) {
    const [left, right, normal] = [-1.2 + 0.05 * k, 0.9 + 0.03 * k, 0.04 * k];
    expect(skyFraction(left, right, normal)).toBeCloseTo(skyFraction(-right, -left, -normal), 12);
  }
});

test("a leaf overhead shuts out sky and key; a leaf laid away does not", () => {
  const over = Float32Array.from([0, 0, 0.05, 0.08, 0.12, 0.09]);
  const end = compassToRadians(leftEndUnder(0.06, 0, over, over.length));
  expect(skyFraction(end, Math.PI / 2, 0)).toBeLessThan(0.3);
  expect(keyFraction(end, Math.PI / 2)).toBe(0);
  const away = Float32Array.from([0, 0, -0.07, 0.001, -0.14, 0]);
  const open = compassToRadians(leftEndUnder(0.06, 0.01, away, away.length));
  expect(skyFraction(open, Math.PI / 2, 0)).toBe(1);
  expect(keyFraction(open, Math.PI / 2)).toBe(1);
});

test("a leaf close over another shuts it, down to where both are bound", () => {
  for (const degrees of [0, 40, 80, 100, 140]) {
    const at = (angle: number): [number, number][] =>
      flat.map(([x]) => [x * Math.cos(angle), x * Math.sin(angle)]);
    const lower = at((degrees * Math.PI) / 180);
    const seen = gaps(lower, [], at(((degrees + 4) * Math.PI) / 180));
    for (const [k, [left, right]] of seen.slice(1, 11).entries()) {
      const normal = (-degrees * Math.PI) / 180;
      expect(skyFraction(left, right, normal), `${degrees} degrees, point ${k}`).toBeLessThan(0.12);
    }
  }
});

test("only the points in use shut out light", () => {
  const over = Float32Array.from([-0.1, 0, 0.1, 0.1]);
  expect(leftEndUnder(0.05, 0, over, 2)).toBe(-1);
});

test("a leaf that faces the table sees no sky", () => {
  const turned = flat.map(([x, z]): [number, number] => [-x, z]);
  for (const [left, right] of gaps(turned, [[-0.1, 0]])) {
    expect(skyFraction(left, right, -Math.PI)).toBeCloseTo(0, 9);
    expect(keyFraction(left, right)).toBe(0);
  }
});

test("the key light fades over a soft edge about its own angle", () => {
  expect(keyFraction(keyAngle, Math.PI / 2)).toBeCloseTo(0.5, 9);
  expect(keyFraction(-Math.PI / 2, keyAngle)).toBeCloseTo(0.5, 9);
});

test("a board that stands over a face shuts it", () => {
  const out = { left: 0, right: 0, sky: 0, key: 0 };
  lightBetween(0.05, 0, 0, [none], [0, 0, 0], out);
  expect([out.sky, out.key]).toEqual([1, 1]);
  lightBetween(0.05, 0, 0, [none], [0.14, 0.02, 1], out);
  expect(out.sky).toBeLessThan(0.05);
  expect(out.key).toBe(0);
});
