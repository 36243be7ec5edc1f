/**
 * Every link in the docs leads somewhere: to a file that is there, to a heading
 * that is in it, and, where it leads to a test file, to the test that it names.
 * Every row of SECURITY.md leads to a test.
 */
import { existsSync, readdirSync, readFileSync } from "node:fs";
import { dirname, join, relative } from "node:path";
import { anchorOf } from "./headings.mjs";

const root = join(import.meta.dirname, "..");
const ignored = new Set([".git", "node_modules", "dist", "target", "corpora"]);

function pagesIn(folder) {
  return readdirSync(folder, { withFileTypes: true }).flatMap((entry) => {
    const path = join(folder, entry.name);
    if (entry.isDirectory()) return ignored.has(entry.name) ? [] : pagesIn(path);
    return entry.name.endsWith(".md") ? [relative(root, path)] : [];
  });
}

const errors = [];
let count = 0;
for (const page of pagesIn(root)) {
  const text = readFileSync(join(root, page), "utf8").replace(/```[\s\S]*?```/g, "");
  const links = [...text.matchAll(/\[([^\]]*)\]\(([^)\s]+)\)/g)];
  const images = [...text.matchAll(/<(img) src="([^"]+)"/g)];
  for (const [, words, target] of [...links, ...images]) {
    if (/^[a-z]+:/.test(target)) continue;
    count++;
    const fault = faultOf(page, words, target);
    if (fault) errors.push(`${page}: [${words}](${target}): ${fault}`);
  }
}
errors.push(...untested("SECURITY.md"));
for (const error of errors) console.error(error);
if (errors.length > 0) process.exit(1);
console.log(`${count} links lead somewhere.`);

function faultOf(page, words, target) {
  const [path, heading] = target.split("#");
  const file = path === "" ? join(root, page) : join(root, dirname(page), path);
  if (!existsSync(file)) return `there is no ${relative(root, file)}`;
  if (heading && !headingsOf(file).includes(heading)) return `it has no heading ${heading}`;
  if (!isTestFile(path)) return null;
  const test = words.replaceAll("`", "");
  const text = readFileSync(file, "utf8");
  // Its title as it stands in the file, or a file of tests by its own name.
  const isThere = file.endsWith(test) || text.includes(`"${test}"`) || text.includes(`fn ${test}(`);
  return isThere ? null : "it has no test of that name";
}

function isTestFile(path) {
  return /\.test\.\w+$|tests?\/\w+\.rs$|tests\.rs$/.test(path);
}

/** Rows of the table of SECURITY.md that name no test: their own file's tests of Rust count. */
function untested(page) {
  const rows = readFileSync(join(root, page), "utf8").matchAll(/^\| (?!place |---)(.*) \|$/gm);
  return [...rows].flatMap(([, row]) => {
    const cells = row.split(" | ");
    const names = [...cells.at(-1).matchAll(/\]\(([^)\s]+)\)/g)].map(([, path]) => path);
    const isTested = names.some((path) => {
      return isTestFile(path) || readFileSync(join(root, path), "utf8").includes("#[test]");
    });
    return isTested ? [] : [`${page}: no test for ${cells[0]}`];
  });
}

function headingsOf(file) {
  const text = readFileSync(file, "utf8");
  return [...text.matchAll(/^#+ (.*)$/gm)].map(([, words]) => anchorOf(words));
}
