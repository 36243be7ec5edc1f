import { expect, test } from "vitest";
import type { Pile, Ray, Surface } from "../engine/shapes.ts";
import { pickPile, pickSurface } from "./pick.ts";
import { handAt } from "./reach.ts";

const u = Float32Array.from([0, 0.1, 0.4, 1]);
const width = 0.14;
const height = 0.21;

/** Returns a line of sight straight down onto (x, y). */
const down = (x: number, y: number): Ray => ({ origin: [x, y, 1], direction: [0, 0, -2] });

/** Returns a pile of one flat curve at height z, on the side of `sign`. */
function flatPile(sign: number, z: number): Pile {
  const curves = Float32Array.from([...u].flatMap((u) => [sign * u * width, z]));
  return { columns: u.length, layers: 1, curves };
}

test("a resting page is met where it lies", () => {
  for (const sign of [1, -1] as const) {
    const hit = pickPile(down(sign * 0.07, 0.05), flatPile(sign, 0.01), sign, u, height);
    expect(hit?.u).toBeCloseTo(0.5, 5);
    expect(hit?.v).toBeCloseTo(0.05 / height, 5);
    expect(hit?.distance).toBeCloseTo(0.99 / 2, 5);
    expect(pickPile(down(-sign * 0.07, 0.05), flatPile(sign, 0), sign, u, height)).toBeNull();
    expect(pickPile(down(sign * 0.07, -0.01), flatPile(sign, 0), sign, u, height)).toBeNull();
  }
});

test("the fore-edge of a pile is its uppermost page's edge", () => {
  for (const sign of [1, -1] as const) {
    // The lower layer reaches farther out, as leaves in a thick pile do.
    const curves = Float32Array.from([
      ...[...u].flatMap((u) => [sign * u * width, 0.01]),
      ...[...u].flatMap((u) => [sign * (u * width + 0.006), 0]),
    ]);
    const hit = pickPile(
      down(sign * (width + 0.003), 0.1),
      { columns: u.length, layers: 2, curves },
      sign,
      u,
      height,
    );
    expect(hit?.u).toBe(1);
    expect(hit?.v).toBeCloseTo(0.1 / height, 5);
  }
});

test("a leaf in flight is met from above and from below", () => {
  const rows = 3;
  const positions: number[] = [];
  for (let row = 0; row < rows; row++) {
    for (const k of u) positions.push(k * width * 0.6, (row / 2) * height, k * width * 0.8);
  }
  const surface: Surface = {
    columns: u.length,
    rows,
    positions: Float32Array.from(positions),
    normals: new Float32Array(positions.length),
    version: 1,
  };
  for (const [x, y] of [
    [0.01, 0.02],
    [0.04, 0.1],
    [0.08, 0.2],
  ]) {
    const above = pickSurface(down(x, y), surface, u);
    expect(above?.u).toBeCloseTo(x / (0.6 * width), 4);
    expect(above?.v).toBeCloseTo(y / height, 4);
    const below = pickSurface({ origin: [x, y, -1], direction: [0, 0, 1] }, surface, u);
    expect(below?.u).toBeCloseTo(x / (0.6 * width), 4);
  }
  expect(pickSurface(down(0.09, 0.1), surface, u)).toBeNull();
});

test("a creased leaf is met where its points lie on the paper", () => {
  // Folded over at half its width: its outer half lies on the inner one, 2 mm above it.
  const places = [0, 0, 0.5, 0, 1, 0, 0, 1, 0.5, 1, 1, 1];
  const xz = [0, 0, 0.5, 0, 0, 0.002];
  const positions = [0, 1].flatMap((y) =>
    [0, 1, 2].flatMap((k) => [width * xz[2 * k], height * y, xz[2 * k + 1]]),
  );
  const surface: Surface = {
    columns: 3,
    rows: 2,
    positions: Float32Array.from(positions),
    normals: new Float32Array(positions.length),
    version: 1,
    creased: {
      places: Float32Array.from(places),
      triangles: Uint32Array.from([0, 1, 3, 4, 3, 1, 1, 2, 4, 5, 4, 2]),
      parts: Uint16Array.from([0, 0, 1, 1]),
    },
  };
  const above = pickSurface(down(width / 4, height / 3), surface, u);
  expect([above?.u, above?.v]).toEqual([expect.closeTo(0.75, 5), expect.closeTo(1 / 3, 5)]);
  const below = { origin: [width / 4, height / 3, -1], direction: [0, 0, 1] } as const;
  expect(pickSurface(below, surface, u)?.u).toBeCloseTo(0.25, 5);
});

test("the held point arches over the spine and comes down at its reach", () => {
  const flat = () => 0;
  expect(handAt(down(0, 0.1), width, flat)[2]).toBeCloseTo(0.62 * width, 6);
  expect(handAt(down(width, 0.1), width, flat)[2]).toBeCloseTo(0, 6);
  expect(handAt(down(0.3, 0.1), width, flat)).toEqual([0.3, 0.1, 0]);
  expect(handAt(down(width, 0.1), width, () => 0.01)[2]).toBeCloseTo(0.01, 6);
});

test("a slanting line of sight ends on the arch", () => {
  const ray: Ray = { origin: [0.02, -0.27, 0.7], direction: [0.01, 0.36, -0.93] };
  const [x, y, z] = handAt(ray, width, () => 0);
  expect((x / width) ** 2 + (z / (0.62 * width)) ** 2).toBeCloseTo(1, 4);
  const t = (z - 0.7) / -0.93;
  expect(x).toBeCloseTo(0.02 + 0.01 * t, 6);
  expect(y).toBeCloseTo(-0.27 + 0.36 * t, 6);
});
