/**
 * Every link in the docs leads somewhere: to a file that is there, to a heading
 * that is in it, and, where it leads to a test file, to the test that it names.
 */
import { existsSync, readdirSync, readFileSync } from "node:fs";
import { dirname, join, relative } from "node:path";

const root = join(import.meta.dirname, "..");
const ignored = new Set([".git", "node_modules", "dist", "target"]);

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
for (const error of errors) console.error(error);
if (errors.length > 0) process.exit(1);
console.log(`${count} links lead somewhere.`);

function faultOf(page, words, target) {
  const [path, heading] = target.split("#");
  const file = path === "" ? join(root, page) : join(root, dirname(page), path);
  if (!existsSync(file)) return `there is no ${relative(root, file)}`;
  if (heading && !headingsOf(file).includes(heading)) return `it has no heading ${heading}`;
  if (!/\.test\.\w+$/.test(path)) return null;
  const test = words.replaceAll("`", "");
  // Its title as it stands in the file, or a file of tests by its own name.
  const isThere = file.endsWith(test) || readFileSync(file, "utf8").includes(`"${test}"`);
  return isThere ? null : "it has no test of that name";
}

function headingsOf(file) {
  const text = readFileSync(file, "utf8");
  return [...text.matchAll(/^#+ (.*)$/gm)].map(([, words]) =>
    words
      .toLowerCase()
      .replace(/[^\p{L}\p{N}\s_-]/gu, "")
      .replace(/\s/g, "-"),
  );
}
