/**
 * A hanging page in Jolt Physics and in the engine: cost of a frame, and error.
 *
 *   node bench/peers/jolt_sheet.mjs [FILE.wasm] [--json] [--write] [--again]
 *
 * Prints Markdown tables; --json prints JSON, --write keeps it in
 * bench/results/jolt-sheet.json. Takes some minutes: it searches Jolt's settings
 * first, then times the best of them in turn with ours. An engine without
 * exports for the sheet is left out. --again takes the search from that file, and
 * times anew. How to read it: bench/README.md.
 */
import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { cpus } from "node:os";
import { join } from "node:path";
import { FRAME, hangSheet, loadJolt } from "./jolt.mjs";
import { exactTip, GAMMA, LONGEST_SETTLING, ourSheet, PAGE } from "./our_sheet.mjs";

const root = join(import.meta.dirname, "../..");
const stock = readFileSync(join(root, "engine/src/stock.rs"), "utf8");
const GRAVITY = Number(/const GRAVITY: f64 = ([\d.]+);/.exec(stock)[1]);
const ALLOWED = 0.02;
const SECOND = Math.round(1 / FRAME);
const CONVERGED = 64;
const ITERATIONS = [5, 8, 9, 10, 12, 16, 24, 32, 48, 64];

/** The compliance of a hinge of this page by its bending stiffness. */
function paperCompliance() {
  const stiffness = (PAGE.grammage * GRAVITY * PAGE.width ** 3) / GAMMA;
  const across = PAGE.width / (PAGE.columns - 1);
  const along = PAGE.height / (PAGE.rows - 1);
  return across / (stiffness * along);
}

/** Hangs a sheet until it is motionless: within 1e-5 of its width in a second. */
function settle(jolt, how) {
  const gamma = how.gamma ?? GAMMA;
  const sheet = hangSheet(jolt, PAGE, { gravity: (GRAVITY * gamma) / GAMMA, ...how });
  const exact = exactTip(gamma);
  let frames = 0;
  let moved = Infinity;
  let before = sheet.tip();
  let now = before;
  while (frames < LONGEST_SETTLING && moved > 1e-5) {
    for (let frame = 0; frame < SECOND; frame++) sheet.frame();
    frames += SECOND;
    now = sheet.tip();
    moved = Math.max(Math.abs(now.drop - before.drop), Math.abs(now.reach - before.reach));
    before = now;
  }
  const dropError = now.drop / exact.drop - 1;
  const reachError = now.reach / exact.reach - 1;
  return { ...how, ...now, dropError, reachError, frames, motionless: moved <= 1e-5, sheet };
}

function settled(jolt, how) {
  const { sheet, ...result } = settle(jolt, how);
  sheet.free();
  return result;
}

const within = (row) => Math.abs(row.dropError) <= ALLOWED && Math.abs(row.reachError) <= ALLOWED;
const worst = (row) => Math.max(Math.abs(row.dropError), Math.abs(row.reachError));

/** The compliance with which the drop is right at these settings, by bisection. */
function fitCompliance(jolt, how, [stiffest, softest]) {
  let [low, high] = [Math.log(stiffest), Math.log(softest)];
  let best = settled(jolt, { ...how, compliance: stiffest });
  if (best.dropError > 0) return best;
  for (let trial = 0; trial < 10; trial++) {
    const middle = (low + high) / 2;
    const result = settled(jolt, { ...how, compliance: Math.exp(middle) });
    if (Math.abs(result.dropError) < Math.abs(best.dropError)) best = result;
    if (Math.abs(result.dropError) < ALLOWED / 20) break;
    if (result.dropError > 0) high = middle;
    else low = middle;
  }
  return best;
}

/**
 * All that was tried: the paper's stiffness; one calibrated where more iterations
 * change little, which makes up for the mesh; and one fitted at every setting,
 * which makes up for what the solver leaves unsolved too, at this load.
 */
function search(jolt) {
  const paper = paperCompliance();
  const rows = [];
  const add = (stiffness, row) => {
    rows.push({ stiffness, ...row });
    console.error(`${stiffness} ${row.bend} ${row.iterations}: drop ${row.drop.toFixed(4)}`);
  };
  const usual = { bend: "dihedral", attachments: false, damping: 5 };
  const converged = fitCompliance(jolt, { ...usual, iterations: CONVERGED }, [
    paper / 10,
    paper * 4,
  ]);
  for (const iterations of ITERATIONS) {
    for (const attachments of [false, true]) {
      const how = { ...usual, iterations, attachments };
      add("calibrated", settled(jolt, { ...how, compliance: converged.compliance }));
    }
    add("paper", settled(jolt, { ...usual, iterations, compliance: paper }));
    if (iterations > CONVERGED) continue;
    for (const damping of [0.1, 5]) {
      const how = { bend: "dihedral", iterations, attachments: false, damping };
      add("fitted", fitCompliance(jolt, how, [paper / 1e4, paper * 4]));
    }
    const how = { bend: "distance", iterations, attachments: false, damping: 5 };
    add("fitted", fitCompliance(jolt, how, [1e-7, 1]));
  }
  return rows;
}

