import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { createServer } from "node:http";
import { tmpdir } from "node:os";
import { extname, join } from "node:path";
import { chromium } from "playwright-core";
import { afterAll, beforeAll, expect, it } from "vitest";
import { chromiumArguments, findChromium } from "../chromium.mjs";
import { anchorOf } from "../headings.mjs";
import { deadLinks, makeSite } from "./site.mjs";

const types = { ".html": "text/html", ".css": "text/css", ".js": "text/javascript" };
let [out, browser, server, url] = [];

beforeAll(async () => {
  out = mkdtempSync(join(tmpdir(), "turnleaf-site-"));
  makeSite(out);
  server = createServer((request, response) => {
    try {
      const { pathname } = new URL(request.url, "http://localhost");
      const file = pathname === "/" ? "/index.html" : pathname;
      const type = types[extname(file)] ?? "application/octet-stream";
      response.writeHead(200, { "Content-Type": type }).end(readFileSync(join(out, file)));
    } catch {
      response.writeHead(404).end();
    }
  });
  await new Promise((resolve) => server.listen(0, "127.0.0.1", resolve));
  url = `http://127.0.0.1:${server.address().port}/`;
  browser = await chromium.launch({ executablePath: findChromium(), args: chromiumArguments });
});

afterAll(async () => {
  await browser?.close();
  server?.close();
  server?.closeAllConnections();
  if (out) rmSync(out, { recursive: true });
});

it("makes a heading's anchor as links in the docs name it", () => {
  expect(anchorOf("In a `book`: what, and why")).toBe("in-a-book-what-and-why");
});

it("finds links that lead nowhere, to no file and to no heading", () => {
  const folder = mkdtempSync(join(tmpdir(), "turnleaf-links-"));
  const page = '<h2 id="a"></h2><a href="#a"></a><a href="#b"></a><img src="none.png">';
  writeFileSync(join(folder, "page.html"), page);
  expect(deadLinks(folder)).toEqual([
    "page.html leads to #b: it has no such heading.",
    "page.html leads to none.png: there is none.",
  ]);
  rmSync(folder, { recursive: true });
});

it("can be read without JavaScript, the front page too", async () => {
  const context = await browser.newContext({ javaScriptEnabled: false });
  const page = await context.newPage();
  await page.goto(url);
  expect(await page.getByText("What opens").isVisible()).toBe(true);
  await page.getByText("For libraries and museums").click();
  expect(await page.locator("h1").textContent()).toBe("For libraries and museums");
  await page.getByRole("navigation").getByText("Physics").click();
  expect(await page.locator("h1").first().textContent()).toMatch(/physics/i);
  expect(await page.locator("nav [aria-current]").textContent()).toBe("Physics");
  await context.close();
});

it("has a book for its front page, and examples that run", { timeout: 480_000 }, async () => {
  // Small, as drawing is in software here.
  const page = await browser.newPage({ viewport: { width: 400, height: 300 } });
  const failures = [];
  page.on("pageerror", (error) => failures.push(error.message));
  page.on("response", (response) => {
    if (!response.ok()) failures.push(`${response.status()} ${response.url()}`);
  });
  const isSettled = () => document.querySelector("turnleaf-book")?.settled === true;
  await page.goto(url);
  await page.waitForFunction(isSettled, null, { timeout: 200_000 });
  expect(await page.evaluate(() => document.querySelector("turnleaf-book").pageCount)).toBe(8);
  await page.goto(`${url}examples/01-minimal.html`);
  await page.waitForFunction(isSettled, null, { timeout: 200_000 });
  expect(failures).toEqual([]);
  await page.close();
});
