/** `turnleaf publish`: the built command, and its sites in a real Chromium. */

import { type ChildProcess, spawn } from "node:child_process";
import { createHash } from "node:crypto";
import {
  cpSync,
  existsSync,
  readdirSync,
  readFileSync,
  rmSync,
  statSync,
  writeFileSync,
} from "node:fs";
import { join } from "node:path";
import { fileURLToPath } from "node:url";
import { type Browser, chromium, type Page } from "playwright-core";
import type { TurnleafBook } from "turnleaf";
import { afterAll, afterEach, beforeAll, describe, expect, it, test } from "vitest";
import { chromiumArguments, findChromium } from "../../../scripts/chromium.mjs";
import { parseCommand } from "../src/arguments.ts";
import { listBooks } from "../src/publish/catalogue.ts";
import { pdfOf, png, protectedPdf, textPdf } from "./books.ts";
import { type Ended, folderOf } from "./command.ts";
import { type SiteServer, serveSite } from "./site_server.ts";

const main = fileURLToPath(new URL("../dist/main.js", import.meta.url));
/** Small pictures: drawing is in software here. */
const small = ["--size", "256", "--workers", "2"];
/** Books of the tests of many; `TURNLEAF_BOOKS=200 npx vitest run publish` for more. */
const bookCount = Number(process.env.TURNLEAF_BOOKS ?? 4);
const patience = 60_000 + 10_000 * bookCount;

const folders: ReturnType<typeof folderOf>[] = [];
const servers: SiteServer[] = [];
let browser: Browser;

beforeAll(async () => {
  browser = await chromium.launch({ executablePath: findChromium(), args: chromiumArguments });
});
afterEach(async () => {
  for (const context of browser.contexts()) await context.close();
  for (const server of servers.splice(0)) await server.stop();
});
afterAll(async () => {
  await browser?.close();
  for (const folder of folders) folder.remove();
}, patience);

function folder(files: Record<string, string | Uint8Array> = {}): string {
  const made = folderOf(files);
  folders.push(made);
  return made.path;
}

/** Runs the command; `watch` sees it while it runs. */
function publish(
  args: readonly string[],
  watch?: (child: ChildProcess) => void,
): Promise<Pick<Ended, "status" | "stdout" | "stderr">> {
  return new Promise((resolve) => {
    const env = { ...process.env, CHROMIUM: findChromium() };
    const child = spawn(process.execPath, [main, "publish", ...args], { env });
    const text = { stdout: "", stderr: "" };
    child.stdout.on("data", (data) => {
      text.stdout += data;
    });
    child.stderr.on("data", (data) => {
      text.stderr += data;
    });
    child.on("close", (status) => resolve({ status, ...text }));
    watch?.(child);
  });
}

/** Returns every file below a folder with a hash of its bytes. */
function filesOf(path: string): Record<string, string> {
  const names = readdirSync(path, { recursive: true }) as string[];
  const files = names.sort().filter((name) => statSync(join(path, name)).isFile());
  return Object.fromEntries(
    files.map((name) => [
      name,
      createHash("sha256")
        .update(readFileSync(join(path, name)))
        .digest("hex"),
    ]),
  );
}

/** Books whose texts differ, in the order of their names. */
function manyBooks(count: number): string[] {
  const names = Array.from(
    { length: count },
    (_, k) => `book-${String(k + 1).padStart(3, "0")}.pdf`,
  );
  const path = folder(
    Object.fromEntries(
      names.map((name, k) => [
        name,
        textPdf({
          title: `Volume ${k + 1}`,
          pages: [["Volume", `number ${k + 1}`], [k % 3 === 0 ? "an albatross" : "a sparrow"]],
        }),
      ]),
    ),
  );
  return names.map((name) => join(path, name));
}

async function visit(
  site: string,
  address = "",
  options = {},
): Promise<{ page: Page; server: SiteServer; said: string[] }> {
  const server = await serveSite(site);
  servers.push(server);
  const page = await (await browser.newContext(options)).newPage();
  const said: string[] = [];
  page.on("pageerror", (error) => said.push(error.message));
  page.on("console", (message) => {
    if (/error|warning/.test(message.type())) said.push(message.text());
  });
  await page.goto(server.url + address);
  return { page, server, said };
}

