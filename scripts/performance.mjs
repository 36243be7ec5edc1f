/**
 * Measures, and writes docs/performance.md: no number in it is typed by hand.
 *
 *   node scripts/performance.mjs
 */
import { execFileSync } from "node:child_process";
import { readdirSync, readFileSync, statSync, writeFileSync } from "node:fs";
import { cpus } from "node:os";
import { join } from "node:path";
import { gzipSync } from "node:zlib";
import { scriptTimes } from "./script_time.mjs";
import { viewerSize } from "./size.mjs";

const root = join(import.meta.dirname, "..");

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

function costs(native, wasm) {
  const together = "paper step + synchronise + surface";
  const rows = Object.entries(native)
    .sort(([a], [b]) => (a < b ? -1 : 1))
    .map(([name, { median, low, high }]) => {
      const w = wasm[name];
      const browser = w ? `${n(w.median_us)} (${n(w.p5_us)} to ${n(w.p95_us)})` : "";
      return `| ${name} | ${n(median)} (${n(low)} to ${n(high)}) | ${browser} |`;
    });
  const ratio = (us) => n(us / floor, 1);
  return `| | native, us | WASM with SIMD, us |
|---|---|---|
${rows.join("\n")}

Native: criterion's median and its 95 % confidence interval. WASM: median, 5th and 95th percentile of 200 batches in Node. The floor of the paper's step, synchronisation and surface together, all arithmetic at the peak of eight lanes, is about ${floor} us: native takes ${ratio(native[together].median)} times that, WASM ${ratio(wasm[together].median_us)} times.`;
}

function table1Row(label, result) {
  return `| ${label} | ${n(result.mean_live_ms, 3)} | ${n(result.mean_replay_ms, 3)} | ${n(result.reduction_percent ?? (1 - result.mean_replay_ms / result.mean_live_ms) * 100, 1)} |`;
}

function table1() {
  const variants = [
    ["masses, interpolated for every displayed frame", ["--interpolate", "frame"]],
    ["masses, interpolated once a key frame", []],
    ["surface", ["--frames", "surface"]],
  ];
  const rows = variants.map(([label, args]) =>
    table1Row(label, lab("table1", "--runs", "10", ...args)),
  );
  return `| key frames hold | live, ms | replay, ms | reduction, % |
|---|---|---|---|
${rows.join("\n")}
| the paper's own (2014) | 11395 | 9678 | 15.1 |`;
}

function strains() {
  const rows = [
    ["paper-2014", "11.4", "column"],
    ["paper-2014", "60", "column"],
    ["book", "0.8", "column"],
    ["book", "0.8", "corner"],
  ].map(([preset, seconds, gesture]) => {
    const turn = lab("turn", "--preset", preset, "--seconds", seconds, "--gesture", gesture);
    return `| ${preset} | ${seconds} | ${gesture} | ${percent(turn.max_edge_strain)} | ${percent(turn.min_edge_strain)} | ${percent(turn.max_surface_strain)} | ${turn.steps} | ${n(turn.us_per_step)} |`;
  });
  return `| preset | seconds | gesture | greatest edge strain | least | greatest of the surface | steps | us a step |
|---|---|---|---|---|---|---|---|
${rows.join("\n")}`;
}

/** Tips of hanging pages beside the heavy elastica. */
function hanging() {
  const rows = ["0.1", "1", "10", "100", "1000"].map((gamma) => {
    const off = (model) => {
      const found = lab("cantilever", "--gamma", gamma, "--model", model);
      return `${percent(found.error.tip)} | ${found.max_edge_strain.toExponential(1)}`;
    };
    return `| ${gamma} | ${off("sheet")} | ${off("shell")} |`;
  });
  return `| Gamma | sheet, tip off by | edge strain | shell, tip off by | edge strain |
|---|---|---|---|---|
${rows.join("\n")}`;
}

/** The sheet beside the shell over whole turns. */
function agreement() {
  const rows = ["bible", "book", "office", "coated", "card"].map((stock) => {
    const { corner, edge } = lab("agree", "--stock", stock);
    const of = (turn) => `${percent(turn.rms)} | ${percent(turn.worst)}`;
    return `| ${stock} | ${of(corner)} | ${of(edge)} |`;
  });
  return `| stock | corner turn, RMS | worst | edge turn, RMS | worst |
|---|---|---|---|---|
${rows.join("\n")}`;
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
    ["frames drawn more than 1 mm behind the paper", percent(found.frames_behind_share)],
    ["drawn behind the paper, 99th percentile of frames, mm", n(found.drawn_behind_p99_mm)],
    ["depth in the solver, median, mm", n(found.solver_penetration_median_mm)],
    ["the same, 90th percentile", n(found.solver_penetration_p90_mm)],
    ["the same, worst", n(found.solver_penetration_mm)],
    ["all at rest after letting go, median, s", n(found.seconds_to_rest_median)],
    ["the same, worst", n(found.seconds_to_rest_worst)],
    ["a frame, median, us", n(found.us_per_frame_p50, 0)],
    ["a frame, 99th percentile, us", n(found.us_per_frame_p99, 0)],
  ];
  return `| of ${found.count} gestures from seed ${found.seed}, all preset stocks, usual pages | |
|---|---|
${rows.map(([name, value]) => `| ${name} | ${value} |`).join("\n")}`;
}

