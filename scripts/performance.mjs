/**
 * Measures, and writes the tables of docs/reports/performance.md: no number in them is typed by hand.
 *
 *   node scripts/performance.mjs [TABLE ...]    all tables, or those named, as script_time
 */
import { execFileSync } from "node:child_process";
import { readdirSync, readFileSync, statSync } from "node:fs";
import { cpus } from "node:os";
import { join } from "node:path";
import { gzipSync } from "node:zlib";
import { includeTables, writeTable } from "./docs_tables.mjs";
import { importTs } from "./import_ts.mjs";
import { momentsTable, openingMoments, openingTable, openingTimes } from "./opening_time.mjs";
import { scriptTimes } from "./script_time.mjs";

const root = join(import.meta.dirname, "..");

/** The stocks of paper. */
const { presetStocks } = await importTs("stocks.ts");
const papers = Object.keys(presetStocks).filter((name) => name !== "board");

/** Peak arithmetic of one core on the paper's step and surface (34.4 kflop, 8 f32 lanes), microseconds. */
const floor = 0.4;

const run = (command, ...args) =>
  execFileSync(command, args, {
    cwd: root,
    encoding: "utf8",
    stdio: ["ignore", "pipe", "inherit"],
  });
const lab = (...args) =>
  JSON.parse(run("cargo", "run", "--release", "--quiet", "-p", "lab", "--", ...args, "--json"));

/** Criterion's medians in microseconds by the name of the bench. */
function criterion() {
  for (const bench of ["mass_spring", "sheet", "band"]) {
    run("cargo", "bench", "--quiet", "-p", "turnleaf-engine", "--bench", bench);
  }
  const folder = join(root, "target/criterion");
  const found = {};
  for (const name of readdirSync(folder)) {
    try {
      const read = (file) => JSON.parse(readFileSync(join(folder, name, "new", file), "utf8"));
      const { title } = read("benchmark.json");
      const { median } = read("estimates.json");
      const bound = median.confidence_interval;
      const batch = Number(/^(\d+) x /.exec(title)?.[1] ?? 1);
      const us = (ns) => ns / 1000 / batch;
      found[title.replace(/^\d+ x /, "")] = {
        median: us(median.point_estimate),
        low: us(bound.lower_bound),
        high: us(bound.upper_bound),
      };
    } catch {
      // A folder of criterion's own, such as its report.
    }
  }
  return found;
}

const n = (value, digits = 2) => value.toFixed(digits);
const percent = (value) => `${n(100 * value, 2)} %`;

function costs() {
  const native = criterion();
  run("node", "scripts/build_wasm.mjs", "--trials");
  const wasm = JSON.parse(run("node", "bench/engine_wasm.mjs", "--json")).results;
  const rows = Object.entries(native)
    .sort(([a], [b]) => (a < b ? -1 : 1))
    .map(([name, { median, low, high }]) => {
      const w = wasm[name];
      const browser = w ? `${n(w.median_us)} (${n(w.p5_us)} to ${n(w.p95_us)})` : "";
      return [name, `${n(median)} (${n(low)} to ${n(high)})`, browser];
    });
  const together = "arithmetic of paper step + synchronise + surface at its peak";
  return [["", "native, us", "WASM with SIMD, us"], ...rows, [together, n(floor), ""]];
}

function table1() {
  const variants = [
    ["the paper's way: masses, interpolated for every displayed frame", []],
    ["masses, interpolated once a key frame", ["--interpolate", "key-frame"]],
    ["surface", ["--frames", "surface"]],
  ];
  const rows = variants.map(([label, args]) => {
    const found = lab("table1", "--runs", "10", ...args);
    const times = [n(found.mean_live_ms, 3), n(found.mean_replay_ms, 3)];
    return [label, ...times, n(found.reduction_percent, 1)];
  });
  return [
    ["key frames hold", "live, ms", "replay, ms", "reduction, %"],
    ...rows,
    ["the paper's own (2014)", "11395", "9678", "15.1"],
  ];
}

function strains() {
  const rows = [
    ["paper-2014", "11.4", "column"],
    ["paper-2014", "60", "column"],
    ["book", "0.8", "column"],
    ["book", "0.8", "corner"],
  ].map(([preset, seconds, gesture]) => {
    const turn = lab("turn", "--preset", preset, "--seconds", seconds, "--gesture", gesture);
    const strains = [turn.max_edge_strain, turn.min_edge_strain, turn.max_surface_strain];
    return [preset, seconds, gesture, ...strains.map(percent), turn.steps, n(turn.us_per_step)];
  });
  const headings = ["preset", "seconds", "gesture", "greatest edge strain", "least"];
  return [[...headings, "greatest of the surface", "steps", "us a step"], ...rows];
}

