/**
 * Opens the manifests of IIIF's cookbook (github.com/IIIF/cookbook-recipes) and writes what comes of
 * each into docs/data. Nothing is fetched: recipes come from a clone of the repository, and images are
 * made in the sizes that are asked for.
 *
 *   node scripts/iiif_cookbook.mjs FOLDER    the clone, bare or not
 */
import { execFileSync } from "node:child_process";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { chromium } from "playwright-core";
import { PNG } from "pngjs";
import { chromiumArguments, findChromium } from "./chromium.mjs";
import { includeTables, writeTable } from "./docs_tables.mjs";

const root = join(import.meta.dirname, "..");
const [folder] = process.argv.slice(2);
if (!folder) {
  console.error("Give the folder of a clone of github.com/IIIF/cookbook-recipes.");
  process.exit(1);
}

const git = (...args) =>
  execFileSync("git", ["-C", folder, ...args], { encoding: "utf8", maxBuffer: 1 << 28 });

/** Name of the clone's commit in the table's first heading. */
const commit = git("rev-parse", "--short=8", "HEAD").trim();

/** The recipes' address, and that of the page that reads them. */
const cookbook = "https://iiif.io/api/cookbook/recipe/";
const reader = "https://reader.example/";

const files = git("ls-tree", "-r", "--name-only", "HEAD", "recipe/")
  .split("\n")
  .filter((name) => name.endsWith(".json") && !name.includes("0000_template"));

