/**
 * Runs the tests, part after part, and says at the end how long each took and what failed.
 *
 *   node scripts/test.mjs [rust] [js] [--write-work]
 *
 * Every part runs, so that one failure does not hide another. Rust's compiler leaves one of two cores
 * idle for half of its time, so Rust runs beside the others, and what it says comes when it has ended.
 * Of each project of vitest is printed how long its files took, added up: some projects run side by
 * side. `--write-work` writes the work that the files of browser tests counted into the table that
 * bounds it.
 */
import { spawn } from "node:child_process";
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

const named = process.argv.slice(2).filter((part) => part in parts);
const asked = named.length > 0 ? named : Object.keys(parts);
const writesWork = process.argv.includes("--write-work");
const times = [];
const failures = [];
let files = [];
let status = 0;
const start = performance.now();
await Promise.all(asked.map(runPart));
times.push(["Together", performance.now() - start]);
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

/** Runs the commands of a part one after another. */
async function runPart(part) {
  // Of parts side by side one speaks as it goes, which a terminal's lines that are written anew need.
  const isSilent = asked.length > 1 && part !== "js";
  for (const [name, command, ...args] of parts[part]) {
    const begun = performance.now();
    const ended = await end(command, args, isSilent);
    times.push([name, performance.now() - begun]);
    status ||= ended.status;
    if (ended.status !== 0) failures.push({ name, messages: ended.messages });
    if (name === "TypeScript") readSummary();
  }
}

/** Runs a command to its end; a silent one's words are printed then. Resolves with its exit status. */
function end(command, args, isSilent) {
  const env = { ...process.env, TURNLEAF_TEST_SUMMARY: summaryPath };
  const output = isSilent ? "pipe" : "inherit";
  const running = spawn(command, args, { cwd: root, env, stdio: ["inherit", output, output] });
  const said = [];
  for (const stream of [running.stdout, running.stderr]) {
    stream?.on("data", (bytes) => said.push(bytes));
  }
  return new Promise((resolve) => {
    const finish = (status, messages) => {
      process.stdout.write(Buffer.concat(said));
      resolve({ status, messages });
    };
    running.once("error", (error) => finish(1, [error.message]));
    running.once("close", (code) => finish(code ?? 1, []));
  });
}

/** Takes what vitest wrote of its files into the times and the failures. */
function readSummary() {
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
