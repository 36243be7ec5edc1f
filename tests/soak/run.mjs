/**
 * Soaks a book: thousands of random operations in a real browser, by a seed.
 * Fails where WebGL complains, an error is not caught, or a page in sight is blank
 * at rest.
 *
 *   node tests/soak/run.mjs [--operations 10000] [--seed N] [--only folds] [--undrawn] [--write]
 *
 * It fails too where the memory of all the browser's processes has grown by more
 * than a bound since the first thousand operations, or the first half of fewer. Where it draws, the machine code
 * of software GL, which draws here, is left out: it is kept for every new combination
 * of shader and state, which no graphics card needs. With --undrawn no draw call
 * reaches WebGL, and nothing is left out; all else happens: contexts, programs,
 * buffers and textures are made, filled and deleted.
 *
 * With --only folds, pages are folded, leaves torn out and both undone, and nothing else. Every
 * so many operations all of it is undone, and every page must be where it was.
 *
 * With --write the table of memory is written into the docs. Pictures of what is
 * blank are left in target/soak.
 */
import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { createServer } from "node:http";
import { join } from "node:path";
import { parseArgs } from "node:util";
import ts from "typescript";
import { isWebglComplaint } from "../../scripts/console_watch.mjs";
import { includeTables, markdown, writeTable } from "../../scripts/docs_tables.mjs";
import { Browser } from "./browser.mjs";
import {
  compiledBySoftwareGL,
  memoryByHolder,
  memoryByProcess,
  releaseCaches,
} from "./browser_memory.mjs";

const root = join(import.meta.dirname, "../..");
const pictures = join(root, "target/soak");

/** How much more the memory may become than it is after the first operations. */
const mostGrowth = 0.15;

/** Operations between two checks at rest, and how many of them, the last, are drawn. */
const between = 10;
const drawnOperations = 4;

/** Operations between two times that all folds and tears are undone. */
const betweenUndone = 50;

/** Of the frames of a movement that is drawn, one in so many is. */
const drawnFrames = 6;

/** The row of what software GL has compiled. */
const softwareCode = "GPU Process: machine code of software GL";

const { values } = parseArgs({
  options: {
    operations: { type: "string", default: "10000" },
    seed: { type: "string", default: String(Date.now() % 1_000_000) },
    only: { type: "string" },
    undrawn: { type: "boolean", default: false },
    write: { type: "boolean", default: false },
  },
});
const [operations, seed, only] = [Number(values.operations), Number(values.seed), values.only];
if (only !== undefined && only !== "folds") throw new Error("--only takes folds.");
if (only && values.write) throw new Error("The table in the docs is that of all operations.");
/** Operations after which the memory is what later memory is compared with. */
const first = Math.max(Math.min(1000, Math.floor(operations / 2)), 1);
const isDrawn = !values.undrawn;

const html = `<!doctype html><title>Soak</title><link rel="icon" href="data:,">
<style>body { margin: 0 }</style>
<script type="importmap">{"imports":{"three":"/three/three.module.js"}}</script>
<script type="module" src="/turnleaf/index.js"></script>`;

/** Folders by the first part of an address. */
const folders = {
  turnleaf: "packages/turnleaf/dist",
  three: "node_modules/three/build",
  books: "books",
  source: "packages/turnleaf/src",
};

/** A TypeScript file of the tests as a script that runs without a build. */
function transpile(path) {
  const options = { module: ts.ModuleKind.ESNext, target: ts.ScriptTarget.ES2022 };
  return ts.transpile(readFileSync(join(root, path), "utf8"), options);
}

/** Type and body of what is at an address: the page, the built viewer, the book, and what plays with them. */
function fileAt(address) {
  if (address === "/") return ["text/html", html];
  const [, folder, name] = /^\/(\w+)\/((?:\w+\/)?[\w.-]+)$/.exec(address) ?? [];
  const path = join(folders[folder], name);
  if (name.endsWith(".ts")) return ["text/javascript", transpile(path)];
  const type = name.endsWith(".pdf") ? "application/pdf" : "text/javascript";
  return [type, readFileSync(join(root, path))];
}

async function serve() {
  const server = createServer((request, response) => {
    try {
      const [type, body] = fileAt(request.url);
      response.writeHead(200, { "Content-Type": type }).end(body);
    } catch {
      response.writeHead(404).end();
    }
  });
  await new Promise((resolve) => server.listen(0, "127.0.0.1", resolve));
  const stop = () => {
    server.closeAllConnections();
    server.close();
  };
  return { url: `http://127.0.0.1:${server.address().port}/`, stop };
}

