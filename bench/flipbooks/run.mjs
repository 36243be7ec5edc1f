/**
 * Page-turning libraries side by side: the same images, browser and turns, each in browsers of its
 * own, in turn. What a reader notices and what a machine pays.
 *
 *   node bench/flipbooks/run.mjs [--pages 500] [--rounds 5] [--turns 10] [--only NAME] [--write]
 *
 * The others are installed by `npm ci --prefix bench/flipbooks`, for this alone. Chromium draws in
 * software, as the machines have no graphics card: figures compare, and say nothing of frames on one.
 */

import { readdirSync, readFileSync } from "node:fs";
import { createServer } from "node:http";
import { cpus } from "node:os";
import { extname, join } from "node:path";
import { parseArgs } from "node:util";
import { chromium } from "playwright-core";
import { chromiumArguments, findChromium } from "../../scripts/chromium.mjs";
import { summary, table, writeResults } from "./results.mjs";

const root = join(import.meta.dirname, "../..");
const [width, height] = [1200, 860];

const names = [
  "page-flip HTML",
  "page-flip canvas",
  "turn.js",
  "dFlip WebGL",
  "dFlip CSS",
  "html-flip-book",
  "Turnleaf WebGL",
  "Turnleaf flat",
];

const { values } = parseArgs({
  options: {
    pages: { type: "string", default: "500" },
    rounds: { type: "string", default: "5" },
    turns: { type: "string", default: "10" },
    only: { type: "string", multiple: true },
    write: { type: "boolean", default: false },
  },
});
const [pages, rounds, turns] = [Number(values.pages), Number(values.rounds), Number(values.turns)];

/** Milliseconds that a book is left alone after it is ready, and then looked at while idle. */
const settling = 6000;
const idling = 4000;

/** Destroyed books after which nothing should run any more. */
const destroyed = 10;

const types = {
  ".css": "text/css",
  ".html": "text/html",
  ".jpg": "image/jpeg",
  ".js": "text/javascript",
  ".wasm": "application/wasm",
};

const folders = {
  packages: "bench/flipbooks/node_modules",
  turnleaf: "packages/turnleaf/dist",
  three: "node_modules/three/build",
  bench: "bench/flipbooks",
};

const html = `<!doctype html><title>One book</title><link rel="icon" href="data:,">
<style>html, body, main { margin: 0; height: 100%; overflow: hidden }</style>
<script type="importmap">{"imports":{"three":"/three/three.module.js","hammerjs":"/bench/hammer.js","throttle-debounce":"/packages/throttle-debounce/esm/index.js"}}</script>
<main></main>`;

/** Pages drawn at a time: all of many thousands would be more than a browser's tab holds. */
const drawnAtOnce = 250;

/** A distinct picture of each page: text, a hue, its number. */
async function drawPages(browser, count) {
  const images = [];
  for (let first = 1; first <= count; first += drawnAtOnce) {
    const last = Math.min(count, first + drawnAtOnce - 1);
    images.push(...(await drawSome(browser, [first, last])));
  }
  return images;
}

/** Pictures of the pages of two numbers and between them. */
async function drawSome(browser, between) {
  const page = await browser.newPage();
  const drawn = await page.evaluate(async ([first, last]) => {
    const canvas = new OffscreenCanvas(900, 1273);
    const pen = canvas.getContext("2d");
    const word = (k) => "whale leaf paper spine gutter margin folio quire".split(" ")[(k * 7) % 8];
    const list = [];
    for (let n = first; n <= last; n++) {
      pen.fillStyle = "#fbf5e8";
      pen.fillRect(0, 0, 900, 1273);
      pen.fillStyle = `hsl(${(n * 47) % 360} 70% 45%)`;
      pen.fillRect(60, 60, 780, 220);
      pen.fillStyle = "#222";
      pen.font = "26px serif";
      for (let line = 0; line < 26; line++) {
        const text = Array.from({ length: 9 }, (_, k) => word(n * 31 + line * 11 + k)).join(" ");
        pen.fillText(text, 70, 340 + 34 * line);
      }
      pen.fillText(String(n), 440, 1245);
      const blob = await canvas.convertToBlob({ type: "image/jpeg", quality: 0.9 });
      const bytes = new Uint8Array(await blob.arrayBuffer());
      let text = "";
      for (let k = 0; k < bytes.length; k += 8192)
        text += String.fromCharCode(...bytes.subarray(k, k + 8192));
      list.push(btoa(text));
    }
    return list;
  }, between);
  await page.close();
  return drawn.map((text) => Buffer.from(text, "base64"));
}

