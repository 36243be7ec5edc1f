/**
 * Takes the pictures of the README and the docs from the real thing: the built
 * reader with the book that comes with it, two of the examples and the playground, in a real
 * Chromium, its clock driven by hand so that a moment of a turn is the same
 * moment every time.
 *
 *   node scripts/pictures.mjs [name ...]
 */
import { mkdirSync } from "node:fs";
import { join } from "node:path";
import { chromium } from "playwright-core";
import { serve as serveExamples } from "../examples/serve.mjs";
import { chromiumArguments, findChromium } from "./chromium.mjs";
import { driveClock, serve } from "./reader_page.mjs";

const root = join(import.meta.dirname, "..");
const out = join(root, "docs/pictures");
const wide = { width: 1280, height: 800 };
const small = { width: 600, height: 450 };
const phone = { width: 390, height: 844 };

/** Each picture: where the book lies open, how it is shown, and what is done before it is taken. */
const pictures = {
  cover: { page: 1 },
  spread: { page: 18 },
  "turn-1": { page: 18, turn: 240 },
  "turn-2": { page: 18, turn: 400 },
  "cover-opening": { page: 1, turn: 420 },
  riffle: { page: 60, riffle: 870 },
  drag: { page: 18, drag: [0.82, 0.88, 0.6, 0.72] },
  phone: { page: 19, viewport: phone, scale: 2 },
  dark: { page: 30, shown: { controls: true, theme: "dark" } },
  zoom: { page: 19, zoom: [4, 0.62, 0.42] },
  "right-to-left": { example: "03-manga.html", page: 3, turn: 400 },
  calendar: {
    example: "04-calendar.html",
    page: 12,
    viewport: { width: 800, height: 1000 },
    turn: 400,
  },
  ...Object.fromEntries(
    [200, 450, 1150].map((tear, k) => [
      `tear-off-${k + 1}`,
      { example: "18-tear-off.html", viewport: { width: 900, height: 480 }, page: 1, tear },
    ]),
  ),
  ...Object.fromEntries(
    [0, 350, 640].map((unfold, k) => [
      `fold-out-${k + 1}`,
      { example: "20-fold-outs.html", viewport: { width: 900, height: 480 }, page: 5, unfold },
    ]),
  ),
  ...Object.fromEntries(
    ["bible", "book", "office", "coated", "card"].map((stock) => [
      `stock-${stock}`,
      { page: 18, viewport: small, stock, drag: [0.86, 0.83, 0.66, 0.5] },
    ]),
  ),
};

/** Runs in the page too: a frame that nobody sees is not drawn, as software GL takes a second for each. */
function drawWhatIsSeen() {
  const { prototype } = WebGL2RenderingContext;
  const { drawElements } = prototype;
  prototype.drawElements = function (...what) {
    if (window.clock.last) drawElements.apply(this, what);
  };
}

async function take(browser, reader, examples, name) {
  const {
    page: number,
    example,
    viewport = wide,
    scale,
    shown,
    stock,
    zoom,
    turn,
    riffle,
    drag,
    tear,
    unfold,
  } = pictures[name];
  const page = await browser.newPage({ viewport, deviceScaleFactor: scale });
  page.setDefaultTimeout(180_000);
  await page.addInitScript(driveClock);
  await page.addInitScript(drawWhatIsSeen);
  await page.goto(example ? examples + example : `${reader}#page=${number}`);
  await page.waitForFunction(() => document.querySelector("turnleaf-book")?.pageCount);
  const settled = () =>
    page.waitForFunction(() => document.querySelector("turnleaf-book").settled, null, {
      polling: 100,
    });
  if (example) {
    await page.evaluate((number) => {
      const book = document.querySelector("turnleaf-book");
      Object.assign(book.style, { position: "fixed", inset: "0" });
      book.page = number;
      window.clock.pass(4000);
    }, number);
  }
  // The book alone, on the warm desk, where nothing else is asked for.
  await page.evaluate((shown) => Object.assign(document.querySelector("turnleaf-book"), shown), {
    controls: false,
    theme: "paper",
    ...shown,
  });
  await settled();
  // The neighbours too, so that the page beneath is there.
  await page.waitForTimeout(3000);
  if (zoom) {
    const [level, x, y] = zoom;
    const at = { x: x * viewport.width, y: y * viewport.height };
    await page.evaluate(
      ([level, at]) => document.querySelector("turnleaf-book").zoomTo(level, at),
      [level, at],
    );
    await settled();
    // Its sharper picture.
    await page.waitForTimeout(3000);
  }
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
    // One call every 75 ms, as a held key repeats, and time between for the pages that come into sight to be drawn.
    for (let t = 0; t < riffle; t += 75) {
      await page.evaluate(() => {
        document.querySelector("turnleaf-book").next();
        window.clock.pass(75);
      });
      await page.waitForTimeout(2500);
    }
    await page.waitForTimeout(5000);
    await page.evaluate(() => window.clock.pass(1));
  }
  if (drag) {
    const [x0, y0, x1, y1] = drag.map(
      (fraction, i) => fraction * (i % 2 ? viewport.height : viewport.width),
    );
    await page.mouse.move(x0, y0);
    await page.mouse.down();
    await page.mouse.move(x1, y1, { steps: 8 });
    await page.evaluate(() => window.clock.pass(700));
  }
  if (tear) {
    // What tears it is there before the clock goes on.
    await page.evaluate(() => void document.querySelector("turnleaf-book").tearOut());
    await page.waitForTimeout(1000);
    await page.evaluate((milliseconds) => window.clock.pass(milliseconds), tear);
  }
  if (unfold) {
    // Its flap is there before the clock goes on.
    await page.evaluate(
      (number) => void document.querySelector("turnleaf-book").unfold(number),
      number,
    );
    await page.waitForTimeout(3000);
    await page.evaluate((milliseconds) => window.clock.pass(milliseconds), unfold);
  }
  await page.screenshot({ path: join(out, `${name}.png`) });
  await page.close();
  console.log(`docs/pictures/${name}.png`);
}

/** The playground in the middle of a turn by the corner, with what the paper's figures show. */
async function takePlayground(browser) {
  const playground = await serve("playground");
  try {
    const page = await browser.newPage({ viewport: wide, locale: "en-GB" });
    page.setDefaultTimeout(180_000);
    await page.addInitScript(driveClock);
    await page.goto(`${playground.url}#masses=yes&springs=yes`);
    await page.waitForFunction(() => document.querySelector(".plot p")?.textContent);
    await page.evaluate(() => {
      window.clock.free = false;
    });
    await page.getByRole("button", { name: "Turn by corner" }).click();
    await page.evaluate(() => window.clock.pass(480));
    await page.screenshot({ path: join(out, "playground.png") });
    await page.close();
    console.log("docs/pictures/playground.png");
  } finally {
    playground.stop();
  }
}

mkdirSync(out, { recursive: true });
const all = [...Object.keys(pictures), "playground"];
const names = process.argv.length > 2 ? process.argv.slice(2) : all;
const [reader, examples] = await Promise.all([serve(), serveExamples()]);
const browser = await chromium.launch({ executablePath: findChromium(), args: chromiumArguments });
try {
  for (const name of names) {
    if (name === "playground") await takePlayground(browser);
    else await take(browser, reader.url, examples.url, name);
  }
} finally {
  await browser.close();
  reader.stop();
  await examples.stop();
}
