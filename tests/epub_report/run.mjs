/**
 * Opens every test book of w3c/epub-tests in a real browser, judges each by the
 * condition that it states, and writes the report in that project's own form,
 * docs/reports/epub-tests.json, and the tables of docs/reports/conformance.md.
 *
 *   node tests/epub_report/run.mjs            all tests
 *   node tests/epub_report/run.mjs NAME ...   these alone; the others stay as they are in the report
 *
 * Pictures of the pages are left in target/epub_report. Tests that only an eye can
 * judge are in seen.json, with what was seen there and at which commit.
 */
import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { corpora } from "../../scripts/corpora.mjs";
import { includeTables, writeTable } from "../../scripts/docs_tables.mjs";
import { openPage } from "../books_page.mjs";
import { bookOf, factsOf, stoodInFor, testNames } from "./test_books.mjs";
import { missing, notApplicable } from "./verdicts.mjs";

const root = join(import.meta.dirname, "../..");
const pictures = join(root, "target/epub_report");
const seen = JSON.parse(readFileSync(join(import.meta.dirname, "seen.json"), "utf8"));

/** Milliseconds after which a book that is not judged counts as failed: the largest take seconds. */
const patience = 120_000;

/** Runs in the page: judges one book. Returns the verdict, why, and a picture of its first pages. */
async function judge({ name, id, hasCheck, patience }) {
  const { OpenedBook, contactSheet } = await import("/tests/epub_report/opened_book.js");
  const { checks } = await import("/tests/epub_report/checks.js");
  const bytesOf = async (address) =>
    new Uint8Array(await (await fetch(`/books/${address}`)).arrayBuffer());
  const others = {
    name,
    open: async (other) => await OpenedBook.open(await bytesOf(other), other),
    without: async (pattern) =>
      await OpenedBook.open(
        await bytesOf(`${name}?without=${encodeURIComponent(pattern.source)}`),
        name,
      ),
    foreign: () => globalThis.foreignRequests(),
  };
  const late = new Promise((resolve) => setTimeout(resolve, patience, "It took too long."));
  const book = await OpenedBook.open(await bytesOf(name), name);
  try {
    const verdict = hasCheck ? Promise.resolve(checks[id](book, others)) : null;
    const found = await Promise.race([verdict, late]);
    // What passes needs no eye.
    const picture = book.error || found === true ? null : await contactSheet(book);
    if (found === "n/a") return { passes: found, why: "", picture };
    if (typeof found === "string") return { passes: false, why: found, picture };
    return { passes: found, why: book.error ?? "", picture };
  } catch (error) {
    return { passes: false, why: error.message };
  } finally {
    book.close();
  }
}

const reportFile = join(root, "docs/reports/epub-tests.json");
const names = process.argv.slice(2);
const isWhole = names.length === 0;
const reported = isWhole ? {} : JSON.parse(readFileSync(reportFile, "utf8")).tests;
mkdirSync(pictures, { recursive: true });
/** Returns the book of an address, without the files that it asks to leave out. */
function respond({ pathname, searchParams }) {
  const left = new RegExp(searchParams.get("without") ?? "^$");
  return { body: Buffer.from(bookOf(pathname.replace(/^\/books\//, ""), left)) };
}
const { page, foreign, close } = await openPage(respond);
await page.exposeFunction("foreignRequests", () => foreign);
const { checks } = await import("./checks.js");
const results = [];
for (const name of testNames()) {
  const facts = factsOf(name);
  const { id } = facts;
  const hasCheck = Object.hasOwn(checks, id);
  // What is known without looking is not opened: some of these books are large.
  const known = notApplicable[id] ? "n/a" : missing[id] ? false : undefined;
  let verdict = { passes: known, why: notApplicable[id] ?? missing[id] ?? "" };
  const isJudged = isWhole || names.includes(name);
  if (known === undefined && !isJudged)
    verdict = { passes: reported[id], why: seen[id]?.saw ?? "" };
  else if (known === undefined) {
    foreign.length = 0;
    const judged = await page.evaluate(judge, { name, id, hasCheck, patience });
    if (judged.picture) writeFileSync(join(pictures, `${name}.png`), judged.picture, "base64");
    verdict = judged;
    if (seen[id]) verdict = { passes: seen[id].passes, why: seen[id].saw };
    else if (!hasCheck) {
      verdict = { passes: null, why: "nothing judges it yet" };
      process.exitCode = 1;
    }
  }
  // Two books may share an identifier: both have to pass.
  const before = results.find((one) => one.id === id);
  if (before) before.passes = before.passes === true && verdict.passes === true;
  else results.push({ ...facts, ...verdict });
  if (isJudged) console.log(JSON.stringify(verdict.passes), name, verdict.why);
}
await close();

const count = (some, passes) => some.filter((one) => one.passes === passes).length;
const share = (some) => {
  const [passed, failed] = [count(some, true), count(some, false)];
  return `${((100 * passed) / (passed + failed)).toFixed(1)} %`;
};
const current = results.filter(({ isDeprecated }) => !isDeprecated);
const row = (title, some) => [
  title,
  count(some, true),
  count(some, false),
  count(some, "n/a"),
  share(some),
];

const without = (some) => some.filter(({ id, passes }) => passes !== false || !optional(id));
/** Whether a test is of what Turnleaf leaves out by design: scripts. */
function optional(id) {
  return id.startsWith("scr-");
}
const table = [
  ["tests", "pass", "fail", "not applicable", "passes of those that apply"],
  row("of EPUB 3.4", current),
  row("of EPUB 3.4, without failures of scripts", without(current)),
  row("with those that are deprecated", results),
];
console.table(table);
const { version } = JSON.parse(readFileSync(join(root, "packages/turnleaf/package.json"), "utf8"));
const report = {
  name: "Turnleaf",
  variant: `${version}, web, Chromium`,
  tested_by: "implementer",
  tests: Object.fromEntries(results.map(({ id, passes }) => [id, passes])),
};
mkdirSync(join(root, "docs/reports"), { recursive: true });
writeFileSync(reportFile, `${JSON.stringify(report, null, 2)}\n`);
writeTable("epub_tests", table);
const failures = new Map();
for (const { id, passes, why, asks } of results) {
  if (passes !== false) continue;
  const reason = why || asks;
  failures.set(reason, [...(failures.get(reason) ?? []), id]);
}
writeTable("epub_failures", [
  ["why", "tests that fail"],
  ...[...failures].map(([why, tests]) => [why, tests.join(", ")]),
]);
includeTables();
const silent = testNames().filter(stoodInFor);
if (silent.length > 0) {
  console.log(
    `The recording of these is not here, and silence as long was heard in its place: ${silent.join(", ")}.`,
  );
}
console.log(`Of w3c/epub-tests at ${corpora["epub-tests"].commit}.`);
