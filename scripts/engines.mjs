/**
 * Runs the steps that three browser engines go through, and writes the table of
 * docs/browsers.md: versions and times as measured, none typed by hand.
 *
 *   node scripts/engines.mjs
 */
import { spawnSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync } from "node:fs";
import { cpus, tmpdir } from "node:os";
import { join } from "node:path";
import { includeTables, writeTable } from "./docs_tables.mjs";

const root = join(import.meta.dirname, "..");

const folder = mkdtempSync(join(tmpdir(), "turnleaf-engines-"));
const report = join(folder, "report.json");
const { status } = spawnSync(
  "npx",
  [
    ...["vitest", "run", "--project", "engines", "--reporter=default", "--reporter=json"],
    `--outputFile.json=${report}`,
  ],
  { cwd: root, stdio: "inherit" },
);
if (status !== 0) process.exit(status ?? 1);
const tests = JSON.parse(readFileSync(report, "utf8")).testResults.flatMap(
  ({ assertionResults }) => assertionResults,
);
rmSync(folder, { recursive: true });

/** Times in milliseconds by step, by engine. */
const engines = new Map();
for (const { ancestorTitles, title, duration, meta } of tests) {
  const [name] = ancestorTitles;
  const engine = engines.get(name) ?? { name, version: meta.browser.split(" ").at(-1), steps: {} };
  engine.steps[title] = duration;
  engines.set(name, engine);
}
const columns = [...engines.values()];
const steps = Object.keys(columns[0].steps);
const seconds = (milliseconds) => (milliseconds / 1000).toFixed(1);
const sum = (times) => Object.values(times).reduce((all, time) => all + time, 0);

const processors = `${cpus().length} × ${cpus()[0].model.trim()}`;
writeTable("engines", [
  ["step, seconds", ...columns.map(({ name }) => name)],
  ["version", ...columns.map(({ version }) => version)],
  ...steps.map((step) => [step, ...columns.map(({ steps }) => seconds(steps[step]))]),
  ["all", ...columns.map(({ steps }) => seconds(sum(steps)))],
  ["processors", ...columns.map(() => processors)],
]);
includeTables();
