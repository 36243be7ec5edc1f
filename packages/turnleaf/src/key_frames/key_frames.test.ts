import { describe, expect, it } from "vitest";
import cornerSamples from "../../../../engine/tests/fixtures/corner.samples?raw";
import cornerFile from "../../../../engine/tests/fixtures/corner.tlkf?inline";
import wholeFile from "../../../../engine/tests/fixtures/corner-whole.tlkf?inline";
import foldedFile from "../../../../engine/tests/fixtures/folded.tlkf?inline";
import foldedWholeFile from "../../../../engine/tests/fixtures/folded-whole.tlkf?inline";
import scriptFile from "../../../../engine/tests/fixtures/recorded-in-script.tlkf?inline";
import { checksum } from "./file.ts";
import {
  decodeTurn,
  type RecordedTurn,
  splitMesh,
  TurnRecorder,
  turnName,
  writeMeshNormals,
  writeNormals,
} from "./key_frames.ts";

const bytesOf = (url: string): Uint8Array<ArrayBuffer> =>
  Uint8Array.from(atob(url.slice(url.indexOf(",") + 1)), (c) => c.charCodeAt(0));

const corner = decodeTurn(bytesOf(cornerFile));

function sample(turn: RecordedTurn, time: number): Float32Array {
  const out = new Float32Array(3 * turn.columns * turn.rows);
  turn.sample(time, out);
  return out;
}

function apart(a: ArrayLike<number>, b: ArrayLike<number>): number {
  expect(a.length).toBe(b.length);
  let most = 0;
  for (let i = 0; i < a.length; i++) most = Math.max(most, Math.abs(Number(a[i]) - Number(b[i])));
  return most;
}

/** A page that swings over, and bends on its way. */
function bent(columns: number, rows: number, time: number): Float32Array {
  const out = new Float32Array(3 * columns * rows);
  for (let at = 0; at < columns * rows; at++) {
    const [u, v] = [(at % columns) / (columns - 1), Math.floor(at / columns) / (rows - 1)];
    const angle = Math.PI * time + 0.5 * u * u * Math.sin(Math.PI * time) * (1 - 0.3 * v);
    out.set([0.14 * u * Math.cos(angle), 0.21 * v, 0.14 * u * Math.sin(angle)], 3 * at);
  }
  return out;
}

const even = (n: number) => Array.from({ length: n }, (_, i) => i / (n - 1));

function recordBent(tolerance?: number) {
  const leaf = { width: 0.14, height: 0.21, u: even(26), v: even(26), model: "cone" as const };
  const recorder = new TurnRecorder(leaf);
  for (let step = 0; step <= 96; step++) recorder.add((0.8 * step) / 96, bent(26, 26, step / 96));
  return recorder.finish(tolerance);
}

describe("a file of the engine", () => {
  it("says what it holds", () => {
    expect(corner).toMatchObject({ columns: 9, rows: 9, model: "mass-spring" });
    expect([corner.width, corner.height, corner.duration].map((x) => x.toFixed(4))).toEqual([
      "0.1400",
      "0.2100",
      "0.4000",
    ]);
    expect(corner.error).toBeGreaterThan(0);
    expect(corner.error).toBeLessThanOrEqual(0.001);
  });

  it("is played as the engine plays it", () => {
    const samples = JSON.parse(cornerSamples);
    expect(samples).toHaveLength(10);
    for (const { time, positions } of samples) {
      expect(apart(sample(corner, time), positions), `${time} s`).toBeLessThan(1e-6);
    }
  });

  it("of version 1 is read too, and the condensed one is as near to it as it says", () => {
    const whole = decodeTurn(bytesOf(wholeFile));
    expect(whole.frames).toBeGreaterThan(corner.frames);
    expect(whole.error).toBeNaN();
    let most = 0;
    for (const time of whole.times) {
      const [a, b] = [sample(whole, time), sample(corner, time)];
      for (let i = 0; i < a.length; i += 3) {
        const [x, y, z] = [0, 1, 2].map((k) => (a[i + k] ?? 0) - (b[i + k] ?? 0));
        most = Math.max(most, Math.hypot(x ?? 0, y ?? 0, z ?? 0));
      }
    }
    expect(most / corner.width).toBeCloseTo(corner.error, 5);
  });
});

