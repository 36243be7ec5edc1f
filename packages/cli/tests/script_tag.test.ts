/** The built files for a script tag, on pages without an import map, under a strict policy. */

import { readFileSync } from "node:fs";
import type { Page } from "playwright-core";
import { expect, test } from "vitest";
import { pdf, png } from "./books.ts";
import { chromiumForTests, hearComplaints, pageForTests } from "./browser.ts";
import { sitesForTests } from "./viewer_page.ts";
import { askBook as ask, bookComesTo, bookSettles, comesTo } from "./waiting.ts";

const sites = sitesForTests();
const tests = pageForTests({ viewport: { width: 400, height: 300 } });
const others = chromiumForTests();

const policy =
  "default-src 'none'; script-src 'self' 'wasm-unsafe-eval'; worker-src blob:; style-src 'self'; connect-src 'self'";

/** Opens a page of a body and scripts. Returns it with its console messages. */
async function visit(
  body: string,
  { head = "", script = "", javaScriptEnabled = true } = {},
): Promise<{ page: Page; said: string[]; asked: string[] }> {
  const files: Record<string, Buffer | string> = {
    "/page.html": `<!doctype html><title>Page</title><link rel="stylesheet" href="/page.css">${head}<body>${body}</body>`,
    "/page.js": script,
    "/book.pdf": pdf(8, "Eight pages"),
    "/not-a-book.pdf": Buffer.from([0, 1, 2, 3]),
  };
  const site = await sites.serve(
    (path) => files[path] ?? (path.endsWith(".png") ? png(60, 90) : null),
    policy,
  );
  const page = javaScriptEnabled ? tests.page : await others.newPage({ javaScriptEnabled });
  const said: string[] = [];
  hearComplaints(page, said);
  await page.goto(`${site.url}page.html`);
  return { page, said, asked: site.asked };
}

const standalone = '<script type="module" src="/turnleaf/standalone.js"></script>';

