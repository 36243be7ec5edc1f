import { rmSync } from "node:fs";
import { join } from "node:path";
import type { FileChooser, Page } from "playwright-core";
import type { TurnleafBook } from "turnleaf";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { rar4, rar5, sevenZip } from "../../turnleaf/src/for_tests/stored_archives.ts";
import { tinyFb2 } from "../../turnleaf/src/sources/fb2/tiny_fb2.ts";
import { tinyKf8, tinyMobi } from "../../turnleaf/src/sources/kindle/tiny_kindle.ts";
import { pdf, png } from "./books.ts";
import { chromiumForTests, emptyPage } from "./browser.ts";
import { folderOf, type Started, start } from "./command.ts";
import {
  bookComesTo,
  bookSettles,
  comesTo,
  passFrames,
  passTimeUntil,
  pauseClock,
} from "./waiting.ts";

const tests = chromiumForTests({ keepsPages: true });
let page: Page;
let served: Started;
let folder: ReturnType<typeof folderOf>;
const complaints: string[] = [];

const book = <T>(look: (book: TurnleafBook) => T): Promise<T> =>
  page
    .locator("turnleaf-book")
    .evaluate(look as (element: SVGElement | HTMLElement) => T) as Promise<T>;

async function open(url: string): Promise<void> {
  await page.goto(url);
  await page.getByRole("slider").waitFor({ state: "visible" });
}

/** Ends a server, once its page is left: that might ask it for more. */
async function leave(server: Started): Promise<void> {
  await emptyPage(page);
  await server.stop();
}

beforeAll(async () => {
  folder = folderOf({
    "small.pdf": pdf(9),
    "scans/1.png": png(30, 40),
    "scans/2.png": png(30, 40),
    "volumes/2/9.png": png(40, 20),
    "volumes/2/10.png": png(30, 30),
    "volumes/10/1.png": png(20, 40),
    "volumes/2/notes.txt": "None of the pages.",
    "hero.cbr": Buffer.from(rar5({ "1.png": png(30, 40), "2.png": png(30, 40) })),
    "novel.azw3": Buffer.from(tinyKf8({ text: ["<p>One</p>", "<p>Two</p>"] })),
    "novel.mobi": Buffer.from(tinyMobi({ text: "<p>One</p><mbp:pagebreak/><p>Two</p>" })),
    "novel.fb2": tinyFb2("<section><p>One</p></section><section><p>Two</p></section>"),
    "hero.cb7": Buffer.from(sevenZip({ "1.png": png(30, 40), "2.png": png(30, 40) })),
  });
  served = await start(join(folder.path, "small.pdf"), "--port", "0");
  page = await tests.newPage({ viewport: { width: 480, height: 360 }, reducedMotion: "reduce" });
  await page.clock.install();
  page.on("pageerror", (error) => complaints.push(error.message));
  page.on("console", (message) => {
    const text = message.text();
    // The scripts that a test adds to each frame do not run in those of a book's pages.
    if (/^Blocked script execution in 'about:srcdoc'/.test(text)) return;
    if (message.type() === "error") complaints.push(text);
  });
});
afterAll(async () => {
  await leave(served);
  folder.remove();
});

it("opens the book under the strict policy, with its title and labels", async () => {
  await open(served.url);
  expect(await page.title()).toBe("A Small Book");
  expect(await book(({ pageCount }) => pageCount)).toBe(9);
  expect(await page.getByRole("textbox", { name: "Page" }).inputValue()).toBe("i");
  expect(await page.locator(".count").textContent()).toBe("1 of 9");
  expect(complaints).toEqual([]);
});

it("goes to a page by its label or number, and says when there is none", async () => {
  const field = page.getByRole("textbox", { name: "Page" });
  await field.fill("IV");
  await field.press("Enter");
  await bookComesTo(page, (book) => book.page, 4);
  await comesTo(page, () => location.hash, "#page=4");
  expect(await field.inputValue()).toBe("iv");
  await field.fill("40");
  await field.press("Enter");
  expect(await field.getAttribute("aria-invalid")).toBe("true");
  await field.press("Escape");
  expect(await field.inputValue()).toBe("iv");
});

