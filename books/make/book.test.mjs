/** The committed book is what its script makes, and is whole. */
import { readFileSync } from "node:fs";
import { getDocument } from "pdfjs-dist/legacy/build/pdf.mjs";
import { beforeAll, describe, expect, it } from "vitest";
import { makeBook } from "./book.mjs";
import { PLATES } from "./plates/index.mjs";
import { chapter, extracts } from "./text.mjs";

const file = readFileSync(new URL("../moby-dick.pdf", import.meta.url));
const letters = (text) => text.replace(/[^\p{L}\d]/gu, "").toLowerCase();
let pdf;

// PDF.js wants what Node has from 22 on.
Promise.withResolvers ??= function withResolvers() {
  const made = {};
  made.promise = new Promise((resolve, reject) => Object.assign(made, { resolve, reject }));
  return made;
};

/** All text of a page, in the order it was drawn. */
async function textOf(n) {
  const { items } = await (await pdf.getPage(n)).getTextContent();
  return items.map((item) => item.str).join(" ");
}

beforeAll(async () => {
  pdf = await getDocument({ data: new Uint8Array(file), verbosity: 0 }).promise;
});

describe("the committed book", () => {
  it("is what the script makes, to the byte", async () => {
    const { bytes } = await makeBook();
    expect(bytes.equals(file)).toBe(true);
  });

  it("has whole gatherings, at least sixty pages, under two megabytes", () => {
    expect(pdf.numPages).toBeGreaterThanOrEqual(60);
    expect(pdf.numPages % 4).toBe(0);
    expect(file.length).toBeLessThan(2_000_000);
  });

  it("says who wrote it, what it is called and in what language", async () => {
    const { info } = await pdf.getMetadata();
    expect(info.Title).toMatch(/^Moby-Dick; or, The Whale/);
    expect(info.Author).toBe("Herman Melville");
    expect(info.Language).toBe("en");
  });

  it("lists every chapter in the outline, each at its opening", async () => {
    const outline = await pdf.getOutline();
    for (let n = 1; n <= 14; n++) {
      const { title } = chapter(n);
      const entry = outline.find((item) => item.title === `${n}. ${title}`);
      expect(entry, title).toBeDefined();
      const [ref] =
        typeof entry.dest === "string" ? await pdf.getDestination(entry.dest) : entry.dest;
      const text = await textOf((await pdf.getPageIndex(ref)) + 1);
      expect(letters(text)).toContain(letters(`Chapter ${n} ${title}`));
    }
  });

  it("labels its pages: cover, roman front matter, arabic from chapter 1", async () => {
    const labels = await pdf.getPageLabels();
    expect(labels[0]).toBe("Cover");
    expect(labels[4]).toBe("i");
    expect(labels.at(-1)).toBe("Back cover");
    const first = labels.indexOf("1");
    expect(first % 2).toBe(0); // an even index is a right-hand page
    const [opening] = (await pdf.getOpenAction()).get("dest");
    expect(await pdf.getPageIndex(opening)).toBe(first);
    expect(letters(await textOf(first + 1))).toContain("loomings");
  });

  it("embeds every font", () => {
    const source = file.toString("latin1");
    const descriptors = source.match(/\/Type \/FontDescriptor[\s\S]*?endobj/g);
    expect(descriptors.length).toBeGreaterThanOrEqual(3);
    for (const descriptor of descriptors) expect(descriptor).toMatch(/\/FontFile[23]? /);
    expect(source).not.toMatch(/\/Subtype \/Type1\b/);
  });

  it("links the contents to the chapters", async () => {
    const labels = await pdf.getPageLabels();
    const links = await (await pdf.getPage(labels.indexOf("vii") + 1)).getAnnotations();
    expect(links.filter((link) => link.subtype === "Link")).toHaveLength(16);
  });
});

describe("its text", () => {
  it("prints every word of the chapters, in order", { timeout: 120_000 }, async () => {
    let printed = "";
    for (let n = 1; n <= pdf.numPages; n++) printed += letters(await textOf(n));
    for (let n = 1; n <= 14; n++) {
      for (const block of chapter(n).blocks) {
        const words = block.text ?? block.lines.join(" ");
        // A paragraph may run over a page's foot, with a folio and a head between.
        for (const sentence of words.split(/(?<=[.!?;,—])\s*/)) {
          if (sentence.length > 12 && sentence.length < 60) continue;
          const want = letters(sentence);
          const half = Math.floor(want.length / 2);
          const found = printed.includes(want.slice(0, half)) || printed.includes(want.slice(half));
          expect(found, sentence).toBe(true);
        }
      }
    }
  });

  it("captions plates with words of the chapters", () => {
    const all = Array.from({ length: 14 }, (_, i) => chapter(i + 1).blocks)
      .flat()
      .map((block) => letters(block.text ?? block.lines.join(" ")))
      .join("");
    for (const { caption } of PLATES) expect(all, caption).toContain(letters(caption));
  });

  it("leaves no straight quotation mark and no lone opening mark", () => {
    for (let n = 1; n <= 14; n++) {
      for (const block of chapter(n).blocks) {
        const text = block.text ?? block.lines.join(" ");
        expect(text).not.toMatch(/["']|[“‘]( |$)|--/);
      }
    }
    expect(extracts().quotes.length).toBeGreaterThan(20);
  });
});
