import { expect, test } from "vitest";
import { decodeTurn } from "../key_frames/decode.ts";
import { TurnRecorder } from "../key_frames/recorder.ts";
import { fractionTurned } from "./lying_sheet.ts";
import { Recording, type ReplayedLeaf } from "./recording.ts";
import sheet from "./turns/sheet_turn.tlkf";
import shell from "./turns/shell_turn.tlkf";

const even = (count: number) => Array.from({ length: count }, (_, k) => k / (count - 1));
const read = (base64: string) => decodeTurn(Uint8Array.from(atob(base64), (c) => c.charCodeAt(0)));

const u = even(49).map((place) => place ** 1.7);
const v = even(25);
const leaf: ReplayedLeaf = {
  u,
  v,
  width: 0.14,
  height: 0.21,
  isMirrored: false,
  isUpsideDown: false,
};
const room = () => new Float32Array(3 * u.length * v.length);

/**
 * Returns the maximum change of the length of an edge between neighbouring
 * columns, as a fraction.
 */
function strain(points: Float32Array, width: number): number {
  let most = 0;
  for (let row = 0; row < v.length; row++) {
    for (let column = 1; column < u.length; column++) {
      const at = 3 * (row * u.length + column);
      const way = [0, 1, 2].map((k) => points[at + k] - points[at + k - 3]);
      most = Math.max(
        most,
        Math.abs(Math.hypot(...way) / ((u[column] - u[column - 1]) * width) - 1),
      );
    }
  }
  return most;
}

test.for([
  ["sheet", sheet],
  ["shell", shell],
])("the %s's turn is done as far as it is asked to be", ([name, file]) => {
  const recording = new Recording(read(file), name);
  const points = room();
  for (let k = 1; k < 20; k++) {
    recording.write(leaf, k / 20, points);
    expect(fractionTurned(points, u.length, v.length)).toBeCloseTo(k / 20, 2);
    expect(strain(points, 0.14)).toBeLessThan(0.05);
    for (let row = 0; row < v.length; row++) {
      expect(Math.abs(points[3 * row * u.length])).toBeLessThan(1e-3);
    }
  }
});

test("it is mirrored, turned upside down and stretched", () => {
  const recording = new Recording(read(sheet), "it");
  const [plain, other] = [room(), room()];
  recording.write(leaf, 0.3, plain);
  recording.write({ ...leaf, isMirrored: true }, 0.3, other);
  for (let i = 0; i < plain.length; i += 3) expect(other[i]).toBeCloseTo(-plain[i], 6);
  recording.write({ ...leaf, isUpsideDown: true }, 0.3, other);
  const top = 3 * (24 * u.length + 30);
  const foot = 3 * 30;
  expect(other[top]).toBeCloseTo(plain[foot], 6);
  expect(other[top + 1]).toBeCloseTo(0.21 - plain[foot + 1], 6);
  recording.write({ ...leaf, width: 0.28, height: 0.21 }, 0.3, other);
  expect(other[top]).toBeCloseTo(2 * plain[top], 6);
  expect(other[top + 1]).toBeCloseTo(plain[top + 1], 6);
});

/** Returns a board swung from one angle to another, in fractions of the turn. */
function swung(from: number, to: number) {
  const [columns, rows] = [even(4), even(3)];
  const recorder = new TurnRecorder({ width: 0.14, height: 0.21, u: columns, v: rows });
  for (let k = 0; k <= 40; k++) {
    const angle = Math.PI * (from + ((to - from) * k) / 40);
    const points = rows.flatMap((row) =>
      columns.flatMap((place) => [
        0.14 * place * Math.cos(angle),
        0.21 * row,
        0.14 * place * Math.sin(angle),
      ]),
    );
    recorder.add(k / 40, Float32Array.from(points));
  }
  return decodeTurn(recorder.finish().bytes);
}

test("a recording from the left to the right turns leaves from the right to the left", () => {
  const points = room();
  new Recording(swung(1, 0), "it").write(leaf, 0.25, points);
  expect(fractionTurned(points, u.length, v.length)).toBeCloseTo(0.25, 2);
});

test("a recording of a part of a turn is rejected in one sentence", () => {
  for (const [from, to] of [
    [0, 0.7],
    [0.3, 1],
    [0.4, 0.4],
  ]) {
    expect(() => new Recording(swung(from, to), "The turn file half.tlkf")).toThrow(
      "The turn file half.tlkf leads its leaf only a part of the way over; record a turn from one side to the other.",
    );
  }
});
