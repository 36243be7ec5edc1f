/** Every example, opened in a real Chromium under the strict policy that `examples/serve.mjs` sends. */

import type { Page } from "playwright-core";
import type { TurnleafBook } from "turnleaf";
import { afterAll, afterEach, beforeAll, expect, it } from "vitest";
import { serve } from "../../../examples/serve.mjs";
import { isWebglComplaint } from "../../../scripts/console_watch.mjs";
import { chromiumForTests, pageForTests } from "./browser.ts";
import { askBook, bookComesTo, bookSettles, comesTo, textComesTo } from "./waiting.ts";

const tests = pageForTests();
/** For the one example that is drawn. */
const drawing = chromiumForTests({ isDrawn: true });
let page: Page;
let site: Awaited<ReturnType<typeof serve>>;

beforeAll(async () => {
  site = await serve();
});
afterAll(async () => {
  await site?.stop();
});
afterEach(async () => {
  expect(tests.complaints.splice(0)).toEqual([]);
});

/** Evaluates a function on the example's book. */
const ask = <T, A>(look: (book: TurnleafBook, value: A) => T, value?: A): Promise<Awaited<T>> =>
  askBook(page, look, value);

const spread = () => ask((book) => book.spread);
const place = () => ask((book) => book.page);
const comesToPage = (number: number) => bookComesTo(page, (book) => book.page, number);
const bookShows = (number: number | null | undefined) =>
  page.waitForFunction((number) => {
    const book = document.querySelector<TurnleafBook>("turnleaf-book");
    return Object.values(book?.spread ?? {}).includes(number as number);
  }, number);
const says = (text: string | RegExp) => textComesTo(page, "output", text);

/** Opens an example in a small window, without motion, and waits for its book. */
async function open(name: string, { width = 400, height = 280, of = tests.page } = {}) {
  page = of;
  await page.setViewportSize({ width, height });
  await page.emulateMedia({ reducedMotion: "reduce" });
  const response = await page.goto(`${site.url}${name}.html`);
  const policy = response?.headers()["content-security-policy"] ?? "";
  expect(policy).toContain("default-src 'none'; script-src 'self' 'wasm-unsafe-eval' 'sha256-");
  expect(policy).not.toContain("unsafe-inline");
  await bookComesTo(page, (book) => book.pageCount > 0, true);
  await bookSettles(page);
}

/** Fades to a page, and turns leaves from then on. */
async function turnFrom(number: number) {
  await ask((book, to) => book.goTo(to as number), number);
  await bookSettles(page);
  await page.emulateMedia({ reducedMotion: "no-preference" });
  // A turn takes a tenth of its time: leaves are seen to turn elsewhere.
  await ask((book) => {
    book.duration = 100;
  });
}

/**
 * Drags from one place of the book to another, in fractions of its size, at the
 * pace of its frames.
 */
async function drag(from: readonly [number, number], to: readonly [number, number]) {
  const box = await page.locator("turnleaf-book").boundingBox();
  if (!box) throw new Error("no book");
  const at = (t: number): [number, number] => [
    box.x + box.width * (from[0] + (to[0] - from[0]) * t),
    box.y + box.height * (from[1] + (to[1] - from[1]) * t),
  ];
  await page.mouse.move(...at(0));
  await page.mouse.down();
  for (let step = 1; step <= 20; step++) {
    await page.mouse.move(...at(step / 20));
    await page.evaluate(() => new Promise((resolve) => requestAnimationFrame(resolve)));
  }
  await page.mouse.up();
}

it("1: one element opens a PDF, its keys turn it, and WebGL has no complaint", async () => {
  const complaints: string[] = [];
  const drawn = await drawing.newPage();
  drawn.on("console", (message) => {
    if (isWebglComplaint(message.text())) complaints.push(message.text());
  });
  await open("01-minimal", { of: drawn });
  expect(await ask((book) => [book.bookTitle, book.pageCount, book.page])).toEqual([
    "Moby-Dick; or, The Whale (Chapters 1 to 14)",
    112,
    18,
  ]);
  await turnFrom(19);
  await page.locator("turnleaf-book").press("ArrowRight");
  await comesToPage(20);
  await bookSettles(page);
  expect(complaints).toEqual([]);
});

it("2: images in a list are pages, two facing each other from the first on", async () => {
  await open("02-pictures");
  expect(await spread()).toEqual({ left: 1, right: 2 });
  expect(await ask((book) => [book.pageCount, book.label(6)])).toEqual([8, "18:00"]);
  expect(await ask((book) => book.next())).toBe(true);
  expect(await spread()).toEqual({ left: 3, right: 4 });
});

