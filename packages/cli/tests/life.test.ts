/** The life of books on a page: strict pages, many of them one after the other, very long ones. */

import type { Page } from "playwright-core";
import type { TurnleafBook } from "turnleaf";
import { describe, expect, test } from "vitest";
import { isWebglComplaint } from "../../../scripts/console_watch.mjs";
import { pdf, png } from "./books.ts";
import { chromiumForTests, type TestChromium } from "./browser.ts";
import { countHoldings, framesOfMeasuring, holdingsOf } from "./holdings.ts";
import { sitesForTests } from "./viewer_page.ts";
import { bookSettles, comesTo, passFrames } from "./waiting.ts";

const sites = sitesForTests();
/** With a real WebGL, which complains of what is done with another context's things, and without. */
const drawn = chromiumForTests({ isDrawn: true });
const undrawn = chromiumForTests();

const pageCount = 5000;
const grey = (page: number): number => 40 + ((page * 37) % 200);

/** A manifest of so many images, and each of them. */
function images(count: number): (path: string) => Buffer | string | null {
  const manifest = JSON.stringify({
    title: "A Long Book",
    pages: Array.from({ length: count }, (_, k) => `pages/${k + 1}.png`),
  });
  return (path) => {
    if (path === "/book.json") return manifest;
    const page = Number(/^\/pages\/(\d+)\.png$/.exec(path)?.[1]);
    return page >= 1 && page <= count ? png(60, 90, grey(page)) : null;
  };
}

async function open(
  respond: (path: string) => Buffer | string | null,
  options: { policy?: string; flat?: boolean; calm?: boolean; of?: TestChromium } = {},
) {
  const site = await sites.serve(respond, options.policy);
  const page = await (options.of ?? undrawn).newPage({
    viewport: { width: 400, height: 300 },
    reducedMotion: options.calm ? "reduce" : "no-preference",
  });
  const complaints: string[] = [];
  page.on("pageerror", (error) => complaints.push(error.message));
  page.on("console", (message) => {
    const text = message.text();
    if (message.type() === "error" || isWebglComplaint(text)) complaints.push(text);
  });
  await page.addInitScript(countHoldings);
  // Textures are made and filled, and no leaf is drawn with them: that is what costs in software.
  await page.addInitScript(() => {
    WebGL2RenderingContext.prototype.drawElements = () => {};
  });
  if (options.flat) {
    await page.addInitScript(() => {
      const { getContext } = HTMLCanvasElement.prototype;
      HTMLCanvasElement.prototype.getContext = function (this: unknown, ...args: unknown[]) {
        return args[0] === "webgl2" ? null : Reflect.apply(getContext, this, args);
      } as typeof getContext;
    });
  }
  await page.goto(site.url);
  const session = await page.context().newCDPSession(page);
  await session.send("Performance.enable");
  return { page, session, complaints, asked: site.asked };
}

/** Puts a book on the page and waits until it is there and sharp. */
async function show(page: Page, src: string, attributes: Record<string, string> = {}) {
  await page.evaluate(
    async ([src, attributes]) => {
      const book = document.createElement("turnleaf-book") as TurnleafBook;
      for (const [name, value] of Object.entries(attributes)) book.setAttribute(name, value);
      const loaded = new Promise((resolve, reject) => {
        book.addEventListener("load", resolve, { once: true });
        const failed = (event: Event) => reject(new Error((event as CustomEvent).detail?.message));
        book.addEventListener("error", failed, { once: true });
      });
      book.src = src;
      document.body.append(book);
      await loaded;
    },
    [src, attributes] as const,
  );
  await bookSettles(page);
}

const pagesAsked = (asked: readonly string[]): number =>
  asked.filter((path) => path.startsWith("/pages/")).length;

test("a page without WebAssembly shows a book on the flat, and no error", async () => {
  const policy =
    "default-src 'none'; script-src 'self' 'nonce-map'; style-src 'self'; img-src 'self' blob: data:; connect-src 'self'";
  const { page, complaints, asked } = await open(images(12), { policy });
  await show(page, "/book.json", { duration: "80" });
  expect(await page.evaluate(() => document.querySelector("turnleaf-book")?.next())).toBe(true);
  const at = await page.evaluate(() => document.querySelector("turnleaf-book")?.page);
  expect(at).toBe(2);
  expect(asked.filter((path) => /three|webgl/.test(path))).toEqual([]);
  expect(asked.some((path) => path.includes("canvas2d_backend"))).toBe(true);
  expect(complaints).toEqual([]);
});

/** Books that come and go once all is compiled that they need. */
const books = 6;

/** Measurements, each of several collections, after which what is still there was left behind. */
const mostRounds = 50;

/** Bytes of heap that they may leave: what the browser compiles and learns while they run. */
const mostHeapLeft = 240_000;

