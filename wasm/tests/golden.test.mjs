/**
 * The same turns in WASM as in native code, bit for bit. Reads the hashes that
 * the engine's own test holds native code to. Riffles are turned by the machine
 * code that the viewer ships, through the exports that it calls; loose leaves by
 * the machine code that is shipped beside it; the sheet and the paper's model by
 * target/trials.wasm, where `node scripts/build_wasm.mjs`
 * has built it.
 */
import assert from "node:assert/strict";
import { existsSync, readFileSync } from "node:fs";
import { join } from "node:path";
import test from "node:test";
import { Riffle } from "./riffle.mjs";

const root = join(import.meta.dirname, "../..");
const shipped = join(root, "packages/turnleaf/src/engine/turnleaf.wasm");
const leaves = join(root, "packages/turnleaf/src/models/models.wasm");
const trials = join(root, "target/trials.wasm");
const golden = readFileSync(join(root, "engine/tests/turns.golden"), "utf8");

const presets = ["paper-2014", "book"];
const gestures = ["column", "corner"];
/** The models by their numbers less 1, as the loose leaves are written down. */
const models = [...golden.matchAll(/^loose (\S+)/gm)].map(([, name]) => name);

async function load(file) {
  const { instance } = await WebAssembly.instantiate(readFileSync(file), {});
  return instance.exports;
}

/** The hash of one of the scenes that only benches and tests know, by the words of its line. */
function hashOfScene(engine, [model, gesture, seconds, settle]) {
  if (model === "sheet") return engine.tl_sheet_hash();
  if (model === "creased") return engine.tl_creased_hash();
  const [preset, path] = [presets.indexOf(model), gestures.indexOf(gesture)];
  return engine.tl_turn_hash(preset, path, Number(seconds), Number(settle));
}

/** FNV-1a, 64 bits, as the engine's `BitHash`, in two halves that doubles hold exactly. */
class BitHash {
  #high = 0xcbf29ce4;
  #low = 0x84222325;

  bytes(bytes) {
    let [high, low] = [this.#high, this.#low];
    for (const byte of bytes) {
      low = (low ^ byte) >>> 0;
      const product = low * 0x1b3;
      high = (high * 0x1b3 + Math.floor(product / 2 ** 32) + low * 256) % 2 ** 32;
      low = product % 2 ** 32;
    }
    [this.#high, this.#low] = [high, low];
  }

  get value() {
    return (BigInt(this.#high) << 32n) | BigInt(this.#low);
  }
}

/** As the engine's `riffle_hash`. */
function hashOfRiffle(engine, stock) {
  const riffle = new Riffle(engine, stock, 6);
  const hash = new BitHash();
  for (let frame = 0; frame < 60; frame++) {
    if (frame === 10) riffle.catchOne();
    riffle.frame();
    for (const bytes of riffle.drawn()) hash.bytes(bytes);
  }
  riffle.drop();
  return hash.value;
}

function hashOf(engine, words) {
  const [kind, name] = words;
  if (kind === "riffle") return hashOfRiffle(engine, name);
  if (kind === "loose") return engine.tl_leaf_hash(models.indexOf(name) + 1);
  return hashOfScene(engine, words);
}

for (const line of golden.trim().split("\n")) {
  const words = line.split(" ");
  const hash = words.pop();
  const file = { riffle: shipped, loose: leaves }[words[0]] ?? trials;
  const skip = existsSync(file) ? false : "no target/trials.wasm: node scripts/build_wasm.mjs";
  test(`${words.join(" ")}: the bits of native code`, { skip }, async () => {
    const engine = await load(file);
    const found = hashOf(engine, words);
    assert.equal(BigInt.asUintN(64, found).toString(16).padStart(16, "0"), hash);
  });
}

const functionsOf = (engine) =>
  Object.keys(engine).filter((name) => typeof engine[name] === "function");

test("the shipped machine code holds what the viewer calls and nothing else", async () => {
  const wrapper = readFileSync(join(root, "packages/turnleaf/src/engine/wasm_book.ts"), "utf8");
  const called = new Set(wrapper.match(/\btl_\w+/g));
  const exported = functionsOf(await load(shipped));
  assert.deepEqual(exported.sort(), [...called].sort());
});

test("the machine code of loose leaves holds what its wrapper calls and nothing else", async () => {
  const wrapper = readFileSync(join(root, "packages/turnleaf/src/models/models.ts"), "utf8");
  const called = new Set(wrapper.match(/\btl_\w+/g));
  const exported = functionsOf(await load(leaves));
  assert.deepEqual(exported.sort(), [...called].sort());
});