it("3: a comic read from the right is turned by a drag from the left", async () => {
  await open("03-manga", { height: 420 });
  expect(await ask((book) => [book.direction, book.bookTitle])).toEqual(["rtl", "The Leaf"]);
  await turnFrom(2);
  expect(await spread()).toEqual({ left: 3, right: 2 });
  await drag([0.2, 0.6], [0.85, 0.6]);
  await comesToPage(4);
  expect(await spread()).toEqual({ left: 5, right: 4 });
});

it("4: a calendar's month is turned upwards", async () => {
  await open("04-calendar", { width: 300, height: 460 });
  expect(await ask((book) => book.pageCount)).toBe(25);
  await turnFrom(2);
  expect(await spread()).toEqual({ left: 2, right: 3 });
  await drag([0.5, 0.9], [0.5, 0.25]);
  await comesToPage(4);
});

it("5: one page alone, and the next a leaf further", async () => {
  await open("05-phone", { width: 300, height: 520 });
  expect(await ask((book) => [book.shownLayout, book.page])).toEqual(["single", 19]);
  expect(await ask((book) => book.next())).toBe(true);
  expect(await place()).toBe(20);
});

it("6: the reader keeps its page in the address and its bookmarks over a reload", async () => {
  await open("06-reader", { width: 760 });
  await page.getByRole("button", { name: "Next page" }).click();
  await comesTo(page, () => location.hash, "#page=20");
  await page.getByRole("button", { name: "Bookmark this page" }).click();
  await page.reload();
  await bookComesTo(page, (book) => book.pageCount, 112);
  expect(await ask((book) => [book.page, ...book.bookmarks])).toEqual([20, 20]);
  expect(await page.evaluate(() => location.hash)).toBe("#page=20");
});

it("7: the panel follows the book, and its buttons wait for it", async () => {
  await open("07-events", { width: 700 });
  const current = page.locator("[aria-current]");
  await page.getByRole("button", { name: "15:00" }).click();
  await says("15:00 it is.");
  expect(await current.allTextContents()).toEqual(["12:00", "15:00"]);
  await page.getByRole("button", { name: "Through the day" }).click();
  await says("The day is over.");
  expect(await current.allTextContents()).toEqual(["23:00"]);
});

it("8: the form's paper is the book's, and its leaves still turn", async () => {
  await open("08-paper", { width: 700 });
  await page.getByLabel("Paper").selectOption("card");
  await page.getByLabel("Wind").fill("2");
  await page.getByLabel("Help").uncheck();
  expect(await ask((book) => book.paper)).toEqual({
    stock: "card",
    grain: "along",
    wind: [-2, 0, 0],
    assist: false,
  });
  await turnFrom(30);
  expect(await ask((book) => book.next())).toBe(true);
  expect(await place()).toBe(32);
});

it("9: finds with a form of its own, marks the hit and leads through the contents", async () => {
  await open("09-search", { width: 760 });
  await page.getByRole("searchbox").fill("hypos");
  await page.getByRole("searchbox").press("Enter");
  await says("1 places");
  await page.locator("ol button").click();
  await comesToPage(18);
  await page.locator("[part~=mark-here]").first().waitFor({ state: "attached" });
  await page.getByRole("searchbox").fill("");
  await page.getByRole("searchbox").press("Enter");
  await page.getByRole("button", { name: "The Chapel" }).click();
  const chapel = await ask(async (book) => {
    const entries = await book.outline();
    return entries.find(({ title }) => title.includes("The Chapel"))?.page;
  });
  await bookShows(chapel);
  expect(await page.locator("[part~=mark]").count()).toBe(0);
});

it("10: the controls have the page's colours and speak its language", async () => {
  await open("10-theming", { width: 760 });
  const bar = page.getByRole("toolbar", { name: "Leser" });
  expect(await bar.evaluate((bar) => getComputedStyle(bar).backgroundColor)).toBe(
    "rgb(16, 43, 40)",
  );
  const next = page.getByRole("button", { name: "Nächste Seite" });
  expect(await next.evaluate((button) => getComputedStyle(button).borderRadius)).toBe("50%");
  await next.click();
  await comesToPage(20);
});

it("11: a guest's page comes into the open book, and goes out again", async () => {
  await open("11-guest-book", { width: 700 });
  await page.getByRole("textbox").fill("Emmy");
  await page.getByRole("button", { name: "Write" }).click();
  await says("9 pages");
  await bookShows(7);
  await page.getByRole("button", { name: "Take" }).click();
  await says("8 pages");
});

