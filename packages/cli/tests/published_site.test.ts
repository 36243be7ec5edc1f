/** A site of `turnleaf publish` in a real Chromium. */

import { cpSync, existsSync, readdirSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import type { TurnleafBook } from "turnleaf";
import { beforeAll, describe, expect, it } from "vitest";
import { png, textPdf } from "./books.ts";
import {
  filesOf,
  folder,
  patience,
  publish,
  removeFolders,
  small,
  visitorForTests,
} from "./publishing.ts";

removeFolders();
const { newPage, visit } = visitorForTests();

/** Runs in a page. Returns the width of an image's file once it is loaded. */
const widthOnceLoaded = async (element: SVGElement | HTMLElement): Promise<number> => {
  const image = element as HTMLImageElement;
  if (!image.complete || image.naturalWidth === 0) {
    await new Promise((resolve) => image.addEventListener("load", resolve, { once: true }));
  }
  return image.naturalWidth;
};

describe("a site of three books", () => {
  let site: string;
  let ended: Awaited<ReturnType<typeof publish>>;

  beforeAll(async () => {
    const path = folder({
      "whale.pdf": textPdf({
        title: 'The <b>Whale</b> & "Others"',
        pages: [
          ["Call me Ishmael. I saw a divid-", "ed sea."],
          ...Array.from({ length: 22 }, (_, k) => [
            `This is page ${k + 2}.`,
            k === 20 ? "Ein Kaf\\351 am Meer" : "",
          ]),
        ],
      }),
      "scans/01.png": png(300, 400, 90),
      "scans/02.png": png(300, 400, 200),
      "manga.pdf": textPdf({
        title: "Manga",
        author: "Ann Author",
        pages: [["one"], ["two"], ["three"], ["four"], ["five"]],
      }),
      "catalogue.json": JSON.stringify({
        books: [
          {
            file: "whale.pdf",
            authors: ["<script>alert(1)</script>"],
            licence: "CC-BY-4.0",
            language: "en-GB",
          },
          { file: "scans", title: "Scans", licence: "javascript:alert(1)" },
          {
            file: "manga.pdf",
            direction: "rtl",
            language: "ja",
            licence: "https://example.org/terms",
          },
        ],
      }),
    });
    site = join(folder(), "site");
    ended = await publish([
      ...["--catalogue", join(path, "catalogue.json"), "--out", site, ...small],
      ...["--url", "https://books.example/library", "--title", "Three <Books>"],
    ]);
  }, patience);

  it("is published", () => {
    expect(ended).toMatchObject({
      status: 0,
      stdout: expect.stringContaining("3 books, 3 drawn, 0 unchanged"),
    });
    expect(JSON.parse(readFileSync(join(site, "report.json"), "utf8"))).toEqual({
      books: 3,
      failures: [],
    });
  });

  it("has language and licence of each book, and escapes what it was given", async () => {
    const { page, said } = await visit(site, "", { javaScriptEnabled: false });
    expect(await page.locator("h1").textContent()).toBe("Three <Books>");
    const cards = await page.locator(".shelf li").allTextContents();
    expect(cards[0]).toContain('The <b>Whale</b> & "Others"');
    expect(cards[0]).toContain("<script>alert(1)</script>");
    expect(cards[0]).toContain("British English · 23 pages · CC BY 4.0");
    expect(cards[1]).toContain("2 pages · javascript:alert(1)");
    expect(cards[2]).toContain("Ann Author");
    expect(cards[2]).toContain("Japanese · 5 pages · example.org/terms");
    await page.locator(".shelf a").nth(1).click();
    expect(await page.locator('a[href^="javascript" i]').count()).toBe(0);
    expect(said).toEqual([]);
  });

  it("has the text of every page without JavaScript", async () => {
    const { page } = await visit(site, "books/whale/", { javaScriptEnabled: false });
    await page.getByText("Read it page by page").click();
    expect(await page.locator("#page-1 .words").textContent()).toContain("I saw a divided sea.");
    for (let number = 1; number <= 20; number++) {
      expect(await page.locator(`#page-${number} .words`).count()).toBe(1);
    }
    await page.locator("a[rel=next]").first().click();
    expect(await page.locator("#page-23 .words").textContent()).toContain("This is page 23.");
    const picture = page.locator("#page-22 img");
    await picture.scrollIntoViewIfNeeded();
    expect(await picture.evaluate(widthOnceLoaded)).toBeGreaterThan(40);
  });

  it("turns the pages of a book under its own policy, asks for nothing outside", async () => {
    const { page, server, said } = await visit(site, "books/manga/#page=2");
    await page.waitForFunction(() => document.querySelector("turnleaf-book")?.ready);
    const book = page.locator("turnleaf-book");
    expect(
      await book.evaluate((book: TurnleafBook) => [book.bookTitle, book.pageCount, book.page]),
    ).toEqual(["Manga", 5, 2]);
    const outside: string[] = [];
    page.on("request", (request) => {
      if (!request.url().startsWith(server.url) && !/^(blob|data):/.test(request.url()))
        outside.push(request.url());
    });
    await book.evaluate((book: TurnleafBook) => book.next());
    expect(await book.evaluate((book: TurnleafBook) => book.page)).toBe(4);
    const hits = await book.evaluate((book: TurnleafBook) => book.search("three"));
    expect(hits).toHaveLength(1);
    expect(outside).toEqual([]);
    expect(said.filter((line) => !/GPU stall|GL Driver/.test(line))).toEqual([]);
    const policy = await page
      .locator("meta[http-equiv=Content-Security-Policy]")
      .getAttribute("content");
    expect(policy).not.toContain("unsafe-inline");
    expect(policy).toContain("default-src 'none'");
  });

  it("finds a word in all books, on its page", async () => {
    const { page, said } = await visit(site, "");
    await page.getByRole("searchbox").fill("kafe meer");
    await page.getByRole("button", { name: "Search" }).click();
    await page.locator("#results li").waitFor();
    expect(await page.locator("#search-state").textContent()).toBe("1 book has kafe meer.");
    expect(await page.locator("#results mark").textContent()).toBe("Kafé");
    expect(await page.locator("#results a[href*='#page=22']").count()).toBe(1);
    await page.goto(page.url().replace(/q=.*/, "q=thr"));
    await page.locator("#results li").waitFor();
    expect(await page.locator("#results .title").textContent()).toBe("Manga");
    await page.goto(page.url().replace(/q=.*/, "q=walrus"));
    await page.getByText("No book has walrus.").waitFor();
    expect(said).toEqual([]);
  });

  it("has IIIF manifests whose pictures are there in every size that they name", async () => {
    const base = "https://books.example/library/books/manga/";
    const read = (name: string) =>
      JSON.parse(readFileSync(join(site, "books/manga", name), "utf8"));
    const manifest = read("manifest.json");
    expect(manifest).toMatchObject({
      id: `${base}manifest.json`,
      type: "Manifest",
      label: { ja: ["Manga"] },
      viewingDirection: "right-to-left",
    });
    expect(manifest.items).toHaveLength(5);
    for (const [k, canvas] of manifest.items.entries()) {
      const { body } = canvas.items[0].items[0];
      const info = read(`iiif/${k + 1}/info.json`);
      expect(body.service[0].id).toBe(info.id);
      expect([info.width, info.height]).toEqual([canvas.width, canvas.height]);
      expect(existsSync(join(site, "books/manga", body.id.slice(base.length)))).toBe(true);
      for (const { width, height } of info.sizes) {
        const size = width === info.width ? "max" : `${width},${height}`;
        expect(existsSync(join(site, `books/manga/iiif/${k + 1}/full/${size}/0/default.jpg`))).toBe(
          true,
        );
      }
      const [{ id }] = canvas.annotations;
      expect(read(id.slice(base.length)).items[0].body.value).toBe(
        ["one", "two", "three", "four", "five"][k],
      );
    }
    expect(readFileSync(join(site, "sitemap.xml"), "utf8")).toContain(
      `<loc>${base}text/1.html</loc>`,
    );
  });

  it("has a IIIF manifest that opens as the same book", async () => {
    // At the address that it was published for, where nothing else is.
    const url = "https://books.example/library/";
    const page = await newPage({ viewport: { width: 300, height: 300 } });
    const missing: string[] = [];
    await page.route("**/*", async (route) => {
      const address = decodeURIComponent(route.request().url().split(/[?#]/, 1)[0] ?? "");
      const file = join(site, address.slice(url.length), address.endsWith("/") ? "index.html" : "");
      const isThere = address.startsWith(url) && existsSync(file);
      if (!isThere) missing.push(address);
      await (isThere ? route.fulfill({ path: file }) : route.fulfill({ status: 404 }));
    });
    await page.goto(`${url}books/manga/`);
    const opened = await page.evaluate(async () => {
      const book = document.createElement("turnleaf-book");
      const loading = new Promise<void>((resolve, reject) => {
        book.addEventListener("load", () => resolve());
        book.addEventListener("error", ({ detail }) => reject(new Error(detail.message)));
      });
      book.src = "manifest.json";
      document.body.replaceChildren(book);
      await loading;
      const hits = await book.search("four");
      return [book.bookTitle, book.pageCount, hits.length, hits[0]?.page];
    });
    expect(opened).toEqual(["Manga", 5, 1, 4]);
    await page.waitForFunction(() => document.querySelector("turnleaf-book")?.ready);
    expect(missing).toEqual([]);
  });

  it("is read offline after the first visit", async () => {
    const { page, server } = await visit(site, "books/manga/");
    const book = page.locator("turnleaf-book");
    await page.waitForFunction(() => document.querySelector("turnleaf-book")?.ready);
    await page.getByRole("button", { name: "Keep for reading offline" }).click();
    await page.getByText("Kept: the whole book").waitFor();
    await server.stop();
    await page.context().setOffline(true);
    await page.reload();
    await page.waitForFunction(() => document.querySelector("turnleaf-book")?.ready);
    await book.evaluate((book: TurnleafBook) => book.goTo(5));
    await page.waitForFunction(() => document.querySelector("turnleaf-book")?.ready);
    expect(await book.evaluate((book: TurnleafBook) => [book.pageCount, book.page])).toEqual([
      5, 4,
    ]);
  });

  it("is left as it is by a second run, but for a book that changed", async () => {
    const before = filesOf(site);
    const path = folder();
    const list = join(path, "catalogue.json");
    cpSync(site, join(path, "site"), { recursive: true });
    const whale = join(path, "other.pdf");
    writeFileSync(whale, textPdf({ title: "Other", pages: [["new"]] }));
    writeFileSync(list, JSON.stringify({ books: [whale] }));
    const again = await publish(["--catalogue", list, "--out", join(path, "site"), ...small]);
    expect(again.stdout).toContain("1 book, 1 drawn, 0 unchanged");
    expect(readdirSync(join(path, "site/books"))).toEqual(["other"]);
    expect(filesOf(site)).toEqual(before);
  });
});
