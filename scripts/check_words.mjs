/**
 * Finds words of the project's old dialect in names, comments and docs. Every
 * word has a standard term; the few exceptions are listed with their reasons.
 *
 *   node scripts/check_words.mjs
 */

import { execFileSync } from "node:child_process";
import { readFileSync } from "node:fs";
import { join } from "node:path";

const root = join(import.meta.dirname, "..");

/** The checked folders. */
const folders = ["packages", "docs", "scripts", "examples"];

/** Text files that are neither generated nor a record of their time. */
const isChecked = (path) =>
  /\.(ts|m?js|md|html|rs)$/.test(path) &&
  !/^docs\/(decisions\/|reference\.md)|^scripts\/check_words\.mjs/.test(path);

/** A forbidden word or phrase, and the standard term. */
const words = [
  [/\banswers\b/i, "returns"],
  [/\b(is|are) told\b/i, "is called, is reported, receives"],
  [/\bwhoever\b/i, "a caller, a reader, anyone who"],
  [/\bwhat is none\b/i, "an invalid one"],
  [/\bshares?\b|[a-z]Shares?\b/, "fraction, coefficient; use in common"],
  [/\brolled\b/i, "quarterTurned"],
  [/\bhands\b|\bHands\b/, "grabs, pointers"],
  [/\bwish(es)?\b/i, "options, requested"],
  [/\bwaves?\b/i, "basis"],
  [/\brustles?\b|\bstirs?\b/i, "sound, vibrates"],
  [/\blacks?\b/i, "missing, does not have"],
  [/\bworn\b|\bseated\b|\bwary\b|\bastray\b|\btangled\b|\bsheetlike\b/i, "see docs/glossary.md"],
  [/\bCraft\b|\bPicturing\b|\bHolding\b|\bViewing\b|\bFurnishing\b/, "a noun for the thing"],
];

/** Files or lines in which a word stays, each with its reason. */
const exceptions = [
  // The engine's own terms, until its words are checked too.
  [/^docs\/(architecture|physics|methods|performance)\.md|^scripts\/performance\.mjs/, /./],
  // A sentence of the Content-Security-Policy's own kind: users search for it.
  [/^packages\//, /Content-Security-Policy lacks|"lacks blob/],
  // The script that finds features that old browsers lack keeps its file name and its export.
  [/^packages\/cli\/tests\/oldest_browsers|^scripts\/lacking/, /\black(s|ing)?\b/],
  // Melville, Moby-Dick.
  [/^packages\/cli\/app\/playground\/page_pictures\.ts|^examples\//, /Ishmael/],
];

const files = execFileSync("git", ["ls-files", ...folders], { cwd: root, encoding: "utf8" })
  .split("\n")
  .filter(isChecked);
const found = [];
for (const file of files) {
  const lines = readFileSync(join(root, file), "utf8").split("\n");
  for (const [at, line] of lines.entries()) {
    for (const [word, say] of words) {
      const match = word.exec(line);
      const isException = exceptions.some(([path, text]) => path.test(file) && text.test(line));
      if (match && !isException) found.push(`${file}:${at + 1}: "${match[0]}": ${say}`);
    }
  }
}
if (found.length > 0) {
  console.error(found.join("\n"));
  process.exit(1);
}
console.log(`${files.length} files use standard terms.`);