it("turns with the buttons and finds the page again after a reload", async () => {
  await page.mouse.move(200, 200);
  await page.getByRole("button", { name: "Next page" }).click();
  await comesTo(page, () => location.hash, "#page=6");
  await emptyPage(page);
  await open(served.url);
  expect(await book(({ page }) => page)).toBe(6);
  await page.getByRole("button", { name: "Previous page" }).click();
  await bookComesTo(page, (book) => book.page, 4);
});

it("keeps its controls beside the book, never over it", async () => {
  const stage = await page.locator("[part=stage]").boundingBox();
  const bars = await Promise.all(
    ["toolbar", "pages"].map((part) => page.locator(`[part=${part}]`).boundingBox()),
  );
  const [top, bottom] = bars;
  expect(stage && top && top.y + top.height).toBe(stage?.y);
  expect(stage && stage.y + stage.height).toBe(bottom?.y);
  const field = await page.getByRole("textbox", { name: "Page" }).boundingBox();
  expect(field?.y).toBeGreaterThan(bottom?.y ?? 0);
});

it("takes its controls away in full screen, and brings them when the pointer moves", async () => {
  const bars = () =>
    page.locator("[part=toolbar]").evaluate((bar) => getComputedStyle(bar).visibility);
  await book((book) => book.focus());
  await page.keyboard.press("f");
  await comesTo(page, () => document.fullscreenElement !== null, true);
  await pauseClock(page);
  await passTimeUntil(page, async () => (await bars()) === "hidden", 100);
  await page.mouse.move(100, 100);
  await page.mouse.move(120, 120);
  await passTimeUntil(page, async () => (await bars()) === "visible", 100);
  await page.clock.resume();
  await page.evaluate(() => document.exitFullscreen());
  await comesTo(page, () => document.fullscreenElement === null, true);
  await page.locator("[part=toolbar]").waitFor();
  expect(await bars()).toBe("visible");
});

it("shows a book of scans, and one sentence where a page would be if it is gone", async () => {
  const scans = await start(join(folder.path, "scans"), "--port", "0");
  await open(scans.url);
  expect(await book(({ pageCount }) => pageCount)).toBe(2);
  rmSync(join(folder.path, "scans"), { recursive: true });
  await leave(scans);
  expect(complaints).toEqual([]);
});

it.each(["novel.azw3", "novel.mobi", "novel.fb2"])("shows the book %s", async (name) => {
  const novel = await start(join(folder.path, name), "--port", "0");
  await open(novel.url);
  expect(await book(({ pageCount }) => pageCount)).toBe(2);
  expect(await page.title()).toBe("A small book");
  await leave(novel);
  expect(complaints).toEqual([]);
});

it.each(["hero.cbr", "hero.cb7"])("shows the comic %s", async (name) => {
  const comic = await start(join(folder.path, name), "--port", "0");
  await open(comic.url);
  expect(await book(({ pageCount }) => pageCount)).toBe(2);
  expect(await page.title()).toBe("hero");
  await leave(comic);
  expect(complaints).toEqual([]);
});