describe("what cannot be published ends with one sentence", () => {
  it.each([
    [[], "Name the site's folder: --out site"],
    [["--out", "site"], "Name a book to publish."],
    [["--out", "site", "--merge"], "Name the folders of the shards."],
    [["a.pdf", "--out", "site", "--shard", "3/2"], "--shard is a part of all, such as 2/8."],
    [["a.pdf", "--out", "site", "--shard", "0/2"], "--shard is a part of all, such as 2/8."],
    [["a.pdf", "--out", "s", "--merge", "--shard", "1/2"], "--merge takes the folders of shards"],
    [["a.pdf", "--out", "site", "--format", "gif"], "--format is jpeg or webp."],
    [["a.pdf", "--out", "site", "--quality", "0"], "--quality takes a number from 1 to 100."],
    [["a.pdf", "--out", "site", "--workers", "1.5"], "--workers takes a whole number"],
    [["a.pdf", "--out", "site", "--url", "javascript:1"], "--url is the site's address"],
  ])("%j", (args, sentence) => {
    expect(() => parseCommand(["publish", ...args])).toThrow(sentence);
  });

  it.each([
    ["{", "is no valid JSON; correct it."],
    ['{"pages": []}', 'has no list of "books"; add one.'],
    ['{"books": [{}]}', 'book 1 has no "file".'],
    [
      '{"books": ["a.pdf", {"file": "b.pdf", "rights": "CC0"}]}',
      'book 2 has an unknown member "rights".',
    ],
    ['{"books": [{"file": "a.pdf", "id": "../a"}]}', "has an id that is not of lower-case letters"],
    ['{"books": [{"file": "a.pdf", "id": "con"}]}', "has an id that is not of lower-case letters"],
    [
      '{"books": [{"file": "a.pdf", "id": "a"}, {"file": "b.pdf", "id": "a"}]}',
      "the id a is given twice",
    ],
    ['{"books": [{"file": "a.pdf", "language": "not a tag"}]}', "has a language that is no tag"],
    [
      '{"books": [{"file": "a.pdf", "direction": "up"}]}',
      'has a direction that is neither "ltr" nor "rtl".',
    ],
    ['{"books": [{"file": "a.pdf", "title": 7}]}', "has a title that is no text"],
    ['{"books": [{"file": "a.pdf", "authors": [7]}]}', "has authors that are no list of names"],
  ])("a catalogue %s", async (text, sentence) => {
    const path = folder({ "catalogue.json": text });
    await expect(listBooks([], join(path, "catalogue.json"))).rejects.toThrow(sentence);
  });
});

test("a book's name in the site is one part of a path, whatever its file is called", async () => {
  const names = [
    "../../etc/passwd",
    "/a/..",
    "a/CON.pdf",
    "Ein Buch!.pdf",
    "ein-buch.epub",
    "本.pdf",
    "?.pdf",
  ];
  const long = `${"長".repeat(60)}.pdf`;
  const books = await listBooks([...names, long, long], undefined);
  const ids = books.map(({ id }) => id);
  expect(ids).toEqual([
    ...["passwd", "book", "book-con", "ein-buch", "ein-buch-2", "本", "book-2"],
    ...["長".repeat(33), `${"長".repeat(33)}-2`],
  ]);
});

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
    await expect
      .poll(() => picture.evaluate((image: HTMLImageElement) => image.naturalWidth))
      .toBeGreaterThan(40);
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
    const page = await browser.newPage({ viewport: { width: 300, height: 300 } });
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
    await page.close();
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

