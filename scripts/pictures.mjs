/**
 * Takes the pictures of the README and the docs from the real thing: the built
 * reader with the book that comes with it, in a real Chromium, its clock driven
 * by hand so that a moment of a turn is the same moment every time.
 *
 *   node scripts/pictures.mjs [name ...]
 */
import { spawn } from "node:child_process";
import { mkdirSync } from "node:fs";
import { join } from "node:path";
import { chromium } from "playwright-core";
import { chromiumArguments, findChromium } from "./chromium.mjs";

const root = join(import.meta.dirname, "..");
const out = join(root, "docs/pictures");
const wide = { width: 1280, height: 800 };
const small = { width: 600, height: 450 };

/** Each picture: where the book lies open, and what is done before it is taken. */
const pictures = {
  cover: { page: 1, viewport: wide },
  spread: { page: 18, viewport: wide },
  "turn-1": { page: 18, viewport: wide, turn: 240 },
  "turn-2": { page: 18, viewport: wide, turn: 400 },
  "cover-opening": { page: 1, viewport: wide, turn: 420 },
  riffle: { page: 60, viewport: wide, riffle: 870 },
  drag: { page: 18, viewport: wide, drag: [0.82, 0.88, 0.6, 0.72] },
  ...Object.fromEntries(
    ["bible", "book", "office", "coated", "card"].map((stock) => [
      `stock-${stock}`,
      { page: 18, viewport: small, stock, drag: [0.86, 0.83, 0.66, 0.5] },
    ]),
  ),
};

/** Serves the book that comes with the project; answers its address. */
async function serve() {
  const command = join(root, "packages/cli/dist/main.js");
  const book = join(root, "books/moby-dick.pdf");
  const child = spawn(process.execPath, [command, "read", book, "--no-open", "--port", "0"]);
  child.stderr.pipe(process.stderr);
  const url = await new Promise((resolve, reject) => {
    child.stdout.on("data", (data) => {
      const found = /http:\S+/.exec(String(data));
      if (found) resolve(found[0]);
    });
    child.on("exit", () => reject(new Error("The reader did not start.")));
  });
  return { url, stop: () => child.kill() };
}

/** Runs in the page before anything else: frames come when they are called for. */
function driveClock() {
  let waiting = [];
  let now = 1000;
  let count = 0;
  const clock = {
    free: true,
    /** Lets a time pass, in frames of 60 Hz. */
    pass(milliseconds, before) {
      for (let t = 0; t < milliseconds; t += 1000 / 60) {
        now += 1000 / 60;
        before?.();
        const calls = waiting;
        waiting = [];
        for (const { call } of calls) call(now);
      }
    },
  };
  Object.assign(window, {
    clock,
    requestAnimationFrame(call) {
      waiting.push({ id: ++count, call });
      if (clock.free) setTimeout(() => clock.pass(1), 0);
      return count;
    },
    cancelAnimationFrame(id) {
      waiting = waiting.filter((frame) => frame.id !== id);
    },
  });
}

async function take(browser, url, name) {
  const { page: number, viewport, stock, turn, riffle, drag } = pictures[name];
  const page = await browser.newPage({ viewport });
  await page.addInitScript(driveClock);
  await page.goto(`${url}#page=${number}`);
  // The book alone, on the warm desk.
  await page.locator("turnleaf-book").evaluate((book) => {
    book.controls = false;
    book.theme = "paper";
  });
  await page.waitForFunction(() => document.querySelector("turnleaf-book")?.settled, null, {
    polling: 100,
    timeout: 60_000,
  });
  // The neighbours too, so that the page beneath is there.
  await page.waitForTimeout(3000);
  await page.evaluate(() => {
    window.clock.free = false;
  });
  if (stock) {
    await page.evaluate((stock) => {
      document.querySelector("turnleaf-book").stock = stock;
    }, stock);
  }
  if (turn) {
    await page.evaluate((milliseconds) => {
      document.querySelector("turnleaf-book").next();
      window.clock.pass(milliseconds);
    }, turn);
  }
  if (riffle) {
    // In pieces, so that the pages that come into sight are drawn in between.
    for (let t = 0; t < riffle; t += 60) {
      await page.evaluate(() => {
        window.clock.pass(59, () => document.querySelector("turnleaf-book").next());
      });
      await page.waitForTimeout(1500);
    }
  }
  if (drag) {
    const [x0, y0, x1, y1] = drag.map(
      (share, i) => share * (i % 2 ? viewport.height : viewport.width),
    );
    await page.mouse.move(x0, y0);
    await page.mouse.down();
    await page.mouse.move(x1, y1, { steps: 8 });
    await page.evaluate(() => window.clock.pass(700));
  }
  await page.screenshot({ path: join(out, `${name}.png`) });
  await page.close();
  console.log(`docs/pictures/${name}.png`);
}

mkdirSync(out, { recursive: true });
const names = process.argv.length > 2 ? process.argv.slice(2) : Object.keys(pictures);
const reader = await serve();
const browser = await chromium.launch({ executablePath: findChromium(), args: chromiumArguments });
try {
  for (const name of names) await take(browser, reader.url, name);
} finally {
  await browser.close();
  reader.stop();
}
