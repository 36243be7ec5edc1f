/**
 * The WASM of books prints no numbers: what does takes 20 kB, and comes in with one panic that would
 * print its figures, as that of `clamp` between bounds that are no constants.
 */
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import test from "node:test";

const engine = join(import.meta.dirname, "../../packages/turnleaf/src/engine");

/** What the standard library asserts as it finds the digits of a floating-point number. */
const digits = "assertion failed: d.mant > 0";

for (const file of ["turnleaf.wasm", "creases.wasm"]) {
  test(`${file} has nothing that prints floating-point numbers`, () => {
    const text = readFileSync(join(engine, file), "latin1");
    assert.ok(!text.includes(digits));
  });
}