/**
 * Runs in the page before anything else: frames come one after another, and each
 * stands for the longest time that the viewer counts for one, so that a turn takes
 * no longer than it takes to compute. Drawing is in software and takes nearly all
 * of the time: while `clock.draws`, a part of the frames of a movement is drawn and
 * always its last; else none. All but the drawing itself happens in any case.
 * Without `drawnFrames` nothing is ever drawn.
 */
function driveFrames(drawnFrames) {
  const clock = { draws: true };
  Object.assign(globalThis, { clock });
  const canDraw = drawnFrames !== undefined;
  let [now, count, frames, isDrawn] = [1000, 0, 0, canDraw];
  const waiting = new Map();
  const pass = () => {
    now += 100;
    isDrawn = canDraw && clock.draws && ++frames % drawnFrames === 0;
    const calls = [...waiting.values()];
    waiting.clear();
    for (const call of calls) call(now);
    // All has come to rest, and nobody will ask for another frame.
    const isLast = canDraw && clock.draws && !isDrawn && waiting.size === 0;
    isDrawn = canDraw;
    if (isLast) for (const call of calls) call(now);
    isDrawn = canDraw && clock.draws;
  };
  window.requestAnimationFrame = (call) => {
    waiting.set(++count, call);
    if (waiting.size === 1) setTimeout(pass);
    return count;
  };
  window.cancelAnimationFrame = (frame) => waiting.delete(frame);
  const { prototype } = WebGL2RenderingContext;
  for (const name of ["drawElements", "drawArrays"]) {
    const draw = prototype[name];
    prototype[name] = function (...what) {
      if (isDrawn) draw.apply(this, what);
    };
  }
}

/** Runs in the page: makes the operations, with a first book. */
async function prepare([seed, only]) {
  const { RandomOperations } = await import("/source/for_tests/random_operations.ts");
  const picture = async () => {
    const png = await fetch(`data:image/png;base64,${await globalThis.takePicture()}`);
    const bitmap = await createImageBitmap(await png.blob());
    const canvas = new OffscreenCanvas(bitmap.width, bitmap.height);
    const pen = canvas.getContext("2d", { willReadFrequently: true });
    pen.drawImage(bitmap, 0, 0);
    bitmap.close();
    return pen.getImageData(0, 0, canvas.width, canvas.height);
  };
  globalThis.operations = new RandomOperations({
    ...{ seed, pdf: "/books/moby-dick.pdf", picture },
    ...(only ? { only } : {}),
  });
  await globalThis.operations.start();
}

/**
 * Runs in the page: the operations from one number up to another. Returns what was
 * wrong. At every check the book comes to rest; what it shows is judged where it is drawn.
 */
async function soak([from, to, between, drawnOperations, isDrawn, betweenUndone]) {
  const { operations, clock } = globalThis;
  const wrong = [];
  for (let k = from; k < to; k++) {
    const draws = k % between >= between - drawnOperations;
    if (draws !== clock.draws) {
      clock.draws = draws;
      operations.redraw();
    }
    await operations.next();
    if (k % between < between - 1) continue;
    if (betweenUndone && (k + 1) % betweenUndone === 0) {
      const moved = await operations.undoAll();
      if (moved.length > 0) wrong.push(`Not undone: ${moved.join(", ")}: ${operations.state}`);
    }
    const blank = await operations.check();
    if (!isDrawn || blank.length === 0) continue;
    await globalThis.keepPicture();
    wrong.push(`${blank.join(", ")}: ${operations.state}`);
  }
  return [...wrong, ...operations.errors.splice(0)];
}

console.log(`Seed ${seed}, ${operations} operations.`);
const site = await serve();
const viewport = [120, 90];
const browser = await Browser.start(...viewport);
const wrong = [];
const complain = (text) => {
  wrong.push(text);
  console.error(text);
};
browser.page.on("Runtime.exceptionThrown", ({ exceptionDetails: { text, exception } }) =>
  complain(`Not caught: ${exception?.description ?? text}`),
);
const hear = (level, text) => {
  if (level === "error" || isWebglComplaint(text)) complain(text);
};
browser.page.on("Log.entryAdded", ({ entry: { level, text } }) => hear(level, text));
browser.page.on("Runtime.consoleAPICalled", ({ type, args }) =>
  hear(type, args.map(({ value, description }) => value ?? description).join(" ")),
);
const holdings = transpile("packages/cli/tests/holdings.ts");
const { countHoldings, holdingsOf } = await import(
  `data:text/javascript,${encodeURIComponent(holdings)}`
);
await browser.runFirst(driveFrames, isDrawn ? drawnFrames : undefined);
await browser.runFirst(countHoldings);
await browser.expose("takePicture", () => browser.picture());
let kept = 0;
await browser.expose("keepPicture", async () => {
  mkdirSync(pictures, { recursive: true });
  const picture = Buffer.from(await browser.picture(), "base64");
  writeFileSync(join(pictures, `${seed}-${++kept}.png`), picture);
});
await browser.goTo(site.url);
await browser.evaluate(prepare, [seed, only]);

