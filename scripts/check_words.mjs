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
const folders = ["packages", "docs", "scripts", "examples", "engine", "lab", "wasm"];

/** Text files that are neither generated nor a record of their time. */
const isChecked = (path) =>
  /\.(ts|m?js|md|html|rs)$/.test(path) &&
  !/^docs\/(decisions\/|reference\.md)|^scripts\/check_words\.mjs/.test(path);

/** A forbidden word or phrase, and the standard term. */
const words = [
  [/\banswer(s|ed|ing)?\b/i, "return, response, reply"],
  [/\btold\b/i, "is called, is reported, receives"],
  [/\brefus(e|es|ed|ing|als?)\b/i, "reject, fail, reason"],
  [/\bwhoever\b/i, "a caller, a reader, anyone who"],
  [/\bwhat is none\b/i, "an invalid one"],
  [/\bshares?\b|[a-z]Shares?\b/, "fraction, coefficient; use in common"],
  [/\brolled\b/i, "quarterTurned"],
  [/\b(?<!(-|by |at |on the other ))hands?\b/i, "grab, pointer"],
  [/\bwish(es)?\b/i, "options, requested"],
  [/\bwaves?\b/i, "basis"],
  [/\brustles?\b|\bstirs?\b/i, "sound, vibrates"],
  [/\blacks?\b/i, "missing, does not have"],
  [/\bworn\b|\bseated\b|\bwary\b|\bastray\b|\btangled\b|\bsheetlike\b/i, "see docs/glossary.md"],
  [/\bCraft\b|\bPicturing\b|\bHolding\b|\bViewing\b|\bFurnishing\b/, "a noun for the thing"],
];

/** Files or lines in which a word stays, each with its reason. */
const exceptions = [
  // A sentence of the Content-Security-Policy's own kind: users search for it.
  [/^packages\//, /Content-Security-Policy lacks|"lacks blob/],
  // The script that finds features that old browsers lack keeps its file name and its export.
  [/^packages\/cli\/tests\/oldest_browsers|^scripts\/lacking/, /\black(s|ing)?\b/],
  // Paper is rolled around a cylinder: the bindings' word is of the viewer's settings.
  [/^engine\//, /\brolled\b/i],
  // The verb: triangles share an edge.
  [/^(engine|lab)\//, /(that|rows|to|lab|bending|\(f64\)|experiments) share\b/],
  // A kind of `lab gestures`, whose name is in commands and reports.
  [/^(lab|scripts|docs)\//, /"hands"|--kind hands|\bHands,|\| hands \|/],
  // In physics, what holds and pulls a leaf is a hand: of a person, a gesture or the engine.
  [/^(engine|lab|wasm|docs)\//, /\bhand\b/i],
  // The playground's one hand, which both leaves follow, is a control of its own.
  [/^packages\/cli\/app\/playground\//, /\bhand\b/],
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
