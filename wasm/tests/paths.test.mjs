/**
 * The committed WASM names no folder of the machine that built it. That it is the same wherever it is
 * built is what scripts/verify_wasm.mjs checks.
 */
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { basename, join } from "node:path";
import test from "node:test";
import { absolutePaths } from "../../scripts/wasm_paths.mjs";

const root = join(import.meta.dirname, "../..");
const committed = ["engine/turnleaf.wasm", "engine/creases.wasm", "models/models.wasm"];

for (const file of committed) {
  test(`${basename(file)} names no folder of a machine`, () => {
    const wasm = readFileSync(join(root, "packages/turnleaf/src", file));
    assert.deepEqual(absolutePaths(wasm), []);
  });
}

test("absolute paths are found among machine code", () => {
  const bytes = Buffer.from([0, 255, 47, 65, 66, 0, 1]);
  const sample = (text) => Buffer.concat([bytes, Buffer.from(text, "latin1"), bytes]);
  for (const path of [
    "/home/ann/.rustup/toolchains/1.95.0/lib/rustlib/src/rust/library/core/src/str.rs",
    "/home/me/turnleaf",
    "C:\\Users\\me\\turnleaf",
  ]) {
    assert.deepEqual(absolutePaths(sample(path)), [path]);
  }
  for (const place of [
    "/rustc/59807616e1fa2540724bfbac14d7976d7e4a3860/library/core/src/num/bignum.rs",
    "engine/src/book/leaf.rswasm/src/live.rs",
    "crates/libm-0.2.16/src/math/exp.rs",
  ]) {
    assert.deepEqual(absolutePaths(sample(place)), []);
  }
  assert.deepEqual(absolutePaths(sample("engine/src/book.rs/home/ann/x.rs")), ["/home/ann/x.rs"]);
  assert.deepEqual(absolutePaths(sample("3 to 16 columns and/or rows")), []);
});
