/**
 * Which of the viewer's files and functions run in an act: how much of the house one has to know to
 * follow it. By Chromium's own coverage over the sources as they are, not bundled.
 *
 *   node scripts/act_coverage.mjs [--files]    files and functions an act; with --files their names
 */
import { join } from "node:path";
import { strToU8, zipSync } from "fflate";
import { chromium } from "playwright-core";
import { createServer } from "vite";
import { packedFiles } from "../packages/turnleaf/packed_files.js";
import { turnInline } from "../packages/turnleaf/turn_inline.js";
import { wasmInline } from "../packages/turnleaf/wasm_inline.js";
import { workerInline } from "../packages/turnleaf/worker_inline.js";
import { chromiumArguments, findChromium } from "./chromium.mjs";

const root = join(import.meta.dirname, "..");
const sources = "/packages/turnleaf/src/";
/** Milliseconds that an act may take on a busy machine. */
const patience = 120_000;

const page = (title, text) =>
  `<html xmlns="http://www.w3.org/1999/xhtml"><head><title>${title}</title></head><body><h1>${title}</h1>${text}</body></html>`;
const epub = zipSync({
  "META-INF/container.xml": strToU8(
    '<container xmlns="urn:oasis:names:tc:opendocument:xmlns:container" version="1.0"><rootfiles><rootfile full-path="book.opf" media-type="application/oebps-package+xml"/></rootfiles></container>',
  ),
  "book.opf": strToU8(
    '<package xmlns="http://www.idpf.org/2007/opf" version="3.0" unique-identifier="i"><metadata xmlns:dc="http://purl.org/dc/elements/1.1/"><dc:identifier id="i">1</dc:identifier><dc:title>A book</dc:title><dc:language>en</dc:language></metadata><manifest><item id="n" href="nav.xhtml" media-type="application/xhtml+xml" properties="nav"/><item id="a" href="a.xhtml" media-type="application/xhtml+xml"/></manifest><spine><itemref idref="a"/></spine></package>',
  ),
  "nav.xhtml": strToU8(
    '<html xmlns="http://www.w3.org/1999/xhtml" xmlns:epub="http://www.idpf.org/2007/ops"><head><title>N</title></head><body><nav epub:type="toc"><ol><li><a href="a.xhtml">A chapter</a></li></ol></nav></body></html>',
  ),
  "a.xhtml": strToU8(page("A chapter", "<p>Some words of a book.</p>".repeat(200))),
});

/** What is done, in a page that has the element, and what it shows. */
const acts = {
  "one drag": {
    book: "/books/moby-dick.pdf",
    act: async ({ mouse }, box) => {
      const y = box.y + 0.6 * box.height;
      await mouse.move(box.x + 0.9 * box.width, y);
      await mouse.down();
      for (let k = 0; k <= 20; k++)
        await mouse.move(box.x + (0.9 - 0.04 * k) * box.width, y - 2 * k);
      await mouse.up();
    },
  },
  "tearOut(5), until the leaf lies beside the book": {
    book: "/books/moby-dick.pdf",
    attributes: 'tearable="sewn"',
    act: ({ evaluate }) => evaluate("document.querySelector('turnleaf-book').tearOut(5)"),
  },
  "an EPUB, until its first page": { book: "/a.epub" },
};

const server = await createServer({
  root,
  configFile: false,
  logLevel: "error",
  server: { port: 0, host: "127.0.0.1" },
  plugins: [
    wasmInline(),
    turnInline(),
    packedFiles(),
    workerInline(),
    {
      name: "pages",
      configureServer({ middlewares }) {
        middlewares.use((request, response, next) => {
          if (request.url === "/a.epub") return response.end(Buffer.from(epub));
          const { searchParams, pathname } = new URL(request.url, "http://localhost");
          if (pathname !== "/act.html") return next();
          response.setHeader("Content-Type", "text/html");
          response.end(
            `<!doctype html><script type="module" src="${sources}index.ts"></script><turnleaf-book style="display: block; width: 800px; height: 600px" ${searchParams.get("of")}></turnleaf-book>`,
          );
        });
      },
    },
  ],
});
await server.listen();
const [origin] = server.resolvedUrls.local;
const browser = await chromium.launch({
  executablePath: findChromium(),
  args: chromiumArguments,
});

/** Returns the functions that ran since the last call, by file. */
async function taken(session) {
  const { result } = await session.send("Profiler.takePreciseCoverage");
  const ran = new Map();
  for (const { url, functions } of result) {
    const at = url.indexOf(sources);
    if (at < 0) continue;
    const file = url.slice(at + sources.length).replace(/\?.*/, "");
    // The first is the module itself.
    const count = functions.filter(
      ({ functionName, ranges }) => functionName && ranges[0].count > 0,
    );
    if (count.length > 0) ran.set(file, count.length);
  }
  return ran;
}

try {
  for (const [name, { book, attributes = "", act }] of Object.entries(acts)) {
    const tab = await browser.newPage({ viewport: { width: 800, height: 600 } });
    const session = await tab.context().newCDPSession(tab);
    await session.send("Profiler.enable");
    await session.send("Profiler.startPreciseCoverage", { callCount: true, detailed: false });
    const of = `src="${book}" page="5" ${attributes}`;
    await tab.goto(`${origin}act.html?of=${encodeURIComponent(of)}`, { timeout: patience });
    const settled = () =>
      tab.waitForFunction(() => document.querySelector("turnleaf-book")?.settled, null, {
        polling: 100,
        timeout: patience,
      });
    await settled();
    if (act) {
      await taken(session);
      const box = await tab.locator("turnleaf-book").boundingBox();
      await act({ mouse: tab.mouse, evaluate: (script) => tab.evaluate(script) }, box);
      await settled();
    }
    const ran = await taken(session);
    const functions = [...ran.values()].reduce((sum, count) => sum + count, 0);
    console.log(`${name}: ${ran.size} files, ${functions} functions`);
    if (process.argv.includes("--files"))
      for (const [file, count] of [...ran].sort()) console.log(`  ${count}\t${file}`);
    await tab.close();
  }
} finally {
  await browser.close();
  await server.close();
}