/** Serves the page, the libraries and the images, none of them to be kept. */
async function serve(images) {
  const seen = { images: 0, bytes: 0 };
  const server = createServer((request, response) => {
    const { pathname, searchParams } = new URL(request.url, "http://localhost");
    const head = { "Cache-Control": "no-store" };
    try {
      if (pathname === "/") {
        // Without WebAssembly Turnleaf draws on the flat.
        if (searchParams.has("flat")) {
          head["Content-Security-Policy"] = "script-src 'self' 'unsafe-inline'";
        }
        return void response.writeHead(200, { ...head, "Content-Type": "text/html" }).end(html);
      }
      const [, folder, ...rest] = pathname.split("/");
      let body;
      if (folder === "images") {
        body = images[Number.parseInt(rest[0], 10)];
        seen.images++;
        seen.bytes += body.length;
      } else body = readFileSync(join(root, folders[folder], ...rest));
      response.writeHead(200, { ...head, "Content-Type": types[extname(pathname)] }).end(body);
    } catch {
      response.writeHead(404, head).end();
    }
  });
  await new Promise((resolve) => server.listen(0, "127.0.0.1", resolve));
  return { url: `http://127.0.0.1:${server.address().port}/`, seen, stop: () => server.close() };
}

/** Seconds of processor and megabytes (proportional set size) of a process and all under it. */
function costOf(pid) {
  const parents = new Map();
  const seconds = new Map();
  for (const name of readdirSync("/proc")) {
    if (!/^\d+$/.test(name)) continue;
    try {
      const stat = readFileSync(`/proc/${name}/stat`, "utf8");
      const fields = stat.slice(stat.lastIndexOf(")") + 2).split(" ");
      parents.set(Number(name), Number(fields[1]));
      seconds.set(Number(name), (Number(fields[11]) + Number(fields[12])) / 100);
    } catch {
      // It has ended meanwhile.
    }
  }
  const cost = { seconds: 0, megabytes: 0 };
  for (const [id, time] of seconds) {
    let above = id;
    while (above && above !== pid) above = parents.get(above);
    if (above !== pid) continue;
    cost.seconds += time;
    try {
      const rollup = readFileSync(`/proc/${id}/smaps_rollup`, "utf8");
      cost.megabytes += Number(/^Pss:\s+(\d+)/m.exec(rollup)?.[1] ?? 0) / 1024;
    } catch {
      // It has ended meanwhile.
    }
  }
  return cost;
}

/** Runs in the page before anything else: counts the frames that anybody calls for. */
function countFrames() {
  const real = window.requestAnimationFrame.bind(window);
  const counts = { called: 0 };
  window.requestAnimationFrame = (call) => {
    counts.called++;
    return real(call);
  };
  Object.assign(window, { counts, realFrame: real });
}

/** Runs in the page: a turn, with the times between frames while it lasts, milliseconds. */
async function turn() {
  const times = [];
  let runs = true;
  const tick = (now) => {
    times.push(now);
    if (runs) window.realFrame(tick);
  };
  window.realFrame(tick);
  const start = performance.now();
  await window.book.next();
  const took = performance.now() - start;
  runs = false;
  return { took, between: times.slice(1).map((time, k) => time - times[k]) };
}

const wait = (time) => new Promise((resolve) => setTimeout(resolve, time));

/** Whether what is on the screen is blank: none of the strong hues that every page has. */
async function isBlank(page) {
  const picture = (await page.screenshot()).toString("base64");
  return await page.evaluate(async (picture) => {
    const blob = await (await fetch(`data:image/png;base64,${picture}`)).blob();
    const bitmap = await createImageBitmap(blob);
    const canvas = new OffscreenCanvas(bitmap.width, bitmap.height);
    const pen = canvas.getContext("2d");
    pen.drawImage(bitmap, 0, 0);
    // Each of the two visible pages has a band of its hue in its upper part.
    const has = (from, to) => {
      const { data } = pen.getImageData(from, 0, to - from, bitmap.height);
      let strong = 0;
      for (let k = 0; k < data.length; k += 4) {
        const least = Math.min(data[k], data[k + 1], data[k + 2]);
        if (Math.max(data[k], data[k + 1], data[k + 2]) - least > 90) strong++;
      }
      return strong > 4000;
    };
    const middle = bitmap.width / 2;
    return !(has(0, middle) && has(middle, bitmap.width));
  }, picture);
}

