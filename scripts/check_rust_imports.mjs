/**
 * Checks that the modules of each Rust crate form no cycle (`super::` and re-exports included), that
 * the engine's modules use only lower ones, and that the engine knows no file, clock, thread or
 * network.
 *
 * Home-made, because clippy has no such lint, and what has one (cargo-modules) would be compiled with
 * rust-analyzer for every fresh checkout. `.dependency-cruiser.mjs` checks TypeScript.
 */
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { cyclesOf, modulesOf } from "./imports/rust.mjs";

const root = join(import.meta.dirname, "..");

/** The engine's modules, from low to high, that none below them and none that is not listed may use. */
const engine = ["contact", "key_frames", "loose", "book", "trials"];

const errors = [];

function checkRust() {
  for (const crate of ["engine/src", "wasm/src", "lab/src"]) {
    const modules = modulesOf(join(root, crate));
    for (const cycle of cyclesOf(modules)) {
      const uses = cycle.flatMap((from) =>
        [...modules.get(from).uses]
          .filter((to) => cycle.includes(to))
          .map((to) => `\n  ${from || "(root)"} uses ${to || "(root)"}`),
      );
      errors.push(`${crate}: a cycle of modules:${uses.join("")}`);
    }
    if (crate === "engine/src") checkEngine(modules);
  }
}

function checkEngine(modules) {
  for (const [name, { file, uses }] of modules) {
    const from = engine.indexOf(name.split("::")[0]);
    for (const target of uses) {
      const to = engine.indexOf(target.split("::")[0]);
      if (to >= 0 && from < to) errors.push(`engine: ${name} may not use ${target}`);
    }
    const text = readFileSync(file, "utf8").split("#[cfg(test)]")[0];
    if (/\bstd::(fs|net|thread|time|env|process)\b/.test(text)) {
      errors.push(`${file}: the engine knows no file, clock, thread or network`);
    }
  }
}

checkRust();
for (const error of errors) console.error(error);
if (errors.length > 0) process.exit(1);
console.log("The Rust modules form no cycle.");
