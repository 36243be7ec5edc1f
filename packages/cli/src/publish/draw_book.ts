/** Draws one book into a folder: pictures, texts and the index of its words. */

import { copyFile, mkdir, rename, rm, writeFile } from "node:fs/promises";
import { basename, dirname, extname, join } from "node:path";
import type { ServedBook } from "../book.ts";
import { Problem } from "../problem.ts";
import type { DrawnPage, DrawOptions, UnshownPart } from "./drawn_page.ts";
import { type PageDrawer, TookTooLong } from "./page_drawer.ts";
import { paragraphsOf } from "./page_text.ts";
import { searchWords } from "./search_words.ts";
import {
  halvings,
  pagesInPart,
  pictureAddress,
  type SiteBook,
  type SitePage,
  type SiteText,
} from "./site_book.ts";
import { termFiles } from "./term_lists.ts";

/** Pages given up for their time before the whole book is. */
const mostLatePages = 3;

/** How a book is drawn. */
export interface BookOptions extends Omit<DrawOptions, "pictures"> {
  /** Whether the site has the book's own file in place of pictures. */
  readonly keepFile: boolean;
}

/** Where a book is drawn to, and who follows it. */
export interface BookTask {
  readonly book: ServedBook;
  /** Its name in sentences. */
  readonly name: string;
  readonly drawer: PageDrawer;
  readonly options: BookOptions;
  /** Wall-clock time at which it is given up. */
  readonly until: number;
  readonly signal: AbortSignal;
  readonly progress: (fraction: number) => void;
  /** Called with what the book lists and cannot be shown, once all its pages are drawn. */
  readonly missing: (missing: readonly UnshownPart[]) => void;
}

/**
 * Draws a book into a new folder. Returns the indices of the pages that were
 * given up for their time.
 *
 * @throws Problem if it cannot be opened, or takes too long
 */
export async function drawBook(folder: string, task: BookTask): Promise<number[]> {
  const { book, name, drawer, options, until } = task;
  const opened = await drawer.open(book, name, until);
  const original = options.keepFile ? singleFile(book) : null;
  if (original) await copyFile(original.path, await fileIn(folder, original.name));
  const pages: SitePage[] = [];
  const terms = new Map<string, number[]>();
  let part: SiteText[] = [];
  let hasText = false;
  const late: number[] = [];
  for (let index = 0; index < opened.pageCount; index++) {
    task.signal.throwIfAborted();
    if (Date.now() > until) throw new Problem(`${name} took too long and was given up.`);
    const pictures = original === null || index === 0;
    let page: DrawnPage;
    try {
      page = await drawer.draw(index, { ...options, pictures });
    } catch (error) {
      if (!(error instanceof TookTooLong) || late.length === mostLatePages) throw error;
      late.push(index);
      page = failedPage(index, error.message);
      await drawer.open(book, name, until);
    }
    pages.push(await savePage(folder, index, page, options.format));
    const text = paragraphsOf(page.runs);
    hasText ||= text.length > 0;
    addTerms(terms, index + 1, [...text, page.alt]);
    part.push({ runs: page.runs, links: page.links, alt: page.alt });
    if (part.length === pagesInPart || index === opened.pageCount - 1) {
      const number = Math.floor(index / pagesInPart) + 1;
      await writeJson(folder, `text/${number}.json`, part);
      part = [];
    }
    task.progress((index + 1) / opened.pageCount);
  }
  task.missing(await drawer.warnings());
  for (const [file, text] of termFiles(terms)) {
    await writeFile(await fileIn(folder, `words/${file}`), text);
  }
  const { title, pageCount: _, ...rest } = opened;
  const about: SiteBook = {
    ...rest,
    title: titleOf(title, name, singleFile(book) !== null),
    ...{ format: options.format, file: original?.name ?? null, hasText, pages },
  };
  await writeJson(folder, "book.json", about);
  return late;
}

/**
 * Makes a folder by `fill`, completely or not at all; what was there before is
 * replaced.
 *
 * @param part a folder beside it that nothing else uses
 */
export async function makeFolder(
  folder: string,
  part: string,
  fill: (part: string) => Promise<void>,
): Promise<void> {
  await rm(part, { recursive: true, force: true });
  await mkdir(part, { recursive: true });
  try {
    await fill(part);
    await rm(folder, { recursive: true, force: true });
    await mkdir(dirname(folder), { recursive: true });
    await rename(part, folder);
  } finally {
    await rm(part, { recursive: true, force: true });
  }
}

function failedPage(index: number, failed: string): DrawnPage {
  const size = { width: 3, height: 4, label: String(index + 1) };
  return { ...size, pictures: [], runs: [], links: [], alt: "", failed };
}

async function savePage(
  folder: string,
  index: number,
  { width, height, label, side, roll, pictures, failed }: DrawnPage,
  format: SiteBook["format"],
): Promise<SitePage> {
  const [largest] = pictures;
  const pixels = largest ? ([largest.width, largest.height] as const) : null;
  if (pixels) {
    for (let times = 0; times <= halvings; times++) {
      const address = pictureAddress(index, pixels, times, format);
      const data = Buffer.from(pictures[times]?.data ?? "", "base64");
      await writeFile(await fileIn(folder, address), data);
    }
  }
  return {
    ...{ width, height },
    ...(label !== String(index + 1) ? { label } : {}),
    ...(side ? { side } : {}),
    ...(roll === undefined ? {} : { roll }),
    ...(pixels ? { pixels } : {}),
    ...(failed === undefined ? {} : { failed }),
  };
}

function addTerms(terms: Map<string, number[]>, page: number, texts: readonly string[]): void {
  for (const word of new Set(texts.flatMap(searchWords))) {
    const pages = terms.get(word);
    if (pages) pages.push(page);
    else terms.set(word, [page]);
  }
}

/** The one file that a book is; null if it is more than one. */
function singleFile(book: ServedBook): { readonly path: string; readonly name: string } | null {
  const [file] = book.files.values();
  if (book.files.size !== 1 || !file || "text" in file) return null;
  const ending = extname(file.path).toLowerCase();
  return { path: file.path, name: `book${/^\.[a-z0-9]{1,8}$/.test(ending) ? ending : ""}` };
}

/** A book without a title has its file's name, which is shown without its ending. */
function titleOf(title: string, name: string, isFile: boolean): string {
  return isFile && title === name ? basename(name, extname(name)) || name : title;
}

async function writeJson(folder: string, name: string, value: unknown): Promise<void> {
  await writeFile(await fileIn(folder, name), `${JSON.stringify(value)}\n`);
}

async function fileIn(folder: string, name: string): Promise<string> {
  const file = join(folder, name);
  await mkdir(dirname(file), { recursive: true });
  return file;
}
