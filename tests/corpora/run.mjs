/**
 * Opens every book of the collections in a real browser, walks its pages and judges
 * what can be judged without an eye.
 *
 *   node tests/corpora/run.mjs                       all collections of scripts/corpora.json
 *   node tests/corpora/run.mjs NAME ...              these alone
 *   node tests/corpora/run.mjs --folder FOLDER       the books beneath any folder
 *   --match PATTERN    those alone whose path matches; what was found of others is kept
 *   --every N          every Nth book
 *   --resume           goes on with a walk: books of which something was found are left out
 *
 * What comes of each collection is written to target/corpora/NAME.json; once all
 * are there, `node tests/corpora/report.mjs` writes docs/reports/corpora.md of them.
 */
import { existsSync, mkdirSync, readFileSync, renameSync, writeFileSync } from "node:fs";
import { extname, join } from "node:path";
import { parseArgs } from "node:util";
import { corpora } from "../../scripts/corpora.mjs";
import { openPage } from "../books_page.mjs";
import { memoryByProcess } from "../soak/browser_memory.mjs";
import { booksIn } from "./books.mjs";

/** Milliseconds without a step after which a book counts as one that never ends. */
const patience = 600_000;

/** Milliseconds from one measure of memory to the next. */
const measureEvery = 500;

const { values, positionals } = parseArgs({
  allowPositionals: true,
  options: {
    folder: { type: "string" },
    match: { type: "string", default: "" },
    every: { type: "string", default: "1" },
    resume: { type: "boolean", default: false },
  },
});

/** Media types of what plain Chromium is to show, by the ending of its name. */
const types = {
  ".xhtml": "application/xhtml+xml",
  ".html": "application/xhtml+xml",
  ".htm": "application/xhtml+xml",
  ".xml": "application/xhtml+xml",
  ".css": "text/css",
  ".svg": "image/svg+xml",
};

let current;

/** Returns the response to an address: the book itself, or a file in it. */
function respond({ pathname }) {
  const path = decodeURIComponent(pathname.replace(/^\/books\//, ""));
  if (path === "book") return { body: Buffer.from(current.bytes()) };
  const name = path.replace(/^files\//, "");
  const files = current.files();
  if (!Object.hasOwn(files, name)) return { status: 404 };
  return {
    contentType: types[extname(name).toLowerCase()] ?? "",
    // Its own documents are shown as they are, and yet ask for nothing elsewhere.
    headers: { "content-security-policy": "default-src 'self' data: blob: 'unsafe-inline'" },
    body: Buffer.from(files[name]),
  };
}

/** Runs in the page. */
async function judgeInPage({ fileName, isEpub }) {
  const { judge } = await import("/tests/corpora/judge.js");
  const log = (step) => void globalThis.takeStep(step);
  const base = isEpub ? new URL("/books/files/", location.href).href : null;
  return await judge("/books/book", fileName, base, log);
}

let opened;

/** When the judge took its last step. */
let lastStep = 0;

/** Returns the page, in a browser that is started where there is none. */
async function browserPage() {
  if (opened) return opened;
  opened = await openPage(respond);
  await opened.page.exposeFunction("takeStep", () => {
    lastStep = Date.now();
  });
  const session = await opened.browser.newBrowserCDPSession();
  const { processInfo } = await session.send("SystemInfo.getProcessInfo");
  opened.pid = processInfo.find(({ type }) => type === "browser").id;
  return opened;
}

/** Opens a book, and returns what came of it. */
async function judgeBook(book) {
  const { page, foreign, site, pid } = await browserPage();
  current = book;
  await page.goto(site);
  // What every book needs is there before the time counts.
  await page.evaluate(() => import("/tests/corpora/judge.js"));
  foreign.length = 0;
  const before = memoryByProcess(pid).all;
  let most = before;
  lastStep = Date.now();
  let isLate;
  const late = new Promise((resolve) => {
    isLate = resolve;
  });
  const measuring = setInterval(() => {
    most = Math.max(most, memoryByProcess(pid).all);
    if (Date.now() - lastStep > patience) isLate(null);
  }, measureEvery);
  const isEpub = book.format === "epub";
  try {
    const found = await Promise.race([
      page.evaluate(judgeInPage, { fileName: book.fileName, isEpub }),
      late,
    ]);
    if (!found) {
      opened = undefined;
      await page.context().browser().close();
      return { faults: [["failed", `It did not go on for ${patience / 1000} s.`]] };
    }
    most = Math.max(most, memoryByProcess(pid).all);
    if (foreign.length > 0) found.foreign = [...foreign];
    return { ...found, megabytes: Math.round(most - before) };
  } catch (error) {
    opened = undefined;
    await page
      .context()
      .browser()
      .close()
      .catch(() => {});
    return { faults: [["failed", error.message.split("\n")[0]]] };
  } finally {
    clearInterval(measuring);
    book.forget();
  }
}

const chosen = values.folder
  ? [{ name: "folder", folder: values.folder, folders: ["."] }]
  : Object.values(corpora).filter(
      ({ name }) => positionals.length === 0 || positionals.includes(name),
    );
/** Returns what an earlier walk found of the books of a collection, by their paths. */
function foundBefore(file) {
  if (!(values.resume || values.match) || !existsSync(file)) return new Map();
  const { books } = JSON.parse(readFileSync(file, "utf8"));
  return new Map(books.map((row) => [row.path, row]));
}

/** Writes a file as a whole, so that a walk that is ended meanwhile leaves one that can be read. */
function writeWhole(file, text) {
  writeFileSync(`${file}.part`, text);
  renameSync(`${file}.part`, file);
}

const results = join(import.meta.dirname, "../../target/corpora");
mkdirSync(results, { recursive: true });
for (const { name, folder, folders } of chosen) {
  const places = folders.map((one) => join(folder, one)).filter(existsSync);
  if (places.length === 0) {
    console.error(`${name} is not here: run \`make corpora\`, then this again.`);
    process.exitCode = 1;
    continue;
  }
  const pattern = new RegExp(values.match);
  const books = places.flatMap((place) => booksIn(place));
  const tried = books
    .filter(({ path }) => pattern.test(path))
    .filter((_, k) => k % Number(values.every) === 0);
  const file = join(results, `${name}.json`);
  const rows = foundBefore(file);
  for (const book of tried) {
    if (values.resume && rows.has(book.path)) continue;
    const found = await judgeBook(book);
    rows.set(book.path, { path: book.path, format: book.format, ...found });
    const verdict = found.refused
      ? `refused: ${found.refused}`
      : `${found.pages} pages, ${found.milliseconds?.all} ms, ${found.megabytes} MB`;
    console.log(`${name} ${book.path}: ${verdict}${found.opinion ? ` (${found.opinion})` : ""}`);
    for (const fault of (found.faults ?? []).slice(0, 12))
      console.log("   ", JSON.stringify(fault));
    if (found.foreign) console.log("    asked:", found.foreign.slice(0, 3).join(" "));
    // In the collection's order, whichever walk found it.
    const known = books.flatMap(({ path }) => rows.get(path) ?? []);
    writeWhole(file, `${JSON.stringify({ total: books.length, books: known }, null, 1)}\n`);
  }
}
await opened?.close();