const start = Date.now();
/** Megabytes after so many operations: of all processes, of each, and by what holds them. */
const measured = [];

/**
 * Memory by process without what is only kept for reuse, once nothing more is
 * freed: the graphics process frees what a book held after seconds.
 */
async function restingMemory() {
  await releaseCaches(browser.session);
  for (let least = Number.POSITIVE_INFINITY, same = 0; ; ) {
    const processes = memoryByProcess(browser.pid);
    same = processes.all > 0.99 * least ? same + 1 : 0;
    if (same === 3) return processes;
    least = Math.min(least, processes.all);
    await new Promise((resolve) => setTimeout(resolve, 5000));
  }
}

async function measure(done) {
  await browser.evaluate(() => {
    globalThis.clock.draws = true;
    return globalThis.operations.start();
  });
  const held = await holdingsOf(browser, browser.page);
  const processes = await restingMemory();
  const holders = {
    [softwareCode]: compiledBySoftwareGL(browser.pid),
    ...(await memoryByHolder(browser.session)),
  };
  const inPage = {
    "JavaScript objects": held.heap / 2 ** 20,
    "WASM memories": held.memoryBytes / 2 ** 20,
    "bitmaps and canvases": held.pictureBytes / 2 ** 20,
    textures: held.textureBytes / 2 ** 20,
  };
  measured.push({ done, processes, inPage, holders });
  const { rests, hues, prints, folds, tears, undone } = await browser.evaluate(
    () => globalThis.operations.checked,
  );
  const list = (sizes) =>
    Object.entries(sizes)
      .map(([name, size]) => `${name} ${size.toFixed(1)}`)
      .join(", ");
  const seconds = Math.round((Date.now() - start) / 1000);
  console.log(`${done} operations, ${seconds} s; ${rests} rests, ${hues} coloured and ${prints} printed pages checked; ${folds} changes of folds, ${tears} leaves torn out, all undone ${undone} times; ${wrong.length} complaints; ${held.workers} workers, ${held.contexts} contexts, ${held.urls} URLs, ${held.nodes} nodes, ${held.listeners} listeners
  MB by process: ${list(processes)}
  MB in the page: ${list(inPage)}
  MB by the browser's count: ${list(holders)}`);
}

/** A table of what is measured first and last. */
function table() {
  const [before, after] = [measured[0], measured.at(-1)];
  const rows = ["processes", "inPage", "holders"].flatMap((group) =>
    Object.keys(after[group]).map((name) => {
      const [from, to] = [before[group][name] ?? 0, after[group][name]];
      return [name === "all" ? "**all processes**" : name, from.toFixed(1), to.toFixed(1)];
    }),
  );
  return [["MB", `after ${before.done} operations`, `after ${after.done}`], ...rows];
}

try {
  const batch = 250;
  for (let done = 0, to = 0; done < operations; done = to) {
    to = Math.min(done + batch, operations, first * Math.floor(done / first + 1));
    const range = [done, to, between, drawnOperations, isDrawn, only && betweenUndone];
    for (const text of await browser.evaluate(soak, range)) complain(text);
    if (to % first === 0 || to === operations) await measure(to);
  }
} finally {
  await browser.close();
  site.stop();
}
/** Megabytes that are judged. */
const judged = ({ processes, holders }) => processes.all - (isDrawn ? holders[softwareCode] : 0);
const growth = judged(measured.at(-1)) / judged(measured[0]) - 1;
const what = isDrawn ? "without software GL's machine code" : "with everything";
console.log(`Growth of all processes, ${what}: ${(100 * growth).toFixed(1)} %.`);
if (growth > mostGrowth) {
  complain(`The browser's memory has grown by ${(100 * growth).toFixed(0)} %.`);
}
console.log(`\n${markdown(table())}\nSeed ${seed}: ${wrong.length} complaints.`);
if (values.write) {
  writeTable(isDrawn ? "memory_drawn" : "memory", table());
  includeTables();
}
process.exitCode = wrong.length > 0 ? 1 : 0;
