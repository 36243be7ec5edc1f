/**
 * The tables of the docs. What measures writes a table into docs/data, a row a line, and this those
 * that are made of the viewer's sources;
 * pages include it between the lines `<!-- table NAME -->` and `<!-- /table -->`.
 *
 *   node scripts/docs_tables.mjs            writes the tables into the pages
 *   node scripts/docs_tables.mjs --check    fails if a page differs from its data
 *
 * `<!-- table NAME: words|other words -->` includes the rows alone that begin with these words.
 */
import { existsSync, readdirSync, readFileSync, writeFileSync } from "node:fs";
import { join, relative } from "node:path";

const root = join(import.meta.dirname, "..");
const docs = join(root, "docs");
const data = join(docs, "data");

/** Rows of cells, the first of them headings. */
export function readTable(name) {
  return JSON.parse(readFileSync(join(data, `${name}.json`), "utf8"));
}

/** Whether there is such a table. */
function hasTable(name) {
  return existsSync(join(data, `${name}.json`));
}

/** Writes the rows of a table as data. */
export function writeTable(name, rows) {
  const lines = rows.map((row) => `  ${JSON.stringify(row.map(String))}`);
  writeFileSync(join(data, `${name}.json`), `[\n${lines.join(",\n")}\n]\n`);
}

/** A table in Markdown: columns of numbers are aligned to the right. */
export function markdown([headings, ...rows]) {
  const isNumber = (cell) => /^[+-]?\d/.test(cell);
  const rule = headings.map((_, column) => {
    const numbers = rows.filter((row) => isNumber(row[column])).length;
    return column > 0 && 2 * numbers > rows.length ? "---:" : "---";
  });
  return [headings, rule, ...rows].map((cells) => `| ${cells.join(" | ")} |\n`).join("");
}

/** The rows that begin with one of the given beginnings, under the headings; all rows without any. */
function chosen(rows, beginnings) {
  if (beginnings === undefined) return rows;
  const isChosen = beginnings.split("|").map((beginning) => {
    const begins = ([cell]) => cell.startsWith(beginning);
    if (!rows.some(begins)) throw new Error(`No row begins with "${beginning}".`);
    return begins;
  });
  const [headings, ...others] = rows;
  return [headings, ...others.filter((row) => isChosen.some((begins) => begins(row)))];
}

/** The pages that may include tables: those of docs and of docs/reports. */
function pages() {
  return [docs, join(docs, "reports")].flatMap((folder) => {
    const names = readdirSync(folder).filter((name) => name.endsWith(".md"));
    return names.map((name) => join(folder, name));
  });
}

/** Puts the tables into the pages, or with `isCheck` lists what differs. */
export function includeTables(isCheck = false) {
  const unused = new Set(readdirSync(data).map((file) => file.replace(/\.json$/, "")));
  const faults = [];
  for (const path of pages()) {
    const text = readFileSync(path, "utf8");
    const section = /(<!-- table (\w+)(?:: (.+?))? -->\n)[\s\S]*?(<!-- \/table -->)/g;
    const written = text.replace(section, (_, open, name, beginnings, close) => {
      if (beginnings === undefined) unused.delete(name);
      return `${open}${markdown(chosen(readTable(name), beginnings))}${close}`;
    });
    if (written === text) continue;
    if (isCheck)
      faults.push(
        `${relative(root, path)} differs from docs/data: run node scripts/docs_tables.mjs`,
      );
    else writeFileSync(path, written);
  }
  for (const name of unused) faults.push(`No page includes docs/data/${name}.json`);
  return faults;
}

if (process.argv[1] === import.meta.filename) {
  const isCheck = process.argv.includes("--check");
  const { sourceTables } = await import("./source_tables.mjs");
  const outdated = Object.entries(await sourceTables()).filter(
    ([name, rows]) => !hasTable(name) || JSON.stringify(rows) !== JSON.stringify(readTable(name)),
  );
  if (!isCheck) for (const [name, rows] of outdated) writeTable(name, rows);
  const faults = includeTables(isCheck);
  if (isCheck)
    for (const [name] of outdated)
      faults.push(`docs/data/${name}.json is out of date: run node scripts/docs_tables.mjs`);
  for (const fault of faults) console.error(fault);
  if (faults.length > 0) process.exit(1);
}
