/** Several books: listed with their covers, each read from there. */

import { join } from "node:path";
import { afterEach, describe, expect, it } from "vitest";
import { openBook } from "../src/book.ts";
import { page as coloured, pdf, png } from "./books.ts";
import { chromiumForTests } from "./browser.ts";
import { ask, folderOf, run, type Started, start } from "./command.ts";

const running: Started[] = [];
const folders: ReturnType<typeof folderOf>[] = [];

function folderWith(files: Parameters<typeof folderOf>[0]): string {
  const folder = folderOf(files);
  folders.push(folder);
  return folder.path;
}

async function serve(...names: string[]): Promise<Started> {
  const served = await start(...names, "--port", "0");
  running.push(served);
  return served;
}

/** Returns the books that the reader receives. */
async function booksOf({ port }: Started): Promise<{ src: string; title: string }[]> {
  return JSON.parse((await ask(port, "/config.json")).body.toString()).books;
}

afterEach(async () => {
  for (const served of running.splice(0)) await served.stop();
  for (const folder of folders.splice(0)) folder.remove();
});

describe("several books", () => {
  it("are listed in their order, each with its own files", async () => {
    const folder = folderWith({
      "a.pdf": pdf(2, "First <b>"),
      "b/1.png": png(30, 40),
      "b/2.png": png(30, 40),
      "c.md": "[A link](https://example.org) comes first.",
    });
    const served = await serve(join(folder, "a.pdf"), join(folder, "b"), join(folder, "c.md"));
    expect(served.stdout).toContain("Turnleaf is reading 3 books at ");
    const page = (await ask(served.port, "/")).body.toString();
    expect(page).toContain("First &#60;b&#62;");
    expect([...page.matchAll(/href="(index[^"]*)"/g)].map(([, href]) => href)).toEqual([
      "index.html?book=1",
      "index.html?book=2",
      "index.html?book=3",
    ]);
    const books = await booksOf(served);
    expect(books).toEqual([
      { src: "/books/1/book/a.pdf", title: "First <b>" },
      { src: "/books/2/book/b", title: "b" },
      { src: "/books/3/book/c.md", title: "c.md" },
    ]);
    const manifest = JSON.parse((await ask(served.port, "/books/2/book/b")).body.toString());
    const image = new URL(manifest.pages[0].src, "http://x/books/2/book/b").pathname;
    expect((await ask(served.port, image)).headers["content-type"]).toBe("image/png");
    const markdown = await ask(served.port, "/books/3/book/c.md");
    expect(markdown.headers["content-type"]).toBe("text/markdown");
  });

  it("of a folder are a shelf, its images one book more, its texts if there is nothing else", async () => {
    const titles = async (files: Parameters<typeof folderOf>[0]): Promise<string[]> => {
      const served = await serve(folderWith(files));
      return (await booksOf(served)).map(({ title }) => title);
    };
    const pdfs = { "1.pdf": pdf(1, "One"), "2.pdf": pdf(1, "Two"), "notes.txt": "Notes." };
    expect(await titles(pdfs)).toEqual(["One", "Two"]);
    const [one, two, images] = await titles({ ...pdfs, "a.png": png(3, 4), "b.png": png(3, 4) });
    expect([one, two]).toEqual(["One", "Two"]);
    expect(images).toMatch(/^turnleaf-test-/);
    const scans = { "a.png": png(3, 4), "b.png": png(3, 4) };
    const beside = await titles({ "1.pdf": pdf(1, "One"), ...scans });
    expect(beside).toEqual(["One", expect.stringMatching(/^turnleaf-test-/)]);
    expect(await titles({ "b.md": "# B", "a.txt": "Ay." })).toEqual(["a.txt", "b.md"]);
  });

  it("that cannot be read are left out with a sentence; without any nothing is served", async () => {
    const folder = folderWith({ "a.pdf": pdf(1, "One"), "torn.pdf": "%PDF-1.7\nno" });
    const names = ["torn.pdf", "a.pdf", "missing.epub"].map((name) => join(folder, name));
    const served = await serve(...names);
    expect(served.stderr()).toMatch(/torn\.pdf is damaged or no PDF; .*\. It is left out\.\n/);
    expect(served.stderr()).toMatch(/missing\.epub was not found; .*\. It is left out\.\n/);
    // What remains is one book.
    expect(served.stdout).toContain("Turnleaf is reading One at ");
    const ended = await run("read", names[0] as string, names[2] as string);
    expect(ended.stderr).toMatch(/None of these books can be read\.\n$/);
    expect(ended.status).toBe(1);
  });

  it("of a folder are not one book for other commands", async () => {
    const folder = folderWith({ "1.pdf": pdf(), "2.epub": "PK\x03\x04" });
    const opening = openBook(folder, () => {});
    await expect(opening).rejects.toThrow(/ holds 2 books and no images; name the one/);
  });
});

describe("in Chromium", () => {
  const tests = chromiumForTests();

  it("covers and titles are drawn, a book is opened and left, and a broken one says so", {
    timeout: 180_000,
  }, async () => {
    const folder = folderWith({
      "a.pdf": pdf(9),
      "b/1.png": coloured([20, 160, 60]),
      "b/2.png": coloured([20, 60, 160]),
      "c.cbz": "PK\x03\x04 and then nothing",
    });
    const served = await serve(join(folder, "a.pdf"), join(folder, "b"), join(folder, "c.cbz"));
    const page = await tests.newPage({ viewport: { width: 700, height: 500 } });
    const complaints: string[] = [];
    page.on("pageerror", (error) => complaints.push(error.message));
    page.on("console", (message) => {
      if (message.type() === "error") complaints.push(message.text());
    });
    await page.goto(served.url);
    const entries = page.getByRole("listitem");
    await entries.nth(0).getByText("9 pages").waitFor();
    await entries.nth(2).getByText("c.cbz is damaged").waitFor();
    await entries.nth(1).locator("canvas").waitFor();
    expect(await entries.nth(1).locator("canvas").evaluate(pixelOf)).toEqual([20, 160, 60]);
    expect(await entries.nth(0).locator("canvas").evaluate(pixelOf)).toEqual([255, 0, 0]);
    expect(complaints).toEqual([]);

    await page.getByRole("link", { name: "A Small Book" }).click();
    await page.getByRole("slider").waitFor({ state: "visible" });
    expect(await page.title()).toBe("A Small Book");
    await page.getByRole("link", { name: "All books" }).click();
    await page.waitForURL(served.url);
  });
});

/** Returns the colour at the right edge of a canvas, half-way down. */
function pixelOf(element: SVGElement | HTMLElement): number[] {
  const canvas = element as HTMLCanvasElement;
  const pen = canvas.getContext("2d") as CanvasRenderingContext2D;
  const { data } = pen.getImageData(canvas.width - 2, Math.floor(canvas.height / 2), 1, 1);
  return [...data.slice(0, 3)];
}
