/**
 * Makes a release: sets the version, checks and tests, packs, commits and tags.
 * Publishes nothing.
 *
 *   node scripts/release.mjs 0.2.0
 *
 * Fails before it changes anything if the version is not higher than the present
 * one, files are changed, or CHANGELOG.md says nothing of what is new.
 */
import { execFileSync } from "node:child_process";
import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";

const root = join(import.meta.dirname, "..");
const run = (command, ...given) =>
  execFileSync(command, given, { cwd: root, stdio: "inherit", encoding: "utf8" });
const read = (file) => readFileSync(join(root, file), "utf8");
const write = (file, text) => writeFileSync(join(root, file), text);

function fail(sentence) {
  console.error(sentence);
  process.exit(1);
}

const version = process.argv[2] ?? "";
const before = JSON.parse(read("packages/turnleaf/package.json")).version;
const numbers = (text) => text.split(".").map(Number);
const isHigher = (a, b) => {
  const at = a.findIndex((number, index) => number !== b[index]);
  return at >= 0 && a[at] > b[at];
};
if (!/^\d+\.\d+\.\d+$/.test(version)) fail("Name the version: node scripts/release.mjs 0.2.0");
if (!isHigher(numbers(version), numbers(before))) fail(`${version} is not above ${before}.`);
if (execFileSync("git", ["status", "--porcelain"], { cwd: root }).length > 0) {
  fail("There are changes that are not committed.");
}
const unreleased = "## Not released yet";
const log = read("CHANGELOG.md");
const news = log.split(unreleased)[1]?.split(/\n## /)[0].trim();
if (!news) fail(`CHANGELOG.md has nothing under "${unreleased}".`);

const date = new Date().toISOString().slice(0, 10);
write("CHANGELOG.md", log.replace(unreleased, `${unreleased}\n\n## ${version} (${date})`));
for (const name of ["turnleaf", "cli"]) {
  const file = `packages/${name}/package.json`;
  const text = read(file).replace(`"version": "${before}"`, `"version": "${version}"`);
  // The command needs the viewer of its own version.
  write(file, text.replace(`"turnleaf": "${before}"`, `"turnleaf": "${version}"`));
}
write("Cargo.toml", read("Cargo.toml").replace(`version = "${before}"`, `version = "${version}"`));
run("npm", "install", "--package-lock-only", "--ignore-scripts");
run("node", "scripts/complete_lock.mjs");
run("cargo", "update", "--workspace", "--offline");

run("make", "check");
run("make", "test");
run("make", "test-long");

const out = join(root, `target/release-${version}`);
mkdirSync(out, { recursive: true });
for (const name of ["turnleaf", "turnleaf-cli"]) {
  run("npm", "pack", "-w", name, "--pack-destination", out);
}
run("git", "commit", "--all", "--message", `Release ${version}`);
run("git", "tag", "--annotate", `v${version}`, "--message", `Release ${version}`);
console.log(`Release ${version} is packed in ${out} and tagged. Publishing is yours.`);