/** What a turn costs the page's thread. */
async function frames() {
  const rows = Object.entries(await scriptTimes()).map(
    ([name, { frames, script, style, layout, all, least, most }]) =>
      `| ${name} | ${frames} | ${n(script)} | ${n(style)} | ${n(layout)} | ${n(all)} (${n(least)} to ${n(most)}) |`,
  );
  return `| a turn of | frames | script, ms a frame | style | layout | together, least and most |
|---|---|---|---|---|---|
${rows.join("\n")}

In Chromium, by its own count of the thread's time, the engine's steps included; medians of fresh pages. Wanted are 4 ms for one leaf.`;
}

function sizes() {
  const dist = join(root, "packages/turnleaf/dist");
  const gzip = (file) => gzipSync(readFileSync(file), { level: 9 }).length;
  const kilobytes = (bytes) => n(bytes / 1000, 1);
  const rows = readdirSync(dist)
    .filter((name) => name.endsWith(".js"))
    .map((name) => ({ name: name.replace(/-[\w-]{8}\.js$/, ".js"), file: join(dist, name) }))
    .sort((a, b) => (a.name === "index.js" ? -1 : a.name < b.name ? -1 : 1))
    .map(
      ({ name, file }) =>
        `| ${name} | ${kilobytes(statSync(file).size)} | ${kilobytes(gzip(file))} |`,
    );
  return `| file of the package | kB | kB gzip |
|---|---|---|
${rows.join("\n")}

The viewer without three.js and the page sources, the engine's WASM inlined, is ${kilobytes(viewerSize().gzip)} kB gzip, of which a page loads at once what \`index.js\` imports, and everything else when it is needed (\`node scripts/size.mjs\`).`;
}

run("npm", "run", "--silent", "build");
const native = criterion();
run("node", "scripts/build_wasm.mjs", "--trials");
const wasm = JSON.parse(run("node", "bench/engine_wasm.mjs", "--json")).results;
/** What `make soak` has written last: it takes longer than all the rest. */
const memory = () =>
  /<!-- soak -->[\s\S]*<!-- \/soak -->[\s\S]*/
    .exec(readFileSync(join(root, "docs/performance.md"), "utf8"))[0]
    .trimEnd();

const text = `# Performance

Written by \`node scripts/performance.mjs\`; every number is that run's. One core of: ${cpus()[0].model.trim()}, Node ${process.version}. Shared machines are noisy: compare ratios within one run.

## Cost of a step and of a surface

${costs(native, wasm)}

## Table 1 of the paper

One full turn of the column path, 11.4 s in steps of 1/60 s, each step displayed: ten runs, the mean of a turn.

${table1()}

Counted: stepping and synchronising the masses (live), blending key frames (replay), and the 676 points of every displayed frame in all of them. Not counted: recording, drawing, normals, allocation before the first frame. The live side is the same in all rows, and is the one in the table of costs above.

Interpolation is linear in the masses, so a blend of interpolated key frames is, but for rounding, the interpolation of blended masses. The second row uses that: each key frame is interpolated once, when the replay reaches it, and displayed frames blend two surfaces. The first row is the paper taken literally, which interpolates anew for every displayed frame; there the surface's cost is in both columns, and a tuned step with synchronisation costs less than the surface: however cheap its blending, such a replay cannot save more than the step's share of a frame, about ${n((100 * native["paper step + synchronise"].median) / native["paper step + synchronise + surface"].median, 0)} %. Eight lanes instead of four (AVX) were tried for the surface and were no faster here.

## Strain

Greatest stretch and compression of any structural or shear spring over all steps, and of the drawn 26 x 26 surface's edges.

${strains()}

The paper's constants stretch the sheet: its drag is large against its springs. The preset \`book\` holds its springs within 1 %. Its drawn surface strains more than its springs do, because a polynomial through six masses is not isometric between them where the leaf bends sharply.

## The sheet and the exact hanging page

The interactive sheet at its own settings, and the offline shell; errors of the tip over the length.

${hanging()}

## The sheet and the shell

Both turned by the same hand; distances over the width of the page. With the lightest and the stiffest stock the moment at which a corner snaps over differs.

${agreement()}

## Gestures

Random drags, throws, jumps, two hands, several leaves at once (\`lab gestures\`). What goes deep are leaves that a wild hand presses into each other.

${gestures()}

## Script time

${await frames()}

## Size

${sizes()}

## Memory

${memory()}
`;
writeFileSync(join(root, "docs/performance.md"), text);
console.log("docs/performance.md written");
