import { expect, test } from "vitest";
import { unpackLzma } from "./src/engine/lzma.ts";
import { packLzma } from "./wasm_inline.js";

/** Bytes that need every kind of symbol: fresh ones, runs, and what was said near and far before. */
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

test.each([
  [1, 256, 1],
  [5000, 4, 2],
  [200_000, 256, 3],
  [300_000, 16, 4],
])("%i bytes of %i letters come back as they were", (length, letters, seed) => {
  const bytes = bytesOf(length, letters, seed);
  const found = unpackLzma(packLzma(bytes));
  expect(found.length).toBe(length);
  expect(found.every((byte, at) => byte === bytes[at])).toBe(true);
});
