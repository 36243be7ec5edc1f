/**
 * Builds a small app in each of several frameworks and bundlers with the packed package, serves
 * it, and turns its book in Chromium. Writes the table in docs/browsers.md.
 *
 *   node tests/apps/run.mjs           all of them
 *   node tests/apps/run.mjs next vue  some of them, and their rows of the table
 *
 * An app's package.json has scripts "build" and "start", or "build" and the name
 * of the folder to be served; with a script "dev" it is tried in development as
 * well, where frameworks check more.
 */
import { execFile, spawn } from "node:child_process";
import { cp, mkdtemp, readdir, readFile, rm } from "node:fs/promises";
import { createServer } from "node:net";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { promisify } from "node:util";
import { chromium } from "playwright-core";
import { preview } from "vite";
import { chromiumArguments, findChromium } from "../../scripts/chromium.mjs";
import { includeTables, readTable, writeTable } from "../../scripts/docs_tables.mjs";

const root = join(import.meta.dirname, "../..");
const environment = {
  ...process.env,
  CI: "1",
  NEXT_TELEMETRY_DISABLED: "1",
  NG_CLI_ANALYTICS: "false",
  NUXT_TELEMETRY_DISABLED: "1",
  ASTRO_TELEMETRY_DISABLED: "1",
};

/** Runs a command; fails with everything it said. */
async function run(folder, command, ...args) {
  try {
    const options = { cwd: folder, env: environment, maxBuffer: 64 * 1024 * 1024 };
    return (await promisify(execFile)(command, args, options)).stdout;
  } catch (error) {
    throw new Error(`${command} ${args.join(" ")}:\n${error.stdout}${error.stderr}`);
  }
}

async function freePort() {
  const server = createServer();
  await new Promise((resolve) => server.listen(0, "127.0.0.1", resolve));
  const { port } = server.address();
  await new Promise((resolve) => server.close(resolve));
  return port;
}

/** Serves a folder of files. */
async function serveFolder(folder) {
  const port = await freePort();
  const server = await preview({
    root: folder,
    configFile: false,
    logLevel: "error",
    build: { outDir: folder },
    preview: { host: "127.0.0.1", port, strictPort: true },
  });
  return { url: `http://127.0.0.1:${port}/`, stop: () => server.close() };
}

/** Serves an app by a script of its own, which takes a port. */
async function serveByScript(folder, script) {
  const port = await freePort();
  const child = spawn("npm", ["run", "--silent", script, "--", String(port)], {
    cwd: folder,
    env: environment,
    stdio: ["ignore", "pipe", "pipe"],
    detached: true,
  });
  let output = "";
  for (const stream of [child.stdout, child.stderr]) {
    stream.on("data", (data) => {
      output += data;
    });
  }
  const ended = new Promise((resolve) => child.once("close", resolve));
  const stop = async () => {
    if (child.exitCode === null) process.kill(-child.pid);
    await ended;
  };
  const url = `http://127.0.0.1:${port}/`;
  for (let round = 0; round < 1200; round++) {
    const response = await fetch(url).catch(() => null);
    if (response?.ok) return { url, stop };
    if (child.exitCode !== null) break;
    await new Promise((resolve) => setTimeout(resolve, 100));
  }
  await stop();
  throw new Error(`${script} does not serve:\n${output}`);
}

/**
 * Warnings that no app can help: those of a driver that draws in software, and one of Svelte in
 * development, for which a test of the browser's own `includes` looks like a comparison of its state
 * (core-js makes it, in pdf.js).
 */
const ofOthers = /GL Driver Message|GPU stall|state_proxy_equality_mismatch.*array\.includes/s;

