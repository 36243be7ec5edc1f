/** Pages in Chromium for the tests of a file. */

import { fileURLToPath } from "node:url";
import {
  type Browser,
  type BrowserContext,
  type BrowserContextOptions,
  chromium,
  type Page,
} from "playwright-core";
import { build } from "vite";
import { afterAll, afterEach, beforeAll } from "vitest";
import { chromiumArguments, findChromium } from "../../../scripts/chromium.mjs";

/** Options of {@link chromiumForTests}. */
export interface ChromiumOptions {
  /** If true, pages have the WebGL of the browser; otherwise a WebGL 2 that draws nothing. */
  readonly isDrawn?: boolean;
}

/** Pages for the tests of a file. */
export interface TestChromium {
  /** Opens an empty page in a context of its own. It has no timeout but the test's. */
  newPage(options?: BrowserContextOptions): Promise<Page>;
}

/**
 * Opens pages for the tests of a file; to be called outside them. They are closed after each test, or
 * after all if `keepsPages`.
 */
export function chromiumForTests({
  isDrawn = false,
  keepsPages = false,
}: ChromiumOptions & { readonly keepsPages?: boolean } = {}): TestChromium {
  const contexts: BrowserContext[] = [];
  const close = async () => {
    for (const context of contexts.splice(0)) await context.close();
  };
  if (keepsPages) afterAll(close);
  else afterEach(close);
  return {
    async newPage(options) {
      const context = await (await chromiumOf(isDrawn)).newContext(options);
      contexts.push(context);
      context.setDefaultTimeout(0);
      if (!isDrawn) await context.addInitScript({ content: await undrawn });
      return await context.newPage();
    },
  };
}

/** A page for the tests of a file, one after another. */
export interface TestPage {
  readonly page: Page;
  /** Errors and warnings in the page since the test began. */
  readonly complaints: string[];
}

/**
 * Opens one page for all tests of a file; to be called outside them. After each test the page is left
 * and what its site stored is deleted. That costs half as much as a page for each, as the page's
 * process keeps what it compiled.
 */
export function pageForTests({
  isDrawn = false,
  ...options
}: BrowserContextOptions & ChromiumOptions = {}): TestPage {
  const tests = chromiumForTests({ isDrawn, keepsPages: true });
  let page: Page;
  const complaints: string[] = [];
  beforeAll(async () => {
    page = await tests.newPage(options);
    hearComplaints(page, complaints);
  });
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

/**
 * Empties a page by a navigation of its own. After `page.goto("about:blank")` from a page with a
 * Cross-Origin-Opener-Policy, as the command's have, the next page gets a new process, which compiles all
 * scripts anew.
 */
export async function emptyPage(page: Page): Promise<void> {
  // One that is empty has no change of its address to wait for.
  if (page.url() === "about:blank") return;
  await page.evaluate(() => location.replace("about:blank"));
  await page.waitForURL("about:blank");
}

/** Empties a page and deletes what its site stored. */
async function leave(page: Page): Promise<void> {
  const { origin } = new URL(page.url());
  await emptyPage(page);
  if (origin === "null") return;
  const session = await page.context().newCDPSession(page);
  await session.send("Storage.clearDataForOrigin", { origin, storageTypes: "all" });
  await session.detach();
}

/** The browsers of all files of tests that run, one after another, in this process; they end with it. */
const browsers = new Map<boolean, Promise<Browser>>();

/** Returns the Chromium that draws or the one that does not, launched when it is first needed. */
function chromiumOf(isDrawn: boolean): Promise<Browser> {
  let browser = browsers.get(isDrawn);
  if (!browser) {
    browser = launchChromium(isDrawn);
    browsers.set(isDrawn, browser);
    browser.catch(() => browsers.delete(isDrawn));
  }
  return browser;
}

/** Launches Chromium. Without WebGL it composes its pages on the processor, which costs less. */
async function launchChromium(isDrawn: boolean): Promise<Browser> {
  const args = isDrawn
    ? chromiumArguments
    : [...chromiumArguments.filter((flag) => !/swiftshader|gpu/.test(flag)), "--disable-gpu"];
  // As a page, it has no timeout but that of the test or hook that needs it.
  const browser = await chromium.launch({ executablePath: findChromium(), args, timeout: 0 });
  // One that crashed fails the tests of one file.
  browser.once("disconnected", () => browsers.delete(isDrawn));
  return browser;
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
