/**
 * Makes the films of the docs from the real thing: `turnleaf film` folds, tears and crumples pages
 * of the book that comes with it and of two of the examples. Needs Chromium and ffmpeg.
 *
 *   node scripts/films.mjs [name ...]
 */
import { spawnSync } from "node:child_process";
import { copyFileSync, existsSync, mkdirSync, rmSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { chromium } from "playwright-core";
import { serve as serveExamples } from "../examples/serve.mjs";
import { chromiumArguments, findChromium } from "./chromium.mjs";

const root = join(import.meta.dirname, "..");
const command = join(root, "packages/cli/dist/main.js");
const out = join(root, "docs/films");
/** Where pages and films are made. */
const made = join(root, "target/films");
const novel = join(root, "books/moby-dick.pdf");

/** A calendar: how its pages are bound, and a picture wide enough for one of them beside it. */
const calendar = {
  example: "18-tear-off.html",
  page: 1,
  bound: ["binding=top", "layout=single", "cover=none", "offset=0", "tearable=perforated"],
  size: "512x208",
};

/** Each film: its book, the page at which it begins, what is done, how the book is bound, and its size. */
const films = {
  "dog-ear": { page: 18, does: "dog-ear 19 foot, next, previous, unfold 19" },
  letter: { page: 18, does: "fold 19 letter, unfold 19" },
  map: {
    example: "20-fold-outs.html",
    page: 10,
    does: "unfold 11, fold-in",
    bound: ["cover=none"],
  },
  "tear-off": { ...calendar, does: "tear-out" },
  "tear-across": { ...calendar, does: "tear-out, tear-across 0,0.42 1,0.55" },
  crumple: { ...calendar, does: "tear-out, crumple" },
};

/** The rate of every film, and how long a turn takes and the book lies still. */
const look = ["--fps", "25", "--seconds-per-turn", "0.8", "--pause", "0.3"];

/** Returns the folder of the pages of an example, drawn on a day that is always the same. */
async function pagesOf(browser, address, name) {
  const folder = join(made, name.replace(/\.html$/, ""));
  if (existsSync(folder)) return folder;
  mkdirSync(folder, { recursive: true });
  const page = await browser.newPage({ locale: "en-GB", timezoneId: "UTC" });
  page.setDefaultTimeout(180_000);
  await page.clock.setFixedTime(new Date("2026-01-01T12:00:00Z"));
  await page.goto(address + name);
  await page.waitForFunction(() => document.querySelector("turnleaf-book")?.pageCount);
  const pages = await page.evaluate(async () => {
    const book = document.querySelector("turnleaf-book");
    return await Promise.all(
      (book.pages ?? []).map(async ({ src }) => {
        const bytes = new Uint8Array(await src.arrayBuffer());
        return btoa(Array.from(bytes, (byte) => String.fromCharCode(byte)).join(""));
      }),
    );
  });
  await page.close();
  for (const [k, base64] of pages.entries()) {
    const file = join(folder, `${String(k + 1).padStart(3, "0")}.png`);
    writeFileSync(file, Buffer.from(base64, "base64"));
  }
  return folder;
}

rmSync(made, { recursive: true, force: true });
for (const folder of [out, made]) mkdirSync(folder, { recursive: true });
const names = process.argv.length > 2 ? process.argv.slice(2) : Object.keys(films);
const examples = await serveExamples();
const executablePath = findChromium();
const browser = await chromium.launch({ executablePath, args: chromiumArguments });
try {
  for (const name of names) {
    const { example, page, does, bound = [], size = "480x288" } = films[name];
    const book = example ? await pagesOf(browser, examples.url, example) : novel;
    const attributes = bound.flatMap((attribute) => ["--attribute", attribute]);
    const file = join(made, `${name}.webm`);
    const shown = ["--pages", String(page), "--size", size, ...look, ...attributes];
    const how = [...shown, "--do", does, "--out", file];
    const { status } = spawnSync(process.execPath, [command, "film", book, ...how], {
      stdio: "inherit",
      env: { ...process.env, CHROMIUM: executablePath },
    });
    if (status !== 0) throw new Error(`The film ${name} was not made.`);
    copyFileSync(file, join(out, `${name}.webm`));
  }
} finally {
  await browser.close();
  await examples.stop();
}
