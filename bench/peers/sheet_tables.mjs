/**
 * The tables of docs/reports/performance.md on the hanging page, from bench/results/jolt-sheet.json and
 * bench/results/vbd-sheet.json: no number in them is typed by hand.
 *
 *   node bench/peers/sheet_tables.mjs
 */
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { includeTables, writeTable } from "../../scripts/docs_tables.mjs";

const results = join(import.meta.dirname, "../results");
const read = (name) => JSON.parse(readFileSync(join(results, name), "utf8"));

const percent = (part) =>
  typeof part === "number" ? `${part > 0 ? "+" : ""}${(100 * part).toFixed(1)} %` : "";
const number = (value, digits) => value?.toFixed(digits) ?? "";
const spread = (values, digits) => {
  const [median, low, high] = values.map((value) => number(value, digits));
  return `${median} (${low} to ${high})`;
};
const atRest = (row) => (row.motionless === undefined ? "" : row.motionless ? "yes" : "no");

function joltRow(row) {
  const times = [row.median_us, row.p5_us, row.p95_us].map((us) => us / 1000);
  const work = row.iterations ? `${row.iterations} x 1` : "";
  const errors = [percent(row.dropError), percent(row.reachError)];
  return [row.name, work, ...errors, atRest(row), spread(times, 2), number(row.timesOurs, 2)];
}

function vbdRow(row) {
  const times = [row.cpu_ms, row.p5_ms, row.p95_ms];
  const errors = [percent(row.dropError), percent(row.reachError)];
  const work = `${row.substeps} x ${row.iterations}`;
  return [row.name, work, ...errors, atRest(row), spread(times, 1), number(row.timesOurs, 1)];
}

/** The settings chosen of each engine, one beside the other. */
function peers(jolt, vbd) {
  const headings = ["", "substeps x iterations", "drop", "reach", "at rest"];
  return [
    [...headings, "ms a frame (5th to 95th)", "times ours"],
    ...jolt.timed.filter((row) => !/ iterations$/.test(row.name)).map(joltRow),
    ...vbd.timed.map(vbdRow),
  ];
}

/** All that was tried of vertex block descent. */
function tried(vbd) {
  const headings = ["substeps x iterations", "nodes", "hinges, of the paper's", "membrane, N/m"];
  const rows = vbd.tried.map((row) => [
    `${row.substeps} x ${row.iterations}`,
    `${row.columns} x ${row.rows}`,
    number(row.factor, 2),
    row.stretch,
    percent(row.dropError),
    percent(row.reachError),
    percent(row.strain),
    atRest(row),
    number(row.cpu_ms, 1),
  ]);
  return [[...headings, "drop", "reach", "strain", "at rest", "ms a frame"], ...rows];
}

/** Drops of a page that hardly bends: what is the mesh's error, and what the solver's. */
function checks({ checks: { gamma, meshes, solved } }) {
  const direct = meshes.map((row) => [
    "the hinges, solved directly",
    `${row.columns} x ${row.rows}`,
    percent(row.meshError),
  ]);
  const work = `VBD, ${solved.substeps} x ${solved.iterations}`;
  const rows = [...direct, [work, `${solved.columns} x ${solved.rows}`, percent(solved.dropError)]];
  return [[`Gamma = ${gamma}`, "nodes", "drop"], ...rows];
}

/** The chosen settings under other loads. */
function loads(jolt, vbd) {
  const row = (name, work, { stiffness, gamma, dropError, reachError, motionless }) => [
    `${name}, stiffness ${stiffness}`,
    work,
    gamma,
    percent(dropError),
    percent(reachError),
    atRest({ motionless }),
  ];
  return [
    ["", "substeps x iterations", "Gamma", "drop", "reach", "at rest"],
    ...jolt.otherLoads.map((one) => row("jolt", `${one.iterations} x 1`, one)),
    ...vbd.otherLoads.map((one) => row("VBD", `${one.substeps} x ${one.iterations}`, one)),
  ];
}

/** Writes all tables from the stored results, and puts them into the pages. */
export function writeSheetTables() {
  const [jolt, vbd] = [read("jolt-sheet.json"), read("vbd-sheet.json")];
  writeTable("hanging_peers", peers(jolt, vbd));
  writeTable("hanging_loads", loads(jolt, vbd));
  writeTable("hanging_vbd", tried(vbd));
  writeTable("hanging_vbd_checks", checks(vbd));
  return includeTables();
}

if (process.argv[1] === import.meta.filename) {
  for (const fault of writeSheetTables()) console.error(fault);
}
