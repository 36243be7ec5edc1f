/** A browser's page with the built package, scripts of tests and the books that they open: nothing else is there. */
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { chromium } from "playwright-core";
import { chromiumArguments, findChromium } from "../scripts/chromium.mjs";

const root = join(import.meta.dirname, "..");

// Secure, as fonts are decoded only there; every request is answered here.
const site = "https://turnleaf.test/";

const html = `<!doctype html><title>Test books</title><link rel="icon" href="data:,">
<style>body { margin: 0 }</style>
<script type="importmap">{"imports":{"three":"/three/three.module.js"}}</script>`;

/** Folders by the first part of an address. */
const folders = {
  turnleaf: "packages/turnleaf/dist",
  three: "node_modules/three/build",
  tests: "tests",
};

/**
 * Opens the page.
 *
 * @param respond returns the response to an address that begins with `/books/`, as Playwright's `fulfill` takes it
 */
export async function openPage(respond) {
  const browser = await chromium.launch({
    executablePath: findChromium(),
    args: chromiumArguments,
  });
  const page = await browser.newPage({ viewport: { width: 1000, height: 700 } });
  /** Addresses that something in the page has asked for, besides its own. */
  const foreign = [];
  await page.route("**/*", (route) => {
    const url = route.request().url();
    if (url.startsWith("data:")) return route.continue();
    if (!url.startsWith(site)) {
      foreign.push(url);
      return route.abort();
    }
    const { pathname } = new URL(url);
    const [folder = "", name = ""] = pathname.slice(1).split(/\/(.*)/);
    if (folder === "") return route.fulfill({ contentType: "text/html", body: html });
    if (folder === "books") return route.fulfill(respond(new URL(url)));
    if (!(folder in folders)) return route.fulfill({ status: 404 });
    const body = readFileSync(join(root, folders[folder], name));
    return route.fulfill({
      contentType: name.endsWith(".wasm") ? "application/wasm" : "text/javascript",
      body,
    });
  });
  await page.goto(site);
  return { browser, page, foreign, site, close: () => browser.close() };
}
