/** Writes what a site has besides its books: shelf, search, worker, sitemap, report. */

import { mkdir, readdir, readFile, rename, rm, writeFile } from "node:fs/promises";
import { dirname, join } from "node:path";
import { escapeText } from "../html.ts";
import { bookAddress } from "./book_pages.ts";
import { makeFolder } from "./draw_book.ts";
import type { SiteOptions } from "./page_shell.ts";
import { readRecord } from "./record.ts";
import { searchWords } from "./search_words.ts";
import {
  type ShelvedBook,
  searchPage,
  shelfAddress,
  shelfCount,
  shelfPage,
} from "./shelf_pages.ts";
import { type SiteAssets, writeAssets } from "./site_assets.ts";
import { pagesInPart } from "./site_book.ts";
import { parseTermFile, type TermIndex, termFiles } from "./term_lists.ts";

/** Books in one file of details for the search page. */
export const booksInPart = 100;

/** The file in which a shard says what it is. */
export const shardNoteName = "shard.json";

/** Addresses that a sitemap may have. */
const longestSitemap = 50_000;

/** A book, or pages of one, that could not be published. */
export interface Failure {
  readonly id: string;
  /** As the user named it. */
  readonly book: string;
  /** From 1; absent if it is the whole book. */
  readonly page?: number;
  readonly message: string;
}

/** What a site is of. */
export interface SiteContent {
  readonly site: SiteOptions;
  readonly assets: SiteAssets;
  /** In their order. */
  readonly ids: readonly string[];
  readonly failures: readonly Failure[];
}

/**
 * Writes everything but the books, which lie in `books/` already. The same
 * books yield the same bytes.
 */
export async function writeSite(out: string, content: SiteContent): Promise<number> {
  const { site, assets, ids, failures } = content;
  const books: ShelvedBook[] = [];
  for (const id of ids) {
    const record = await readRecord(join(out, "books", id));
    if (record) books.push({ id, record });
  }
  await removeOthers(join(out, "books"), new Set(books.map(({ id }) => id)));
  for (const name of await readdir(out)) {
    // Of runs that were killed, or were of a shard.
    if (name.startsWith(".part-") || name === shardNoteName) {
      await rm(join(out, name), { recursive: true });
    }
  }
  await renew(out, "assets", async (part) => {
    await writeAssets(dirname(part), { ...assets, files: filesBelow("assets/", part, assets) });
  });
  for (const [name, bytes] of assets.files) {
    if (!name.startsWith("assets/")) await replace(join(out, name), bytes);
  }
  await renew(out, "search", (part) => writeSearch(out, part, books));
  await renew(out, "shelf", async (part) => {
    for (let shelf = 1; shelf < shelfCount(books.length); shelf++) {
      await writeFile(join(part, `${shelf + 1}.html`), shelfPage(site, assets, books, shelf));
    }
  });
  await replace(join(out, "search.html"), searchPage(site, assets));
  await replace(join(out, "site.webmanifest"), webManifest(site));
  await writeSitemaps(out, site, books);
  await replace(join(out, "report.json"), report(ids, failures));
  // Last: what it leads to is there.
  await replace(join(out, "index.html"), shelfPage(site, assets, books, 0));
  return books.length;
}

/** Removes the folders of books that are no longer in the list, and of no others. */
async function removeOthers(folder: string, ids: ReadonlySet<string>): Promise<void> {
  for (const name of await readdir(folder).catch(() => [])) {
    const path = join(folder, name);
    if (!ids.has(name) && (await readRecord(path))) await rm(path, { recursive: true });
  }
}

async function writeSearch(
  out: string,
  part: string,
  books: readonly ShelvedBook[],
): Promise<void> {
  const lists = new Map<string, number[]>();
  for (const [number, { id, record }] of books.entries()) {
    const { title, authors = [] } = record.details;
    const named = new Set([title, ...authors].flatMap(searchWords));
    const words = join(out, "books", id, "words");
    const { first } = JSON.parse(await readFile(join(words, "index.json"), "utf8")) as TermIndex;
    for (let file = 0; file < first.length; file++) {
      const text = await readFile(join(words, `${file}.json`), "utf8");
      for (const [term, pages] of parseTermFile(text)) {
        if (!named.has(term)) add(lists, term, 4 * number + weightOf(pages.length));
      }
    }
    for (const term of named) add(lists, term, 4 * number + 3);
  }
  for (const [name, text] of termFiles(lists)) await writeFile(join(part, name), text);
  await mkdir(join(part, "books"));
  for (let from = 0; from < books.length; from += booksInPart) {
    const listed = books.slice(from, from + booksInPart).map(({ id, record }) => {
      const { title, authors, language, pageCount, cover } = record.details;
      return { id, title, authors, language, pageCount, cover, version: record.drawn.slice(0, 8) };
    });
    const name = `books/${from / booksInPart}.json`;
    await writeFile(join(part, name), `${JSON.stringify(listed)}\n`);
  }
}