test("no file that standalone.js loads needs a name that an import map would give", () => {
  const dist = new URL("../../turnleaf/dist/", import.meta.url);
  const read = (name: string) => readFileSync(new URL(name, dist), "utf8");
  const found = new Set<string>();
  const follow = (name: string) => {
    // standalone.js replaces that of the viewer.
    if (found.has(name) || name.startsWith("webgl_backend")) return;
    found.add(name);
    const targets = read(name).matchAll(/(?:\bfrom|\bimport\(?)\s*["'`]([\w@./-]+)["'`]/g);
    for (const [, target] of targets) {
      expect(target, name).toMatch(/^\.\/[\w.-]+\.js$/);
      follow(target.slice(2));
    }
  };
  follow("standalone.js");
  const leadsTo = (part: string) => [...found].filter((name) => name.startsWith(part)).length;
  const parts = [
    "three.module",
    "standalone_webgl_backend",
    "standalone_photographs",
    "replay",
    "pdf.worker",
  ];
  expect(parts.map(leadsTo)).toEqual([1, 1, 1, 1, 1]);
});

test("one script tag shows a PDF in 3D, which turns", async () => {
  const { page, said, asked } = await visit(
    `${standalone}<turnleaf-book src="book.pdf" page="2"></turnleaf-book>`,
  );
  await bookSettles(page);
  expect(await ask(page, (book) => [book.bookTitle, book.pageCount])).toEqual(["Eight pages", 8]);
  await page.locator("turnleaf-book").press("ArrowRight");
  await bookComesTo(page, (book) => book.page, 4);
  await bookSettles(page);
  expect(asked.filter((path) => /three|webgl_backend/.test(path)).length).toBe(2);
  expect(asked.filter((path) => path.includes("canvas2d_backend"))).toEqual([]);
  expect(said).toEqual([]);
});

test("it is one element with index.js, which needs a map", async () => {
  const index = '<script type="module" src="/turnleaf/index.js"></script>';
  const { page, said } = await visit(
    `<turnleaf-book src="book.pdf"></turnleaf-book>${standalone}${index}`,
  );
  await bookSettles(page);
  expect(said).toEqual([]);
});

test("a leaf turned in photographs needs no map either", async () => {
  const { page, said } = await visit(`${standalone}<turnleaf-book src="book.pdf"></turnleaf-book>`);
  await bookSettles(page);
  // What is there is no photograph: the code that reads one is there, and says so.
  const error = await ask(page, (book) => {
    const said = new Promise<string>((resolve) =>
      book.addEventListener("error", ({ detail }) => resolve(detail.message)),
    );
    book.modelSrc = "/book.pdf";
    book.model = "photographs";
    void book.next();
    return said;
  });
  expect(error).not.toContain("could not be loaded");
  expect(said).toEqual([]);
});

test("a link with data-turnleaf becomes a book, with what it says of it", async () => {
  const { page, said } = await visit(
    `<p><a href="book.pdf" data-turnleaf data-turnleaf-page="3" data-turnleaf-swipe-distance="20"
      data-turnleaf-onclick="alert(1)" data-turnleaf-engine-src="/evil.wasm"
      data-turnleaf-style="color: red" data-turnleaf-id="x" data-turnleaf-src="/other.pdf"
      data-turnleaf-pdf-worker="/evil.js">A book</a></p>
    <p><a href="none.pdf">A link</a></p>`,
    { head: standalone },
  );
  await bookComesTo(page, (book) => book.pageCount, 8);
  expect(await ask(page, (book) => [book.page, book.controls])).toEqual([2, true]);
  const attributes = await ask(page, (book) => [...book.attributes].map(({ name }) => name));
  expect(attributes.sort()).toEqual(["controls", "page", "src", "swipe-distance"]);
  expect(await page.locator("a").allTextContents()).toEqual(["A link"]);
  expect(said).toEqual([]);
});

test("a link whose book does not open is a link again", async () => {
  const { page } = await visit(
    `<p>One: <a href="not-a-book.pdf" data-turnleaf data-turnleaf-controls="off">A book</a></p>`,
    { head: standalone },
  );
  await page.locator("turnleaf-book").waitFor({ state: "detached" });
  expect(await page.locator("p").textContent()).toBe("One: A book");
  expect(await page.locator("a").getAttribute("href")).toBe("not-a-book.pdf");
});

test("a link stays where there is no JavaScript", async () => {
  const { page } = await visit('<a href="book.pdf" data-turnleaf>A book</a>', {
    head: standalone,
    javaScriptEnabled: false,
  });
  expect(await page.locator("a").textContent()).toBe("A book");
  expect(await page.locator("turnleaf-book").count()).toBe(0);
});

test("links that come later become books by openLinks", async () => {
  const { page, said } = await visit(`<div></div>${standalone}`, {
    head: '<script type="module" src="/page.js"></script>',
    script: `import { openLinks } from "/turnleaf/links.js";
      const div = document.querySelector("div");
      div.innerHTML = '<a href="book.pdf" data-turnleaf data-turnleaf-controls="off">A book</a>';
      openLinks(div);`,
  });
  await bookSettles(page);
  expect(await ask(page, (book) => [book.pageCount, book.controls])).toEqual([8, false]);
  expect(said).toEqual([]);
});

test("page-flip's global is there at once, for a plain script tag", async () => {
  const { page, said } = await visit(
    `<div id="book"><div class="my-page">One</div><div class="my-page">Two</div>
      <div class="my-page">Three</div><div class="my-page">Four</div></div>
    <script src="/turnleaf/page-flip.browser.js"></script><script src="/page.js"></script>`,
    {
      script: `const pageFlip = new St.PageFlip(document.getElementById("book"), { width: 60, height: 90, flippingTime: 200 });
        pageFlip.loadFromHTML(document.querySelectorAll(".my-page"));
        pageFlip.flipNext();
        window.flipped = [];
        pageFlip.on("flip", ({ data, object }) => window.flipped.push([data, object === pageFlip]));`,
    },
  );
  await comesTo(page, () => Reflect.get(window, "flipped"), [[2, true]]);
  await bookSettles(page);
  expect(await ask(page, (book) => [book.pageCount, book.page])).toEqual([4, 3]);
  // A picture of a page of HTML needs what this policy does not allow: it is shown when it is live.
  expect(said.filter((text) => !/Content Security Policy/.test(text))).toEqual([]);
});
