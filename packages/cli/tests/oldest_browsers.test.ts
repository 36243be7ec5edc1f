/**
 * The built viewer in a Chromium from which all features are deleted that the
 * oldest supported browsers do not have.
 */

import { readdirSync, readFileSync } from "node:fs";
import { parse } from "acorn";
import type { TurnleafBook } from "turnleaf";
import { afterAll, beforeAll, expect, test } from "vitest";
import { lacking, oldestBrowsers } from "../../../scripts/lacking.mjs";
import { pdf, png } from "./books.ts";
import { pageForTests } from "./browser.ts";
import { serveViewer, type ViewerSite } from "./viewer_page.ts";

const tests = pageForTests({ viewport: { width: 400, height: 300 } });
let site: ViewerSite;

beforeAll(async () => {
  await tests.page.addInitScript(deleteFeatures);
  const manifest = JSON.stringify({ pages: ["1.png", "2.png", "3.png", "4.png"] });
  const files: Record<string, Buffer | string> = { "/book.pdf": pdf(9), "/book.json": manifest };
  site = await serveViewer(
    (path) => files[path] ?? (/^\/\d\.png$/.test(path) ? png(60, 90) : null),
  );
});
afterAll(async () => {
  await site?.stop();
});

/** Opens an empty page without features. */
const openWithout = (features: readonly string[]): Promise<unknown> =>
  tests.page.goto(`${site.url}#${encodeURIComponent(JSON.stringify(features))}`);

/**
 * Runs in the page before anything else: deletes the features that its address lists there and,
 * before their own code, in its workers. Counts the features it deleted in `deleted`.
 */
function deleteFeatures(): void {
  const features: readonly string[] = JSON.parse(
    decodeURIComponent(location.hash.slice(1)) || "[]",
  );
  const deleteAll = (names: readonly string[]): number => {
    let count = 0;
    const drop = (object: unknown, key: string): void => {
      if (object && Object.hasOwn(object, key))
        count += Number(Reflect.deleteProperty(object, key));
    };
    for (const name of names) {
      const [object, member] = name.split(".") as [string, string | undefined];
      const of = Reflect.get(globalThis, object) as { prototype?: unknown } | undefined;
      if (member === undefined) drop(globalThis, object);
      else {
        drop(of, member);
        drop(of?.prototype, member);
      }
    }
    return count;
  };
  Object.assign(globalThis, { deleted: deleteAll(features) });
  // zone.js replaces the page's Promise, not its workers'.
  if (features[0] === "Promise.withResolvers") return;
  const first = `data:text/javascript,(${encodeURIComponent(String(deleteAll))})(${encodeURIComponent(JSON.stringify(features))})`;
  globalThis.Worker = class extends Worker {
    constructor(address: string | URL, options?: WorkerOptions) {
      const own = new URL(address, location.href).href;
      const code = `import ${JSON.stringify(first)}; import ${JSON.stringify(own)};`;
      super(URL.createObjectURL(new Blob([code], { type: "text/javascript" })), options);
    }
  };
}

/** Opens a book in place of the one before, turns it, reads it and zooms. Resolves to what was found. */
async function use(src: string) {
  document.querySelector("turnleaf-book")?.remove();
  const book = document.createElement("turnleaf-book") as TurnleafBook;
  book.style.cssText = "width: 320px; height: 240px";
  book.setAttribute("controls", "");
  book.setAttribute("duration", "100");
  const loaded = new Promise((resolve, reject) => {
    book.addEventListener("load", resolve, { once: true });
    book.addEventListener("error", (event) => reject(new Error(event.detail.message)));
  });
  book.src = src;
  document.body.append(book);
  await loaded;
  const turned = await book.next();
  book.zoom = 2;
  while (!book.settled) await new Promise(requestAnimationFrame);
  const hits = await book.search("page 3");
  const outline = await book.outline();
  const picture = await book.drawPage(2, 60);
  return {
    deleted: Reflect.get(globalThis, "deleted") as number,
    turned,
    page: book.page,
    hits: hits.length,
    outline: outline.length,
    width: picture.width,
  };
}

/** Edge is Chromium of the same version. */
const engines = oldestBrowsers().filter(({ name }) => name !== "Edge");

test.each(engines)("$name $version has all that the viewer needs", async (oldest) => {
  await openWithout(lacking(oldest));
  for (const src of ["/book.pdf", "/book.json"]) {
    const found = await tests.page.evaluate(use, src);
    expect(found).toMatchObject({ turned: true, page: 2, width: 60 });
    // The table of features and the deleting both work.
    expect(found.deleted).toBeGreaterThan(100);
  }
  expect(tests.complaints).toEqual([]);
});

const built = new URL("../../turnleaf/dist/", import.meta.url);
const modules = new URL("../../../node_modules/", import.meta.url);

test.each([
  ...readdirSync(built)
    .filter((name) => name.endsWith(".js"))
    .map((name) => new URL(name, built)),
  // These are packed in files of the above.
  new URL("pdfjs-dist/legacy/build/pdf.worker.min.mjs", modules),
  new URL("pdfjs-dist/legacy/build/pdf.renderer.min.mjs", modules),
  new URL("three/build/three.module.js", modules),
  new URL("three/build/three.core.js", modules),
])("%s has no syntax newer than ES2022, which all of them read", (file) => {
  parse(readFileSync(file, "utf8"), { ecmaVersion: 2022, sourceType: "module" });
});

test.each([
  ["Promise.try", "as zone.js takes it away"],
  ["Map.getOrInsertComputed", "of 2025"],
  ["Promise.withResolvers", "as older versions of zone.js take it away"],
])("a PDF opens without %s, %s", async (feature) => {
  await openWithout([feature]);
  expect(await tests.page.evaluate(use, "/book.pdf")).toMatchObject({ turned: true, deleted: 1 });
});
