/**
 * Runs the tests, part after part, and says at the end how long each took and what failed.
 *
 *   node scripts/test.mjs [rust] [js] [--write-work]
 *
 * Every part runs, so that one failure does not hide another. Of each project of vitest is printed how
 * long its files took, added up: some projects run side by side. `--write-work` writes the work that
 * the files of browser tests counted into the table that bounds it.
 */
import { spawnSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { workErrors, writeWork } from "./test_work.mjs";

const root = join(import.meta.dirname, "..");
const folder = mkdtempSync(join(tmpdir(), "turnleaf-tests-"));
const summaryPath = join(folder, "summary.json");

const parts = {
  rust: [["Rust", "cargo", "test", "--no-fail-fast", "--quiet"]],
  js: [
    ["WASM against its sources", "node", "scripts/verify_wasm.mjs"],
    ["WASM in Node", "node", "--test", "wasm/tests/"],
    [
      "TypeScript",
      ...["npx", "vitest", "run", "--reporter=default"],
      `--reporter=${join(root, "scripts/test_summary.mjs")}`,
    ],
  ],
};

/** Files that are named with their times. */
const slowest = 10;

const asked = process.argv.slice(2).filter((part) => part in parts);
const writesWork = process.argv.includes("--write-work");
const times = [];
const failures = [];
let files = [];
let status = 0;
for (const [name, command, ...args] of (asked.length > 0 ? asked : Object.keys(parts)).flatMap(
  (part) => parts[part],
)) {
  const start = performance.now();
  const env = { ...process.env, TURNLEAF_TEST_SUMMARY: summaryPath };
  const ended = spawnSync(command, args, { cwd: root, env, stdio: "inherit" });
  times.push([name, performance.now() - start]);
  if (ended.status !== 0)
    failures.push({ name, messages: ended.error ? [ended.error.message] : [] });
  if (name === "TypeScript") {
    const summary = testSummary();
    files = summary.files;
    for (const project of new Set(files.map((file) => file.project))) {
      const its = files.filter((file) => file.project === project);
      const milliseconds = its.reduce((sum, file) => sum + file.milliseconds, 0);
      times.push([`  ${its.length} files of ${project}`, milliseconds]);
    }
    failures.push(...summary.failures);
    if (writesWork) writeWork(files);
    const messages = workErrors(files);
    if (messages.length > 0) failures.push({ name: "Counted work", messages });
    if (messages.length > 0) status ||= 1;
  }
  status ||= ended.status ?? 1;
}
rmSync(folder, { recursive: true });

if (files.length > 0) {
  console.log("\nThe slowest files:");
  files.sort((a, b) => b.milliseconds - a.milliseconds);
  for (const { name, tests, milliseconds, work } of files.slice(0, slowest)) {
    const counted = work ? `, ${work.frames} frames, ${work.ticks} ticks, ${work.books} books` : "";
    const seconds = (milliseconds / 1000).toFixed(1).padStart(6);
    console.log(`${seconds} s  ${name} (${tests} tests${counted})`);
  }
}
console.log("\nHow long it took:");
for (const [name, milliseconds] of times) console.log(`${name.padEnd(40)}${inWords(milliseconds)}`);
// At the end, where it is found in a long output.
if (failures.length > 0) console.log("\nFailed:");
for (const { name, messages } of failures) {
  console.log(name);
  for (const message of messages) console.log(`    ${message.replaceAll("\n", "\n    ")}`);
}
process.exit(status);

function testSummary() {
  try {
    return JSON.parse(readFileSync(summaryPath, "utf8"));
  } catch {
    // Vitest ended before its tests did.
    return { files: [], failures: [] };
  }
}

function inWords(milliseconds) {
  const seconds = Math.round(milliseconds / 1000);
  return `${String(Math.floor(seconds / 60)).padStart(3)} min ${String(seconds % 60).padStart(2)} s`;
}
