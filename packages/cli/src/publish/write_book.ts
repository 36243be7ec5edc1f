/** Writes the HTML and the manifests of a book that is drawn. */

import { mkdir, rm, writeFile } from "node:fs/promises";
import { dirname, join } from "node:path";
import { Problem } from "../problem.ts";
import { type BookView, bookAddress, bookPage, partCount, textPage } from "./book_pages.ts";
import type { GivenDetails } from "./catalogue.ts";
import { imageInfo, manifest, textAnnotations } from "./iiif.ts";
import type { SiteOptions } from "./page_shell.ts";
import { type BookDetails, type BookRecord, readJson } from "./record.ts";
import type { SiteAssets } from "./site_assets.ts";
import {
  halved,
  halvings,
  pagesInPart,
  pictureAddress,
  type SiteBook,
  type SiteDetail,
  type SiteText,
} from "./site_book.ts";

/** Maximum of bytes of a file that drawing a book writes. */
const longest = 2_000_000_000;

/** What a book's pages are made of, besides what is drawn. */
export interface BookSettings {
  readonly id: string;
  readonly given: GivenDetails;
  readonly site: SiteOptions;
  readonly assets: SiteAssets;
  /** The hashes that its record gets. */
  readonly drawn: string;
  readonly written: string;
}

/** Writes a drawn book's pages; its record last, so that an interrupted book is done again. */
export async function writeBook(folder: string, settings: BookSettings): Promise<BookRecord> {
  const { id, given, site, assets, drawn, written } = settings;
  const book = (await readJson(join(folder, "book.json"), longest)) as SiteBook | null;
  if (!book) throw new Problem(`${folder} was changed by somebody else; remove it.`);
  const details = detailsOf(book, given);
  const view: BookView = { site, assets, id, book, details, version: drawn.slice(0, 8) };
  await rm(join(folder, "record.json"), { force: true });
  await write(folder, "index.html", bookPage(view));
  const withText = new Set<number>();
  const base = site.url === null || book.file !== null ? null : site.url + bookAddress(id);
  for (let part = 0; part < partCount(book); part++) {
    const file = join(folder, `text/${part + 1}.json`);
    const texts = (await readJson(file, longest)) as SiteText[] | null;
    if (!texts) throw new Problem(`${folder} was changed by somebody else; remove it.`);
    await write(folder, `text/${part + 1}.html`, textPage(view, part, texts));
    for (const [k, text] of texts.entries()) {
      const index = part * pagesInPart + k;
      if (text.runs.length > 0) withText.add(index);
      if (base !== null) await writeImage(folder, base, view, index, text);
    }
  }
  if (site.url !== null && base !== null) {
    const iiif = manifest(site.url, view, (index) => withText.has(index));
    await write(folder, "manifest.json", `${JSON.stringify(iiif)}\n`);
  } else await rm(join(folder, "manifest.json"), { force: true });
  const record: BookRecord = { drawn, written, details };
  await write(folder, "record.json", `${JSON.stringify(record)}\n`);
  return record;
}

async function writeImage(
  folder: string,
  base: string,
  view: BookView,
  index: number,
  text: SiteText,
): Promise<void> {
  const page = view.book.pages[index];
  const info = page && imageInfo(base, index, page);
  const here = `iiif/${index + 1}`;
  if (info && view.book.format === "jpeg") {
    await write(folder, `${here}/info.json`, `${JSON.stringify(info)}\n`);
  }
  if (text.runs.length === 0) return;
  const annotations = textAnnotations(base, view, index, text);
  await write(folder, `${here}/text.json`, `${JSON.stringify(annotations)}\n`);
}

/** Returns what is known of a book: what the publisher says goes before what its file says. */
function detailsOf(book: SiteBook, given: GivenDetails): BookDetails {
  const pixels = book.pages[0]?.pixels;
  const own = (label: RegExp): SiteDetail[] =>
    book.details.filter((detail) => label.test(detail.label));
  const authors = own(/^author$/i).map(({ value }) => value);
  const [rights] = own(/^(rights|licen[cs]e)$/i);
  return {
    ...(authors.length > 0 ? { authors } : {}),
    ...(rights ? { licence: rights.href ?? rights.value } : {}),
    ...given,
    title: given.title ?? book.title,
    language: given.language ?? book.language,
    direction: given.direction ?? book.direction,
    pageCount: book.pages.length,
    cover: pixels ? coverOf(pixels, book.format) : null,
    failures: book.pages.flatMap(({ failed }, index) =>
      failed === undefined ? [] : [{ page: index + 1, message: failed }],
    ),
  };
}

function coverOf(
  pixels: readonly [number, number],
  format: SiteBook["format"],
): BookDetails["cover"] {
  const [width, height] = halved(pixels, halvings);
  return { src: pictureAddress(0, pixels, halvings, format), width, height };
}

async function write(folder: string, name: string, text: string): Promise<void> {
  const file = join(folder, name);
  await mkdir(dirname(file), { recursive: true });
  await writeFile(file, text);
}
