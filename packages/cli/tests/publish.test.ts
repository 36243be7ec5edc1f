/** Runs of `turnleaf publish`: with faults, in shards, after a kill, of many books. */

import {
  chmodSync,
  cpSync,
  existsSync,
  readdirSync,
  readFileSync,
  rmSync,
  writeFileSync,
} from "node:fs";
import { join } from "node:path";
import type { TurnleafBook } from "turnleaf";
import { beforeAll, describe, expect, test } from "vitest";
import { findChromium } from "../../../scripts/chromium.mjs";
import { parseCommand } from "../src/arguments.ts";
import { Problem } from "../src/problem.ts";
import { publish as publishHere } from "../src/publish/publish.ts";
import type { PublishCommand } from "../src/publish/publish_arguments.ts";
import { pdfOf, png, protectedPdf, textPdf } from "./books.ts";
import { signalOnce } from "./command.ts";
import {
  bookCount,
  filesOf,
  folder,
  manyBooks,
  patience,
  publish,
  removeFolders,
  small,
  visitorForTests,
} from "./publishing.ts";
import { comesTo } from "./waiting.ts";

removeFolders();
const { visit } = visitorForTests();

/** Two books at a time. */
const byTwo = ["--workers", "2"];

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
    "lacking.fb2":
      '<FictionBook xmlns="http://www.gribuser.ru/xml/fictionbook/2.0" xmlns:l="http://www.w3.org/1999/xlink"><body><section><p>x</p><image l:href="#gone"/></section></body></FictionBook>',
  });
  const site = join(path, "site");
  const books = ["broken.pdf", "good.pdf", "locked.pdf", "mixed", "missing.pdf", "lacking.fb2"];
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
  // What is no failure of a page is said all the same.
  expect(stderr).toContain(
    "lacking.fb2, page 1: #gone, an image of lacking.fb2, is missing or cannot be shown.",
  );
  expect(readdirSync(join(site, "books")).sort()).toEqual(["good", "lacking", "mixed"]);
  expect(readFileSync(join(site, "books/mixed/text/1.html"), "utf8")).toContain(
    "This page could not be drawn",
  );
});

test("stopped in a merge, or unable to write, it says so in a sentence", async () => {
  const path = folder({
    "shard/shard.json": '{"number": 1, "count": 1, "ids": ["a"], "failures": []}',
    "site/report.json/in the way": "",
  });
  const [shard, site] = ["shard", "site"].map((name) => join(path, name)) as [string, string];
  const merging = parseCommand(["publish", "--merge", shard, "--out", site]) as PublishCommand;
  await expect(publishHere(merging, AbortSignal.abort())).rejects.toThrow(
    new Problem("Stopped; the same command goes on from here."),
  );
  const { status, stderr } = await publish(["--merge", shard, "--out", site]);
  expect([status, stderr]).toEqual([1, expect.stringMatching(/^\S+site could not be written/)]);
  expect(stderr.trim().split("\n")).toHaveLength(1);
});

test("stopped while a second browser starts, it leaves none", { timeout: patience }, async () => {
  const path = folder({
    chromium: `#!/bin/sh
# The second browser starts once the first was ended.
if mkdir "$0.first" 2>/dev/null; then
  echo $$ > "$0.first/pid"
else
  echo $$ > "$0.pid"
  until [ -s "$0.first/pid" ]; do sleep 0.05; done
  while kill -0 "$(cat "$0.first/pid")" 2>/dev/null; do sleep 0.05; done
fi
exec "${findChromium()}" "$@"
`,
  });
  const program = join(path, "chromium");
  chmodSync(program, 0o755);
  const site = join(path, "site");
  const args = [...manyBooks(2), "--out", site, "--chromium", program, ...small, ...byTwo];
  const { status, stderr } = await publish(args, (child) => {
    signalOnce(child, () => existsSync(`${program}.pid`), "SIGINT");
  });
  expect([status, stderr]).toEqual([1, "Stopped; the same command goes on from here.\n"]);
  const id = Number(readFileSync(`${program}.pid`, "utf8"));
  expect(() => process.kill(id, 0)).toThrow("ESRCH");
});