describe("playing", () => {
  it("backward, across the spine, faster and larger", () => {
    const { duration } = corner;
    const at = 0.3 * duration;
    const here = sample(corner, at);
    expect(apart(sample(corner.reversed(), duration - at), here)).toBeLessThan(1e-7);
    expect(apart(sample(corner.reversed().reversed(), at), here)).toBe(0);
    expect(apart(sample(corner.faster(2), at / 2), here)).toBeLessThan(1e-7);
    expect(corner.faster(2).duration).toBeCloseTo(duration / 2, 9);
    const mirrored = here.map((value, i) => (i % 3 === 0 ? -value : value));
    expect(apart(sample(corner.mirrored(), at), mirrored)).toBe(0);
    const larger = corner.scaled(0.28, 0.42);
    expect([larger.width, larger.height].map((x) => x.toFixed(3))).toEqual(["0.280", "0.420"]);
    const twice = here.map((value) => 2 * value);
    expect(apart(sample(larger, at), twice)).toBeLessThan(1e-6);
    const all = corner.mirrored().scaled(0.07, 0.105).faster(4).reversed();
    const expected = mirrored.map((value) => value / 2);
    expect(apart(sample(all, (duration - at) / 4), expected)).toBeLessThan(1e-6);
    expect(sample(corner, at)).toEqual(here);
  });

  it("stands still before its beginning and after its end", () => {
    expect(sample(corner, -5)).toEqual(sample(corner, 0));
    expect(sample(corner, 99)).toEqual(sample(corner, corner.duration));
    expect(sample(corner, Number.NaN)).toEqual(sample(corner, 0));
  });

  it("tells when its key frames come, backward too", () => {
    const times = corner.reversed().faster(2).times;
    expect([times[0], times.at(-1)?.toFixed(6)]).toEqual([0, "0.200000"]);
    expect(times.every((time, i) => i === 0 || time > (times[i - 1] ?? 0))).toBe(true);
  });

  it("rejects in one sentence", () => {
    expect(() => corner.scaled(0.2, 0.2)).toThrow(
      "This turn is of a leaf of 0.140 x 0.210 m; a leaf of another ratio needs another recording.",
    );
    expect(() => corner.scaled(-0.14, -0.21)).toThrow(RangeError);
    expect(() => corner.faster(0)).toThrow("A turn is played faster by a factor above 0.");
    expect(() => corner.sample(0, new Float32Array(3))).toThrow("takes 243 floats");
  });

  it("has unit normals that point up on the right and down on the left", () => {
    const normals = new Float32Array(243);
    for (const [time, z] of [
      [0, 1],
      [1, -1],
    ] as const) {
      writeNormals(9, 9, sample(corner, time), normals);
      for (let i = 0; i < 243; i += 3) expect(normals[i + 2]).toBeCloseTo(z, 3);
    }
  });
});

