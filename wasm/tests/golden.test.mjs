/**
 * The same turns in WASM as in native code, bit for bit. Reads the hashes that
 * the engine's own test holds native code to. Another machine code than the
 * viewer's may be named by TURNLEAF_WASM.
 */
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import test from "node:test";

const root = join(import.meta.dirname, "../..");
const kept = join(root, "packages/turnleaf/src/engine/turnleaf.wasm");
const wasm = readFileSync(process.env.TURNLEAF_WASM || kept);
const golden = readFileSync(join(root, "engine/tests/turns.golden"), "utf8");

const presets = ["paper-2014", "book"];
const gestures = ["column", "corner"];

const { instance } = await WebAssembly.instantiate(wasm, {});

for (const line of golden.trim().split("\n")) {
  const [preset, gesture, seconds, settle, hash] = line.split(" ");
  test(`${preset}, ${gesture}, ${seconds} s: the bits of native code`, () => {
    const found = instance.exports.tl_turn_hash(
      presets.indexOf(preset),
      gestures.indexOf(gesture),
      Number(seconds),
      Number(settle),
    );
    assert.equal(BigInt.asUintN(64, found).toString(16).padStart(16, "0"), hash);
  });
}