test("--keep-file publishes the book's own file with its text", { timeout: patience }, async () => {
  const path = folder({ "a.pdf": textPdf({ title: "A", pages: [["first"], ["second"]] }) });
  const site = join(path, "site");
  const { status } = await publish([join(path, "a.pdf"), "--out", site, "--keep-file", ...small]);
  expect(status).toBe(0);
  expect(readFileSync(join(site, "books/a/book.pdf"))).toEqual(readFileSync(join(path, "a.pdf")));
  expect(readdirSync(join(site, "books/a/iiif"))).toEqual(["1"]);
  const { page } = await visit(site, "books/a/#page=2");
  await page.waitForFunction(() => document.querySelector("turnleaf-book")?.ready);
  const book = page.locator("turnleaf-book");
  expect(await book.evaluate((book: TurnleafBook) => [book.pageCount, book.page])).toEqual([2, 2]);
  await page.goto(page.url().replace(/#.*/, "text/1.html"));
  expect(await page.locator("#page-2").textContent()).toContain("second");
});

test("a broken book is reported and the others are published", { timeout: patience }, async () => {
  const path = folder({
    "good.pdf": textPdf({ title: "Good", pages: [["fine"]] }),
    "broken.pdf": "%PDF-1.7\nnothing",
    "locked.pdf": protectedPdf,
    "mixed/1.png": png(30, 40),
    "mixed/2.png": Buffer.from("\x89PNG\r\n\x1a\nno picture", "latin1"),
  });
  const site = join(path, "site");
  const books = ["broken.pdf", "good.pdf", "locked.pdf", "mixed", "missing.pdf"];
  const { status, stderr } = await publish([
    ...books.map((name) => join(path, name)),
    "--out",
    site,
    ...small,
  ]);
  expect(status).toBe(1);
  const { failures } = JSON.parse(readFileSync(join(site, "report.json"), "utf8"));
  expect(failures.map(({ id, page }: { id: string; page?: number }) => [id, page])).toEqual([
    ["broken", undefined],
    ["locked", undefined],
    ["mixed", 2],
    ["missing", undefined],
  ]);
  expect(stderr).toContain("broken.pdf is damaged or no PDF; repair the file or get it again.");
  expect(stderr).toContain("locked.pdf is protected by a password");
  expect(stderr).toContain("4 failures; the rest was published.");
  expect(readdirSync(join(site, "books")).sort()).toEqual(["good", "mixed"]);
  expect(readFileSync(join(site, "books/mixed/text/1.html"), "utf8")).toContain(
    "This page could not be drawn",
  );
});

test("a page that takes too long is given up, and the next is drawn", {
  timeout: patience,
}, async () => {
  // A picture that is a web page's whole day of work: nested forms, each of which draws the next ten times.
  const slow = slowPdf();
  const path = folder({ "slow.pdf": slow });
  const site = join(path, "site");
  const { status, stderr } = await publish([
    ...[join(path, "slow.pdf"), "--out", site, "--page-seconds", "5", ...small],
  ]);
  expect(stderr).toContain("Page 1 took longer than 5 s and was given up.");
  expect(status).toBe(1);
  const { failures } = JSON.parse(readFileSync(join(site, "report.json"), "utf8"));
  expect(failures).toEqual([expect.objectContaining({ id: "slow", page: 1 })]);
  expect(existsSync(join(site, "books/slow/iiif/2/full/max/0/default.jpg"))).toBe(true);
});

test(`${bookCount} books in two shards are the same bytes as in one run`, {
  timeout: 3 * patience,
}, async () => {
  const books = manyBooks(bookCount);
  const path = folder();
  const [one, a, b, merged] = ["one", "a", "b", "merged"].map((name) => join(path, name));
  const options = [...small, "--url", "https://books.example/"];
  expect((await publish([...books, "--out", one!, ...options])).status).toBe(0);
  for (const [out, shard] of [
    [a!, "1/2"],
    [b!, "2/2"],
  ] as const) {
    expect((await publish([...books, "--out", out, ...options, "--shard", shard])).status).toBe(0);
  }
  const missing = await publish(["--merge", a!, "--out", merged!, ...options]);
  expect([missing.status, missing.stderr]).toEqual([1, "Shard 2 of 2 is missing.\n"]);
  rmSync(merged!, { recursive: true });
  // In any order.
  expect((await publish(["--merge", b!, a!, "--out", merged!, ...options])).status).toBe(0);
  expect(filesOf(merged!)).toEqual(filesOf(one!));
  expect(Object.keys(filesOf(one!)).length).toBeGreaterThan(10 * bookCount);
});

test("killed half-way and started again it ends the same, and redoes at most one book a worker", {
  timeout: 3 * patience,
}, async () => {
  const books = manyBooks(bookCount);
  const path = folder();
  const [whole, killed] = ["whole", "killed"].map((name) => join(path, name));
  expect((await publish([...books, "--out", whole!, ...small])).status).toBe(0);
  const finished = (): string[] =>
    existsSync(join(killed!, "books"))
      ? readdirSync(join(killed!, "books")).filter((name) =>
          existsSync(join(killed!, "books", name, "record.json")),
        )
      : [];
  await publish([...books, "--out", killed!, ...small], (child) => {
    const look = setInterval(() => {
      if (finished().length < bookCount / 2) return;
      clearInterval(look);
      child.kill("SIGKILL");
    }, 5);
    child.on("close", () => clearInterval(look));
  });
  const kept = finished().length;
  expect(kept).toBeGreaterThanOrEqual(bookCount / 2);
  expect(kept).toBeLessThan(bookCount);
  const again = await publish([...books, "--out", killed!, ...small]);
  expect(again.stdout).toContain(
    `${bookCount} books, ${bookCount - kept} drawn, ${kept} unchanged`,
  );
  expect(filesOf(killed!)).toEqual(filesOf(whole!));
});

test("a shelf of 1,000 books opens with a bounded number of requests", {
  timeout: 2 * patience,
}, async () => {
  const path = folder({ "a.pdf": textPdf({ title: "A", pages: [["albatross"]] }) });
  const site = join(path, "site");
  const shard = join(path, "shard");
  expect(
    (await publish([join(path, "a.pdf"), "--out", shard, "--shard", "1/1", ...small])).status,
  ).toBe(0);
  // One book is drawn; the others have of its files what shelf and search need.
  const ids = Array.from({ length: 1000 }, (_, k) => `volume-${k + 1}`);
  const drawn = join(shard, "books/a");
  const files = (readdirSync(drawn, { recursive: true }) as string[]).filter((name) =>
    /^(record\.json|words\/.*|text\/1\.json|iiif\/1\/full\/\d.*\.jpg)$/.test(name),
  );
  for (const id of ids) {
    for (const name of files) cpSync(join(drawn, name), join(shard, "books", id, name));
  }
  writeFileSync(
    join(shard, "shard.json"),
    JSON.stringify({ number: 1, count: 1, ids, failures: [] }),
  );
  expect((await publish(["--merge", shard, "--out", site])).status).toBe(0);
  const { page, server } = await visit(site);
  await page.waitForLoadState("networkidle");
  const first = server.asked.filter((address) => !address.includes("service-worker")).length;
  expect(await page.locator(".shelf li").count()).toBe(48);
  // The page, its style, scripts and icon, and the covers in and just below the window.
  expect(first).toBeLessThanOrEqual(60);
  expect(await page.locator("a[rel=next]").getAttribute("href")).toBe("shelf/2.html");
  const before = server.asked.length;
  await page.goto(`${server.url}search.html?q=albatross`);
  await page.locator("#results li").nth(9).waitFor();
  expect(await page.locator("#search-state").textContent()).toBe("1000 books have albatross.");
  expect(server.asked.length - before).toBeLessThanOrEqual(80);
});

/** A PDF whose first page would take hours to draw, and whose second is plain. */
function slowPdf(): Buffer {
  const depth = 9;
  const objects = [
    "<< /Type /Catalog /Pages 2 0 R >>",
    "<< /Type /Pages /Count 2 /Kids [4 0 R 5 0 R] >>",
    "<< /Title (Slow) >>",
    "<< /Type /Page /Parent 2 0 R /MediaBox [0 0 100 100] /Contents 6 0 R /Resources << /XObject << /F 7 0 R >> >> >>",
    "<< /Type /Page /Parent 2 0 R /MediaBox [0 0 100 100] >>",
    "<< /Length 5 >>\nstream\n/F Do\nendstream",
    ...Array.from({ length: depth }, (_, k) => {
      const last = k === depth - 1;
      const content = last ? "0 0 1 1 re f" : "/F Do ".repeat(10);
      const resources = last ? "" : `/Resources << /XObject << /F ${8 + k} 0 R >> >>`;
      return `<< /Type /XObject /Subtype /Form /BBox [0 0 100 100] ${resources} /Length ${content.length} >>\nstream\n${content}\nendstream`;
    }),
  ];
  return pdfOf(objects);
}
