/** The built viewer in a page without an origin of its own, as in a frame with `sandbox` and without `allow-same-origin`. */

import type { TurnleafBook } from "turnleaf";
import { expect, test } from "vitest";
import { sevenZip } from "../../turnleaf/src/for_tests/stored_archives.ts";
import { tinyEpub } from "../../turnleaf/src/sources/epub/tiny_epub.ts";
import { pdf, png } from "./books.ts";
import { pageForTests } from "./browser.ts";
import { sitesForTests } from "./viewer_page.ts";

const sites = sitesForTests();
const tests = pageForTests({ viewport: { width: 400, height: 300 } });

const files: Record<string, Buffer | string> = {
  "/book.pdf": pdf(4),
  "/book.epub": Buffer.from(
    tinyEpub({
      chapters: [
        '<p id="a">One <a href="c2.xhtml">link</a></p><img src="1.png" alt=""/>',
        "<p>Two</p>",
      ],
      css: "p { color: #00f; height: 100vh }",
      files: { "1.png": png(60, 90) },
    }),
  ),
  "/comic.cb7": Buffer.from(sevenZip({ "1.png": png(60, 90), "2.png": png(60, 90) })),
  "/book.json": JSON.stringify({ pages: ["1.png", "2.png"] }),
  "/1.png": png(60, 90),
  "/2.png": png(60, 90),
};

test.each([
  ["book.json", ""],
  ["book.pdf", "1"],
  ["comic.cb7", ""],
  ["book.epub", "One"],
])(
  "%s opens there, turns and is read, and its place is kept as far as may be",
  async (src, words) => {
    const site = await sites.serve((path) => files[path] ?? null, "sandbox allow-scripts");
    const { page } = tests;
    await page.goto(site.url);
    const said = await page.evaluate(async (address) => {
      const book = document.createElement("turnleaf-book") as TurnleafBook;
      for (const name of ["address", "remember", "controls"]) book.setAttribute(name, "");
      book.setAttribute("duration", "20");
      const happened = new Promise<string>((resolve) => {
        book.addEventListener("load", () => resolve(""), { once: true });
        book.addEventListener("error", (event) => resolve(event.detail.message), { once: true });
        book.addEventListener("pageerror", (event) => resolve(event.detail.message), {
          once: true,
        });
      });
      book.src = address;
      document.body.append(book);
      const error = await happened;
      if (error !== "") return { error };
      const { width } = await book.drawPage(1, 40);
      const hits = await book.search("o");
      const isTurned = await book.next();
      return { error, width, isTurned, hits: hits.length, origin: globalThis.origin };
    }, src);
    expect(said).toMatchObject({ error: "", width: 40, isTurned: true, origin: "null" });
    if (words === "One") expect(said.hits).toBeGreaterThan(0);
  },
);