/** One book in a fresh browser. */
async function measure(name, site) {
  const server = await chromium.launchServer({
    executablePath: findChromium(),
    args: [...chromiumArguments, "--disable-gpu-compositing"],
  });
  try {
    const browser = await chromium.connect(server.wsEndpoint());
    const { pid } = server.process();
    const page = await browser.newPage({ viewport: { width, height } });
    const errors = [];
    page.on("pageerror", ({ message }) => errors.push(message));
    await page.addInitScript(countFrames);
    await page.goto(`${site.url}${name === "Turnleaf flat" ? "?flat" : ""}`);
    Object.assign(site.seen, { images: 0, bytes: 0 });
    const ready = await page.evaluate(
      async ([name, pages]) => {
        const { books } = await import("/bench/books.js");
        const images = Array.from({ length: pages }, (_, k) => `/images/${k}.jpg`);
        const start = performance.now();
        window.openAgain = (place) => books[name](place, images);
        window.book = await window.openAgain(document.querySelector("main"));
        return performance.now() - start;
      },
      [name, pages],
    );
    await wait(settling);
    const { images, bytes } = site.seen;
    const before = costOf(pid);
    await wait(idling);
    const idle = costOf(pid).seconds - before.seconds;
    // The cover is opened, and what is compiled once is compiled.
    await page.evaluate(turn);
    await wait(1500);
    const start = costOf(pid);
    const turned = [];
    for (let k = 0; k < turns; k++) {
      turned.push(await page.evaluate(turn));
      await wait(700);
    }
    const spent = costOf(pid).seconds - start.seconds;
    const blank = await isBlank(page);
    const between = turned.flatMap(({ between }) => between).sort((a, b) => a - b);
    const at = (fraction) => between[Math.floor(fraction * (between.length - 1))];
    const took = turned.map(({ took }) => took).sort((a, b) => a - b);
    const after = await page
      .evaluate(async (destroyed) => {
        window.book.destroy();
        for (let k = 1; k < destroyed; k++) {
          const place = document.querySelector("main");
          place.replaceChildren();
          const book = await window.openAgain(place);
          book.destroy();
        }
        await new Promise((resolve) => setTimeout(resolve, 1000));
        const before = window.counts.called;
        await new Promise((resolve) => setTimeout(resolve, 1000));
        return window.counts.called - before;
      }, destroyed)
      .catch((error) => `fails: ${error.message.split("\n")[0]}`);
    return {
      ready,
      images,
      megabytes: bytes / 2 ** 20,
      memory: before.megabytes,
      idle,
      turn: took[took.length >> 1],
      slowest: took.at(-1),
      perTurn: spent / turns,
      perFrame: spent / Math.max(1, between.length),
      frame: at(0.5),
      lateFrame: at(0.95),
      blank,
      after,
      errors,
    };
  } finally {
    await server.close();
  }
}

const painter = await chromium.launch({ executablePath: findChromium(), args: chromiumArguments });
const images = await drawPages(painter, pages);
const version = painter.version();
await painter.close();
const site = await serve(images);
const chosen = names.filter((name) => !values.only || values.only.includes(name));
const rows = Object.fromEntries(chosen.map((name) => [name, []]));
for (let round = 1; round <= rounds; round++) {
  // Each round in another order, so that none always follows the same.
  const order = chosen.map((_, k) => chosen[(k + round) % chosen.length]);
  for (const name of order) {
    const run = await measure(name, site);
    rows[name].push(run);
    console.log(round, name, JSON.stringify(run));
  }
}
site.stop();
const found = summary(rows);
console.log(
  table(found)
    .map((row) => row.join(" | "))
    .join("\n"),
);
if (values.write) {
  const machine = `${cpus().length} cores, ${cpus()[0].model}; Chromium ${version}, WebGL by SwiftShader`;
  const { dependencies } = JSON.parse(
    readFileSync(join(root, "bench/flipbooks/package.json"), "utf8"),
  );
  const date = new Date().toISOString();
  const what = { date, machine, pages, rounds, turns, versions: dependencies, found };
  writeResults(what);
}