describe("recording", () => {
  it("keeps 0.8 s of 26 x 26 points within 20 kB and a thousandth of the width", () => {
    const { bytes, error, frames } = recordBent();
    expect(bytes.length).toBeLessThan(20_000);
    expect(error).toBeLessThanOrEqual(0.001);
    const turn = decodeTurn(bytes);
    expect(turn).toMatchObject({ frames, model: "cone", columns: 26, rows: 26 });
    let most = 0;
    for (let step = 0; step <= 96; step++) {
      const [a, b] = [sample(turn, (0.8 * step) / 96), bent(26, 26, step / 96)];
      most = Math.max(most, apart(a, b));
    }
    expect(most / 0.14).toBeLessThanOrEqual(error + 1e-6);
    expect(error).toBeCloseTo(turn.error, 7);
  });

  it("encodes a turn as the engine does: the same frames, quantum and packed bytes", () => {
    const whole = decodeTurn(bytesOf(wholeFile));
    const recorder = new TurnRecorder(whole);
    for (const time of whole.times) recorder.add(time, sample(whole, time));
    const { bytes, error } = recorder.finish(0.001);
    expect(error).toBeCloseTo(corner.error, 6);
    // The error is measured with the reader's own rounding; the checksum follows it.
    const encoded = (file: Uint8Array) => [...file.slice(0, 40), ...file.slice(44, -8)];
    expect(encoded(bytes)).toEqual(encoded(bytesOf(cornerFile)));
  });

  it("keeps fewer frames where less is asked", () => {
    const [fine, rough] = [recordBent(0.0003), recordBent(0.01)];
    expect(rough.frames).toBeLessThan(fine.frames);
    expect(rough.bytes.length).toBeLessThan(fine.bytes.length / 2);
  });

  it("is still what the engine's own test reads", () => {
    const kept = decodeTurn(bytesOf(scriptFile));
    const now = decodeTurn(recordBent().bytes);
    for (const time of [0, 0.2, 0.5, 0.8]) {
      expect(apart(sample(kept, time), sample(now, time))).toBeLessThan(3e-4);
    }
  });

  it("rejects what is no turn", () => {
    const leaf = { width: 0.1, height: 0.2, u: [0, 1], v: [0, 0.5, 1] };
    expect(() => new TurnRecorder({ ...leaf, u: [0, 0.7, 0.6, 1] })).toThrow("rise from 0 to 1");
    expect(() => new TurnRecorder({ ...leaf, width: 0 })).toThrow("above 0");
    const recorder = new TurnRecorder(leaf);
    expect(() => recorder.finish()).toThrow("Nothing was recorded.");
    expect(() => recorder.add(0, [1, 2])).toThrow("A frame of this leaf is 18 finite numbers.");
    recorder.add(0, new Float32Array(18));
    expect(() => recorder.add(0, new Float32Array(18))).toThrow("after the one before");
    expect(() => recorder.finish(0)).toThrow("The tolerance is above 0.");
    for (const tolerance of [Number.POSITIVE_INFINITY, 3e38, 3e6]) {
      expect(() => recorder.finish(tolerance)).toThrow("The tolerance is too large.");
    }
    const one = decodeTurn(recorder.finish().bytes);
    expect([one.frames, one.duration]).toEqual([1, 0]);
    expect(sample(one, 3)).toEqual(new Float32Array(18));
  });
});

describe("a fold", () => {
  const folded = decodeTurn(bytesOf(foldedFile));
  const { creased } = folded;

  it("says how its points lie on the paper and hang together", () => {
    if (!creased) throw new Error("It has no mesh.");
    const { places, triangles, parts } = creased;
    expect([places.length, triangles.length, parts.length]).toEqual([162, 384, 128]);
    let area = 0;
    for (let at = 0; at < triangles.length; at += 3) {
      const [a, b, c] = [0, 1, 2].map((k) => places.subarray(2 * triangles[at + k]));
      const twice = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
      expect(twice).toBeGreaterThan(0);
      area += twice / 2;
    }
    expect(area).toBeCloseTo(1, 4);
    expect([...new Set(parts)].sort()).toEqual([0, 1]);
    // It lies flat at first, where its places say.
    const flat = sample(folded, 0);
    for (let point = 0; point < 81; point++) {
      expect(flat[3 * point]).toBeCloseTo(0.14 * places[2 * point], 3);
      expect(flat[3 * point + 1]).toBeCloseTo(0.21 * places[2 * point + 1], 3);
    }
  });

  it("is drawn with a normal for each side of its crease, on a larger page too", () => {
    if (!creased) throw new Error("It has no mesh.");
    const { points, index } = splitMesh(creased);
    expect(points.length).toBeGreaterThan(81);
    for (const turn of [folded, folded.scaled(0.28, 0.42)]) {
      const end = sample(turn, turn.duration);
      const positions = Float32Array.from(points, (p) => end[3 * p]);
      const all = new Float32Array(3 * points.length);
      for (const [vertex, p] of points.entries()) {
        all.set(end.subarray(3 * p, 3 * p + 3), 3 * vertex);
      }
      expect(positions.every(Number.isFinite)).toBe(true);
      const normals = new Float32Array(all.length);
      writeMeshNormals(index, all, normals);
      for (let vertex = 81; vertex < points.length; vertex++) {
        const [a, b] = [3 * vertex, 3 * points[vertex]];
        const cosine = [0, 1, 2].reduce((sum, k) => sum + normals[a + k] * normals[b + k], 0);
        // Folded by more than a right angle.
        expect(cosine).toBeLessThan(0);
      }
    }
  });

  it("is encoded as the engine does", () => {
    const whole = decodeTurn(bytesOf(foldedWholeFile));
    const { width, height, u, v, model } = whole;
    const recorder = new TurnRecorder({ width, height, u, v, model, creased });
    for (const time of whole.times) recorder.add(time, sample(whole, time));
    const { bytes } = recorder.finish(0.001);
    const encoded = (file: Uint8Array) => [...file.slice(0, 40), ...file.slice(44, -8)];
    expect(encoded(bytes)).toEqual(encoded(bytesOf(foldedFile)));
  });

  it("is rejected if its mesh is none of its points", () => {
    if (!creased) throw new Error("It has no mesh.");
    const leaf = { width: 0.1, height: 0.2, u: even(9), v: even(9) };
    const beyond = { ...creased, triangles: creased.triangles.map((p) => p + 1) };
    const outside = { ...creased, places: creased.places.map((place) => 1.1 * place) };
    const fewer = { ...creased, parts: creased.parts.slice(1) };
    for (const bad of [beyond, outside, fewer]) {
      expect(() => new TurnRecorder({ ...leaf, creased: bad })).toThrow(RangeError);
    }
    expect(() => new TurnRecorder({ ...leaf, u: even(8), creased })).toThrow(RangeError);
  });

  it("is rejected if its mesh is forged, before anything is made of it", () => {
    const sound = bytesOf(foldedFile);
    const view = new DataView(sound.buffer);
    for (const [at, count] of [
      [48, 0],
      [48, 129],
      [48, 2 ** 32 - 1],
      [52, view.getUint32(52, true) - 1],
      [52, 2 ** 32 - 1],
    ] as const) {
      const forged = sound.slice();
      new DataView(forged.buffer).setUint32(at, count, true);
      const end = forged.length - 8;
      forged.set(checksum(forged.subarray(0, end)), end);
      expect(() => decodeTurn(forged), `${count} at ${at}`).toThrow(/\.$/);
    }
  });
});

