/** The built viewer under each Content-Security-Policy that docs/policy.md has a row for. */

import type { TurnleafBook } from "turnleaf";
import { describe, expect, test } from "vitest";
import { silentRecording } from "../../../tests/silent_recording.mjs";
import { rar5, sevenZip } from "../../turnleaf/src/for_tests/stored_archives.ts";
import { tinyEpub } from "../../turnleaf/src/sources/epub/tiny_epub.ts";
import { jpeg2000, tinyPdf } from "../../turnleaf/src/sources/tiny_pdf.ts";
import { pdf, png } from "./books.ts";
import { pageForTests } from "./browser.ts";
import { sitesForTests } from "./viewer_page.ts";

const sites = sitesForTests();
const tests = pageForTests({ viewport: { width: 400, height: 300 } });

/** The policy that docs/policy.md gives for PDFs and images from the page's own site. */
const enough = {
  "default-src": "'none'",
  "script-src": "'self' 'nonce-map' 'wasm-unsafe-eval'",
  "worker-src": "blob:",
  "style-src": "'self'",
  "connect-src": "'self'",
  "require-trusted-types-for": "'script'",
  "trusted-types": "turnleaf",
};

const svg = `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 20 30"><rect width="20" height="30" fill="#00f"/></svg>`;
const files: Record<string, Buffer | string> = {
  "/book.pdf": pdf(4),
  "/book.epub": Buffer.from(
    tinyEpub({
      chapters: [
        '<style type="text/css">body { background: #ff0 }</style><p style="color: red">One</p><img src="1.png" alt=""/><svg xmlns="http://www.w3.org/2000/svg"><style>rect { fill: red }</style></svg>',
        "<p>Two</p>",
      ],
      css: "p { background: url(1.png) }",
      files: { "1.png": png(60, 90) },
    }),
  ),
  "/aloud.epub": Buffer.from(
    tinyEpub({
      chapters: ["<p>One</p>"],
      items:
        '<item id="o" href="o.smil" media-type="application/smil+xml"/><item id="v" href="v.wav" media-type="audio/wav"/><item id="m" href="m.xhtml" media-type="application/xhtml+xml" media-overlay="o"/>',
      itemrefs: '<itemref idref="m"/>',
      raw: {
        "OEBPS/o.smil":
          '<smil xmlns="http://www.w3.org/ns/SMIL"><body><par><text src="m.xhtml#a"/><audio src="v.wav"/></par></body></smil>',
        "OEBPS/v.wav": silentRecording(0.25),
        "OEBPS/m.xhtml":
          '<html xmlns="http://www.w3.org/1999/xhtml"><body><p id="a">Aloud</p></body></html>',
      },
    }),
  ),
  "/jpeg2000.pdf": Buffer.from(tinyPdf(jpeg2000)),
  "/book.json": JSON.stringify({ pages: ["1.png", "2.png"] }),
  "/svg.json": JSON.stringify({ pages: ["1.svg", "2.png"] }),
  "/data.json": JSON.stringify({
    pages: [`data:image/png;base64,${png(6, 9).toString("base64")}`, "2.png"],
  }),
  "/comic.cbr": Buffer.from(rar5({ "1.png": png(60, 90), "2.png": png(60, 90) })),
  "/comic.cb7": Buffer.from(sevenZip({ "1.png": png(60, 90), "2.png": png(60, 90) })),
  "/1.svg": svg,
  "/1.png": png(60, 90),
  "/2.png": png(60, 90),
};

/** Opens a page under a policy. Returns it with its console messages. */
async function visit(
  changes: Partial<Record<keyof typeof enough | "img-src" | "font-src" | "media-src", string>> = {},
) {
  const policy = Object.entries({ ...enough, ...changes }).map((entry) => entry.join(" "));
  const site = await sites.serve((path) => files[path] ?? null, policy.join("; "));
  const { page, complaints: said } = tests;
  said.length = 0;
  await page.goto(site.url);
  return { page, said, asked: site.asked };
}

/**
 * Shows a book and turns a leaf. Resolves to the sentence of its error, or ""
 * if it opened and turned.
 */
async function show([src, attributes]: readonly [string, Record<string, string>]) {
  const book = document.createElement("turnleaf-book") as TurnleafBook;
  for (const [name, value] of Object.entries({ duration: "20", ...attributes })) {
    book.setAttribute(name, value);
  }
  const happened = new Promise<string>((resolve) => {
    book.addEventListener("load", () => resolve(""), { once: true });
    book.addEventListener("error", (event) => resolve(event.detail.message), { once: true });
  });
  const blob = async (path: string) => new Blob([await (await fetch(path)).arrayBuffer()]);
  if (src.startsWith("blob:")) book.src = URL.createObjectURL(await blob(src.slice(5)));
  else if (src.startsWith("file:")) book.pages = await blob(src.slice(5));
  else book.src = src;
  document.body.append(book);
  const sentence = await happened;
  if (sentence !== "") return sentence;
  await book.next();
  while (!book.settled) await new Promise(requestAnimationFrame);
  return "";
}

