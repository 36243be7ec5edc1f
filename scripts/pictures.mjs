/**
 * Takes the pictures of the README and the docs from the real thing: the built
 * reader with the book that comes with it, in a real Chromium, its clock driven
 * by hand so that a moment of a turn is the same moment every time.
 *
 *   node scripts/pictures.mjs [name ...]
 */
import { mkdirSync } from "node:fs";
import { join } from "node:path";
import { chromium } from "playwright-core";
import { chromiumArguments, findChromium } from "./chromium.mjs";
import { driveClock, serve } from "./reader_page.mjs";

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
