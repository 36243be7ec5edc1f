/**
 * What a frame takes in which a page is torn out, carried away, torn across or crumpled, in a real
 * Chromium: the script of a frame, and from one frame to the next.
 *
 *   npm run build
 *   node bench/tearing.mjs [--pages 5] [--undrawn] [--json]
 *
 * In each of some fresh pages a leaf of the calendar of the examples is torn out, left to come to
 * rest and torn across, and after that another, which is crumpled: so each first time is among
 * them, in which code is compiled. Of all frames from the command until everything lies still the median, the
 * 95th percentile and the worst over all pages, beside those of a leaf that is turned. A frame's
 * script is the time in all callbacks of animation frames; from one frame to the next counts
 * drawing too, which without a graphics card software does, and for which script waits. With
 * --undrawn no draw call reaches WebGL, as if a card drew in no time.
 */
import { parseArgs } from "node:util";
import { chromium } from "playwright-core";
import { serve } from "../examples/serve.mjs";
import { chromiumArguments, findChromium } from "../scripts/chromium.mjs";
import { quantiles } from "./quantiles.mjs";

const { values } = parseArgs({
  options: {
    pages: { type: "string", default: "5" },
    undrawn: { type: "boolean", default: false },
    json: { type: "boolean", default: false },
  },
});

/** Runs in the page before anything else: keeps when each frame began, ms, and the time of its callbacks. */
function watch() {
  const frames = [];
  const request = window.requestAnimationFrame.bind(window);
  window.requestAnimationFrame = (callback) =>
    request((now) => {
      const start = performance.now();
      callback(now);
      if (frames.at(-1)?.now !== now) frames.push({ now, script: 0 });
      frames.at(-1).script += performance.now() - start;
    });
  window.takeFrames = () => frames.splice(0);
}

/** Runs in the page before anything else: nothing is drawn. */
function drawNothing() {
  for (const call of ["drawArrays", "drawElements", "drawArraysInstanced", "drawElementsInstanced"])
    WebGL2RenderingContext.prototype[call] = () => {};
}

/** Runs in the page: starts a motion, and returns its frames once there were none for half a second. */
async function motion(name) {
  const book = document.querySelector("turnleaf-book");
  const until = async (isSo) => {
    while (!isSo()) await new Promise((resolve) => setTimeout(resolve, 20));
  };
  const motions = {
    turned: () => book.next(),
    "torn out": () => book.tearOut(),
    "torn across": () => book.tearAcross({ x: 0, y: 0.5 }, { x: 1, y: 0.45 }),
    crumpled: () => book.crumple(),
  };
  window.takeFrames();
  let last = performance.now();
  if ((await motions[name]()) === false) throw new Error(`No page is ${name}.`);
  const all = [];
  await until(() => {
    const now = performance.now();
    const frames = window.takeFrames();
    if (frames.length > 0) last = now;
    all.push(...frames);
    return now - last > 500;
  });
  return all;
}

const examples = await serve();
const browser = await chromium.launch({
  executablePath: findChromium(),
  args: [...chromiumArguments],
});
const found = {};
try {
  for (let k = 0; k < Number(values.pages); k++) {
    const page = await browser.newPage({ viewport: { width: 1280, height: 900 } });
    page.on("pageerror", (error) => {
      throw error;
    });
    await page.addInitScript(watch);
    if (values.undrawn) await page.addInitScript(drawNothing);
    await page.goto(new URL("18-tear-off.html", examples.url).href);
    await page.waitForFunction(() => document.querySelector("turnleaf-book").pageCount > 0);
    await page.waitForTimeout(2000);
    for (const name of ["turned", "torn out", "torn across", "torn out", "crumpled"]) {
      const frames = await page.evaluate(motion, name);
      found[name] ??= { script: [], between: [] };
      found[name].script.push(...frames.map(({ script }) => script));
      for (let i = 1; i < frames.length; i++) {
        const between = frames[i].now - frames[i - 1].now;
        // What lies still for a while asks for no frames.
        if (between < 400) found[name].between.push(between);
      }
    }
    await page.close();
  }
} finally {
  await browser.close();
  await examples.stop();
}

/** The median, the 95th percentile and the worst of some times, ms. */
function percentiles(times) {
  const at = quantiles(times);
  return { median_ms: at(0.5), p95_ms: at(0.95), worst_ms: at(1) };
}

const results = {};
for (const [name, { script, between }] of Object.entries(found)) {
  results[name] = {
    frames: script.length,
    script: percentiles(script),
    between: percentiles(between),
  };
}
if (values.json) {
  console.log(JSON.stringify({ pages: Number(values.pages), results }, null, 2));
} else {
  const say = ({ median_ms, p95_ms, worst_ms }) =>
    [median_ms, p95_ms, worst_ms].map((time) => time.toFixed(1).padStart(6)).join(" ");
  console.log(`${"median, 95th, worst, ms".padEnd(24)}  script of a frame    frame to frame`);
  for (const [name, { script, between }] of Object.entries(results)) {
    console.log(`${name.padEnd(24)} ${say(script)} ${say(between)}`);
  }
}
