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
import { quantiles } from "./quantiles.mjs";
import { droppedFrames, flapFrames, foldedTurns, tornFrames } from "./scenes.mjs";

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
  const { median_us, p5_us, p95_us } = percentiles(batches);
  return { median_us, p5_us, p95_us };
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
for (const folded of [1, 3]) {
  const name = `${folded} dog-eared ${folded === 1 ? "leaf" : "leaves"} turned and back, a frame`;
  results[name] = percentiles(foldedTurns(await load(creasable), folded));
}
const ofTorn = tornFrames(await load(creasable)).map(percentiles);
const [torn, crumpled, across, begun, parted] = ofTorn;
const turning = percentiles(tornFrames(await load(creasable), true)[2]);
results["a leaf torn out and carried, a frame"] = torn;
results["a sheet crumpled and let fall, a frame"] = crumpled;
results["a sheet torn across, a frame"] = across;
results["along a path that turns, a frame"] = turning;
results["its tear begun"] = begun;
results["its pieces parted"] = parted;
const onOthers = droppedFrames(await load(creasable)).map(percentiles);
results["a loose sheet alone, a frame"] = onOthers[0];
results["dropped upon two others, a frame"] = onOthers[1];
results["pulled out from below two others, a frame"] = onOthers[2];
for (const panels of [1, 2, 3]) {
  results[`a fold-out of ${panels} panels opened and shut, a frame`] = percentiles(
    flapFrames(await load(creasable), panels),
  );
}

/** The median, the 5th and 95th percentile and the worst of some times. */
function percentiles(times) {
  const at = quantiles(times);
  return { median_us: at(0.5), p5_us: at(0.05), p95_us: at(0.95), worst_us: at(1) };
}

if (process.argv.includes("--json")) {
  console.log(JSON.stringify({ node: process.version, results }, null, 2));
} else {
  for (const [name, { median_us, p5_us, p95_us, worst_us }] of Object.entries(results)) {
    const worst = worst_us === undefined ? "" : `, worst ${worst_us.toFixed(2)}`;
    const spread = `${p5_us.toFixed(2)} to ${p95_us.toFixed(2)}${worst}`;
    console.log(`${name.padEnd(36)} ${median_us.toFixed(2).padStart(7)} us  (${spread})`);
  }
}