test("a page that takes too long is given up, and the next is drawn; the next run draws the book again", {
  timeout: 2 * patience,
}, async () => {
  // A picture that is a web page's whole day of work: nested forms, each of which draws the next ten times.
  const slow = slowPdf();
  const path = folder({ "slow.pdf": slow });
  const site = join(path, "site");
  const args = [join(path, "slow.pdf"), "--out", site, "--page-seconds", "5", ...small];
  const { status, stderr } = await publish(args);
  expect(stderr).toContain("Page 1 took longer than 5 s and was given up.");
  expect(status).toBe(1);
  const { failures } = JSON.parse(readFileSync(join(site, "report.json"), "utf8"));
  expect(failures).toEqual([expect.objectContaining({ id: "slow", page: 1 })]);
  expect(existsSync(join(site, "books/slow/iiif/2/full/max/0/default.jpg"))).toBe(true);
  // The next run draws it again: it is stopped once it has begun to.
  const again = await publish(args, (child) => {
    signalOnce(child, () => existsSync(join(site, ".part-slow")), "SIGINT");
  });
  expect(again.stderr).toBe("Stopped; the same command goes on from here.\n");
});

describe(`${bookCount} books`, () => {
  const options = [...small, "--url", "https://books.example/"];
  let books: string[];
  /** All of them, published in one run. */
  let whole: string;

  beforeAll(async () => {
    books = manyBooks(bookCount);
    whole = join(folder(), "whole");
    expect((await publish([...books, "--out", whole, ...options, ...byTwo])).status).toBe(0);
  }, patience);

  test("in two shards are the same bytes as in one run", { timeout: 3 * patience }, async () => {
    const path = folder();
    const [a, b, merged] = ["a", "b", "merged"].map((name) => join(path, name)) as [
      string,
      string,
      string,
    ];
    for (const [out, shard] of [
      [a, "1/2"],
      [b, "2/2"],
    ] as const) {
      const sharded = [...books, "--out", out, ...options, "--shard", shard];
      expect((await publish(sharded)).status).toBe(0);
    }
    const missing = await publish(["--merge", a, "--out", merged, ...options]);
    expect([missing.status, missing.stderr]).toEqual([1, "Shard 2 of 2 is missing.\n"]);
    rmSync(merged, { recursive: true });
    // In any order.
    expect((await publish(["--merge", b, a, "--out", merged, ...options])).status).toBe(0);
    expect(filesOf(merged)).toEqual(filesOf(whole));
    expect(Object.keys(filesOf(whole)).length).toBeGreaterThan(10 * bookCount);
  });

  test("killed half-way and started again end the same, at most one book a worker drawn twice", {
    timeout: 3 * patience,
  }, async () => {
    const killed = join(folder(), "killed");
    const finished = (): string[] =>
      existsSync(join(killed, "books"))
        ? readdirSync(join(killed, "books")).filter((name) =>
            existsSync(join(killed, "books", name, "record.json")),
          )
        : [];
    await publish([...books, "--out", killed, ...options, ...byTwo], (child) => {
      signalOnce(child, () => finished().length >= bookCount / 2, "SIGKILL");
    });
    const kept = finished().length;
    expect(kept).toBeGreaterThanOrEqual(bookCount / 2);
    expect(kept).toBeLessThan(bookCount);
    const again = await publish([...books, "--out", killed, ...options]);
    expect(again.stdout).toContain(
      `${bookCount} books, ${bookCount - kept} drawn, ${kept} unchanged`,
    );
    expect(filesOf(killed)).toEqual(filesOf(whole));
  });
});