/** Tips of hanging pages beside the heavy elastica. */
function hanging() {
  const rows = ["0.1", "1", "10", "100", "1000"].map((gamma) => {
    const off = (model) => {
      const found = lab("cantilever", "--gamma", gamma, "--model", model);
      return [percent(found.error.tip), found.max_edge_strain.toExponential(1)];
    };
    return [gamma, ...off("sheet"), ...off("shell")];
  });
  const of = (model) => [`${model}, tip off by`, "edge strain"];
  return [["Gamma", ...of("sheet"), ...of("shell")], ...rows];
}

/** The sheet beside the shell over whole turns. */
function agreement() {
  const rows = papers.map((stock) => {
    const { corner, edge } = lab("agree", "--stock", stock);
    const of = (turn) => [percent(turn.rms), percent(turn.worst)];
    return [stock, ...of(corner), ...of(edge)];
  });
  return [["stock", "corner turn, RMS", "worst", "edge turn, RMS", "worst"], ...rows];
}

/** Random gestures on a book's leaves. */
function gestures() {
  const found = lab(
    "gestures",
    ..."--count 300 --seed 1 --kind hands --page usual --stock presets".split(" "),
  );
  const rows = [
    ["all finite", found.finite ? "yes" : "no"],
    ["edge strain, median", percent(found.edge_strain_median)],
    ["edge strain, 99th percentile", percent(found.edge_strain_p99)],
    ["edge strain, worst", percent(found.edge_strain_worst)],
    ["edge strain half a second after letting go, worst", percent(found.edge_strain_after_release)],
    ["drawn surface inside block, cover or leaf, median, mm", n(found.drawn_penetration_median_mm)],
    ["the same, 99th percentile", n(found.drawn_penetration_p99_mm)],
    ["the same, worst", n(found.drawn_penetration_mm)],
    ["the same, in the piles alone, worst", n(found.drawn_penetration_in_piles_mm)],
    ["frames drawn more than 1 mm behind the paper", percent(found.frames_behind_fraction)],
    ["drawn behind the paper, 99th percentile of frames, mm", n(found.drawn_behind_p99_mm)],
    ["depth in the solver, median, mm", n(found.solver_penetration_median_mm)],
    ["the same, 90th percentile", n(found.solver_penetration_p90_mm)],
    ["the same, worst", n(found.solver_penetration_mm)],
    ["all at rest after letting go, median, s", n(found.seconds_to_rest_median)],
    ["the same, worst", n(found.seconds_to_rest_worst)],
    ["a frame, median, us", n(found.us_per_frame_p50, 0)],
    ["a frame, 99th percentile, us", n(found.us_per_frame_p99, 0)],
  ];
  const title = `of ${found.count} gestures from seed ${found.seed}, all preset stocks, usual pages`;
  return [[title, ""], ...rows];
}

/** What a turn costs the page's thread. */
async function frames() {
  const rowOf = ([name, { frames, script, style, layout, all, least, most }]) => {
    const times = [script, style, layout].map((time) => n(time));
    return [name, frames, ...times, `${n(all)} (${n(least)} to ${n(most)})`];
  };
  const rows = Object.entries(await scriptTimes()).map(rowOf);
  const headings = ["a turn of", "frames", "script, ms a frame", "style", "layout"];
  return [[...headings, "together, least and most"], ...rows];
}

function sizes() {
  const dist = join(root, "packages/turnleaf/dist");
  const gzip = (file) => gzipSync(readFileSync(file), { level: 9 }).length;
  const kilobytes = (bytes) => n(bytes / 1000, 1);
  const rows = readdirSync(dist)
    .filter((name) => name.endsWith(".js"))
    .map((name) => ({ name: name.replace(/-[\w-]{8}\.js$/, ".js"), file: join(dist, name) }))
    .sort((a, b) => (a.name === "index.js" ? -1 : a.name < b.name ? -1 : 1))
    .map(({ name, file }) => [name, kilobytes(statSync(file).size), kilobytes(gzip(file))]);
  const parts = JSON.parse(execFileSync("npx", ["size-limit", "--json"], { encoding: "utf8" }));
  const ofParts = parts.map(({ name, size }) => [`together: ${name}`, "", kilobytes(size)]);
  return [["file of the package", "kB", "kB gzip"], ...rows, ...ofParts];
}

const tables = {
  machine: () => [
    ["processor", "Node"],
    [cpus()[0].model.trim(), process.version],
  ],
  costs,
  table1,
  strains,
  hanging,
  agreement,
  gestures_usual: gestures,
  script_time: frames,
  opening: async () => openingTable(await openingTimes()),
  opening_moments: async () => momentsTable(await openingMoments()),
  sizes,
};
const named = process.argv.slice(2);
const unknown = named.find((name) => !(name in tables));
if (unknown) {
  console.error(`There is no table ${unknown}: they are ${Object.keys(tables).join(", ")}.`);
  process.exit(2);
}
run("npm", "run", "--silent", "build");
for (const [name, measure] of Object.entries(tables)) {
  if (named.length === 0 || named.includes(name)) writeTable(name, await measure());
}
includeTables();
console.log("The tables of docs/reports/performance.md are written.");
