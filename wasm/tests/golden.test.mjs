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
const stocks = ["bible", "book", "office", "coated", "card"];

const { instance } = await WebAssembly.instantiate(wasm, {});

/** The hash of a scene, as the line before its hash names it. */
function hashOf([model, ...rest]) {
  const engine = instance.exports;
  if (model === "sheet") return engine.tl_sheet_hash();
  if (model === "riffle") return engine.tl_riffle_hash(stocks.indexOf(rest[0]));
  const [gesture, seconds, settle] = rest;
  const [preset, path] = [presets.indexOf(model), gestures.indexOf(gesture)];
  return engine.tl_turn_hash(preset, path, Number(seconds), Number(settle));
}

for (const line of golden.trim().split("\n")) {
  const words = line.split(" ");
  const hash = words.pop();
  test(`${words.join(" ")}: the bits of native code`, () => {
    const found = BigInt.asUintN(64, hashOf(words));
    assert.equal(found.toString(16).padStart(16, "0"), hash);
  });
}
