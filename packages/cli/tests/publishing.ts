/** Helpers for tests of `turnleaf publish`: small books, the built command, pages of its sites. */

import type { ChildProcess } from "node:child_process";
import { createHash } from "node:crypto";
import { readdirSync, readFileSync, statSync } from "node:fs";
import { join } from "node:path";
import type { BrowserContextOptions, Page } from "playwright-core";
import { afterAll, afterEach } from "vitest";
import { textPdf } from "./books.ts";
import { chromiumForTests, hearComplaints } from "./browser.ts";
import { type Ended, folderOf, runWithChromium } from "./command.ts";
import { type SiteServer, serveSite } from "./site_server.ts";

/** Small pictures, as drawing is in software here, by one browser: starting another takes longer. */
export const small: readonly string[] = ["--size", "256", "--workers", "1"];
/** Books of the tests of many; `TURNLEAF_BOOKS=200 npx vitest run publish` for more. */
export const bookCount: number = Number(process.env.TURNLEAF_BOOKS ?? 4);
export const patience: number = 120_000 + 10_000 * bookCount;

const folders: ReturnType<typeof folderOf>[] = [];

/** Removes the folders that the tests of a file have made, once they ended; to be called outside them. */
export function removeFolders(): void {
  afterAll(() => {
    for (const folder of folders.splice(0)) folder.remove();
  }, patience);
}

/** Creates a folder of the given files, deleted by {@link removeFolders}. */
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

/** A page of a published site, with its server, and its errors and warnings in `said`. */
interface Visit {
  readonly page: Page;
  readonly server: SiteServer;
  readonly said: string[];
}

/** Visits published sites for the tests of a file. */
interface Visitor {
  /** Opens an empty page, closed after the test. */
  newPage(options?: BrowserContextOptions): Promise<Page>;
  /** Opens a page of a site, which is served until the test ends. */
  visit(site: string, address?: string, options?: BrowserContextOptions): Promise<Visit>;
}

/** Visits published sites in the tests of a file; to be called outside them. */
export function visitorForTests(): Visitor {
  const servers: SiteServer[] = [];
  // After their pages were closed: the last hook runs first.
  afterEach(async () => {
    for (const server of servers.splice(0)) await server.stop();
  });
  const { newPage } = chromiumForTests();
  return {
    newPage,
    async visit(site, address = "", options = {}) {
      const server = await serveSite(site);
      servers.push(server);
      const page = await newPage(options);
      const said: string[] = [];
      hearComplaints(page, said);
      await page.goto(server.url + address);
      return { page, server, said };
    },
  };
}
