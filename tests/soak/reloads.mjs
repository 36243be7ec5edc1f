/**
 * Reloads the reader at random places of books, by a seed, and compares what stands at the head of the
 * open page: the same word must be there when the book has come to rest again, and still when its pages
 * are counted. Fails where it is another.
 *
 *   node tests/soak/reloads.mjs [--reloads 40] [--seed N] [--flat] BOOK ...
 *
 * BOOK is a file, or a folder of files. Half of the reloads keep the place that the reader writes into the
 * address, the others lose it; half happen while the pages are counted, as far as counting lasts, the
 * others afterwards; half in a window as small as a phone's. Of pages without text the picture's number
 * counts.
 *
 * With --flat the books are shown on the flat, without WebGL: where software draws, a fraction of the time.
 */
import { readdirSync, statSync } from "node:fs";
import { basename, join } from "node:path";
import { parseArgs } from "node:util";
import { chromium } from "playwright-core";
import { chromiumArguments, findChromium } from "../../scripts/chromium.mjs";
import { markdown } from "../../scripts/docs_tables.mjs";
import { randomNumbers } from "../../scripts/random_numbers.mjs";
import { serve } from "../../scripts/reader_page.mjs";

const { values, positionals } = parseArgs({
  allowPositionals: true,
  options: {
    reloads: { type: "string", default: "40" },
    seed: { type: "string", default: String(Date.now() % 1_000_000) },
    flat: { type: "boolean", default: false },
  },
});
const [reloads, seed] = [Number(values.reloads), Number(values.seed)];
const books = positionals.flatMap((path) =>
  statSync(path).isDirectory() ? readdirSync(path).map((name) => join(path, name)) : [path],
);
if (books.length === 0) throw new Error("Name books, or a folder of them.");

const sizes = [
  { width: 1280, height: 800 },
  { width: 390, height: 844 },
];

/** Milliseconds for a book to open, come to rest or be counted on a busy machine. */
const longest = 180_000;

/** Resolves once a condition, which is a function in the page, holds. */
const until = (page, condition) => page.waitForFunction(condition, undefined, { timeout: longest });

const isAtRest = () => {
  const book = document.querySelector("turnleaf-book");
  const layer = book?.shadowRoot.querySelector(".reading");
  return book?.settled && layer?.hidden === false;
};

const isCounted = () => document.querySelector("turnleaf-book")?.estimated === false;

/** Whether the text of every open page that has some lies over it: each is read by itself, after it is drawn. */
const isRead = async () => {
  const book = document.querySelector("turnleaf-book");
  const groups = [...book.shadowRoot.querySelectorAll(".text > *")];
  const { left, right } = book.spread;
  const pages = [left, right].filter((page) => page !== null).sort((a, b) => a - b);
  const { signal } = new AbortController();
  const texts = await Promise.all(pages.map((page) => book.source.text(page - 1, signal)));
  return texts.every((runs, k) => runs.length === 0 || groups[k]?.querySelector(".spoken"));
};

/** The first words of the first open page that has text, its number, and whether pages are being counted. */
const headOfPage = () => {
  const book = document.querySelector("turnleaf-book");
  const pages = [...book.shadowRoot.querySelectorAll(".text > [role=group], .text > div")];
  const texts = pages.map((page) => page.querySelector(".spoken")?.dataset.text?.trim() ?? "");
  const text = texts.find((one) => one !== "")?.slice(0, 60) ?? "";
  return { text, page: book.page, pageCount: book.pageCount, isCounting: book.estimated };
};

/** What the page says once it is at rest and the text of all open pages is read. */
async function headAtRest(page) {
  await until(page, isAtRest);
  await until(page, isRead);
  return page.evaluate(headOfPage);
}

/** Whether two heads are of the same place: by their text; by the number where there is none. */
function isSame(before, after) {
  return before.text || after.text ? before.text === after.text : before.page === after.page;
}

const random = randomNumbers(seed);
const browser = await chromium.launch({
  executablePath: findChromium(),
  args: [...chromiumArguments, ...(values.flat ? ["--disable-3d-apis"] : [])],
});
const version = browser.version();
const tallies = new Map(
  books.map((path) => [path, { reloads: 0, counting: 0, addressed: 0, same: 0 }]),
);
for (let k = 0; k < reloads; k++) {
  const path = books[k % books.length];
  const tally = tallies.get(path);
  const turn = Math.floor(k / books.length);
  const [isCounting, isAddressed, isSmall] = [turn & 1, turn & 2, (turn + (k % 2)) & 4].map(
    Boolean,
  );
  const served = await serve("read", path);
  const viewport = sizes[isSmall ? 1 : 0];
  const context = await browser.newContext({ viewport, reducedMotion: "reduce" });
  const page = await context.newPage();
  await page.goto(served.url);
  await until(page, isAtRest);
  if (!isCounting) await until(page, isCounted);
  const fraction = random();
  await page.evaluate((fraction) => {
    const book = document.querySelector("turnleaf-book");
    return book.turnTo(1 + Math.floor(fraction * book.pageCount));
  }, fraction);
  const before = await headAtRest(page);
  if (!isAddressed) {
    await page.evaluate(() => history.replaceState(history.state, "", location.pathname));
  }
  await page.reload();
  const after = await headAtRest(page);
  await until(page, isCounted);
  const counted = await headAtRest(page);
  tally.reloads++;
  if (before.isCounting) tally.counting++;
  if (isAddressed) tally.addressed++;
  const same = isSame(before, after) && isSame(before, counted);
  if (same) tally.same++;
  const inWords = ({ page, pageCount, isCounting, text }) =>
    `${page} of ${isCounting ? "about " : ""}${pageCount} "${text}"`;
  console.log(
    `${same ? "same" : "CHANGED"} ${basename(path)}, ${viewport.width} px${isAddressed ? ", #page" : ""}: ${[before, after, counted].map(inWords).join(" -> ")}`,
  );
  await context.close();
  served.stop();
}
await browser.close();

const table = [
  ["book", "reloads", "while pages were counted", "with the place in the address", "same word"],
  ...[...tallies].map(([path, { reloads, counting, addressed, same }]) => [
    basename(path),
    reloads,
    counting,
    addressed,
    same,
  ]),
];
const wrong = [...tallies.values()].reduce((sum, { reloads, same }) => sum + reloads - same, 0);
console.log(
  `\n${markdown(table)}\nChromium ${version}, seed ${seed}: ${wrong} of ${reloads} changed.`,
);
process.exitCode = wrong > 0 ? 1 : 0;
