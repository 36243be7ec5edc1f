/** Helpers for tests of `turnleaf publish`: small books, the built command, pages of its sites. */

import type { ChildProcess } from "node:child_process";
import { createHash } from "node:crypto";
import { readdirSync, readFileSync, statSync } from "node:fs";
import { join } from "node:path";
import type { Browser, BrowserContextOptions, Page } from "playwright-core";
import { afterAll, afterEach } from "vitest";
import { textPdf } from "./books.ts";
import { hearComplaints, launchChromium, newPage as newPageIn } from "./browser.ts";
import { type Ended, folderOf, runWithChromium } from "./command.ts";
import { type SiteServer, serveSite } from "./site_server.ts";

/** Small pictures, as drawing is in software here, by one browser: starting another takes longer. */
export const small: readonly string[] = ["--size", "256", "--workers", "1"];
/** Books of the tests of many; `TURNLEAF_BOOKS=200 npx vitest run publish` for more. */
export const bookCount: number = Number(process.env.TURNLEAF_BOOKS ?? 4);
export const patience: number = 60_000 + 10_000 * bookCount;

const folders: ReturnType<typeof folderOf>[] = [];
const servers: SiteServer[] = [];
let browser: Browser | undefined;

afterEach(async () => {
  for (const context of browser?.contexts() ?? []) await context.close();
  for (const server of servers.splice(0)) await server.stop();
});
afterAll(async () => {
  await browser?.close();
  for (const folder of folders) folder.remove();
}, patience);

/** Creates a folder of the given files, deleted when all tests have run. */
export function folder(files: Record<string, string | Uint8Array> = {}): string {
  const made = folderOf(files);
  folders.push(made);
  return made.path;
}

/** Publishes with the built command; `watch` sees it as it begins. */
export const publish = (
  args: readonly string[],
  watch?: (child: ChildProcess) => void,
): Promise<Ended> => runWithChromium(["publish", ...args], watch);

/** Returns every file below a folder with a hash of its bytes. */
export function filesOf(path: string): Record<string, string> {
  const names = readdirSync(path, { recursive: true }) as string[];
  const files = names.sort().filter((name) => statSync(join(path, name)).isFile());
  return Object.fromEntries(
    files.map((name) => [
      name,
      createHash("sha256")
        .update(readFileSync(join(path, name)))
        .digest("hex"),
    ]),
  );
}

/** Books whose texts differ, in the order of their names. */
export function manyBooks(count: number): string[] {
  const names = Array.from(
    { length: count },
    (_, k) => `book-${String(k + 1).padStart(3, "0")}.pdf`,
  );
  const path = folder(
    Object.fromEntries(
      names.map((name, k) => [
        name,
        textPdf({
          title: `Volume ${k + 1}`,
          pages: [["Volume", `number ${k + 1}`], [k % 3 === 0 ? "an albatross" : "a sparrow"]],
        }),
      ]),
    ),
  );
  return names.map((name) => join(path, name));
}

/** Returns an empty page of a Chromium, closed after the test. */
export async function newPage(options: BrowserContextOptions = {}): Promise<Page> {
  browser ??= await launchChromium();
  return await newPageIn(browser, options);
}

/** Opens a page of a site in a Chromium; `said` gets its errors and warnings. */
export async function visit(
  site: string,
  address = "",
  options: BrowserContextOptions = {},
): Promise<{ page: Page; server: SiteServer; said: string[] }> {
  const server = await serveSite(site);
  servers.push(server);
  const page = await newPage(options);
  const said: string[] = [];
  hearComplaints(page, said);
  await page.goto(server.url + address);
  return { page, server, said };
}
