/**
 * Checks that a link of the docs to a test file names a test of it, and that every row of
 * SECURITY.md leads to a test. That files and headings exist is lychee's to check (lychee.toml).
 */
import { readdirSync, readFileSync } from "node:fs";
import { dirname, join, relative } from "node:path";

const root = join(import.meta.dirname, "..");
const ignored = new Set([".git", "node_modules", "dist", "target", "corpora"]);

function pagesIn(folder) {
  return readdirSync(folder, { withFileTypes: true }).flatMap((entry) => {
    const path = join(folder, entry.name);
    if (entry.isDirectory()) return ignored.has(entry.name) ? [] : pagesIn(path);
    return entry.name.endsWith(".md") ? [relative(root, path)] : [];
  });
}

const errors = untested("SECURITY.md");
let count = 0;
for (const page of pagesIn(root)) {
  const text = readFileSync(join(root, page), "utf8").replace(/```[\s\S]*?```/g, "");
  for (const [, words, target] of text.matchAll(/\[([^\]]*)\]\(([^)\s]+)\)/g)) {
    const [path] = target.split("#");
    if (!isTestFile(path) || /^[a-z]+:/.test(path)) continue;
    count++;
    if (!hasTest(join(root, dirname(page), path), words.replaceAll("`", ""))) {
      errors.push(`${page}: [${words}](${target}): it has no test of that name`);
    }
  }
}
for (const error of errors) console.error(error);
if (errors.length > 0) process.exit(1);
console.log(`${count} links lead to tests that they name.`);

function isTestFile(path) {
  return /\.test\.\w+$|tests?\/\w+\.rs$|tests\.rs$/.test(path);
}

/** Whether a file has a test of this title, or is itself called that. */
function hasTest(file, title) {
  const text = readFileSync(file, "utf8");
  return file.endsWith(title) || text.includes(`"${title}"`) || text.includes(`fn ${title}(`);
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
