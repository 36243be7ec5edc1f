/**
 * Cost in WASM of a frame at 60 Hz of a book with one, three and ten leaves in the air:
 * two ticks and what is drawn, by the machine code that the viewer ships and, beside it,
 * by any other builds named.
 *
 *   node bench/leaves.mjs [--stock card] [--json] [before.wasm ...]
 *
 * A riffle is the same every time, so each frame counts by the shortest of several
 * rounds, in which the builds take turns: what else the machine does is left out. Prints
 * the mean over the frames, the median and the slowest.
 */
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { parseArgs } from "node:util";
import { Riffle, stocks } from "../wasm/tests/riffle.mjs";

const { values, positionals } = parseArgs({
  allowPositionals: true,
  options: { stock: { type: "string", default: "book" }, json: { type: "boolean" } },
});
if (!stocks.includes(values.stock)) {
  console.error(`--stock is one of ${stocks.join(", ")}.`);
  process.exit(2);
}
const root = join(import.meta.dirname, "..");
const shipped = join(root, "packages/turnleaf/src/engine/turnleaf.wasm");

const ROUNDS = 6;
const FRAMES = 120;

async function load(file) {
  return (await WebAssembly.instantiate(readFileSync(file), {})).instance.exports;
}

/** Milliseconds of each frame of each build's riffle. */
function measure(engines, leaves) {
  const least = engines.map(() => new Array(FRAMES).fill(Infinity));
  for (let round = 0; round < ROUNDS; round++) {
    engines.forEach((engine, build) => {
      const riffle = new Riffle(engine, values.stock, leaves);
      for (let frame = 0; frame < FRAMES; frame++) {
        const start = performance.now();
        riffle.frame();
        least[build][frame] = Math.min(least[build][frame], performance.now() - start);
      }
      riffle.drop();
    });
  }
  return least.map((times) => {
    times.sort((a, b) => a - b);
    return {
      mean_ms: times.reduce((sum, time) => sum + time) / FRAMES,
      median_ms: times[FRAMES / 2],
      slowest_ms: times[FRAMES - 1],
    };
  });
}

const builds = [shipped, ...positionals];
const engines = await Promise.all(builds.map(load));
const results = {};
for (const leaves of [1, 3, 10]) {
  const found = measure(engines, leaves);
  results[leaves] = Object.fromEntries(
    found.map((figures, k) => [positionals[k - 1] ?? "shipped", figures]),
  );
}

if (values.json) {
  console.log(JSON.stringify({ node: process.version, stock: values.stock, results }, null, 2));
} else {
  for (const [leaves, builds] of Object.entries(results)) {
    for (const [name, { mean_ms, median_ms, slowest_ms }] of Object.entries(builds)) {
      const others = `median ${median_ms.toFixed(2)}, slowest ${slowest_ms.toFixed(2)}`;
      console.log(
        `${leaves.padStart(2)} in the air, ${name}: ${mean_ms.toFixed(2)} ms a frame (${others})`,
      );
    }
  }
}
