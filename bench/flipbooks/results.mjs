/**
 * What runs of the libraries found: kept in bench/results, a file a number of pages, and
 * from there the tables and plots of docs/comparison.md.
 *
 *   node bench/flipbooks/results.mjs    writes tables and plots anew
 */

import { mkdirSync, readdirSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { includeTables, writeTable } from "../../scripts/docs_tables.mjs";

const root = join(import.meta.dirname, "../..");
const folder = join(root, "bench/results");
const pictures = join(root, "docs/pictures");

/** Figures of a run: what each is called, and how many digits it is shown with. */
const figures = {
  ready: ["ready, ms", 0],
  images: ["images at open", 0],
  memory: ["memory, MB", 0],
  idle: ["CPU idle in 4 s, s", 2],
  turn: ["a turn of 800 ms takes, ms", 0],
  slowest: ["the slowest, ms", 0],
  perTurn: ["CPU a turn, s", 2],
  perFrame: ["CPU a frame, s", 3],
  frame: ["between frames, ms", 0],
  lateFrame: ["95 in 100, ms", 0],
};

/** Figures that are plotted, and what the plots say. */
const plots = {
  ready: "Until the book can be read and turned, ms",
  perTurn: "Processor's time for a turn, s",
  frame: "From one frame of a turn to the next, ms",
  memory: "Memory of all the browser's processes, MB",
};

const median = (list) => [...list].sort((a, b) => a - b)[list.length >> 1];

/** Medians with the least and the most, by library. */
export function summary(rows) {
  return Object.fromEntries(
    Object.entries(rows).map(([name, runs]) => {
      const entries = Object.keys(figures).map((key) => {
        const list = runs.map((run) => run[key]).filter(Number.isFinite);
        return [key, { median: median(list), least: Math.min(...list), most: Math.max(...list) }];
      });
      const blank = runs.filter((run) => run.blank).length;
      const after = runs.map((run) => run.after);
      const errors = [...new Set(runs.flatMap((run) => run.errors))];
      return [name, { ...Object.fromEntries(entries), blank, after, errors }];
    }),
  );
}

/** A row a library. */
export function table(found) {
  const shown = (name, key) => {
    const { median, least, most } = found[name][key];
    const digits = figures[key][1];
    return `${median.toFixed(digits)} (${least.toFixed(digits)} to ${most.toFixed(digits)})`;
  };
  const frames = (name) => {
    const numbers = found[name].after.filter(Number.isFinite);
    return numbers.length > 0 ? String(median(numbers)) : "fails";
  };
  const head = [
    "",
    ...Object.values(figures).map(([title]) => title),
    "frames a second after ten destroys",
    "blank at the end",
  ];
  const rows = Object.keys(found).map((name) => [
    name.startsWith("Turnleaf") ? `**${name}**` : name,
    ...Object.keys(figures).map((key) => shown(name, key)),
    frames(name),
    `${found[name].blank} of ${found[name].after.length}`,
  ]);
  return [head, ...rows];
}

/** Bars of one figure, a library each: the median, and a line from the least to the most. */
function plot(title, key, found) {
  const [left, bar, gap, width] = [130, 16, 8, 520];
  const entries = Object.entries(found).map(([name, figures]) => [name, figures[key]]);
  const greatest = Math.max(...entries.map(([, { most }]) => most));
  const x = (value) => (left + (value / greatest) * width).toFixed(1);
  const digits = figures[key][1];
  const rows = entries.map(([name, { median, least, most }], k) => {
    const y = 34 + k * (bar + gap);
    const own = name.startsWith("Turnleaf") ? ' class="own"' : "";
    const middle = y + bar / 2;
    return `<text x="${left - 8}" y="${y + 12}" text-anchor="end">${name}</text>
<rect${own} x="${left}" y="${y}" width="${(x(median) - left).toFixed(1)}" height="${bar}"/>
<path d="M${x(least)} ${middle}H${x(most)}"/>
<text x="${Number(x(most)) + 8}" y="${y + 12}">${median.toFixed(digits)}</text>`;
  });
  const height = 34 + entries.length * (bar + gap) + 8;
  return `<svg xmlns="http://www.w3.org/2000/svg" width="720" height="${height}" viewBox="0 0 720 ${height}" role="img" aria-label="${title}">
<style>text{font:12px system-ui,sans-serif;fill:#555}rect{fill:#b9b4aa}.own{fill:#9a3324}path{stroke:#333}@media (prefers-color-scheme:dark){text{fill:#bbb}path{stroke:#eee}}</style>
<text x="${left}" y="18">${title}</text>
${rows.join("\n")}
</svg>
`;
}

/** Keeps what a run found. */
export function writeResults(what) {
  mkdirSync(folder, { recursive: true });
  const file = join(folder, `flipbooks-${what.pages}.json`);
  writeFileSync(file, `${JSON.stringify(what, null, 2)}\n`);
  writePage();
}

/** Writes the tables and plots of docs/comparison.md from all runs that are kept. */
function writePage() {
  for (const name of readdirSync(folder).filter((name) => /^flipbooks-\d+\.json$/.test(name))) {
    const { pages, found, machine, rounds, turns, versions, date } = JSON.parse(
      readFileSync(join(folder, name), "utf8"),
    );
    writeTable(`flipbooks_${pages}`, table(found));
    const rows = Object.entries(versions).map(([library, version]) => [library, version]);
    writeTable(`flipbooks_${pages}_run`, [
      ["", "of this run"],
      ["date", date.slice(0, 10)],
      ["machine", machine],
      ["pages, fresh browsers a library, turns in each", `${pages}, ${rounds}, ${turns}`],
      ...rows,
    ]);
    for (const [key, title] of Object.entries(plots)) {
      const picture = plot(`${title}: ${pages} pages`, key, found);
      writeFileSync(join(pictures, `comparison-${key}-${pages}.svg`), picture);
    }
  }
  for (const fault of includeTables()) console.error(fault);
}

if (process.argv[1] === import.meta.filename) writePage();