/** Returns how much a book is about a word that is on some pages of it: 0 to 2; 3 is its title. */
function weightOf(pages: number): number {
  return pages >= 8 ? 2 : pages >= 2 ? 1 : 0;
}

function add(lists: Map<string, number[]>, term: string, number: number): void {
  const list = lists.get(term);
  if (list) list.push(number);
  else lists.set(term, [number]);
}

function webManifest(site: SiteOptions): string {
  const name = site.title;
  const icons = [{ src: "icon.svg", type: "image/svg+xml", sizes: "any" }];
  const colours = { background_color: "#e4dfd6", theme_color: "#e4dfd6" };
  return `${JSON.stringify({ name, start_url: "./", display: "minimal-ui", ...colours, icons })}\n`;
}

async function writeSitemaps(
  out: string,
  { url }: SiteOptions,
  books: readonly ShelvedBook[],
): Promise<void> {
  await rm(join(out, "sitemaps"), { recursive: true, force: true });
  await rm(join(out, "sitemap.xml"), { force: true });
  if (url === null) return;
  const addresses = [
    ...Array.from({ length: shelfCount(books.length) }, (_, shelf) => shelfAddress(shelf)),
    ...books.flatMap(({ id, record }) => [
      bookAddress(id),
      ...Array.from(
        { length: Math.ceil(record.details.pageCount / pagesInPart) },
        (_, part) => `${bookAddress(id)}text/${part + 1}.html`,
      ),
    ]),
  ].map((address) => url + address);
  if (addresses.length <= longestSitemap) {
    await replace(join(out, "sitemap.xml"), sitemap("urlset", "url", addresses));
    return;
  }
  const parts: string[] = [];
  await mkdir(join(out, "sitemaps"));
  for (let from = 0; from < addresses.length; from += longestSitemap) {
    const name = `sitemaps/${parts.length + 1}.xml`;
    const part = addresses.slice(from, from + longestSitemap);
    await replace(join(out, name), sitemap("urlset", "url", part));
    parts.push(url + name);
  }
  await replace(join(out, "sitemap.xml"), sitemap("sitemapindex", "sitemap", parts));
}

function sitemap(root: string, item: string, addresses: readonly string[]): string {
  const items = addresses.map(
    (address) => `<${item}><loc>${escapeText(address)}</loc></${item}>\n`,
  );
  return `<?xml version="1.0" encoding="UTF-8"?>
<${root} xmlns="http://www.sitemaps.org/schemas/sitemap/0.9">
${items.join("")}</${root}>
`;
}

/** Returns what failed, in the order of the books, from whichever shards. */
function report(ids: readonly string[], failures: readonly Failure[]): string {
  const places = new Map(ids.map((id, place) => [id, place]));
  const placeOf = ({ id }: Failure): number => places.get(id) ?? 0;
  const sorted = [...failures].sort((a, b) => placeOf(a) - placeOf(b));
  return `${JSON.stringify({ books: ids.length, failures: sorted }, null, 1)}\n`;
}

function filesBelow(folder: string, part: string, { files }: SiteAssets): Map<string, Uint8Array> {
  const name = part.slice(dirname(part).length + 1);
  return new Map(
    [...files]
      .filter(([file]) => file.startsWith(folder))
      .map(([file, bytes]) => [`${name}/${file.slice(folder.length)}`, bytes]),
  );
}

/** Makes a folder of the site anew, completely or not at all. */
async function renew(
  out: string,
  name: string,
  fill: (part: string) => Promise<void>,
): Promise<void> {
  await makeFolder(join(out, name), join(out, `.part-${name}`), fill);
}

/** Writes a file, completely or not at all. */
async function replace(file: string, content: string | Uint8Array): Promise<void> {
  await writeFile(`${file}.part`, content);
  await rename(`${file}.part`, file);
}
