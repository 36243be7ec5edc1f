/**
 * What a page loads to show a book: every built file of the viewer with the
 * engine's WASM inside, but for three.js and the page sources, in kB gzip.
 *
 *   node scripts/size.mjs    fails beyond the limit
 *
 * Counted is what index.js imports, at once or later, and what that imports. Left
 * out is what is loaded only for a source of pages: a file that is imported
 * later and comes whole from src/sources or another package.
 */
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { fileURLToPath } from "node:url";
import { gzipSync } from "node:zlib";

/** kB gzip, all files together. */
const limit = 80;

const dist = join(import.meta.dirname, "../packages/turnleaf/dist");

/** Whether a built file holds page sources and nothing of the viewer's. */
function isPageSource(name) {
  const map = JSON.parse(readFileSync(join(dist, `${name}.map`), "utf8"));
  return map.sources.every(
    (source) => source.includes("/src/sources/") || !source.includes("/src/"),
  );
}

/** The files that index.js needs, by name, and whether each is loaded at once. */
function filesOfViewer() {
  const found = new Map();
  const visit = (name, atOnce) => {
    if (found.has(name) && (found.get(name) || !atOnce)) return;
    found.set(name, atOnce);
    const text = readFileSync(join(dist, name), "utf8");
    for (const [, target] of text.matchAll(/(?:from|import)["'`]\.\/([^"'`]+\.js)/g)) {
      visit(target, atOnce);
    }
    for (const [, target] of text.matchAll(/import\(["'`]\.\/([^"'`]+\.js)/g)) {
      if (!isPageSource(target)) visit(target, false);
    }
  };
  visit("index.js", true);
  return found;
}

/** Sizes of the viewer's files in bytes, and of all together. */
export function viewerSize() {
  const files = [...filesOfViewer()].map(([file, atOnce]) => {
    const text = readFileSync(join(dist, file));
    const name = file.replace(/-[\w-]{8}\.js$/, ".js");
    return { name, atOnce, bytes: text.length, gzip: gzipSync(text, { level: 9 }).length };
  });
  files.sort((a, b) => b.gzip - a.gzip);
  return { files, gzip: files.reduce((sum, file) => sum + file.gzip, 0) };
}

const kilobytes = (bytes) => (bytes / 1000).toFixed(1);

if (process.argv[1] === fileURLToPath(import.meta.url)) {
  const { files, gzip } = viewerSize();
  for (const { name, atOnce, bytes, gzip } of files) {
    const when = atOnce ? "at once" : "later";
    console.log(
      `${name.padEnd(24)} ${kilobytes(bytes).padStart(7)} kB  ${kilobytes(gzip).padStart(6)} kB gzip  ${when}`,
    );
  }
  console.log(`The viewer without three.js and page sources: ${kilobytes(gzip)} kB gzip.`);
  if (gzip > limit * 1000) {
    console.error(`It may have ${limit} kB at most.`);
    process.exitCode = 1;
  }
}
