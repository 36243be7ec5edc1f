import { fileAt, fileIn } from "./book_file.ts";
import { cleanText, nameOfUrl } from "./book_text.ts";
import { handedOut } from "./handed_out.ts";
import { type Bytes, blobOf, elementsOf, filesOf, wrongKind } from "./input_values.ts";
import { loadPart } from "./load_part.ts";
import { type Manifest, type ManifestPage, parseManifest } from "./manifest.ts";
import { openFile, openImages, pagesOfImage, prepareFor } from "./open_file.ts";
import { pageOfHash } from "./page_hash.ts";
import { PageList } from "./page_list.ts";
import { BookError, type PageSource, type Typography } from "./page_source.ts";
import type { PdfOptions } from "./pdf_file.ts";

/**
 * What can be opened: an address, images in order, a manifest, a file that was
 * chosen, dropped or fetched, several chosen images, which are put in the
 * natural order of their names, elements of a web page, or a source of pages. A source is closed with
 * its book; one that may be opened again is given by a function that makes it.
 */
export type BookInput =
  | string
  | readonly ManifestPage[]
  | Manifest
  | Bytes
  | FileList
  | readonly HTMLElement[]
  | HTMLCollection
  | NodeListOf<HTMLElement>
  | PageSource
  | (() => PageSource | Promise<PageSource>);

/** How a book is opened. */
export interface OpenOptions extends PdfOptions {
  /** How flowing text is set at first; the default is as the book has it. */
  readonly typography?: Typography;
  /** The book's name in sentences if its address or file has none. */
  readonly name?: string;
  /** Base of relative addresses. The default is the document. */
  readonly base?: string;
}

/**
 * Opens a book, whose format is detected from its first bytes, whatever its
 * name. The code for the format is loaded here and not before. Rejects with a
 * `BookError`, or with the signal's reason when aborted.
 */
export async function openSource(input: BookInput, options: OpenOptions = {}): Promise<PageSource> {
  options.signal?.throwIfAborted();
  if (typeof input === "string") return await openAddress(input, options);
  const source = typeof input === "function" ? await input() : input;
  if (isSource(source)) return source;
  const elements = elementsOf(input);
  if (elements) {
    const { HtmlPages } = await loadPart(import("./html/html_pages.ts"));
    return new HtmlPages(elements);
  }
  const blob = blobOf(input) ?? aloneOf(input);
  if (blob) return await openBlob(blob, options);
  const files = filesOf(input);
  if (files?.length === 0)
    throw new BookError("No file was chosen; choose one.", { code: "empty" });
  if (!Array.isArray(files ?? input) && !isManifest(input)) throw wrongKind(input);
  const pages = files ?? input;
  const list = Array.isArray(pages) ? await withPagesOfTiffs(pages) : pages;
  const manifest = parseManifest(list, baseOf(options), options.name ?? "This book");
  return await openImages(manifest);
}

/** Returns a list of pages with each page of a TIFF in it that is at hand. */
async function withPagesOfTiffs(list: readonly unknown[]): Promise<unknown[]> {
  const found: unknown[] = [];
  for (const page of list) {
    const image = blobOf(page);
    const pages = image ? await pagesOfImage(image).catch(() => []) : [];
    // What cannot be read says so on its page.
    found.push(...(pages.length > 1 ? pages.map(({ src }) => src) : [page]));
  }
  return found;
}

/** As `openSource`, for a program, which may put a Proxy around what it gets. */
export async function openHandedOut(input: BookInput, options: OpenOptions): Promise<PageSource> {
  const source = await openSource(input, options);
  return source === input ? source : handedOut(source);
}

function isSource(value: unknown): value is PageSource {
  return typeof value === "object" && value !== null && "draw" in value && "pageCount" in value;
}

/** Returns the single file of a list of one, which need not be an image; null for other lists. */
function aloneOf(input: BookInput): Blob | null {
  const list = filesOf(input) ?? input;
  return Array.isArray(list) && list.length === 1 ? blobOf(list[0]) : null;
}

/** Returns whether a value is a JSON object, valid as a manifest or not, or has pages. */
function isManifest(value: unknown): boolean {
  if (typeof value !== "object" || value === null) return false;
  const kind = Object.getPrototypeOf(value);
  return kind === null || kind === Object.prototype || "pages" in value;
}

/** As `openSource`, for a book whose pages may change while it is open. */
export async function openList(input: BookInput, options: OpenOptions): Promise<PageList> {
  return new PageList(await openSource(input, options));
}

async function openAddress(address: string, options: OpenOptions): Promise<PageSource> {
  const url = resolve(address, options);
  prepareFor(url, options);
  const file = await fileAt(url, options.name ?? nameOfUrl(url), options.signal);
  const fragment = new URL(url).hash.slice(1);
  const source = await openFile(file, { ...options, base: url, fragment });
  const page = pageOfHash(fragment);
  if (page === null) return source;
  // The address says it of any format, and says more than the file.
  return Object.defineProperty(source, "openingPage", { value: Math.min(page, source.pageCount) });
}

async function openBlob(blob: Blob, options: OpenOptions): Promise<PageSource> {
  const fileName = "name" in blob ? cleanText(blob.name, 80) : "";
  const file = await fileIn(blob, options.name ?? (fileName || "this book"));
  return await openFile(file, { ...options, base: baseOf(options) });
}

function resolve(address: string, options: OpenOptions): string {
  const name = cleanText(address, 80) || "An empty address";
  if (/^\[object \w+\]$/.test(name)) {
    throw new BookError(`src is an address, and not ${name.slice(8, -1)}; set pages instead.`, {
      code: "misused",
    });
  }
  let url: URL;
  try {
    url = new URL(address, baseOf(options));
  } catch {
    throw new BookError(`${name} is no address; correct it.`, { code: "misused", source: name });
  }
  if (/^(https?|blob|file):$/.test(url.protocol) || /^data:/i.test(url.href)) return url.href;
  throw new BookError(`${name} is not an address of the web; use http or https.`, {
    code: "misused",
    source: name,
  });
}

function baseOf(options: OpenOptions): string {
  return options.base ?? globalThis.document?.baseURI ?? "http://localhost/";
}
