/** The whole path of a reader: the built command, a real Chromium, a mouse. */

import { readFileSync } from "node:fs";
import { fileURLToPath } from "node:url";
import type { Page } from "playwright-core";
import { afterAll, afterEach, beforeAll, expect, test } from "vitest";
import { png } from "./books.ts";
import { pageForTests } from "./browser.ts";
import { folderOf, type Started, start } from "./command.ts";
import { bookSettles, passTime, passTimeUntil, pauseClock } from "./waiting.ts";

const whale = fileURLToPath(new URL("../../../books/moby-dick.pdf", import.meta.url));
const other = fileURLToPath(new URL("../../../books/others/charis-features.pdf", import.meta.url));

// Small: rendering is in software here.
const viewport = { width: 760, height: 620 };

/** For what is seen, and for what is not. */
const drawn = pageForTests({ viewport, isDrawn: true });
const undrawn = pageForTests({ viewport });

/** Errors of both pages since the test began. */
const errors: string[] = [];

/** Started by a test; stopped after it, however it ended. */
const running: Started[] = [];

afterEach(async () => {
  for (const served of running.splice(0)) await served.stop();
  errors.length = 0;
});

/** The default book, for all tests that read it. */
let book: Started;

beforeAll(async () => {
  book = await start(whale, "--no-open", "--port", "0");
  for (const { page } of [drawn, undrawn]) {
    page.on("pageerror", (error) => errors.push(error.message));
    await page.clock.install();
    await page.addInitScript(countActivity);
  }
});
afterAll(async () => {
  await book?.stop();
});

async function serve(path: string): Promise<Started> {
  const served = await start(path, "--no-open", "--port", "0");
  running.push(served);
  return served;
}

/** The page's activity over time, counted from inside. */
interface Counts {
  frames: number;
  timers: number;
}

/** Runs in the page before anything else: counts its activity. */
function countActivity(): void {
  const counts = { frames: 0, timers: 0 };
  Object.assign(globalThis, { counts });
  const frame = globalThis.requestAnimationFrame;
  globalThis.requestAnimationFrame = (call) => {
    counts.frames++;
    return frame(call);
  };
  for (const name of ["setTimeout", "setInterval"] as const) {
    const set = globalThis[name] as typeof setTimeout;
    Object.assign(globalThis, {
      [name]: (...args: Parameters<typeof setTimeout>) => {
        counts.timers++;
        return set(...args);
      },
    });
  }
}

/** Opens a served book in a page whose clock runs, and waits until its pages are sharp. */
async function open({ url }: Started, hash: string, { page } = undrawn): Promise<Page> {
  await page.clock.resume();
  await page.goto(`${url}${hash}`);
  await bookSettles(page);
  return page;
}

/** Lets the clock of a page run until its book is at rest and sharp. */
async function settle(page: Page): Promise<void> {
  await page.clock.resume();
  await bookSettles(page);
}

/** Lets leaves turn unseen until the page is left: drawing them is what takes time in software. */
const stopDrawing = (page: Page): Promise<void> =>
  page.evaluate(() => {
    WebGL2RenderingContext.prototype.drawElements = () => {};
  });

/** Makes the turns of a page's book short: leaves are seen to turn elsewhere. */
const hurry = (page: Page): Promise<void> =>
  page.evaluate(() => document.querySelector("turnleaf-book")?.setAttribute("duration", "100"));

const shownPage = (page: Page) =>
  page.evaluate(() => document.querySelector("turnleaf-book")?.page);

const counts = (page: Page): Promise<Counts> =>
  page.evaluate(() => ({ ...(globalThis as unknown as { counts: Counts }).counts }));

/** Moves in from the window's side at a height until the pointer is over something it can grab. */
async function findEdge(page: Page, from: "left" | "right", fraction: number): Promise<number> {
  const y = viewport.height * fraction;
  for (let inward = 0; inward < viewport.width / 2; inward += 6) {
    const x = from === "left" ? inward : viewport.width - inward;
    await page.mouse.move(x, y);
    const cursor = await page.evaluate(
      () =>
        document.querySelector("turnleaf-book")?.shadowRoot?.querySelector("canvas")?.style.cursor,
    );
    if (cursor === "grab") return x;
  }
  throw new Error(`No page to take from the ${from}.`);
}