describe("a book of the reader's own machine", () => {
  const notice = () => page.locator("#notice");
  /** Drops files on the window, as their bytes in base64 by their names. */
  const drop = (files: Record<string, Buffer | string>): Promise<void> =>
    page.evaluate(
      (files) => {
        const dataTransfer = new DataTransfer();
        for (const [name, bytes] of files) {
          const data = Uint8Array.from(atob(bytes), (letter) => letter.charCodeAt(0));
          dataTransfer.items.add(new File([data], name));
        }
        document.body.dispatchEvent(new DragEvent("drop", { dataTransfer, bubbles: true }));
      },
      Object.entries(files).map(([name, bytes]) => [
        name,
        Buffer.from(bytes).toString("base64"),
      ]) as [string, string][],
    );

  /** Opens the dialog of a key. */
  const chooserOf = async (key: string): Promise<FileChooser> => {
    const opened: FileChooser[] = [];
    page.once("filechooser", (chooser) => opened.push(chooser));
    // On a busy machine Chromium was once seen to open no dialog for the first press.
    for (let times = 0; times < 10 && opened.length === 0; times++) {
      await page.keyboard.press(key);
      for (let k = 0; k < 120 && opened.length === 0; k++) await passFrames(page, 1);
    }
    return opened[0] ?? expect.fail(`${key} opens no dialog.`);
  };

  it("that cannot be read says so in a sentence, and the one that is shown stays", async () => {
    await open(served.url);
    await drop({ "torn.pdf": "%PDF-1.7 and nothing" });
    await notice().getByText("torn.pdf is damaged").waitFor();
    expect(await book(({ pageCount, bookTitle }) => [pageCount, bookTitle])).toEqual([
      9,
      "A Small Book",
    ]);
    await page.keyboard.press("Escape");
    expect(await notice().isHidden()).toBe(true);
  });

  it("that takes long is announced, and given up by a button", async () => {
    await page.evaluate(() => {
      const folder = {
        ...{ name: "scans", isDirectory: true, isFile: false },
        createReader: () => ({ readEntries() {} }),
      };
      const items = [{ webkitGetAsEntry: () => folder }];
      const dataTransfer = { types: ["Files"], files: [], items };
      dispatchEvent(Object.assign(new Event("drop"), { dataTransfer }));
    });
    await page.getByRole("button", { name: "Cancel" }).click();
    expect(await notice().isHidden()).toBe(true);
    expect(await book(({ pageCount }) => pageCount)).toBe(9);
  });

  it("leaves nothing of its place to the book that a reload brings back", async () => {
    const before = await book(({ page }) => page);
    expect(before).not.toBe(8);
    await drop({ "a.pdf": pdf(9, "Dropped") });
    await comesTo(page, () => document.title, "Dropped");
    await book((book) => book.goTo(8));
    await comesTo(page, () => /page=8/.test(location.hash), true);
    await page.reload();
    await comesTo(page, () => document.title, "A Small Book");
    await bookComesTo(page, (book) => book.page, before);
  });

  it("is shown in place of the other: dropped, or picked by a key", async () => {
    await drop({ "10.png": png(30, 40), "9.png": png(40, 30) });
    await bookComesTo(page, (book) => book.pageCount, 2);
    await drop({ "hero.cbr": Buffer.from(rar4({ "1.png": png(30, 40), "2.png": png(40, 40) })) });
    await comesTo(page, () => document.title, "hero");
    await bookSettles(page);
    await (await chooserOf("Control+o")).setFiles({
      name: "a.pdf",
      mimeType: "",
      buffer: pdf(3, "Picked"),
    });
    await comesTo(page, () => document.title, "Picked");
    expect(await book(({ pageCount }) => pageCount)).toBe(3);
    expect(await notice().isHidden()).toBe(true);
    expect(complaints).toEqual([]);
  });

  it("may be a folder of images, picked by a button that Tab leads to, or by a key", async () => {
    const button = page.getByRole("button", { name: "Open a folder of images …" });
    const isSeen = () =>
      button.evaluate((element) => {
        const { left, top, width, height } = element.getBoundingClientRect();
        return document.elementFromPoint(left + width / 2, top + height / 2) === element;
      });
    expect(await isSeen()).toBe(false);
    await button.focus();
    expect(await isSeen()).toBe(true);
    const dialog = page.waitForEvent("filechooser");
    await button.press("Enter");
    // The book that is shown has three pages too.
    const loaded = book(
      (book) =>
        new Promise<void>((resolve) =>
          book.addEventListener("load", () => resolve(), { once: true }),
        ),
    );
    await (await dialog).setFiles(join(folder.path, "volumes"));
    await loaded;
    const sizes = () =>
      book(async (book) => {
        const pictures = await Promise.all([1, 2, 3].map((page) => book.drawPage(page, 100)));
        return pictures.map(({ width, height }) => Math.round((10 * width) / height));
      });
    expect(await sizes()).toEqual([20, 10, 5]);
    await (await chooserOf("Control+Shift+O")).setFiles(join(folder.path, "volumes/2"));
    await bookComesTo(page, (book) => book.pageCount, 2);
    expect(await notice().isHidden()).toBe(true);
    expect(complaints).toEqual([]);
  });
});

it("says in the browser when the book is gone", async () => {
  const other = await start(join(folder.path, "small.pdf"), "--port", "0");
  rmSync(join(folder.path, "small.pdf"));
  await page.goto(other.url);
  await page.getByText("small.pdf was not found; check the address and open it again.").waitFor();
  await other.stop();
});
