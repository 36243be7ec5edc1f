import { cleanText, nameOfUrl } from "./book_text.ts";
import { brokeOff, emptyFile, fetchChecked, readBounded, readStart } from "./fetch_bytes.ts";
import { type Bytes, blobOf, filesOf, wrongKind } from "./input_values.ts";
import { limits } from "./limits.ts";
import { loadPart } from "./load_part.ts";
import { type ImageBook, type Manifest, type ManifestPage, parseManifest } from "./manifest.ts";
import { PageList } from "./page_list.ts";
import { BookError, type PageSource } from "./page_source.ts";
import type { PdfOptions } from "./pdf.ts";
import { type Kind, sniff, sniffLength } from "./sniff.ts";

/**
 * What can be opened: an address, images in order, a manifest, a file that was
 * chosen, dropped or fetched, or several chosen images, which are put in the
 * natural order of their names.
 */
export type BookInput = string | readonly ManifestPage[] | Manifest | Bytes | FileList;

export interface OpenOptions extends PdfOptions {
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
  const blob = blobOf(input) ?? aloneOf(input);
  if (blob) return await openBlob(blob, options);
  const files = filesOf(input);
  if (files?.length === 0) throw new BookError("No file was chosen; choose one.");
  if (!Array.isArray(files ?? input) && !isManifest(input)) throw wrongKind(input);
  const manifest = parseManifest(files ?? input, baseOf(options), options.name ?? "This book");
  return await openImages(manifest);
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
  const name = options.name ?? nameOfUrl(url);
  const init = options.signal ? { signal: options.signal } : {};
  const response = await fetchChecked(url, name, {
    ...init,
    headers: { Range: `bytes=0-${sniffLength - 1}` },
  });
  const start = await readStart(response, sniffLength).catch((error: unknown) => {
    options.signal?.throwIfAborted();
    throw error instanceof BookError ? error : brokeOff(name);
  });
  switch (kindOf(start, name)) {
    case "pdf":
      return await openPdfFrom(url, name, lengthOf(response), options);
    case "json": {
      const whole = await fetchChecked(url, name, init);
      const bytes = await readBounded(whole, limits.manifestBytes, name, options.signal);
      // A redirect moves the base of relative addresses.
      return await openImages(parseManifest(parseJson(bytes, name), whole.url || url, name));
    }
    default:
      return await openImages(single(url, name));
  }
}

async function openBlob(blob: Blob, options: OpenOptions): Promise<PageSource> {
  const fileName = "name" in blob ? cleanText(blob.name, 80) : "";
  const name = options.name ?? (fileName || "this book");
  const start = await readBlob(blob.slice(0, sniffLength), name);
  switch (kindOf(start, name)) {
    case "pdf":
      return await openPdfFrom(blob, name, blob.size, options);
    case "json": {
      const most = limits.manifestBytes;
      if (blob.size > most) throw new BookError(`${name} is too large for a manifest; split it.`);
      return await openImages(
        parseManifest(parseJson(await readBlob(blob, name), name), baseOf(options), name),
      );
    }
    default:
      return await openImages(single(blob, name));
  }
}

/** @throws BookError if no source reads files with this start */
function kindOf(start: Uint8Array, name: string): Kind {
  if (start.length === 0) throw emptyFile(name);
  const kind = sniff(start);
  const readable =
    "PDF, images (PNG, JPEG, WebP, AVIF, GIF, SVG) and JSON manifests of images can be read.";
  if (kind === "html") throw new BookError(`${name} is a web page, not a book; ${readable}`);
  if (kind === "archive")
    throw new BookError(`${name} is an archive, an EPUB or a comic; unpack it first: ${readable}`);
  if (kind === "unknown") throw new BookError(`${name} is of an unknown format; ${readable}`);
  return kind;
}

async function openPdfFrom(
  from: string | Blob,
  name: string,
  length: number | undefined,
  options: OpenOptions,
): Promise<PageSource> {
  const { openPdf } = await loadPart(import("./pdf.ts"));
  return await openPdf({ name, from, ...(length === undefined ? {} : { length }) }, options);
}

async function openImages(book: ImageBook): Promise<PageSource> {
  const { ImageSource } = await loadPart(import("./images.ts"));
  return new ImageSource(book);
}

function single(src: string | Blob, name: string): ImageBook {
  return { name, title: name, language: "", direction: "ltr", kind: "scan", pages: [{ src }] };
}

/** Returns the whole file's length, from the response to a request for its start. */
function lengthOf(response: Response): number | undefined {
  const total = /\/(\d+)$/.exec(response.headers.get("content-range") ?? "")?.[1];
  const length = total ?? (response.status === 200 ? response.headers.get("content-length") : null);
  return length ? Number(length) : undefined;
}

function resolve(address: string, options: OpenOptions): string {
  const name = cleanText(address, 80) || "An empty address";
  if (/^\[object \w+\]$/.test(name)) {
    throw new BookError(`src is an address, and not ${name.slice(8, -1)}; set pages instead.`);
  }
  let url: URL;
  try {
    url = new URL(address, baseOf(options));
  } catch {
    throw new BookError(`${name} is no address; correct it.`);
  }
  if (/^(https?|blob|file):$/.test(url.protocol) || /^data:/i.test(url.href)) return url.href;
  throw new BookError(`${name} is not an address of the web; use http or https.`);
}

function baseOf(options: OpenOptions): string {
  return options.base ?? globalThis.document?.baseURI ?? "http://localhost/";
}

async function readBlob(blob: Blob, name: string): Promise<Uint8Array> {
  try {
    return new Uint8Array(await blob.arrayBuffer());
  } catch {
    throw new BookError(`${name} cannot be read any more; choose the file again.`);
  }
}

function parseJson(bytes: Uint8Array, name: string): unknown {
  try {
    return JSON.parse(new TextDecoder().decode(bytes));
  } catch {
    throw new BookError(`${name} is no valid JSON; correct it and open it again.`);
  }
}