/**
 * Returns the fraction of the window's pixels in a rectangle (in fractions of
 * the window) that are dark as ink.
 */
async function ink(page: Page, box: { x: number; y: number; width: number; height: number }) {
  const png = (await page.screenshot()).toString("base64");
  return page.evaluate(
    async ({ png, box }) => {
      const bytes = Uint8Array.from(atob(png), (c) => c.charCodeAt(0));
      const picture = await createImageBitmap(new Blob([bytes], { type: "image/png" }));
      const canvas = new OffscreenCanvas(picture.width, picture.height);
      const pen = canvas.getContext("2d") as OffscreenCanvasRenderingContext2D;
      pen.drawImage(picture, 0, 0);
      const { width, height } = picture;
      const data = pen.getImageData(
        box.x * width,
        box.y * height,
        box.width * width,
        box.height * height,
      ).data;
      let dark = 0;
      let paper = 0;
      for (let i = 0; i < data.length; i += 4) {
        if (data[i] + data[i + 1] + data[i + 2] < 450) dark++;
        if (data[i] > 225 && data[i + 1] > 215 && data[i + 2] > 195) paper++;
      }
      return { dark: dark / (data.length / 4), paper: paper / (data.length / 4) };
    },
    { png, box },
  );
}

const leftText = { x: 0.27, y: 0.41, width: 0.17, height: 0.29 };
const rightText = { x: 0.56, y: 0.41, width: 0.17, height: 0.29 };

test("the default book opens, is dragged over, and rests", async () => {
  const page = await open(book, "#page=22", drawn);
  expect(await shownPage(page)).toBe(22);
  expect(
    await page.evaluate(() => document.querySelector("turnleaf-book")?.pageCount),
  ).toBeGreaterThanOrEqual(60);

  // Two pages of text on paper.
  for (const box of [leftText, rightText]) {
    const { dark, paper } = await ink(page, box);
    expect(dark).toBeGreaterThan(0.02);
    expect(paper).toBeGreaterThan(0.4);
  }

  // At rest nothing runs.
  await pauseClock(page);
  const before = await counts(page);
  await passTime(page, 10, 100);
  expect(await counts(page)).toEqual(before);

  // Dragged by the fore-edge to the other side.
  const x = await findEdge(page, "right", 0.7);
  await page.mouse.move(x - 8, viewport.height * 0.7);
  await page.mouse.down();
  await page.mouse.move(x - 120, viewport.height * 0.66, { steps: 4 });
  await passTime(page, 3, 100);
  expect((await counts(page)).frames).toBeGreaterThan(before.frames);
  expect(await shownPage(page)).toBe(22);
  await page.mouse.move(viewport.width - x, viewport.height * 0.68, { steps: 6 });
  await page.mouse.up();
  await passTimeUntil(page, async () => (await shownPage(page)) === 24, 100);
  await settle(page);
  for (const box of [leftText, rightText])
    expect((await ink(page, box)).dark).toBeGreaterThan(0.02);
  expect(await page.evaluate(() => location.hash)).toBe("#page=24");

  // Released near where it was grabbed, it falls back.
  await stopDrawing(page);
  await pauseClock(page);
  const again = await findEdge(page, "right", 0.7);
  await page.mouse.move(again - 8, viewport.height * 0.7);
  await page.mouse.down();
  await page.mouse.move(again - 60, viewport.height * 0.7, { steps: 4 });
  await passTime(page, 4, 100);
  await page.mouse.up();
  await settle(page);
  expect(await shownPage(page)).toBe(24);

  // Removed, it leaves nothing running.
  await pauseClock(page);
  await page.evaluate(() => {
    void document.querySelector("turnleaf-book")?.next();
    document.querySelector("turnleaf-book")?.remove();
  });
  await passTime(page, 2, 100);
  const removed = await counts(page);
  await passTime(page, 8, 100);
  expect(await counts(page)).toEqual(removed);
  expect(errors).toEqual([]);
});

