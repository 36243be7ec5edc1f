/**
 * What a turn costs the page's thread, by the browser's own count: scripts, style
 * and layout of each frame at 60 Hz, without what the graphics card does. Frames
 * are called for one after another by a clock of the script's, so that a slow
 * machine draws as many as a quick one.
 *
 *   node scripts/script_time.mjs [--json]    milliseconds a frame
 */
import { fileURLToPath } from "node:url";
import { chromium } from "playwright-core";
import { chromiumArguments, findChromium } from "./chromium.mjs";
import { driveClock, serve } from "./reader_page.mjs";

/** Fresh pages that each figure is the median of. */
const pages = 5;

/** What is turned: by how many pages, from page 40 on. */
const turns = { "one leaf": 2, "a riffle of twelve leaves": 24 };

/** The browser's figures that are counted, and what they are called here. */
const counted = {
  script: "ScriptDuration",
  style: "RecalcStyleDuration",
  layout: "LayoutDuration",
};

/** Milliseconds a frame of one turn in a fresh page. */
async function measure(browser, url, by) {
  const page = await browser.newPage({ viewport: { width: 480, height: 360 } });
  await page.addInitScript(driveClock);
  await page.goto(`${url}#page=40`);
  const isSettled = () => document.querySelector("turnleaf-book")?.settled;
  await page.waitForFunction(isSettled, null, { polling: 100, timeout: 120_000 });
  const turn = (by) =>
    page.evaluate(async (by) => {
      const book = document.querySelector("turnleaf-book");
      const before = window.clock.frames;
      await book.goTo(book.page + by);
      return window.clock.frames - before;
    }, by);
  // Once there and back, so that what is measured is compiled as it stays.
  for (const way of [by, -by]) await turn(way);
  await page.waitForFunction(isSettled, null, { polling: 100, timeout: 120_000 });
  const session = await page.context().newCDPSession(page);
  // The thread's own time: what other programs take of the processor is not counted.
  await session.send("Performance.enable", { timeDomain: "threadTicks" });
  const read = async () => {
    const { metrics } = await session.send("Performance.getMetrics");
    return Object.fromEntries(metrics.map(({ name, value }) => [name, value]));
  };
  const before = await read();
  const frames = await turn(by);
  const after = await read();
  await page.close();
  const found = { frames };
  for (const [name, metric] of Object.entries(counted)) {
    found[name] = (1000 * (after[metric] - before[metric])) / frames;
  }
  found.all = found.script + found.style + found.layout;
  return found;
}

const median = (values) => values.sort((a, b) => a - b)[Math.floor(values.length / 2)];

/** For each turn the medians, and the least and the most of all together, milliseconds a frame. */
export async function scriptTimes() {
  const { url, stop } = await serve();
  const browser = await chromium.launch({
    executablePath: findChromium(),
    args: chromiumArguments,
  });
  try {
    const results = {};
    for (const [name, by] of Object.entries(turns)) {
      const found = [];
      for (let k = 0; k < pages; k++) found.push(await measure(browser, url, by));
      const of = (key) => found.map((one) => one[key]);
      results[name] = {
        ...Object.fromEntries(Object.keys(found[0]).map((key) => [key, median(of(key))])),
        least: Math.min(...of("all")),
        most: Math.max(...of("all")),
      };
    }
    return results;
  } finally {
    await browser.close();
    stop();
  }
}

if (process.argv[1] === fileURLToPath(import.meta.url)) {
  const results = await scriptTimes();
  if (process.argv.includes("--json")) console.log(JSON.stringify(results, null, 2));
  else console.table(results);
}