/** Returns a file of the cookbook as it is published. */
function published(file) {
  const url = cookbook + file.replace(/^recipe\//, "");
  const path = url.replace(/\/[^/]*$/, "");
  return git("show", `HEAD:${file}`)
    .replaceAll(/\{\{\s*id\.url\s*\}\}/g, url)
    .replaceAll(/\{\{\s*id\.path\s*\}\}/g, path);
}

/** Sizes of images with a service, by its address, as the recipes say. */
const sizes = new Map();
function collectSizes(value) {
  if (typeof value !== "object" || value === null) return;
  const [service] = [value.service ?? []].flat();
  const id = service?.id ?? service?.["@id"];
  if (id && value.width) sizes.set(id, { width: value.width, height: value.height });
  for (const inner of Object.values(value)) collectSizes(inner);
}

/** Returns a grey picture. */
function picture(width, height) {
  const png = new PNG({ width, height });
  png.data.fill(128);
  for (let k = 3; k < png.data.length; k += 4) png.data[k] = 255;
  return PNG.sync.write(png);
}

/** Returns the response of an image server, or of the server of an image. */
function image(url) {
  const service = [...sizes.keys()].find((id) => url.startsWith(`${id}/`));
  if (!service) return { contentType: "image/png", body: picture(60, 90) };
  const { width, height } = sizes.get(service);
  const [region, size] = url.slice(service.length + 1).split("/");
  if (region === "info.json") {
    const context = "http://iiif.io/api/image/3/context.json";
    const info = { "@context": context, id: service, type: "ImageService3", profile: "level1" };
    return { contentType: "application/json", body: JSON.stringify({ ...info, width, height }) };
  }
  const [, , w, h] = region === "full" ? [0, 0, width, height] : region.split(",").map(Number);
  const across = Number.parseInt(size, 10) || w;
  const down = Math.max(Math.round((across * h) / w), 1);
  return { contentType: "image/png", body: picture(across, down) };
}

/** Responds to every request of the page. */
async function respond(route) {
  const url = route.request().url();
  const headers = { "access-control-allow-origin": "*" };
  const file = `recipe/${url.slice(cookbook.length)}`;
  if (url === reader)
    return await route.fulfill({ contentType: "text/html", body: "<!doctype html>" });
  if (url.startsWith(reader)) {
    const path = join(root, "packages/turnleaf/dist", new URL(url).pathname);
    return await route.fulfill({ contentType: "text/javascript", body: readFileSync(path) });
  }
  if (url.startsWith(cookbook) && files.includes(file)) {
    return await route.fulfill({ headers, contentType: "application/json", body: published(file) });
  }
  await route.fulfill({ headers, ...image(url) });
}

/** Runs in the page: opens a manifest, and reads and draws its pages. */
async function read(url) {
  const { openSource } = await import("/index.js");
  const never = new AbortController().signal;
  let source;
  try {
    source = await openSource(url);
  } catch (error) {
    return { rejected: error.name === "BookError", sentence: error.message };
  }
  const found = { pages: source.pageCount, drawn: 0, inked: 0, letters: 0, failures: [] };
  for (let index = 0; index < source.pageCount; index++) {
    try {
      const bitmap = await source.draw(index, 60, never);
      found.drawn += 1;
      const canvas = new OffscreenCanvas(bitmap.width, bitmap.height);
      const pen = canvas.getContext("2d");
      pen.drawImage(bitmap, 0, 0);
      const { data } = pen.getImageData(0, 0, bitmap.width, bitmap.height);
      if (data.some((value) => value < 200)) found.inked += 1;
      const runs = await source.text(index, never);
      found.letters += runs.reduce((sum, { text }) => sum + text.length, 0);
    } catch (error) {
      found.failures.push(`${error.name}: ${error.message}`);
    }
  }
  const lines = (entries) => entries.reduce((sum, one) => sum + 1 + lines(one.children), 0);
  found.lines = lines(await source.outline(never));
  const { direction, edge, layout, openingPage = 1, details } = source;
  found.more = [
    direction === "rtl" ? "right to left" : "",
    edge ? `bound at the ${edge}` : "",
    layout ? "one page at a time" : "",
    openingPage > 1 ? `opens at page ${openingPage}` : "",
    details.length > 0 ? `lines about the book: ${details.length}` : "",
    found.lines > 0 ? `lines of contents: ${found.lines}` : "",
    found.letters > 0 ? `letters of text: ${found.letters}` : "",
  ].filter((text) => text !== "");
  source.close();
  return found;
}

/** Returns what is not read of a manifest, by its own JSON. */
function unread(text) {
  const has = (pattern) => pattern.test(text);
  return [
    has(/"type":\s*"(Video|Sound)"/) ? "sound and video" : "",
    has(/"rotation":\s*"?(?!(0|90|180|270)\b)/) ? "rotation by other angles" : "",
    has(/"behavior":\s*\[\s*"sequence"/) ? "another order of pages" : "",
    has(/"type":\s*"Choice"/) ? "the other images of a choice" : "",
    has(/"motivation":\s*\[?\s*"(commenting|tagging|linking|identifying|assessing|describing)"/)
      ? "notes"
      : "",
    has(/"navPlace"/) ? "places on a map" : "",
    has(/"navDate"/) ? "dates" : "",
    has(/"(placeholder|accompanying)Canvas"/) ? "pages in place of others" : "",
    has(/"stylesheet"/) ? "style sheets" : "",
    has(/"rendering":/) ? "other copies" : "",
    has(/"seeAlso":/) ? "related data" : "",
  ].filter((what) => what !== "");
}

const manifests = files.filter((file) => {
  const { type, "@type": old } = JSON.parse(published(file));
  return /^(sc:)?(Manifest|Collection)$/.test(type ?? old ?? "");
});
for (const file of manifests) collectSizes(JSON.parse(published(file)));
const browser = await chromium.launch({ executablePath: findChromium(), args: chromiumArguments });
const rows = [[`file, at commit ${commit}`, "pages drawn", "what is read", "what is not"]];
let broken = 0;
try {
  const page = await browser.newPage();
  await page.route("**/*", respond);
  await page.goto(reader);
  for (const file of manifests) {
    const name = file.replace(/^recipe\//, "");
    const found = await page.evaluate(read, cookbook + name);
    const left = unread(published(file)).join(", ");
    if ("rejected" in found) {
      if (!found.rejected) broken += 1;
      const sentence = found.sentence
        .replaceAll("|", " ")
        .replace(/\(http[^)]*\)/g, "")
        .replace(/\s+([,.])/g, "$1");
      rows.push([name, "none", sentence, left]);
      continue;
    }
    broken += found.failures.length;
    const blank = found.drawn - found.inked;
    const pages = `${found.drawn} of ${found.pages}${blank > 0 ? `, ${blank} of them blank` : ""}`;
    rows.push([name, pages, [...found.failures, ...found.more].join("; "), left]);
  }
} finally {
  await browser.close();
}
writeTable("iiif_cookbook", rows);
includeTables();
console.log(`${rows.length - 1} files of commit ${commit}; ${broken} broken.`);
process.exit(broken > 0 ? 1 : 0);
