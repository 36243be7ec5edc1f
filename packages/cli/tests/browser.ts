/** A Chromium for the tests of a file. */

import { fileURLToPath } from "node:url";
import { type Browser, type BrowserContextOptions, chromium, type Page } from "playwright-core";
import { build } from "vite";
import { afterAll, afterEach, beforeAll } from "vitest";
import { chromiumArguments, findChromium } from "../../../scripts/chromium.mjs";

/** Options of {@link chromiumForTests}. */
export interface ChromiumOptions {
  /** If true, pages have the WebGL of the browser; otherwise a WebGL 2 that draws nothing. */
  readonly isDrawn?: boolean;
}

/** A Chromium that runs while the tests of a file do. */
export interface TestChromium {
  readonly browser: Browser;
  /** Opens an empty page in a context of its own, closed after the test. It has no timeout but the test's. */
  newPage(options?: BrowserContextOptions): Promise<Page>;
}

/**
 * Launches Chromium for the tests of a file; to be called outside them. Closes its pages after each
 * test, unless `keepsPages`.
 */
export function chromiumForTests({
  isDrawn = false,
  keepsPages = false,
}: ChromiumOptions & { readonly keepsPages?: boolean } = {}): TestChromium {
  let browser: Browser;
  beforeAll(async () => {
    browser = await launchChromium({ isDrawn });
  });
  afterAll(() => browser?.close());
  if (!keepsPages) {
    afterEach(async () => {
      for (const context of browser?.contexts() ?? []) await context.close();
    });
  }
  return {
    get browser() {
      return browser;
    },
    newPage: (options) => newPage(browser, { ...options, isDrawn }),
  };
}

/** A page for the tests of a file, one after another. */
export interface TestPage {
  readonly page: Page;
  /** Errors and warnings in the page since the test began. */
  readonly complaints: string[];
}

/**
 * Launches Chromium with one page for all tests of a file; to be called outside them. After each test
 * the page is left and what its site stored is deleted. That costs half as much as a page for each, as
 * the page's process keeps what it compiled.
 */
export function pageForTests({
  isDrawn = false,
  ...options
}: BrowserContextOptions & ChromiumOptions = {}): TestPage {
  let browser: Browser;
  let page: Page;
  const complaints: string[] = [];
  beforeAll(async () => {
    browser = await launchChromium({ isDrawn });
    page = await newPage(browser, { ...options, isDrawn });
    hearComplaints(page, complaints);
  });
  afterAll(() => browser?.close());
  afterEach(async () => {
    await leave(page);
    complaints.length = 0;
  });
  return {
    get page() {
      return page;
    },
    complaints,
  };
}

/** Adds the errors and warnings of a page to a list. */
export function hearComplaints(page: Page, complaints: string[]): void {
  page.on("pageerror", (error) => complaints.push(error.message));
  page.on("console", (message) => {
    if (/error|warning/.test(message.type())) complaints.push(message.text());
  });
}

/** Empties a page and deletes what its site stored. */
async function leave(page: Page): Promise<void> {
  const { origin } = new URL(page.url());
  await page.goto("about:blank");
  if (origin === "null") return;
  const session = await page.context().newCDPSession(page);
  await session.send("Storage.clearDataForOrigin", { origin, storageTypes: "all" });
  await session.detach();
}

/** Launches Chromium. Without WebGL it composes its pages on the processor, which costs less. */
export function launchChromium({ isDrawn = false }: ChromiumOptions = {}): Promise<Browser> {
  const args = isDrawn
    ? chromiumArguments
    : [...chromiumArguments.filter((flag) => !/swiftshader|gpu/.test(flag)), "--disable-gpu"];
  return chromium.launch({ executablePath: findChromium(), args });
}

/** Opens an empty page in a context of its own. It has no timeout but the test's. */
export async function newPage(
  browser: Browser,
  { isDrawn = false, ...options }: BrowserContextOptions & ChromiumOptions = {},
): Promise<Page> {
  const context = await browser.newContext(options);
  context.setDefaultTimeout(0);
  if (!isDrawn) await context.addInitScript({ content: await undrawn });
  return await context.newPage();
}

const undrawnFile = new URL("../../turnleaf/src/for_tests/undrawn.ts", import.meta.url);

/** A script that gives every canvas of a page a WebGL 2 context that draws nothing. */
const undrawn: Promise<string> = build({
  configFile: false,
  logLevel: "silent",
  build: {
    write: false,
    lib: { entry: fileURLToPath(undrawnFile), formats: ["iife"], name: "undrawn" },
  },
}).then((built) => {
  const [{ output }] = [built].flat() as { output: { code: string }[] }[];
  return `${output[0].code}\nundrawn.drawNothing();`;
});