describe("a book that was drawn", () => {
  let book: string;
  /** The only shard of a site of this book. */
  let drawn: string;

  beforeAll(async () => {
    const path = folder({ "a.pdf": textPdf({ title: "A", pages: [["albatross"]] }) });
    [book, drawn] = [join(path, "a.pdf"), join(path, "shard")];
    const { status } = await publish([book, "--out", drawn, "--shard", "1/1", ...small]);
    expect(status).toBe(0);
  }, patience);

  test("stays as it was published before where it fails, in a site and in a merge", {
    timeout: 2 * patience,
  }, async () => {
    const path = folder();
    const [moved, shard, site, merged] = ["a.pdf", "shard", "site", "merged"].map((name) =>
      join(path, name),
    ) as [string, string, string, string];
    cpSync(book, moved);
    cpSync(drawn, shard, { recursive: true });
    cpSync(join(drawn, "books"), join(site, "books"), { recursive: true });
    const first = await publish([moved, "--out", site, ...small]);
    expect([first.status, first.stdout]).toEqual([
      0,
      expect.stringContaining("1 book, 0 drawn, 1 unchanged"),
    ]);
    expect((await publish(["--merge", shard, "--out", merged])).status).toBe(0);
    const before = filesOf(join(site, "books"));
    rmSync(moved);
    rmSync(join(shard, "books/a"), { recursive: true });
    const again = await publish([moved, "--out", site, ...small]);
    expect([again.status, again.stderr]).toEqual([
      1,
      expect.stringMatching(/a\.pdf was not found.*\n1 failure; the rest was published\.\n$/s),
    ]);
    const asShard = await publish([moved, "--out", shard, "--shard", "1/1", ...small]);
    expect(asShard.status).toBe(1);
    expect((await publish(["--merge", shard, "--out", merged])).status).toBe(1);
    for (const out of [site, merged]) {
      expect(filesOf(join(out, "books"))).toEqual(before);
      expect(readFileSync(join(out, "index.html"), "utf8")).toContain("books/a/");
      const { failures } = JSON.parse(readFileSync(join(out, "report.json"), "utf8"));
      expect(failures).toEqual([expect.objectContaining({ id: "a" })]);
    }
  });

  test("on a shelf of 200 books opens with a bounded number of requests", {
    timeout: 2 * patience,
  }, async () => {
    const path = folder();
    const [shard, site] = [join(path, "shard"), join(path, "site")];
    // One book is drawn; the others have of its files what shelf and search need.
    const ids = Array.from({ length: 200 }, (_, k) => `volume-${k + 1}`);
    const files = (readdirSync(join(drawn, "books/a"), { recursive: true }) as string[]).filter(
      (name) => /^(record\.json|words\/.*|text\/1\.json|iiif\/1\/full\/\d.*\.jpg)$/.test(name),
    );
    for (const id of ids) {
      for (const name of files)
        cpSync(join(drawn, "books/a", name), join(shard, "books", id, name));
    }
    writeFileSync(
      join(shard, "shard.json"),
      JSON.stringify({ number: 1, count: 1, ids, failures: [] }),
    );
    expect((await publish(["--merge", shard, "--out", site])).status).toBe(0);
    const { page, server } = await visit(site);
    await comesTo(page, areCoversLoaded, true);
    const first = server.asked.filter((address) => !address.includes("service-worker")).length;
    expect(await page.locator(".shelf li").count()).toBe(48);
    // The page, its style, scripts and icon, and the covers in and just below the window.
    expect(first).toBeLessThanOrEqual(60);
    expect(await page.locator("a[rel=next]").getAttribute("href")).toBe("shelf/2.html");
    const before = server.asked.length;
    await page.goto(`${server.url}search.html?q=albatross`);
    await page.locator("#results li").nth(9).waitFor();
    expect(await page.locator("#search-state").textContent()).toBe("200 books have albatross.");
    expect(server.asked.length - before).toBeLessThanOrEqual(80);
  });
});

/**
 * Runs in a page. Returns whether the covers in the window are loaded: those just below it are asked
 * for with them.
 */
function areCoversLoaded(): boolean {
  const covers = [...document.querySelectorAll<HTMLImageElement>(".shelf img")];
  const seen = covers.filter((cover) => cover.getBoundingClientRect().top < innerHeight);
  return (
    seen.length > 0 && seen.every(({ complete, naturalWidth }) => complete && naturalWidth > 0)
  );
}

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