const open = (
  page: Awaited<ReturnType<typeof visit>>["page"],
  src: string,
  attributes: Record<string, string> = {},
) => page.evaluate(show, [src, attributes] as const);

/** Draws a page (from 1) of the open book. Resolves to "" or to why it cannot be drawn. */
const draw = (page: Awaited<ReturnType<typeof visit>>["page"], number: number) =>
  page.evaluate(
    (number) =>
      (document.querySelector("turnleaf-book") as TurnleafBook)
        .drawPage(number, 60)
        .then(() => "", String),
    number,
  );

describe.each(["/book.pdf", "/book.json", "file:/book.pdf", "/comic.cbr", "/comic.cb7"])(
  "%s",
  (src) => {
    test("opens in space under the policy that is enough, and nothing is blocked", async () => {
      const { page, said, asked } = await visit();
      expect(await open(page, src)).toBe("");
      expect(asked.some((path) => path.includes("webgl_backend"))).toBe(true);
      expect(said).toEqual([]);
    });
  },
);

test("img-src data: an EPUB is drawn with its style and pictures, and nothing is blocked", async () => {
  const { page, said } = await visit({ "img-src": "data:", "font-src": "data:" });
  expect(await open(page, "/book.epub")).toBe("");
  const colours = await page.evaluate(async () => {
    const book = document.querySelector("turnleaf-book") as TurnleafBook;
    const pen = new OffscreenCanvas(60, 90).getContext("2d") as OffscreenCanvasRenderingContext2D;
    pen.drawImage(await book.drawPage(1, 60), 0, 0);
    return [...pen.getImageData(2, 2, 1, 1).data.slice(0, 3)];
  });
  expect(colours).toEqual([255, 255, 0]);
  expect(said).toEqual([]);
});

/** Reads the open book aloud to its end. Resolves to "" or to why it cannot be read. */
const readAloud = (page: Awaited<ReturnType<typeof visit>>["page"]) =>
  page.evaluate(async () => {
    const book = document.querySelector("turnleaf-book") as TurnleafBook;
    let sentence = "";
    book.addEventListener("error", ({ detail }) => {
      sentence = detail.message;
    });
    await book.goTo(1);
    await book.readAloud();
    return sentence;
  });

test("media-src blob: an EPUB is read aloud, and nothing is blocked", async () => {
  const { page, said } = await visit({ "img-src": "data:", "media-src": "blob:" });
  expect(await open(page, "/aloud.epub")).toBe("");
  expect(await readAloud(page)).toBe("");
  expect(said).toEqual([]);
});

test("media-src without blob: reading aloud says so", async () => {
  const { page } = await visit({ "img-src": "data:" });
  expect(await open(page, "/aloud.epub")).toBe("");
  expect(await readAloud(page)).toContain("allow blob: in media-src");
});

test("img-src without data: the pages of an EPUB say so", async () => {
  const { page } = await visit();
  expect(await open(page, "/book.epub")).toBe("");
  expect(await draw(page, 1)).toContain("allow data: in img-src");
});

test("script-src without 'wasm-unsafe-eval': books lie flat, which is said once", async () => {
  const { page, said, asked } = await visit({ "script-src": "'self' 'nonce-map'" });
  for (const src of ["/book.pdf", "/book.json"]) expect(await open(page, src)).toBe("");
  expect(asked.some((path) => path.includes("canvas2d_backend"))).toBe(true);
  expect(said).toEqual([
    "turnleaf-book: books are shown on the flat, as this page's Content-Security-Policy lacks 'wasm-unsafe-eval' in script-src.",
  ]);
});

test.each([
  ["with", "'self' 'nonce-map' 'wasm-unsafe-eval'", [200, 30, 30]],
  ["without", "'self' 'nonce-map'", [255, 255, 255]],
])("an image in JPEG 2000 %s 'wasm-unsafe-eval': its page is drawn", async (_, scripts, colour) => {
  const { page } = await visit({ "script-src": scripts });
  expect(await open(page, "/jpeg2000.pdf")).toBe("");
  const middle = await page.evaluate(async () => {
    const book = document.querySelector("turnleaf-book") as TurnleafBook;
    const pen = new OffscreenCanvas(1, 1).getContext("2d") as OffscreenCanvasRenderingContext2D;
    pen.drawImage(await book.drawPage(1, 40), -20, -30);
    return [...pen.getImageData(0, 0, 1, 1).data.slice(0, 3)];
  });
  expect(middle).toEqual(colour);
});

