/**
 * Writes docs/reference.md from the comments in the sources.
 *
 * Fails where something public says nothing of itself: an item of the public
 * list or a member of one, an attribute, an event, a CSS part, a custom
 * property, a parameter; where a promise does not say what it resolves to; and
 * where a type is named that the package does not export. With `--check`
 * nothing is written, and a page that is out of date fails too.
 */
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { faultsOf } from "./reference/faults.mjs";
import { readReference, readWordings, root } from "./reference/read.mjs";
import { writeReference } from "./reference/write.mjs";

const page = join(root, "docs/reference.md");
const reference = readReference();
const wordings = readWordings();
const faults = faultsOf(reference, wordings);
if (faults.length === 0) {
  const text = writeReference(reference, wordings);
  if (!process.argv.includes("--check")) writeFileSync(page, text);
  else if (readIfThere(page) !== text)
    faults.push("docs/reference.md is out of date: make reference");
}
for (const fault of faults) console.error(fault);
if (faults.length > 0) process.exit(1);
console.log("The reference says everything.");

function readIfThere(path) {
  try {
    return readFileSync(path, "utf8");
  } catch {
    return null;
  }
}