/** Opens an app, waits for its book, turns it by a key and by a command. Returns its faults. */
async function tryBook(browser, url) {
  const context = await browser.newContext({ viewport: { width: 480, height: 360 } });
  const page = await context.newPage();
  const faults = [];
  page.on("pageerror", (error) => faults.push(`thrown: ${error.message}`));
  page.on("console", (message) => {
    const said = /error|warning/.test(message.type()) && !ofOthers.test(message.text());
    const isFault = said || /hydrat/i.test(message.text());
    if (isFault) faults.push(`console: ${message.text()}`);
  });
  page.setDefaultTimeout(120_000);
  const book = page.locator("turnleaf-book");
  const shows = (number) =>
    page.waitForFunction((number) => {
      const book = document.querySelector("turnleaf-book");
      const reported = document.querySelector("output")?.textContent;
      return book?.page === number && book.settled && reported === String(number);
    }, number);
  try {
    await page.goto(url);
    await page.waitForFunction(() => document.querySelector("turnleaf-book")?.pageCount === 112);
    await page.waitForFunction(() => document.querySelector("turnleaf-book").settled);
    await book.focus();
    await page.keyboard.press("ArrowRight");
    await shows(20);
    if (!(await book.evaluate((book) => book.goTo(40)))) faults.push("goTo(40) resolved to false");
    await shows(40);
  } catch (error) {
    const seen = await book
      .evaluate((book) => ({
        page: book.page,
        pageCount: book.pageCount,
        settled: book.settled,
        reported: document.querySelector("output")?.textContent,
        text: book.shadowRoot?.querySelector("[part=message]")?.textContent,
      }))
      .catch(() => null);
    faults.push(`${error.message} ${JSON.stringify(seen)}`);
  }
  if (process.env.PICTURES) {
    await page.screenshot({ path: join(process.env.PICTURES, `${new URL(url).port}.png`) });
  }
  await context.close();
  return faults;
}

const names = (await readdir(import.meta.dirname, { withFileTypes: true }))
  .filter((entry) => entry.isDirectory())
  .map(({ name }) => name);
const asked = process.argv.slice(2);
const chosen = asked.length > 0 ? asked : names;

const folder = await mkdtemp(join(tmpdir(), "turnleaf-apps-"));
const browser = await chromium.launch({
  executablePath: findChromium(),
  args: chromiumArguments,
});
let hasFault = false;
try {
  await run(root, "npm", "pack", "--workspace", "turnleaf", "--pack-destination", folder);
  const tarball = (await readdir(folder)).find((name) => name.endsWith(".tgz"));
  for (const name of chosen) {
    const app = join(folder, name);
    await cp(join(import.meta.dirname, name), app, { recursive: true });
    const publicFolder = name === "sveltekit" ? "static" : "public";
    await cp(join(root, "books/moby-dick.pdf"), join(app, publicFolder, "book.pdf"));
    const { scripts, served, dependencies, devDependencies } = JSON.parse(
      await readFile(join(app, "package.json"), "utf8"),
    );
    const faults = [];
    const modes = [];
    try {
      await run(app, "npm", "install", "--no-audit", "--no-fund", join("..", tarball));
      await run(app, "npm", "run", "build");
      const starts = [
        ["built", () => (served ? serveFolder(join(app, served)) : serveByScript(app, "start"))],
        ...(scripts.dev ? [["development", () => serveByScript(app, "dev")]] : []),
      ];
      for (const [mode, start] of starts) {
        modes.push(mode);
        const site = await start();
        const html = await (await fetch(site.url)).text();
        if (html.includes("<turnleaf-book")) modes[modes.length - 1] += ", the element in the HTML";
        for (const fault of await tryBook(browser, site.url)) faults.push(`${mode}: ${fault}`);
        await site.stop();
      }
    } catch (error) {
      faults.push(error.message);
    }
    const versions = Object.entries({ ...dependencies, ...devDependencies })
      .filter(([of]) => of !== "three" && of !== "tslib")
      .map(([of, version]) => `${of} ${version}`);
    console.log(`${faults.length === 0 ? "passed" : "FAILED"}  ${name}: ${modes.join("; ")}`);
    for (const fault of faults) console.error(`  ${fault}`);
    hasFault ||= faults.length > 0;
    if (faults.length === 0) writeRow(name, [versions.join(", "), modes.join("; ")]);
  }
} finally {
  await browser.close();
  await rm(folder, { recursive: true, force: true, maxRetries: 5 });
}
if (hasFault) process.exitCode = 1;

/** Puts an app's row into the table, in place of the one it had. */
function writeRow(name, cells) {
  const [headings, ...rows] = readTable("apps");
  const others = rows.filter(([app]) => app !== name);
  writeTable("apps", [headings, ...[...others, [name, ...cells]].sort()]);
  includeTables();
}