describe("what is no recorded turn", () => {
  const bytes = bytesOf(cornerFile);

  it("ends early anywhere, or goes on", () => {
    for (let length = 0; length < bytes.length; length += length < 60 ? 1 : 37) {
      expect(() => decodeTurn(bytes.subarray(0, length)), String(length)).toThrow(/\.$/);
    }
    expect(() => decodeTurn(Uint8Array.of(...bytes, 0))).toThrow("bytes long and is");
  });

  it("is changed anywhere", () => {
    for (let at = 0; at < bytes.length; at += at < 60 ? 1 : 31) {
      const changed = bytes.slice();
      changed[at] = (changed[at] ?? 0) ^ 0x10;
      expect(() => decodeTurn(changed), String(at)).toThrow(/^[^.]+[^\n]*\.$/);
    }
  });

  it("is forged: rejected in one sentence, or played in finite numbers", () => {
    let state = 7;
    const random = (below: number): number => {
      state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
      return Math.floor((state / 2 ** 32) * below);
    };
    let played = 0;
    for (let round = 0; round < 600; round++) {
      const forged = bytes.slice();
      const end = forged.length - 8;
      for (let k = random(3); k >= 0; k--) {
        const first = random(4) === 0 ? 4 : 36;
        forged[first + random(end - first)] = random(256);
      }
      forged.set(checksum(forged.subarray(0, end)), end);
      try {
        const turn = decodeTurn(forged);
        expect(sample(turn, 0.2).every(Number.isFinite)).toBe(true);
        played++;
      } catch (error) {
        expect(error).toMatchObject({ name: "TurnError", message: expect.stringMatching(/\.$/) });
      }
    }
    expect(played).toBeGreaterThan(30);
  });

  it("is of masses, or of a newer version", () => {
    const whole = bytesOf(wholeFile);
    whole[6] = 0;
    expect(() => decodeTurn(whole)).toThrow("only recorded surfaces can be played");
    const newer = bytes.slice();
    newer[4] = 4;
    expect(() => decodeTurn(newer)).toThrow("is recorded in version 4");
  });
});

it("a file's name is its content's", async () => {
  const name = await turnName(Uint8Array.of(1, 2, 3));
  expect(name).toBe("turn-039058c6f2c0cb492c533b0a4d14ef77.tlkf");
});