describe.each([
  ["of images, in space", ["/book.json"], false, 12],
  ["of images and of PDF, on the flat", ["/book.json", "/book.pdf"], true, 18],
])("books that come and go: %s", (_, sources, flat, firstBooks) => {
  test("some of them leave nothing behind", async () => {
    const file = pdf(9);
    const pages = images(12);
    const respond = (path: string) => (path === "/book.pdf" ? file : pages(path));
    const of = flat ? undrawn : drawn;
    const { page, session, complaints } = await open(respond, { flat, calm: true, of });
    const comeAndGo = (times: number) =>
      page.evaluate(
        async ([times, sources]) => {
          for (let round = 0; round < times; round++) {
            const book = document.createElement("turnleaf-book") as TurnleafBook;
            const loaded = new Promise((resolve) => {
              book.addEventListener("load", resolve, { once: true });
            });
            book.src = sources[round % sources.length] as string;
            document.body.append(book);
            await loaded;
            await book.next();
            book.remove();
          }
        },
        [times, sources] as const,
      );
    // A PDF's worker has some time to end by itself: a timer says that it has not.
    const end = () =>
      comesTo(
        page,
        () => (globalThis as unknown as { holdings: { timers: Set<number> } }).holdings.timers.size,
        0,
      );
    // What the first ones load and compile stays for those to come.
    await comeAndGo(firstBooks);
    await end();
    const before = await holdingsOf(page, session);
    await comeAndGo(books);
    await end();
    const [mostNodes, mostListeners] = [before.nodes + 5, before.listeners + 2];
    let after = await holdingsOf(page, session);
    // The browser gives the last book back some collections later than those before it.
    for (let round = 0; round < mostRounds; round++) {
      if (after.nodes <= mostNodes && after.listeners <= mostListeners) break;
      after = await holdingsOf(page, session);
    }
    expect(after.nodes).toBeLessThanOrEqual(mostNodes);
    expect(after.listeners).toBeLessThanOrEqual(mostListeners);
    // What so many books hold is several times as much.
    expect(after.heap - before.heap).toBeLessThan(mostHeapLeft);
    expect(after.contexts).toBe(0);
    expect(after.memories).toBe(0);
    expect(after.urls).toBeLessThanOrEqual(before.urls);
    expect(after.workers).toBeLessThanOrEqual(before.workers);
    expect(after.pictureBytes).toBe(0);
    // Nor does anything go on: no timer runs, and no frame is requested but by this test.
    expect(after.timers).toBe(0);
    await passFrames(page, 5);
    const later = await holdingsOf(page, session);
    expect(later.frames - after.frames).toBe(5 + framesOfMeasuring);
    expect(later.timers).toBe(0);
    expect(complaints).toEqual([]);
  });
});

test("a book of 5,000 pages opens with few of them, goes far and back", async () => {
  const { page, asked, complaints } = await open(images(pageCount));
  await show(page, "/book.json", { duration: "300" });
  expect(await page.evaluate(() => document.querySelector("turnleaf-book")?.pageCount)).toBe(5000);
  expect(pagesAsked(asked)).toBeLessThanOrEqual(10);
  const goTo = (number: number) =>
    page.evaluate((to) => document.querySelector("turnleaf-book")?.goTo(to), number);
  for (const [to, at] of [
    [4321, 4320],
    [1, 1],
  ] as const) {
    const before = pagesAsked(asked);
    expect(await goTo(to)).toBe(true);
    await bookSettles(page);
    expect(await page.evaluate(() => document.querySelector("turnleaf-book")?.page)).toBe(at);
    // The leaves that fly for all the others, and what lies open at the end with its neighbours.
    expect(pagesAsked(asked) - before).toBeLessThanOrEqual(60);
  }
  expect(complaints).toEqual([]);
});

/** Jumps before the first measurement: the browser compiles and learns during some hundreds. */
const firstJumps = 380;

/** Bytes that 180 more jumps may add to the heap: what is known of each page seen is a number or two. */
const mostHeapGrowth = 400_000;

test("after 560 jumps a book holds no more than after 380", { timeout: 300_000 }, async () => {
  const { page, session, asked, complaints } = await open(images(pageCount), { calm: true });
  await show(page, "/book.json", { style: "width: 60px; height: 45px" });
  const jump = (from: number, to: number) =>
    page.evaluate(
      async ([from, to, pageCount]) => {
        const book = document.querySelector("turnleaf-book") as TurnleafBook;
        for (let k = from; k < to; k++) {
          // The same pages every time, and no order in them.
          const page = 1 + ((k * 2654435761) % pageCount);
          void book.goTo(page);
          // Time enough for some to be fetched and drawn, and for others to be called off.
          await new Promise(requestAnimationFrame);
          if (k % 50 === 19) while (!book.settled) await new Promise(requestAnimationFrame);
        }
      },
      [from, to, pageCount] as const,
    );
  await jump(0, firstJumps);
  await bookSettles(page);
  const before = await holdingsOf(page, session);
  await jump(firstJumps, firstJumps + 180);
  await bookSettles(page);
  const after = await holdingsOf(page, session);
  // Pages called off in time are never asked for at all.
  expect(pagesAsked(asked)).toBeLessThanOrEqual((firstJumps + 180) * 12);
  expect(after.heap - before.heap).toBeLessThan(mostHeapGrowth);
  expect(after.textureBytes).toBeLessThanOrEqual(1.1 * before.textureBytes);
  expect(after.pictureBytes).toBeLessThanOrEqual(1.1 * before.pictureBytes);
  expect(after.nodes).toBeLessThanOrEqual(before.nodes + 20);
  expect(after.listeners).toBeLessThanOrEqual(before.listeners + 5);
  expect(after.urls).toBeLessThanOrEqual(before.urls);
  expect(complaints).toEqual([]);
});