/** The processor's microseconds a frame of every contestant, batches taken in turn. */
function time(contestants) {
  const batches = contestants.map(() => []);
  for (let batch = 0; batch < 41; batch++) {
    contestants.forEach(({ frame }, index) => {
      const start = process.cpuUsage();
      for (let count = 0; count < 20; count++) frame();
      const { user, system } = process.cpuUsage(start);
      if (batch > 0) batches[index].push((user + system) / 20);
    });
  }
  return batches.map((values) => {
    values.sort((a, b) => a - b);
    const at = (part) => values[Math.floor(part * (values.length - 1))];
    return { median_us: at(0.5), p5_us: at(0.05), p95_us: at(0.95) };
  });
}

/** Of those rows the cheapest within what is allowed, else the nearest. */
function choose(rows) {
  const good = rows.filter(within).sort((a, b) => a.iterations - b.iterations);
  return good[0] ?? rows.toSorted((a, b) => worst(a) - worst(b))[0];
}

const percent = (part) => `${part > 0 ? "+" : ""}${(part * 100).toFixed(1)} %`;

function table(results) {
  const lines = [
    "| | iterations | drop error | reach error | us a frame (5th to 95th) | times ours |",
    "|---|---|---|---|---|---|",
  ];
  for (const row of results.timed) {
    const reach = row.reachError === undefined ? "" : percent(row.reachError);
    const spread = `${row.median_us.toFixed(0)} (${row.p5_us.toFixed(0)} to ${row.p95_us.toFixed(0)})`;
    const ratio = row.timesOurs?.toFixed(2) ?? "";
    lines.push(
      `| ${row.name} | ${row.iterations ?? ""} | ${percent(row.dropError)} | ${reach} | ${spread} | ${ratio} |`,
    );
  }
  lines.push("", "The same settings under other loads:", "");
  lines.push(
    "| stiffness | iterations | Gamma | drop error | reach error |",
    "|---|---|---|---|---|",
  );
  for (const row of results.otherLoads) {
    const { stiffness, iterations, gamma, dropError, reachError } = row;
    lines.push(
      `| ${stiffness} | ${iterations} | ${gamma} | ${percent(dropError)} | ${percent(reachError)} |`,
    );
  }
  return lines.join("\n");
}

const jolt = await loadJolt("simd");
const plain = await loadJolt("plain");
const resultsFile = join(root, "bench/results/jolt-sheet.json");
const isAgain = process.argv.includes("--again");
const tried = isAgain ? JSON.parse(readFileSync(resultsFile, "utf8")).tried : search(jolt);
const withStiffness = (name) => tried.filter((row) => row.stiffness === name);
const fitted = (bend) => withStiffness("fitted").filter((row) => row.bend === bend);
const chosen = [
  ["jolt, stiffness of the paper", choose(withStiffness("paper")), jolt],
  ["jolt, stiffness calibrated", choose(withStiffness("calibrated")), jolt],
  ["jolt, stiffness fitted to this load", choose(fitted("dihedral")), jolt],
  ["the same, build without SIMD", choose(fitted("dihedral")), plain],
  ["jolt, bending by distance, fitted", choose(fitted("distance")), jolt],
];
const engineFile = process.argv.slice(2).find((argument) => !argument.startsWith("--"));
const ours = await ourSheet(engineFile);
const settings = ({ bend, compliance, iterations, attachments, damping }) => ({
  bend,
  compliance,
  iterations,
  attachments,
  damping,
});
const contestants = chosen.map(([name, row, build]) => {
  const { sheet, ...result } = settle(build, settings(row));
  return { name, ...result, frame: sheet.frame };
});
// What the peer does in any time given, ours among them.
const ladder = ITERATIONS.map((iterations) => {
  const row = withStiffness("calibrated").find(
    (one) => one.iterations === iterations && !one.attachments,
  );
  const { sheet, ...result } = settle(jolt, settings(row));
  return { name: `jolt, calibrated, ${iterations} iterations`, ...result, frame: sheet.frame };
});
const all = [...(ours ? [ours] : []), ...contestants, ...ladder];
const times = time(all);
const timed = all.map(({ frame: _, ...row }, index) => ({
  ...row,
  ...times[index],
  ...(ours ? { timesOurs: times[index].median_us / times[0].median_us } : {}),
}));
// Fitted to one load, is the stiffness right for another?
const otherLoads = ["fitted", "calibrated"].flatMap((name) => {
  const rows = withStiffness(name).filter((row) => row.bend === "dihedral");
  const how = settings(choose(rows));
  return [1, 25].map((gamma) => ({ stiffness: name, ...settled(jolt, { ...how, gamma }) }));
});

const { version } = JSON.parse(
  readFileSync(join(root, "node_modules/jolt-physics/package.json"), "utf8"),
);
const results = {
  peer: `jolt-physics ${version}`,
  node: process.version,
  processor: cpus()[0].model,
  page: { ...PAGE, gamma: GAMMA },
  exact: exactTip(GAMMA),
  allowed: ALLOWED,
  timed,
  otherLoads,
  tried,
};
if (process.argv.includes("--write")) {
  mkdirSync(join(root, "bench/results"), { recursive: true });
  writeFileSync(resultsFile, `${JSON.stringify(results, null, 2)}\n`);
}
console.log(process.argv.includes("--json") ? JSON.stringify(results, null, 2) : table(results));
