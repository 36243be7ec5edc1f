/**
 * How near the first numbers of pages of books of flowing text are to the last: right after a book is
 * opened, a guess that readers are not shown; once it is estimated by text of the whole book and pieces
 * that are laid out, which is the first that they see; and counted to the end.
 *
 *   node scripts/page_estimates.mjs BOOK ...
 *
 * BOOK is a file, such as an EPUB, or the folder of an unpacked one. It uses the build of
 * `npm run build`. Each line says the numbers and when they were known, seconds after the start.
 */
import { readdirSync, readFileSync, statSync } from "node:fs";
import { createServer } from "node:http";
import { basename, extname, join, relative } from "node:path";
import { zipSync } from "fflate";
import { chromium } from "playwright-core";
import { chromiumArguments, findChromium } from "./chromium.mjs";

const dist = join(import.meta.dirname, "../packages/turnleaf/dist");

/** Returns a book's bytes; a folder is packed. */
function bytesOf(path) {
  if (!statSync(path).isDirectory()) return readFileSync(path);
  const files = readdirSync(path, { recursive: true, withFileTypes: true })
    .filter((entry) => entry.isFile())
    .map((entry) => join(entry.parentPath, entry.name));
  const named = files.map((file) => [relative(path, file), readFileSync(file)]);
  return zipSync(Object.fromEntries(named));
}

const books = process.argv.slice(2);
const types = { ".js": "text/javascript", ".wasm": "application/wasm" };
const server = createServer((request, response) => {
  const { pathname } = new URL(request.url ?? "/", "http://localhost");
  const [, kind, name] = pathname.split("/", 3);
  if (kind === "turnleaf") {
    response.setHeader("content-type", types[extname(pathname)] ?? "application/octet-stream");
    response.end(readFileSync(join(dist, pathname.slice("/turnleaf/".length))));
  } else if (kind === "book") response.end(bytesOf(books[Number(name)]));
  else {
    response.setHeader("content-type", "text/html");
    const map = '<script type="importmap">{"imports":{"three":"data:text/javascript,"}}</script>';
    response.end(`<!doctype html><link rel="icon" href="data:,">${map}`);
  }
});
await new Promise((resolve) => server.listen(0, "127.0.0.1", resolve));
const url = `http://127.0.0.1:${server.address().port}`;

/** Runs in the page. */
async function count([address, name]) {
  const { openSource } = await import("/turnleaf/index.js");
  const start = performance.now();
  const seconds = () => ((performance.now() - start) / 1000).toFixed(2);
  const source = await openSource(address, { name });
  const first = [source.pageCount, seconds()];
  // What is announced is shown at once.
  source.watchPages?.((change) => change());
  const settled = source.settle();
  const estimated = source.estimated.then(() => [source.pageCount, seconds()]);
  await settled;
  const last = source.pageCount;
  source.close();
  return {
    first,
    estimated: await estimated,
    last: [last, seconds()],
  };
}

const browser = await chromium.launch({ executablePath: findChromium(), args: chromiumArguments });
const off = { first: [], estimated: [] };
for (const [index, path] of books.entries()) {
  const page = await browser.newPage();
  await page.goto(url);
  const name = basename(path);
  try {
    const found = await page.evaluate(count, [`${url}/book/${index}`, name]);
    const [last, time] = found.last;
    const inWords = ([pages, seconds]) => `${pages} (${seconds} s)`;
    for (const kind of Object.keys(off)) off[kind].push(Math.abs(found[kind][0] / last - 1));
    console.log(
      `${name.slice(0, 40).padEnd(42)} first ${inWords(found.first)}, estimated ${inWords(found.estimated)}, counted ${last} (${time} s)`,
    );
  } catch (error) {
    console.log(`${name}: ${String(error).slice(0, 200)}`);
  }
  await page.close();
}
const percent = (value) => `${(100 * value).toFixed(1)} %`;
for (const [kind, values] of Object.entries(off)) {
  const sorted = values.sort((a, b) => a - b);
  const median = sorted[sorted.length >> 1] ?? 0;
  console.log(
    `${kind}: off by ${percent(median)} in the median, ${percent(sorted.at(-1) ?? 0)} at most`,
  );
}
await browser.close();
server.close();