it("12: the open book turns its pages in every way that is chosen", async () => {
  await open("12-models", { width: 760 });
  await turnFrom(25);
  const select = page.getByRole("combobox", { name: "Pages turn" });
  let from = await place();
  for (const model of await select
    .locator("option")
    .evaluateAll((all) => all.map((o) => (o as HTMLOptionElement).value))) {
    await select.selectOption(model);
    await bookComesTo(page, (book) => book.ready, true);
    expect(await ask((book) => book.model)).toBe(model);
    expect(await ask((book) => book.next())).toBe(true);
    await comesToPage(from + 2);
    await bookComesTo(page, (book) => book.turning, false);
    from += 2;
  }
});

it("13: pages of a source of one's own are drawn, found and turned", async () => {
  await open("13-source", { width: 760 });
  expect(await ask((book) => book.pageCount)).toBe(100);
  const hits = await ask((book) => book.search("polygon of 57 sides"));
  expect(hits).toMatchObject([{ page: 55 }]);
  expect(await ask((book) => book.goTo(55))).toBe(true);
});

it("14: leaves of board and of paper turn over and back in one book, bound anew", async () => {
  await open("14-stocks", { width: 760 });
  await turnFrom(25);
  const select = page.getByRole("combobox", { name: "This book is" });
  const before = await spread();
  for (const stocks of ["board 25-40", ""]) {
    await select.selectOption(stocks);
    expect(await ask((book) => book.stocks)).toBe(stocks);
    expect(await ask((book) => book.next())).toBe(true);
    await bookComesTo(page, (book) => book.spread, { left: 26, right: 27 });
    expect(await ask((book) => book.previous())).toBe(true);
    await bookComesTo(page, (book) => book.spread, before);
  }
});

it("15: pages of HTML are used where they lie, keep what is written, and lead to each other", async () => {
  await open("15-html", { width: 640, height: 440 });
  expect(await ask((book) => book.pageCount)).toBe(6);
  await ask((book) => book.goTo(4));
  await bookSettles(page);
  await page.getByLabel("Your name").fill("Ishmael");
  await page.getByRole("button", { name: "Order" }).click();
  await says(/^Ishmael comes/);
  await ask((book) => book.goTo(2));
  await bookSettles(page);
  await page.getByRole("link", { name: "Order a place" }).click();
  await comesToPage(4);
  expect(await page.getByLabel("Your name").inputValue()).toBe("Ishmael");
});

it("16: a link is a book, with the theme that it names", async () => {
  await open("16-link", { width: 640, height: 440 });
  expect(await ask((book) => [book.pageCount, book.theme, book.controls])).toEqual([
    112,
    "sepia",
    true,
  ]);
  expect(await page.locator("a").count()).toBe(0);
  expect(await ask((book) => book.next())).toBe(true);
});

it("17: a page is folded as a letter, and opened again", async () => {
  await open("17-folds", { width: 760 });
  await page.emulateMedia({ reducedMotion: "no-preference" });
  await page.getByRole("button", { name: "Fold it as a letter" }).click();
  await says("Folds: 2");
  expect(await ask((book) => book.folds.map(({ page }) => page))).toEqual([25, 25]);
  await page.getByRole("button", { name: "Open it" }).click();
  await says("Folds: 0");
});

it("18: a day is torn off a calendar that is bound at its head, and put back", async () => {
  await open("18-tear-off", { width: 480, height: 640 });
  expect(await ask((book) => [book.pageCount, book.tearable])).toEqual([30, "perforated"]);
  await turnFrom(1);
  await page.getByRole("button", { name: "Tear off today" }).click();
  await bookComesTo(page, (book) => book.pageCount, 29);
  await says("29 days left");
  await page.getByRole("button", { name: "Put it back" }).click();
  await bookComesTo(page, (book) => book.pageCount, 30);
  await says("30 days left");
});

it("19: coupons are torn out but for one that has expired", async () => {
  await open("19-coupons", { width: 720, height: 480 });
  const use = page.getByRole("button", { name: "Use this coupon" });
  // Without motion too.
  await use.click();
  await says("One coffee: show CF-204.");
  expect(await ask((book) => [book.pageCount, book.page])).toEqual([3, 1]);
  await turnFrom(2);
  await use.click();
  await says("Two for one has expired.");
  await bookComesTo(page, (book) => book.state, "resting");
  expect(await ask((book) => book.pageCount)).toBe(3);
  await page.getByRole("button", { name: "Undo" }).click();
  await says("One coffee is back.");
  expect(await ask((book) => book.pageCount)).toBe(4);
});

it("20: a map is unfolded and folded in again", async () => {
  await open("20-fold-outs", { width: 760, height: 520 });
  await page.getByRole("button", { name: "Unfold" }).click();
  await says("Page 5 is open");
  await page.getByRole("button", { name: "Fold in" }).click();
  await says("Folded in");
  expect(await ask((book) => [book.page, book.state])).toEqual([4, "resting"]);
});