describe("worker-src without blob:", () => {
  test("a PDF says what to allow or to set", async () => {
    const { page } = await visit({ "worker-src": "'self'" });
    expect(await open(page, "/book.pdf")).toBe(
      "book.pdf cannot be read, as the browser did not start the script that reads it; allow blob: in worker-src of this page's Content-Security-Policy, or set the attribute pdf-worker.",
    );
  });

  test("a PDF opens with the address that pdf-worker names", async () => {
    const { page, said, asked } = await visit({ "worker-src": "'self'" });
    const worker = "turnleaf/pdf-worker.js";
    expect(await open(page, "/book.pdf", { "pdf-worker": worker })).toBe("");
    expect(await draw(page, 2)).toBe("");
    // One reads, one draws, neither comes packed, and on a busy machine one measures how busy that is.
    expect(asked.filter((path) => path === `/${worker}`).length).toBeGreaterThanOrEqual(2);
    expect(asked.filter((path) => /pdf\.(worker|renderer)/.test(path))).toEqual([]);
    expect(said).toEqual([]);
  });

  test("the file that pdf-worker names measures how busy the machine is, too", async () => {
    const { page } = await visit({ "worker-src": "'self'", "require-trusted-types-for": "" });
    const fraction = await page.evaluate(
      () =>
        new Promise<unknown>((resolve) => {
          const worker = new Worker("turnleaf/pdf-worker.js#fraction", { type: "module" });
          worker.onmessage = ({ data }) => resolve(data);
          worker.onerror = ({ message }) => resolve(message);
          worker.postMessage(null);
        }),
    );
    expect(fraction).toBeGreaterThan(0);
    expect(fraction).toBeLessThanOrEqual(1);
  });

  test("an address that is none is named", async () => {
    const { page } = await visit({ "worker-src": "'self'" });
    expect(await open(page, "/book.pdf", { "pdf-worker": "/none.js" })).toMatch(
      /; pdf-worker names http:\S+\/none\.js: correct it, or allow it in worker-src/,
    );
  });
});

describe("a comic in RAR says what to allow", () => {
  test.each([
    ["worker-src", "'self'", "allow blob: in worker-src"],
    ["script-src", "'self' 'nonce-map'", "allow 'wasm-unsafe-eval' in script-src"],
    ["trusted-types", "'none'", "allow turnleaf in trusted-types"],
  ] as const)("%s %s", async (directive, value, remedy) => {
    const { page } = await visit({ [directive]: value });
    expect(await open(page, "/comic.cbr")).toBe(
      `comic.cbr cannot be read, as the browser did not start the script that unpacks it; ${remedy} of this page's Content-Security-Policy.`,
    );
  });
});

describe("engine-src", () => {
  test("the engine is the file that it names, and the one in the package is not loaded", async () => {
    const { page, said, asked } = await visit();
    const file = "turnleaf/turnleaf.wasm";
    expect(await open(page, "/book.json", { "engine-src": file })).toBe("");
    expect(asked.filter((path) => path === `/${file}`).length).toBe(1);
    expect(asked.some((path) => path.includes("webgl_backend"))).toBe(true);
    expect(asked.filter((path) => /turnleaf-[^/]*\.js/.test(path))).toEqual([]);
    expect(said).toEqual([]);
  });

  test("an address that is none is named, and a right one opens the book afterwards", async () => {
    const { page } = await visit();
    expect(await open(page, "/book.json", { "engine-src": "/none.wasm" })).toMatch(
      /; engine-src names http:\S+\/none\.wasm: correct it, or allow it in connect-src/,
    );
    expect(await open(page, "/book.json", { "engine-src": "turnleaf/turnleaf.wasm" })).toBe("");
  });
});

test("connect-src without the book's site: the sentence names the directive", async () => {
  const { page } = await visit({ "connect-src": "'none'" });
  expect(await open(page, "/book.pdf")).toMatch(
    /^book\.pdf could not be reached; .*\(connect-src\)/,
  );
});

test("connect-src without blob: an address of a blob is blocked, the blob itself is not", async () => {
  const { page } = await visit();
  expect(await open(page, "blob:/book.pdf")).toContain("lacks blob: in connect-src");
  expect(await open(page, "file:/book.json")).toBe("");
});

test("connect-src with blob: an address of a blob opens", async () => {
  const { page, said } = await visit({ "connect-src": "'self' blob:" });
  expect(await open(page, "blob:/book.pdf")).toBe("");
  expect(said).toEqual([]);
});

test.each([
  ["/data.json", "connect-src", "'self' data:"],
  ["/svg.json", "img-src", "data:"],
] as const)("%s needs %s %s, else its page alone is blocked", async (src, directive, allowed) => {
  const blocking = await visit();
  expect(await open(blocking.page, src)).toBe("");
  expect(await draw(blocking.page, 1)).toContain(directive);
  expect(await draw(blocking.page, 2)).toBe("");
  const { page, said } = await visit({ [directive]: allowed });
  expect(await open(page, src)).toBe("");
  expect(await draw(page, 1)).toBe("");
  expect(said).toEqual([]);
});

test("img-src without blob: a book cannot be printed, and says so", async () => {
  const { page } = await visit();
  expect(await open(page, "/book.json")).toBe("");
  const printed = page.evaluate(() =>
    document.querySelector("turnleaf-book")?.print().then(String, String),
  );
  expect(await printed).toContain("img-src");
});

test("trusted-types without turnleaf: a PDF says what to allow, images open", async () => {
  const { page } = await visit({ "trusted-types": "'none'" });
  expect(await open(page, "/book.pdf")).toContain("trusted-types");
  expect(await open(page, "/book.json")).toBe("");
});
