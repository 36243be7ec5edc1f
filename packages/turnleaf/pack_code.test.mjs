import { readFileSync } from "node:fs";
import { expect, test } from "vitest";
import { packCode } from "./pack_code.js";
import { unpackCode } from "./src/engine/machine_code.ts";

/** Bytes with runs and with what was said near and far before. */
function bytesOf(length, letters, seed) {
  const bytes = new Uint8Array(length);
  let random = seed;
  const next = (below) => {
    random = (Math.imul(random, 1664525) + 1013904223) >>> 0;
    return Math.floor((random / 2 ** 32) * below);
  };
  for (let at = 0; at < length; ) {
    const back = next(3) === 0 ? 0 : next(at + 1);
    for (let count = next(40) + 1; count > 0 && at < length; count--, at++) {
      bytes[at] = back === 0 ? next(letters) : bytes[at - back];
    }
  }
  return bytes;
}

const same = (found, bytes) => Buffer.compare(Buffer.from(found), Buffer.from(bytes)) === 0;

test.each([
  [0, 256, 1],
  [1, 256, 1],
  [5000, 4, 2],
  [40_000, 256, 3],
  [40_000, 16, 4],
])("%i bytes of %i letters come back as they were", async (length, letters, seed) => {
  const bytes = bytesOf(length, letters, seed);
  expect(same(await unpackCode(await packCode(bytes)), bytes)).toBe(true);
});

test("what looks like functions and is not comes back as well", async () => {
  const head = [0, 0x61, 0x73, 0x6d, 1, 0, 0, 0, 10, 0xff, 0x7f, 1];
  const bytes = Uint8Array.from([...head, ...bytesOf(20_000, 256, 5)]);
  expect(same(await unpackCode(await packCode(bytes)), bytes)).toBe(true);
});

test("the engine packs to less than a third, and comes back as it was", async () => {
  const bytes = readFileSync(new URL("./src/engine/turnleaf.wasm", import.meta.url));
  const packed = await packCode(bytes);
  expect(packed.length).toBeLessThan(bytes.length / 3);
  expect(same(await unpackCode(packed), bytes)).toBe(true);
});
