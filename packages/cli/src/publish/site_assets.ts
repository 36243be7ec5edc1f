/** The built scripts and styles of a published site. */

import { mkdir, readFile, writeFile } from "node:fs/promises";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { Problem } from "../problem.ts";

/** The site's own scripts, by the pages that have them. */
const entries = { book: "publish/book.ts", search: "publish/search.ts", shelf: "publish/shelf.ts" };
const drawing = "publish/draw.html";
const worker = "publish/service_worker.ts";

/** What a page loads, by addresses relative to the site. */
export interface PageAssets {
  readonly script: string;
  readonly styles: readonly string[];
}

/** The site's scripts and styles. */
export interface SiteAssets {
  /** Names of the scripts that draw books, which are other ones when their code is. */
  readonly drawing: readonly string[];
  readonly pages: Readonly<Record<keyof typeof entries, PageAssets>>;
  /** Every file, by its address relative to the site. */
  readonly files: ReadonlyMap<string, Uint8Array>;
}

/** An entry of the build's own list. */
interface Built {
  readonly file: string;
  readonly imports?: readonly string[];
  readonly dynamicImports?: readonly string[];
  readonly css?: readonly string[];
  readonly assets?: readonly string[];
}

/**
 * Reads the built files that a site needs, and no others.
 *
 * @throws Problem if they are not built
 */
export async function readAssets(): Promise<SiteAssets> {
  const root = fileURLToPath(new URL("./app/", import.meta.url));
  const list = await readFile(join(root, "site_assets.json"), "utf8").catch(() => "null");
  const built = JSON.parse(list) as Record<string, Built> | null;
  if (built === null) throw new Problem("The site's scripts are not built; run: npm run build");
  const files = new Map<string, Uint8Array>();
  const add = async (name: string, as = name): Promise<void> => {
    if (!files.has(as)) files.set(as, await readFile(join(root, name)));
  };
  for (const name of filesFor(built, Object.values(entries))) await add(name);
  // At the site's root: a service worker sees what lies beside and below it.
  await add(built[worker]?.file ?? "", "service-worker.js");
  await add(built["icon.svg"]?.file ?? "", "icon.svg");
  // Of the libraries in the scripts.
  files.set("licenses.txt", await readFile(new URL("./licenses.txt", import.meta.url)));
  const pages = Object.entries(entries).map(([name, key]) => [name, pageAssets(built, key)]);
  return { pages: Object.fromEntries(pages), files, drawing: filesFor(built, [drawing]) };
}

/** Returns the files of some entries and of all that they import, at once or later. */
function filesFor(built: Record<string, Built>, keys: readonly string[]): string[] {
  const done = new Set<string>();
  const files = new Set<string>();
  const follow = (key: string): void => {
    const entry = built[key];
    if (!entry || done.has(key)) return;
    done.add(key);
    for (const name of [entry.file, ...(entry.css ?? []), ...(entry.assets ?? [])]) files.add(name);
    for (const next of [...(entry.imports ?? []), ...(entry.dynamicImports ?? [])]) follow(next);
  };
  for (const key of keys) follow(key);
  return [...files].sort();
}

/** Writes the files into a site. */
export async function writeAssets(site: string, { files }: SiteAssets): Promise<void> {
  for (const [name, bytes] of files) {
    await mkdir(dirname(join(site, name)), { recursive: true });
    await writeFile(join(site, name), bytes);
  }
}

function pageAssets(built: Record<string, Built>, key: string): PageAssets {
  const styles = new Set<string>();
  const done = new Set<string>();
  const follow = (next: string): void => {
    if (done.has(next)) return;
    done.add(next);
    for (const also of built[next]?.imports ?? []) follow(also);
    for (const style of built[next]?.css ?? []) styles.add(style);
  };
  follow(key);
  return { script: built[key]?.file ?? "", styles: [...styles] };
}
