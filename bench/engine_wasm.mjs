/**
 * Cost in WASM: the paper's step and surface, the sheet's frame, and a riffle,
 * which is turned by the machine code that the viewer ships.
 *
 *   node scripts/build_wasm.mjs --trials
 *   node bench/engine_wasm.mjs [--json]
 *
 * Prints the median over batches, and the 5th and 95th percentile.
 */
import { existsSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { Riffle } from "../wasm/tests/riffle.mjs";

const root = join(import.meta.dirname, "..");
const shipped = join(root, "packages/turnleaf/src/engine/turnleaf.wasm");
const creasable = join(root, "packages/turnleaf/src/engine/creases.wasm");
const file = join(root, "target/trials.wasm");
if (!existsSync(file)) {
  console.error(`There is no ${file}: run node scripts/build_wasm.mjs --trials.`);
  process.exit(2);
}

async function load(file) {
  const { instance } = await WebAssembly.instantiate(readFileSync(file), {});
  return instance.exports;
}

const engine = await load(file);
const PAPER = 0;
const BOOK = 1;

/** Tip of a page that hangs with Gamma 10, over its width: the heavy elastica. */
const exact = { drop: 0.7001997155, reach: 0.6563537612 };

/** Microseconds of one of the `count` things that `work(count)` does. */
function measure(work, count) {
  const batches = [];
  for (let warm = 0; warm < 40; warm++) work(count);
  for (let batch = 0; batch < 200; batch++) {
    const start = performance.now();
    work(count);
    batches.push(((performance.now() - start) * 1000) / count);
  }
  batches.sort((a, b) => a - b);
  const at = (part) => batches[Math.floor(part * (batches.length - 1))];
  return { median_us: at(0.5), p5_us: at(0.05), p95_us: at(0.95) };
}

const paper = engine.tl_bench_new(PAPER);
const book = engine.tl_bench_new(BOOK);
const results = {
  "paper step + synchronise": measure((n) => engine.tl_bench_steps(paper, n, 0), 400),
  "surface 26x26 (positions)": measure((n) => engine.tl_bench_surfaces(paper, n), 400),
  "paper step + synchronise + surface": measure((n) => engine.tl_bench_steps(paper, n, 1), 400),
  "normals 26x26": measure((n) => engine.tl_bench_normals(paper, n), 200),
  "book step, 4 substeps": measure((n) => engine.tl_bench_steps(book, n, 0), 60),
};
engine.tl_bench_drop(paper);
engine.tl_bench_drop(book);

/** A fixed amount of work at a time, so that slow things take no longer than quick ones. */
const times = (work) => (count) => {
  for (let i = 0; i < count; i++) work();
};
for (const [columns, rows] of [
  [8, 12],
  [10, 14],
  [12, 16],
  [16, 24],
]) {
  const sheet = engine.tl_bench_sheet_new(columns, rows, 10);
  const [drop, reach] = [engine.tl_bench_sheet_drop(sheet), engine.tl_bench_sheet_reach(sheet)];
  const error = 100 * Math.hypot(drop - exact.drop, reach - exact.reach);
  const name = `sheet frame ${columns} x ${rows}, off by ${error.toFixed(2)} %`;
  results[name] = measure(
    times(() => engine.tl_bench_sheet_frame(sheet)),
    8,
  );
  engine.tl_bench_sheet_free(sheet);
}
for (const creases of [0, 1, 2, 3]) {
  const sheet = engine.tl_bench_creased_new(creases);
  results[`a book's leaf alone, ${creases} creases, a frame`] = measure(
    times(() => engine.tl_bench_sheet_frame(sheet)),
    8,
  );
  engine.tl_bench_sheet_free(sheet);
}
for (const leaves of [1, 10]) {
  const riffle = new Riffle(await load(shipped), "book", leaves);
  results[`book frame, ${leaves} in flight`] = measure(
    times(() => riffle.frame()),
    4,
  );
}
for (const leaves of [1, 3]) {
  for (const isFolded of [false, true]) {
    const riffle = new Riffle(await load(creasable), "book", leaves);
    if (isFolded) riffle.foldCorners();
    for (let frame = 0; frame < 60; frame++) riffle.frame();
    const name = `book with creases, ${leaves} in flight${isFolded ? ", dog-eared" : ""}`;
    results[name] = measure(
      times(() => riffle.frame()),
      4,
    );
  }
}

if (process.argv.includes("--json")) {
  console.log(JSON.stringify({ node: process.version, results }, null, 2));
} else {
  for (const [name, { median_us, p5_us, p95_us }] of Object.entries(results)) {
    const spread = `${p5_us.toFixed(2)} to ${p95_us.toFixed(2)}`;
    console.log(`${name.padEnd(36)} ${median_us.toFixed(2).padStart(7)} us  (${spread})`);
  }
}
