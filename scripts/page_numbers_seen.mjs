/**
 * How near the first number of pages that readers of the reader see is to the last, as a book is opened
 * for the first time and again, in windows of three sizes.
 *
 *   node scripts/page_numbers_seen.mjs BOOK ...
 *
 * It uses the build of `npm run build`, and shows the books on the flat.
 */
import { basename } from "node:path";
import { chromium } from "playwright-core";
import { chromiumArguments, findChromium } from "./chromium.mjs";
import { serve } from "./reader_page.mjs";

const sizes = [
  { width: 1280, height: 800 },
  { width: 820, height: 1180 },
  { width: 390, height: 844 },
];

/** Milliseconds for a book to be opened and counted on a busy machine. */
const longest = 400_000;

/** Runs in the page before anything else: notes the first number that is no mere guess. */
function noteFirst() {
  const look = () => {
    const book = document.querySelector("turnleaf-book");
    if (book?.pageCount > 0 && !book.guessed) window.firstCount = book.pageCount;
    else requestAnimationFrame(look);
  };
  look();
}

const isCounted = () => {
  const book = document.querySelector("turnleaf-book");
  return book?.pageCount > 0 && !book.estimated;
};

const args = [...chromiumArguments, "--disable-3d-apis"];
const browser = await chromium.launch({ executablePath: findChromium(), args });
for (const path of process.argv.slice(2)) {
  const { url, stop } = await serve("read", path);
  for (const viewport of sizes) {
    const context = await browser.newContext({ viewport, reducedMotion: "reduce" });
    const page = await context.newPage();
    page.setDefaultTimeout(longest);
    await page.addInitScript(noteFirst);
    const found = [];
    for (const visit of ["opened first", "opened again"]) {
      if (visit === "opened first") await page.goto(url);
      else await page.reload();
      await page.waitForFunction(isCounted);
      const [first, last] = await page.evaluate(() => [
        window.firstCount,
        document.querySelector("turnleaf-book").pageCount,
      ]);
      found.push(`${visit} ${first} of ${last} (${(100 * (first / last - 1)).toFixed(1)} %)`);
    }
    console.log(`${basename(path)}, ${viewport.width} x ${viewport.height}: ${found.join(", ")}`);
    await context.close();
  }
  stop();
}
await browser.close();
