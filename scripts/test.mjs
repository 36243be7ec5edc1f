/**
 * Runs the tests, part after part, and says at the end how long each took.
 *
 *   node scripts/test.mjs [rust] [js]
 *
 * Every part runs, so that one failure does not hide another. The projects of vitest run side by side:
 * of each is printed how long its files took, one after the other.
 */
import { spawnSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";

const root = join(import.meta.dirname, "..");
const folder = mkdtempSync(join(tmpdir(), "turnleaf-tests-"));
const timesOfProjects = join(folder, "projects.json");

const parts = {
  rust: [["Rust", "cargo", "test", "--release", "--workspace", "--no-fail-fast", "--quiet"]],
  js: [
    ["WASM against its sources", "node", "scripts/build_wasm.mjs", "--verify"],
    ["WASM in Node", "node", "--test", "wasm/tests/"],
    [
      "TypeScript",
      ...["npx", "vitest", "run", "--reporter=default"],
      `--reporter=${join(root, "scripts/project_times.mjs")}`,
    ],
  ],
};

const asked = process.argv.slice(2);
const times = [];
let status = 0;
for (const [name, command, ...args] of (asked.length > 0 ? asked : Object.keys(parts)).flatMap(
  (part) => parts[part],
)) {
  const start = performance.now();
  const env = { ...process.env, TURNLEAF_PROJECT_TIMES: timesOfProjects };
  const ended = spawnSync(command, args, { cwd: root, env, stdio: "inherit" });
  times.push([name, performance.now() - start]);
  if (name === "TypeScript") times.push(...projectTimes());
  status ||= ended.status ?? 1;
}
rmSync(folder, { recursive: true });

console.log("\nHow long it took:");
for (const [name, milliseconds] of times) console.log(`${name.padEnd(32)}${inWords(milliseconds)}`);
process.exit(status);

function projectTimes() {
  try {
    return Object.entries(JSON.parse(readFileSync(timesOfProjects, "utf8"))).map(
      ([project, milliseconds]) => [`  files of ${project}`, milliseconds],
    );
  } catch {
    // Vitest ended before its tests did.
    return [];
  }
}

function inWords(milliseconds) {
  const seconds = Math.round(milliseconds / 1000);
  return `${String(Math.floor(seconds / 60)).padStart(3)} min ${String(seconds % 60).padStart(2)} s`;
}
