/**
 * How long a book takes until its first spread can be read and turned, for each
 * kind of book; a PDF beside pdf.js alone; and an EPUB set anew.
 *
 *   node scripts/first_spread.mjs [--json] [kind ...]    medians, milliseconds
 *
 * Counted is from the moment at which the element gets the address of a book to
 * the frame after which it takes a drag and shows the open pages as sharp as
 * the screen does: its event `load` has fired, and `settled` is true. What the
 * pages beside need comes later and is not counted. Everything that a format
 * needs is fetched within that time, from a server of this machine. pdf.js
 * alone is loaded, opens the same file and draws its first page as many pixels
 * wide, with nothing around it. Every figure is of fresh pages, the two in turn.
 */
import { readFileSync } from "node:fs";
import { createServer } from "node:http";
import { extname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { chromium } from "playwright-core";
import { benchBooks } from "./bench_books.mjs";
import { chromiumArguments, findChromium } from "./chromium.mjs";

const root = join(import.meta.dirname, "..");

/** Fresh pages that each figure is the median of. */
const pages = 5;

const folders = {
  turnleaf: "packages/turnleaf/dist",
  three: "node_modules/three/build",
  pdfjs: "node_modules/pdfjs-dist/build",
};

const types = { ".js": "text/javascript", ".mjs": "text/javascript", ".wasm": "application/wasm" };

const html = `<!doctype html><meta charset="utf-8"><title>First spread</title><link rel="icon" href="data:,">
<style>body { margin: 0 } turnleaf-book { display: block; width: 960px; height: 640px }</style>
<script type="importmap">{"imports":{"three":"/three/three.module.min.js"}}</script>
<script type="module">import "/turnleaf/index.js"; globalThis.isLoaded = true;</script>
<turnleaf-book></turnleaf-book>`;

/** Serves the page, the package, pdf.js and the books. Returns its address. */
function serve(books) {
  const server = createServer((request, response) => {
    const { pathname } = new URL(request.url, "http://localhost");
    const [folder, name] = pathname.slice(1).split(/\/(.*)/);
    if (folder === "") return response.setHeader("Content-Type", "text/html").end(html);
    if (folder === "books") return response.end(books[decodeURIComponent(name)]);
    const file = folders[folder] && join(root, folders[folder], name);
    try {
      const body = readFileSync(file);
      response.setHeader("Content-Type", types[extname(file)] ?? "application/octet-stream");
      response.end(body);
    } catch {
      response.writeHead(404).end();
    }
  });
  return new Promise((resolve) => {
    server.listen(0, "127.0.0.1", () => {
      const url = `http://127.0.0.1:${server.address().port}/`;
      resolve({ url, stop: () => server.close() });
    });
  });
}

/** Runs in the page: milliseconds until the first spread of a book can be read and turned. */
async function firstSpread(name) {
  const book = document.querySelector("turnleaf-book");
  const start = performance.now();
  const isOpen = new Promise((resolve, reject) => {
    book.addEventListener("load", resolve, { once: true });
    book.addEventListener("error", ({ detail }) => reject(new Error(detail.message)));
  });
  book.src = `/books/${name}`;
  await isOpen;
  const opened = performance.now() - start;
  await globalThis.until(() => book.settled);
  return { opened, shown: performance.now() - start };
}

/** Runs in the page: milliseconds until the text stands in another size where the reader is. */
async function setAnew() {
  const book = document.querySelector("turnleaf-book");
  const changed = new Promise((resolve) => {
    book.addEventListener("pageschange", resolve, { once: true });
  });
  const start = performance.now();
  book.fontSize = 1.4;
  await changed;
  await globalThis.until(() => book.settled);
  return performance.now() - start;
}

/** Runs in the page: milliseconds until pdf.js alone has drawn the first page of a PDF. */
async function pdfAlone({ name, width }) {
  const start = performance.now();
  const pdfjs = await import("/pdfjs/pdf.min.mjs");
  pdfjs.GlobalWorkerOptions.workerSrc = "/pdfjs/pdf.worker.min.mjs";
  const pdf = await pdfjs.getDocument({ url: new URL(`/books/${name}`, location).href }).promise;
  const page = await pdf.getPage(1);
  const viewport = page.getViewport({ scale: width / page.getViewport({ scale: 1 }).width });
  const canvas = document.createElement("canvas");
  canvas.width = viewport.width;
  canvas.height = viewport.height;
  await page.render({ canvas, viewport }).promise;
  return performance.now() - start;
}

/** Runs in the page before anything else. Looks between tasks, so that no timer's delay is counted. */
function addUntil() {
  globalThis.until = (isSo) =>
    new Promise((resolve) => {
      const { port1, port2 } = new MessageChannel();
      port1.onmessage = () => {
        if (isSo()) {
          port1.close();
          resolve();
        } else setTimeout(() => port2.postMessage(null), 1);
      };
      port2.postMessage(null);
    });
}

const median = (values) => values.toSorted((a, b) => a - b)[Math.floor(values.length / 2)];

/** Milliseconds by what is measured; `wanted` names kinds of books, all by default. */
export async function firstSpreads(wanted = []) {
  const books = await benchBooks();
  const { url, stop } = await serve(books.files);
  const browser = await chromium.launch({
    executablePath: findChromium(),
    args: chromiumArguments,
  });
  const fresh = async (act, ...args) => {
    const page = await browser.newPage({ viewport: { width: 960, height: 640 } });
    await page.addInitScript(addUntil);
    await page.goto(url);
    await page.waitForFunction(() => globalThis.isLoaded);
    const found = await page.evaluate(act, ...args);
    return { found, page };
  };
  try {
    const results = [];
    for (const [kind, name] of Object.entries(books.kinds)) {
      if (wanted.length > 0 && !wanted.some((word) => kind.includes(word))) continue;
      const [opened, shown, alone, anew] = [[], [], [], []];
      for (let k = 0; k < pages; k++) {
        const { found, page } = await fresh(firstSpread, name);
        opened.push(found.opened);
        shown.push(found.shown);
        if (name.endsWith(".epub")) {
          anew.push(await page.evaluate(setAnew));
        }
        await page.close();
        if (name.endsWith(".pdf")) {
          const other = await fresh(pdfAlone, { name, width: 420 });
          alone.push(other.found);
          await other.page.close();
        }
      }
      results.push({
        kind,
        opened: median(opened),
        shown: median(shown),
        least: Math.min(...shown),
        most: Math.max(...shown),
        ...(alone.length > 0 ? { alone: median(alone), ratio: median(shown) / median(alone) } : {}),
        ...(anew.length > 0 ? { anew: median(anew) } : {}),
      });
    }
    return results;
  } finally {
    await browser.close();
    stop();
  }
}

if (process.argv[1] === fileURLToPath(import.meta.url)) {
  const wanted = process.argv.slice(2).filter((word) => word !== "--json");
  const results = await firstSpreads(wanted);
  if (process.argv.includes("--json")) console.log(JSON.stringify(results, null, 2));
  else console.table(results);
}
