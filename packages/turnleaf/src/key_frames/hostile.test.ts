/**
 * Files that claim far more than they hold: rejected, or read with memory and
 * work in proportion.
 */
import { afterEach, describe, expect, it, vi } from "vitest";
import cornerFile from "../../../../engine/tests/fixtures/corner.tlkf?inline";
import { fuzz, Random, seed } from "../for_tests/random_numbers.ts";
import { BitWriter } from "./bits.ts";
import { checksum, packedHeader } from "./file.ts";
import { decodeTurn, TurnError } from "./key_frames.ts";

afterEach(() => vi.unstubAllGlobals());

/**
 * Returns a file of version 2 with these counts, its coefficients `packed`,
 * with a valid checksum.
 */
function turnFile(columns: number, rows: number, frames: number, packed: Uint8Array): Uint8Array {
  const even = (n: number) => Array.from({ length: n }, (_, i) => i / (n - 1));
  const reals = [...even(columns), ...even(rows)];
  const packedAt = packedHeader + 4 * (reals.length + frames);
  const bytes = new Uint8Array(packedAt + packed.length + 8);
  const view = new DataView(bytes.buffer);
  view.setUint32(0, 0x544c4b46);
  view.setUint16(4, 2, true);
  view.setUint16(6, 1, true);
  view.setUint32(8, 2, true);
  view.setFloat32(16, 0.14, true);
  view.setFloat32(20, 0.21, true);
  for (const [i, count] of [columns, rows, frames].entries())
    view.setUint32(24 + 4 * i, count, true);
  view.setFloat32(36, 0.001, true);
  view.setUint32(44, packed.length, true);
  for (const [i, real] of reals.entries()) view.setFloat32(packedHeader + 4 * i, real, true);
  const times = packedHeader + 4 * reals.length;
  for (let i = 0; i < frames; i++) view.setFloat32(times + 4 * i, i, true);
  bytes.set(packed, packedAt);
  bytes.set(checksum(bytes.subarray(0, -8)), bytes.length - 8);
  return bytes;
}

/** Counts the typed arrays that are created, and their bytes. */
function countArrays() {
  const made = { arrays: 0, bytes: 0 };
  for (const name of ["Int32Array", "Uint32Array", "Float32Array", "Float64Array"] as const) {
    const counting = new Proxy(globalThis[name], {
      construct(target, args, newTarget) {
        const array = Reflect.construct(target, args, newTarget);
        // A view of a buffer takes none of its own.
        if (!(args[0] instanceof ArrayBuffer)) made.bytes += array.byteLength;
        made.arrays++;
        return array;
      },
    });
    vi.stubGlobal(name, counting);
  }
  return made;
}

describe("counts that a file cannot fill", () => {
  it("a hundred thousand frames of nothing take no more arrays than one", () => {
    const frames = 2 ** 17;
    // Every axis of every frame: way 0, and a run of no numbers.
    const bytes = turnFile(2, 2, frames, new Uint8Array(9 * frames));
    expect(bytes.length).toBeGreaterThan(1.7e6);
    const made = countArrays();
    const turn = decodeTurn(bytes);
    expect(turn.frames).toBe(frames);
    expect(made.arrays).toBeLessThan(100);
    // The positions, 12 bytes per point, were requested.
    expect(made.bytes).toBeLessThan(1.2 * 12 * 4 * frames);
  });

  it("more frames than the packed bytes can hold are rejected before anything is allocated", () => {
    for (const [columns, frames] of [
      [2, 2 ** 20],
      [256, 64],
    ] as const) {
      const bytes = turnFile(columns, columns, frames, new Uint8Array(9 * frames - 1));
      const made = countArrays();
      expect(() => decodeTurn(bytes)).toThrow("A frame of this recorded turn cannot be read.");
      expect(made.bytes).toBe(0);
      vi.unstubAllGlobals();
    }
  });

  it("more points than a turn has, or bytes than are there, are rejected likewise", () => {
    const small = turnFile(2, 2, 1, new Uint8Array(9));
    const rejected: [number, number, string][] = [
      [24, 257, "The header of this recorded turn cannot be."],
      [32, 2 ** 21, "The header of this recorded turn cannot be."],
      [32, 2 ** 19, "bytes long and is"],
      [44, 0xffffffff, "bytes long and is"],
    ];
    for (const version of [1, 2]) {
      for (const [at, count, sentence] of rejected) {
        const bytes = small.slice();
        const view = new DataView(bytes.buffer);
        view.setUint16(4, version, true);
        view.setUint32(at, count, true);
        const made = countArrays();
        if (version === 2) expect(() => decodeTurn(bytes)).toThrow(sentence);
        else expect(() => decodeTurn(bytes)).toThrow(TurnError);
        expect(made.bytes).toBe(0);
        vi.unstubAllGlobals();
      }
    }
  });
});

describe("random files", () => {
  const corner = Uint8Array.from(atob(cornerFile.slice(cornerFile.indexOf(",") + 1)), (c) =>
    c.charCodeAt(0),
  );

  /**
   * Counts near their bounds, and coefficients that are random bits, or runs of
   * numbers of any size.
   */
  function invented(random: (below: number) => number): Uint8Array {
    const side = () => [2, 3, 9, 26, 256][random(5)];
    const [columns, rows] = [side(), side()];
    // Of the largest grids few frames: decoding one takes as long as all other files.
    const longest = columns * rows > 2 ** 14 ? 4 : 60;
    const frames = 1 + random(random(2) ? 4 : longest);
    const writer = new BitWriter();
    if (random(2) === 0) {
      for (let k = random(4000); k >= 0; k--) writer.bits(random(2 ** 16), 16);
    } else {
      for (let at = 0; at < 3 * frames; at++) {
        writer.bits(random(Math.min(Math.floor(at / 3), 2) + 1), 2);
        const size = 2 ** random(26);
        writer.run(Int32Array.from({ length: random(20) }, () => random(size) - size / 2));
      }
    }
    return turnFile(columns, rows, frames, writer.bytes);
  }

  /** A sound file with some bytes changed, its checksum made to fit. */
  function changed(random: (below: number) => number): Uint8Array {
    const bytes = corner.slice(0, random(8) === 0 ? random(corner.length) : undefined);
    const end = Math.max(bytes.length - 8, 0);
    for (let k = random(6); k > 0 && end > 0; k--) {
      bytes[random(end)] = random(3) === 0 ? 255 * random(2) : random(256);
    }
    bytes.set(checksum(bytes.subarray(0, end)).subarray(0, bytes.length - end), end);
    return bytes;
  }

  it(`are rejected in one sentence, or played in finite numbers (seed ${seed})`, {
    timeout: 120_000 * fuzz,
  }, () => {
    const numbers = new Random();
    const random = (below: number): number => numbers.below(below);
    let played = 0;
    for (let round = 0; round < 240 * fuzz; round++) {
      const bytes = round % 2 === 0 ? invented(random) : changed(random);
      try {
        const turn = decodeTurn(bytes);
        const frame = new Float32Array(3 * turn.columns * turn.rows);
        for (const fraction of [0, 0.37, 1]) {
          turn.sample(fraction * turn.duration, frame);
          expect(frame.every(Number.isFinite)).toBe(true);
        }
        played++;
      } catch (error) {
        expect(error).toMatchObject({
          name: "TurnError",
          message: expect.stringMatching(/^[^\n]+\.$/),
        });
      }
    }
    expect(played).toBeGreaterThan(10);
  });
});