test("keys, clicks and commands turn pages and land at their pages", async () => {
  const page = await open(book, "");
  // It opens where it asks to: at the ship that faces its first chapter.
  expect(await shownPage(page)).toBe(18);
  await hurry(page);
  await page.keyboard.press("ArrowRight");
  await settle(page);
  expect(await shownPage(page)).toBe(20);
  await page.keyboard.press("ArrowLeft");
  await settle(page);
  expect(await shownPage(page)).toBe(18);

  const x = await findEdge(page, "right", 0.6);
  await page.mouse.click(x - 6, viewport.height * 0.6);
  await settle(page);
  expect(await shownPage(page)).toBe(20);

  const landed = await page.evaluate(() => document.querySelector("turnleaf-book")?.goTo(77));
  expect(landed).toBe(true);
  expect(await shownPage(page)).toBe(76);

  // The covers, and back to the middle: no leaf need fly to land there.
  await page.emulateMedia({ reducedMotion: "reduce" });
  for (const [wanted, lands] of [
    [1, 1],
    [112, 112],
    [55, 54],
  ]) {
    expect(
      await page.evaluate((to) => document.querySelector("turnleaf-book")?.goTo(to), wanted),
    ).toBe(true);
    expect(await shownPage(page)).toBe(lands);
  }

  await page.emulateMedia({ reducedMotion: "no-preference" });

  // A second command takes over from the first, whose promise resolves to false.
  const [first, second] = await page.evaluate(async () => {
    const element = document.querySelector("turnleaf-book");
    return Promise.all([element?.goTo(90), element?.goTo(20)]);
  });
  expect([first, second]).toEqual([false, true]);
  expect(await shownPage(page)).toBe(20);
  expect(errors).toEqual([]);
});

test("a running turn is caught and taken back", async () => {
  const page = await open(book, "#page=40");
  await pauseClock(page);
  await page.evaluate(() => {
    const element = document.querySelector("turnleaf-book");
    element?.setAttribute("duration", "6000");
    void element?.next();
  });
  await passTime(page, 22, 100);
  // The leaf stands somewhere over the right page: press where it is, and pull it back.
  await page.mouse.move(viewport.width * 0.66, viewport.height * 0.55);
  await page.mouse.down();
  const x = viewport.width * 0.8;
  await page.mouse.move(x, viewport.height * 0.7, { steps: 8 });
  await passTime(page, 6, 100);
  await page.mouse.up();
  await settle(page);
  expect(await shownPage(page)).toBe(40);
  expect(errors).toEqual([]);
});

test("another real PDF, with an odd number of pages", async () => {
  const served = await serve(other);
  const page = await open(served, "#page=4", drawn);
  await hurry(page);
  expect(await page.evaluate(() => document.querySelector("turnleaf-book")?.pageCount)).toBe(9);
  expect((await ink(page, { x: 0.2, y: 0.2, width: 0.6, height: 0.6 })).dark).toBeGreaterThan(0.01);
  await stopDrawing(page);
  expect(await page.evaluate(() => document.querySelector("turnleaf-book")?.goTo(9))).toBe(true);
  await settle(page);
  // An article has no boards: its last page lies beside the one before, and nothing after it.
  expect(await shownPage(page)).toBe(8);
  expect(await page.evaluate(() => document.querySelector("turnleaf-book")?.next())).toBe(false);
  expect(await shownPage(page)).toBe(8);
  expect(errors).toEqual([]);
});

test("what breaks after it was opened says so where the page would be", async () => {
  const folder = folderOf({
    "book.pdf": readFileSync(other),
    "scans/1.png": png(30, 40),
    "scans/2.png": png(30, 40),
    "scans/3.png": png(30, 40),
  });
  const whole = await serve(`${folder.path}/book.pdf`);
  const scans = await serve(`${folder.path}/scans`);
  folder.remove();
  const { page } = undrawn;

  // A deleted file: nothing can be shown.
  await page.goto(whole.url);
  const alert = page.locator("[part=message][role=alert]");
  await alert.filter({ hasText: ".pdf" }).waitFor();

  // Deleted pages: the book opens, and each page gives the reason why it is not shown.
  await page.goto(scans.url);
  await page.locator(".live", { hasText: "1.png" }).waitFor({ state: "attached" });
  expect(await alert.isVisible()).toBe(false);
});
