import { rmSync } from "node:fs";
import { join } from "node:path";
import { type Browser, chromium, type Page } from "playwright-core";
import type { TurnleafBook } from "turnleaf";
import { afterAll, beforeAll, expect, it } from "vitest";
import { chromiumArguments, findChromium } from "../../../scripts/chromium.mjs";
import { findPage, pageOfHash } from "../app/pages.ts";
import { pdf, png } from "./books.ts";
import { folderOf, type Started, start } from "./command.ts";

let browser: Browser;
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
  await page.locator("#bar").waitFor({ state: "visible" });
}

beforeAll(async () => {
  folder = folderOf({
    "small.pdf": pdf(9),
    "scans/1.png": png(30, 40),
    "scans/2.png": png(30, 40),
  });
  served = await start(join(folder.path, "small.pdf"), "--port", "0");
  browser = await chromium.launch({ executablePath: findChromium(), args: chromiumArguments });
  page = await browser.newPage({ viewport: { width: 480, height: 360 }, reducedMotion: "reduce" });
  page.on("pageerror", (error) => complaints.push(error.message));
  page.on("console", (message) => {
    if (message.type() === "error") complaints.push(message.text());
  });
});
afterAll(async () => {
  await browser.close();
  await served.stop();
  folder.remove();
});

it("opens the book under the strict policy, with its title and labels", async () => {
  await open(served.url);
  expect(await page.title()).toBe("A Small Book");
  expect(await book(({ pageCount }) => pageCount)).toBe(9);
  expect(await page.getByLabel("Page", { exact: true }).inputValue()).toBe("i");
  expect(await page.locator("#count").textContent()).toBe("/ 9");
  expect(complaints).toEqual([]);
});

it("goes to a page by its label or number, and says when there is none", async () => {
  const field = page.getByLabel("Page", { exact: true });
  await field.fill("IV");
  await field.press("Enter");
  await expect.poll(() => book(({ page }) => page)).toBe(4);
  await expect.poll(() => page.evaluate(() => location.hash)).toBe("#page=4");
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
  await expect.poll(() => page.evaluate(() => location.hash)).toBe("#page=6");
  await page.goto("about:blank");
  await open(served.url);
  expect(await book(({ page }) => page)).toBe(6);
  await page.getByRole("button", { name: "Previous page" }).click();
  await expect.poll(() => book(({ page }) => page)).toBe(4);
});

it("hides its controls at rest and shows them to the pointer and to the keyboard", async () => {
  const shade = (): Promise<string> =>
    page.locator("#bar").evaluate((bar) => getComputedStyle(bar).opacity);
  await page.mouse.move(100, 100);
  await expect.poll(shade).toBe("1");
  await book((book) => book.focus());
  await expect.poll(shade, { timeout: 6000 }).toBe("0");
  await page.getByLabel("Page", { exact: true }).focus();
  await expect.poll(shade).toBe("1");
});

it("shows a book of scans, and one sentence where a page would be if it is gone", async () => {
  const scans = await start(join(folder.path, "scans"), "--port", "0");
  await open(scans.url);
  expect(await book(({ pageCount }) => pageCount)).toBe(2);
  rmSync(join(folder.path, "scans"), { recursive: true });
  await scans.stop();
  expect(complaints).toEqual([]);
});

it("says in the browser when the book is gone", async () => {
  const other = await start(join(folder.path, "small.pdf"), "--port", "0");
  rmSync(join(folder.path, "small.pdf"));
  await page.goto(other.url);
  await page.getByText("small.pdf was not found; check the address and open it again.").waitFor();
  await other.stop();
});

it("finds pages by what is typed", () => {
  const labels = ["i", "ii", "1", "2", "A-1"];
  const found = (text: string): number | null =>
    findPage({ pageCount: 5, label: (page) => labels[page - 1] ?? "" }, text);
  expect([" II ", "1", "a-1", "5", "6", "0", "1.5", "", "x"].map(found)).toEqual([
    2,
    3,
    5,
    5,
    null,
    null,
    null,
    null,
    null,
  ]);
  expect(["#page=12", "#page=0", "#page=", "", "#page=1e3"].map(pageOfHash)).toEqual([
    12,
    null,
    null,
    null,
    null,
  ]);
});
