/**
 * The work that each file of browser tests may have the viewer do: animation frames, ticks of engines and
 * books that are set up to be drawn, against scripts/test_work.json. Counted rather than timed: a test that
 * turns pages by the hundred is found on any machine, and none fails on a slow one.
 */
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";

const path = join(import.meta.dirname, "test_work.json");

/**
 * What a count may be beyond the one in the table, as a factor of it and in counts: frames that pass while
 * a picture is read are counted too, and there are more of these where other programs run.
 */
const most = { factor: 1.5, frames: 60, ticks: 120, books: 0 };

/** Returns a sentence for each file that does more than it may, or of which the table says nothing. */
export function workErrors(files) {
  const table = JSON.parse(readFileSync(path, "utf8"));
  const errors = [];
  for (const { name, work } of files) {
    if (!work) continue;
    if (!(name in table)) errors.push(`${name}: scripts/test_work.json has no counts of it`);
    for (const [what, count] of Object.entries(work)) {
      const allowed = most.factor * (table[name]?.[what] ?? count) + most[what];
      if (count > allowed) {
        errors.push(
          `${name}: ${count} ${what}, and ${table[name][what]} in scripts/test_work.json`,
        );
      }
    }
  }
  if (errors.length > 0) {
    errors.push("Make them fewer, or write the table anew: node scripts/test.mjs js --write-work");
  }
  return errors;
}

/** Writes the counts of all files into the table. */
export function writeWork(files) {
  const counted = files.filter(({ work }) => work).map(({ name, work }) => [name, work]);
  const lines = counted
    .sort(([a], [b]) => (a < b ? -1 : 1))
    .map(([name, work]) => `  ${JSON.stringify(name)}: ${JSON.stringify(work)}`);
  writeFileSync(path, `{\n${lines.join(",\n")}\n}\n`);
}
