/**
 * How long a book takes to open, in a fresh page of a fresh browser context: until its first spread
 * can be read (all that is seen is drawn at full sharpness and nothing moves), and until it can be
 * turned (what the next turn brings into view is drawn too). Beside it, in the same run and in turn,
 * pdf.js alone: its own page of a script and a canvas, until the first page is drawn as large.
 * And how long an EPUB takes to be set anew in another size, of as many pages side by side, at the reader's place.
 *
 *   node scripts/opening_time.mjs [--json] [--rounds N] [--moments] [KIND ...]
 *
 * `--moments` says what the time until the first spread can be read is made of.
 *
 * The books are made here, of the text of Moby-Dick, some by what the tests make theirs with; they come from a server of this process, which
 * adds nothing to how long they take.
 */
import { readdirSync, readFileSync } from "node:fs";
import { createServer } from "node:http";
import { extname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { strToU8, zipSync } from "fflate";
import PDFDocument from "pdfkit";
import { chromium } from "playwright-core";
import { PNG } from "pngjs";
import { runnerImport } from "vite";
import { chromiumArguments, findChromium } from "./chromium.mjs";

const root = join(import.meta.dirname, "..");
const text = join(root, "books/make/text");

/** What writes books of other formats, for the tests too. */
const written = async (file) =>
  (await runnerImport(join(root, "packages/turnleaf/src", file))).module;
const { rar5, sevenZip } = await written("for_tests/stored_archives.ts");
const { tinyFb2 } = await written("sources/fb2/tiny_fb2.ts");
const { tinyKf8, tinyMobi } = await written("sources/kindle/tiny_kindle.ts");

/** Fresh pages that each figure is the median of. */
const usualRounds = 5;

/** The window, CSS pixels. */
const viewport = { width: 1000, height: 700 };

/** The size of type in which the EPUB is set anew: in this window two pages have room for their lines in it too. */
const otherSize = 1.1;

/** Letters of the EPUB and of the text. */
const million = 1_000_000;

const chapters = readdirSync(text)
  .filter((name) => name.endsWith(".txt"))
  .map((name) => readFileSync(join(text, name), "utf8").split(/\n\s*\n/));

/** Returns chapters, each a list of paragraphs, of some letters together. */
function chaptersOf(letters) {
  const found = [];
  for (let length = 0; length < letters; ) {
    const chapter = chapters[found.length % chapters.length];
    found.push(chapter);
    length += chapter.join("").length;
  }
  return found;
}

const escaped = (line) => line.replaceAll("&", "&amp;").replaceAll("<", "&lt;");

function epub() {
  const parts = chaptersOf(million);
  const document = (body) =>
    `<?xml version="1.0" encoding="utf-8"?><html xmlns="http://www.w3.org/1999/xhtml" xmlns:epub="http://www.idpf.org/2007/ops"><head><title>t</title><link rel="stylesheet" href="style.css"/></head><body>${body}</body></html>`;
  const names = parts.map((_, k) => `c${k}.xhtml`);
  const item = (id, href, more = "") =>
    `<item id="${id}" href="${href}" media-type="application/xhtml+xml" ${more}/>`;
  const files = {
    mimetype: [strToU8("application/epub+zip"), { level: 0 }],
    "META-INF/container.xml": strToU8(
      '<container xmlns="urn:oasis:names:tc:opendocument:xmlns:container" version="1.0"><rootfiles><rootfile full-path="b/package.opf" media-type="application/oebps-package+xml"/></rootfiles></container>',
    ),
    "b/package.opf": strToU8(
      `<package xmlns="http://www.idpf.org/2007/opf" version="3.0" unique-identifier="id"><metadata xmlns:dc="http://purl.org/dc/elements/1.1/"><dc:identifier id="id">urn:uuid:1</dc:identifier><dc:title>A megabyte</dc:title><dc:language>en</dc:language></metadata><manifest>${names.map((name, k) => item(`c${k}`, name)).join("")}<item id="s" href="style.css" media-type="text/css"/>${item("nav", "nav.xhtml", 'properties="nav"')}</manifest><spine>${names.map((_, k) => `<itemref idref="c${k}"/>`).join("")}</spine></package>`,
    ),
    "b/nav.xhtml": strToU8(
      document(
        `<nav epub:type="toc"><ol>${names.map((name, k) => `<li><a href="${name}">Part ${k + 1}</a></li>`).join("")}</ol></nav>`,
      ),
    ),
    "b/style.css": strToU8(
      "h1 { font-size: 1.5em; text-align: center; margin: 2em 0 } p { margin: 0; text-indent: 1.4em; text-align: justify }",
    ),
  };
  parts.forEach(([head, ...paragraphs], k) => {
    const body = paragraphs.map((one) => `<p>${escaped(one)}</p>`).join("\n");
    files[`b/c${k}.xhtml`] = strToU8(document(`<h1>${k + 1}. ${escaped(head)}</h1>${body}`));
  });
  return zipSync(files);
}

/** Returns a PDF of 400 pages of text. */
async function pdf() {
  const document = new PDFDocument({ size: "A5", margin: 42, autoFirstPage: false });
  const pieces = [];
  document.on("data", (piece) => pieces.push(piece));
  const ended = new Promise((resolve) => document.on("end", resolve));
  const paragraphs = chaptersOf(million).flat();
  let next = 0;
  for (let page = 1; page <= 400; page++) {
    document.addPage().font("Times-Roman").fontSize(10);
    for (let letters = 0; letters < 1800; ) {
      const paragraph = paragraphs[next++ % paragraphs.length].slice(0, 900).replace(/\s+/g, " ");
      document.text(paragraph, { align: "justify", indent: 12, height: 480 });
      letters += paragraph.length;
    }
    document.fontSize(8).text(String(page), 42, 550, { align: "center", lineBreak: false });
  }
  document.end();
  await ended;
  return Buffer.concat(pieces);
}

/** Returns a grey image with a ramp and lines, as large as a scan of a small page. */
function scan(page) {
  const png = new PNG({ width: 1000, height: 1500 });
  for (let k = 0; k < png.width * png.height; k++) {
    const [x, y] = [k % png.width, Math.floor(k / png.width)];
    const grey = y % 30 < 8 && x > 80 && x < 920 && (x * 7 + y * 13 + page) % 11 < 7 ? 40 : 235;
    png.data.set([grey, grey, grey - 5, 255], 4 * k);
  }
  return PNG.sync.write(png, { deflateLevel: 1 });
}

const scans = Array.from({ length: 8 }, (_, page) => scan(page));
const scanNames = Array.from({ length: 60 }, (_, k) => `${k + 1}.png`);

const comic = () =>
  zipSync(Object.fromEntries(scanNames.map((name, k) => [name, [scans[k % 8], { level: 0 }]])));

/** Returns the images as they are in an archive of another kind. */
const stored = (pack) =>
  Buffer.from(pack(Object.fromEntries(scanNames.map((name, k) => [name, scans[k % 8]]))));

/** Returns the chapters of a megabyte as markup. */
const markup = (heading) =>
  chaptersOf(million).map(
    ([head, ...paragraphs], k) =>
      `${heading(`${k + 1}. ${escaped(head)}`)}${paragraphs.map((one) => `<p>${escaped(one)}</p>`).join("\n")}`,
  );
const asHtml = markup((title) => `<h1>${title}</h1>`);
const mobi = () =>
  tinyMobi({
    text: `<html><body>${asHtml.join("<mbp:pagebreak/>")}</body></html>`,
    compression: 2,
  });
const fb2 = () => {
  const sections = markup((title) => `<title><p>${title}</p></title>`);
  return tinyFb2(sections.map((one) => `<section>${one}</section>`).join(""));
};

const plainText = () => chaptersOf(million).flat().join("\n\n");

/** The books by the kinds that are opened, and what is served for them. */
const books = {
  "PDF, 400 pages": { "book.pdf": await pdf() },
  "EPUB, 1 MB of text": { "book.epub": Buffer.from(epub()) },
  "MOBI, 1 MB of text": { "book.mobi": Buffer.from(mobi()) },
  "AZW3, 1 MB of text": { "book.azw3": Buffer.from(tinyKf8({ text: asHtml, compression: 2 })) },
  "FB2, 1 MB of text": { "book.fb2": Buffer.from(fb2()) },
  "text, 1 MB": { "book.txt": Buffer.from(plainText()) },
  "comic (CBZ), 60 pages": { "book.cbz": Buffer.from(comic()) },
  "comic (CBR), 60 pages": { "book.cbr": stored(rar5) },
  "comic (CB7), 60 pages": { "book.cb7": stored(sevenZip) },
  "images, 60 pages": {
    "book.json": Buffer.from(JSON.stringify({ title: "Images", pages: scanNames })),
    ...Object.fromEntries(scanNames.map((name, k) => [name, scans[k % 8]])),
  },
};
const names = Object.keys(books);
const alone = "pdf.js alone, the same PDF";

/** The kinds for which a time is wanted. */
const wanted = names.filter((name) => /^(PDF|EPUB|images)/.test(name));

const style =
  "html, body { margin: 0; height: 100% } turnleaf-book { display: block; height: 100% }";
const reader = (file) => `<!doctype html><meta charset="utf-8"><link rel="icon" href="data:,">
<style>${style}</style><script type="importmap">{"imports":{"three":"/three/three.module.js"}}</script>
<script type="module">import "/turnleaf/index.js";</script>
<turnleaf-book src="${file}"></turnleaf-book>`;

/** The page of pdf.js alone: its modern build, its worker, a canvas as large as a page of the reader. */
const plainReader = (file) => `<!doctype html><meta charset="utf-8"><link rel="icon" href="data:,">
<canvas></canvas><script type="module">
import * as pdfjs from "/pdfjs/pdf.min.mjs";
pdfjs.GlobalWorkerOptions.workerSrc = "/pdfjs/pdf.worker.min.mjs";
const document = await pdfjs.getDocument({ url: "${file}" }).promise;
const page = await document.getPage(1);
const canvas = globalThis.document.querySelector("canvas");
const width = Number(new URLSearchParams(location.search).get("width"));
const viewport = page.getViewport({ scale: width / page.getViewport({ scale: 1 }).width });
Object.assign(canvas, { width: viewport.width, height: viewport.height });
await page.render({ canvas, viewport }).promise;
window.drawn = performance.now();
</script>`;

const folders = {
  turnleaf: join(root, "packages/turnleaf/dist"),
  three: join(root, "node_modules/three/build"),
  pdfjs: join(root, "node_modules/pdfjs-dist/build"),
};
const types = { ".js": "text/javascript", ".mjs": "text/javascript", ".wasm": "application/wasm" };

/** Serves the pages, the package and the books. */
async function serve() {
  const server = createServer((request, response) => {
    const { pathname } = new URL(request.url, "http://localhost/");
    const [folder = "", name = ""] = decodeURIComponent(pathname)
      .slice(1)
      .split(/\/(.*)/);
    const send = (type, body) => {
      response.writeHead(200, {
        "content-type": type,
        "content-length": body.length,
        "accept-ranges": "none",
      });
      response.end(body);
    };
    const kind = names[Number(folder)];
    const files = folder !== "" && books[kind];
    if (files && name === "") {
      send("text/html", Buffer.from(reader(Object.keys(files)[0])));
    } else if (files && name === "alone") {
      send("text/html", Buffer.from(plainReader(Object.keys(files)[0])));
    } else if (files?.[name]) send("application/octet-stream", files[name]);
    else if (folders[folder]) {
      send(types[extname(name)] ?? "text/plain", readFileSync(join(folders[folder], name)));
    } else {
      response.writeHead(404);
      response.end();
    }
  });
  await new Promise((resolve) => server.listen(0, "127.0.0.1", resolve));
  return { url: `http://127.0.0.1:${server.address().port}/`, stop: () => server.close() };
}

/** Runs in the page before anything else: takes down when the book can be read, and turned. */
function watch() {
  const look = () => {
    const book = document.querySelector("turnleaf-book");
    if (book?.settled) window.read ??= performance.now();
    if (book?.ready) window.turnable ??= performance.now();
    if (window.turnable === undefined) setTimeout(look, 4);
  };
  look();
}

/** Seconds of processors that a whole browser has used. */
async function processorTime(session) {
  const { processInfo } = await session.send("SystemInfo.getProcessInfo");
  return processInfo.reduce((sum, { cpuTime }) => sum + cpuTime, 0);
}

/**
 * Opens one page. Returns milliseconds by what was waited for, and those of processors.
 *
 * @param scripts what else runs in the page before anything else
 */
async function open(browser, address, waitedFor, scripts = []) {
  const context = await browser.newContext({ viewport });
  const session = await browser.newBrowserCDPSession();
  try {
    const page = await context.newPage();
    for (const script of [watch, ...scripts]) await page.addInitScript(script);
    const before = await processorTime(session);
    await page.goto(address, { waitUntil: "commit" });
    const found = { wall: {} };
    for (const name of waitedFor) {
      const handle = await page.waitForFunction((name) => window[name], name, {
        polling: 20,
        timeout: 120_000,
      });
      found.wall[name] = await handle.jsonValue();
      found.cpu ??= 1000 * ((await processorTime(session)) - before);
    }
    found.width = await page.evaluate(() => {
      const book = document.querySelector("turnleaf-book");
      return book ? Math.round(book.bookBounds.width / (book.shownLayout === "single" ? 1 : 2)) : 0;
    });
    return { ...found, page, close: () => context.close() };
  } catch (error) {
    await context.close();
    throw error;
  }
}

/**
 * Sets an open EPUB in another size, from a page in its middle. Returns the milliseconds until the
 * reader's place is shown so, those of the thread, whether it is his place, and whether as many pages
 * are shown as before.
 */
async function setAnew(page) {
  const session = await page.context().newCDPSession(page);
  await session.send("Performance.enable", { timeDomain: "threadTicks" });
  const task = async () => {
    const { metrics } = await session.send("Performance.getMetrics");
    return 1000 * metrics.find(({ name }) => name === "TaskDuration").value;
  };
  // Chapters that are still being counted would take their time of this.
  await page.waitForFunction(() => !document.querySelector("turnleaf-book").estimated, null, {
    polling: 100,
    timeout: 120_000,
  });
  await page.evaluate(async () => {
    const book = document.querySelector("turnleaf-book");
    await book.goTo(Math.round(book.pageCount / 2), { motion: false });
    while (!book.ready) await new Promise((resolve) => setTimeout(resolve, 20));
  });
  const before = await task();
  const found = await page.evaluate(async (size) => {
    const book = document.querySelector("turnleaf-book");
    const { source, shownLayout } = book;
    const lettersOf = async (page) => {
      const runs = page === null ? [] : await source.text(page - 1, new AbortController().signal);
      return runs
        .map(({ text }) => text)
        .join("")
        .replace(/\s+/g, "");
    };
    const first = (await lettersOf(book.page)).slice(0, 20);
    const changed = new Promise((resolve) => {
      book.addEventListener("pageschange", resolve, { once: true });
    });
    const began = performance.now();
    book.setAttribute("font-size", size);
    await changed;
    while (!book.settled) await new Promise((resolve) => setTimeout(resolve, 2));
    const wall = performance.now() - began;
    const { left, right } = book.spread;
    const shown = (await lettersOf(left)) + (await lettersOf(right));
    const isAlike = book.shownLayout === shownLayout;
    return { wall, isPlace: shown.includes(first), isAlike };
  }, String(otherSize));
  return { ...found, cpu: (await task()) - before };
}

/** Runs in the page before anything else: takes down the first and the last time of what happens. */
function watchMoments() {
  const moments = { first: {}, last: {} };
  const note = (name) => {
    moments.first[name] ??= performance.now();
    moments.last[name] = performance.now();
  };
  window.moments = moments;
  const { Worker, createImageBitmap, requestAnimationFrame } = window;
  window.Worker = class extends Worker {
    constructor(...how) {
      super(...how);
      this.addEventListener("message", () => note("worker runs"), { once: true });
    }
  };
  window.createImageBitmap = async (...how) => {
    const bitmap = await createImageBitmap(...how);
    note("picture");
    return bitmap;
  };
  const { transferToImageBitmap } = OffscreenCanvas.prototype;
  OffscreenCanvas.prototype.transferToImageBitmap = function () {
    note("picture");
    return transferToImageBitmap.call(this);
  };
  window.requestAnimationFrame = (call) =>
    requestAnimationFrame((now) => {
      call(now);
      note("frame");
    });
  // It does not bubble.
  const opened = ({ target }) => {
    if (target.localName === "turnleaf-book") note("opened");
  };
  document.addEventListener("load", opened, { capture: true });
}

/** The moments of an opening, in their usual order: what is there or done then, and how a page knows. */
const moments = {
  "the element's script is there": ({ files }) => files(/viewer-/),
  "what reads the book is there": ({ files }) => files(/(open|pdf|epub|zip|images|worker)\b.*\.js/),
  "what draws it is there": ({ files }) => files(/(backend|three|turnleaf-|wasm_book)/),
  "pdf.js's worker runs": ({ last }) => last["worker runs"],
  "the book is open": ({ first }) => first.opened,
  "its first frame is drawn": ({ first }) => first.frame,
  "its first page is drawn": ({ first }) => first.picture,
  "it can be read": ({ read }) => read,
};

/** Returns the moments of openings, milliseconds: by kind and by what draws, each as median, least and most. */
export async function openingMoments({ rounds = 3, kinds = wanted } = {}) {
  const { url, stop } = await serve();
  const found = {};
  for (const [backend, args] of Object.entries(backends)) {
    const browser = await chromium.launch({ executablePath: findChromium(), args });
    for (let round = 0; round < rounds; round++) {
      for (const kind of kinds) {
        const address = `${url}${names.indexOf(kind)}/`;
        const opened = await open(browser, address, ["read"], [watchMoments]);
        const { first, last, loaded } = await opened.page.evaluate(() => ({
          ...window.moments,
          loaded: performance
            .getEntriesByType("resource")
            .map((one) => [one.name, one.responseEnd]),
        }));
        await opened.close();
        const { read } = opened.wall;
        const files = (name) => {
          const ends = loaded.filter(([file, end]) => name.test(file) && end <= read);
          return ends.length > 0 ? Math.max(...ends.map(([, end]) => end)) : undefined;
        };
        for (const [name, at] of Object.entries(moments)) {
          const time = at({ first, last, read, files });
          if (time === undefined) continue;
          const of = `${kind}, ${backend}`;
          found[of] ??= {};
          found[of][name] ??= [];
          found[of][name].push(time);
        }
      }
    }
    await browser.close();
  }
  stop();
  return found;
}

/** Returns the moments as rows of a table. */
export function momentsTable(found) {
  const cases = Object.keys(found);
  const rows = Object.keys(moments)
    .filter((name) => cases.some((one) => found[one][name]))
    .map((name) => [
      name,
      ...cases.map((one) => inWords(found[one][name] && summary(found[one][name]))),
    ]);
  return [["milliseconds until", ...cases], ...rows];
}

const median = (values) => values.toSorted((a, b) => a - b)[Math.floor(values.length / 2)];
const summary = (values) => ({
  median: median(values),
  least: Math.min(...values),
  most: Math.max(...values),
});

/** What draws the book: WebGL in software, or a 2D canvas in a browser that draws nothing by GL. */
const isOfGl = /angle|swiftshader|ignore-gpu/;
const backends = {
  "in 3D, by software": chromiumArguments,
  "on the flat": [...chromiumArguments.filter((one) => !isOfGl.test(one)), "--disable-3d-apis"],
};

/** What is added to the results of an EPUB. */
const anew = "EPUB, 1 MB of text, set in another size";

/**
 * Returns what was measured: by the kind of book, and by what drew it, milliseconds until it can be
 * read and turned, and those of processors, each as median, least and most.
 */
export async function openingTimes({ rounds = usualRounds, kinds = names } = {}) {
  const { url, stop } = await serve();
  const found = {};
  const add = (kind, backend, values) => {
    found[kind] ??= {};
    found[kind][backend] ??= {};
    for (const [key, value] of Object.entries(values)) {
      found[kind][backend][key] ??= [];
      found[kind][backend][key].push(value);
    }
  };
  const browsers = {};
  try {
    for (const [backend, args] of Object.entries(backends)) {
      browsers[backend] = await chromium.launch({ executablePath: findChromium(), args });
    }
    for (let round = 0; round < rounds; round++) {
      for (const kind of kinds) {
        const address = `${url}${names.indexOf(kind)}/`;
        for (const [backend, browser] of Object.entries(browsers)) {
          const opened = await open(browser, address, ["read", "turnable"]);
          const { read, turnable } = opened.wall;
          add(kind, backend, { read, turnable, cpu: opened.cpu });
          if (kind.startsWith("EPUB")) {
            const { wall, cpu, isPlace, isAlike } = await setAnew(opened.page);
            if (!isPlace) throw new Error("The EPUB was set anew at another place.");
            if (!isAlike) throw new Error("The EPUB was set anew in another layout.");
            add(anew, backend, { read: wall, cpu });
          }
          await opened.close();
          if (!kind.startsWith("PDF")) continue;
          // It needs no GL, but is drawn to the screen by the same browser.
          const plain = await open(browser, `${address}alone?width=${opened.width}`, ["drawn"]);
          add(alone, backend, { read: plain.wall.drawn, cpu: plain.cpu });
          await plain.close();
        }
      }
    }
  } finally {
    for (const browser of Object.values(browsers)) await browser.close();
    stop();
  }
  const each = (object, of) =>
    Object.fromEntries(Object.entries(object).map(([key, value]) => [key, of(value)]));
  return each(found, (kind) => each(kind, (backend) => each(backend, summary)));
}

/** Returns a figure in words. */
const inWords = (one) =>
  one ? `${Math.round(one.median)} (${Math.round(one.least)} to ${Math.round(one.most)})` : "";

/** Returns the results as rows of a table. */
export function openingTable(found) {
  const headings = ["", "drawn", "can be read, ms", "can be turned, ms", "processors, ms"];
  const rows = Object.entries(found).flatMap(([kind, byBackend]) =>
    Object.entries(byBackend).map(([backend, { read, turnable, cpu }]) => [
      kind,
      backend,
      inWords(read),
      inWords(turnable),
      inWords(cpu),
    ]),
  );
  const pdfs = found[names[0]];
  const ratios = Object.entries(found[alone] ?? {}).map(([backend, { read, cpu }]) => {
    const times = (one, other) => `${(one.median / other.median).toFixed(1)} times`;
    const { read: ours, cpu: used } = pdfs[backend];
    return ["the PDF over pdf.js alone", backend, times(ours, read), "", times(used, cpu)];
  });
  return [headings, ...rows, ...ratios];
}

if (process.argv[1] === fileURLToPath(import.meta.url)) {
  const args = process.argv.slice(2);
  const at = args.indexOf("--rounds");
  const rounds = at < 0 ? {} : { rounds: Number(args.splice(at, 2)[1]) };
  const asked = args.filter((one) => !one.startsWith("--"));
  const isAsked = (name) => asked.length === 0 || asked.some((one) => name.startsWith(one));
  const kinds = names.filter(isAsked);
  const isOfMoments = args.includes("--moments");
  const found = await (isOfMoments ? openingMoments : openingTimes)({ ...rounds, kinds });
  if (isOfMoments) console.table(momentsTable(found));
  else if (args.includes("--json")) console.log(JSON.stringify(found, null, 2));
  else console.table(openingTable(found));
}
