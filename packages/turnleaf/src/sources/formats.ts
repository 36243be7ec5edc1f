/**
 * The formats of books, and which code reads each: it is imported when such a
 * book is opened. A new format is a row here, and a mark in `sniff` if its
 * first bytes show it.
 */

import type { Archive } from "./archive/archive.ts";
import { type BookFile, bytesOf, fileIn, type WholeFile } from "./book_file.ts";
import { isEpub } from "./epub/epub_names.ts";
import { limits } from "./limits.ts";
import { loadPart } from "./load_part.ts";
import { type ImageBook, type ImagePage, parseManifest } from "./manifest.ts";
import { isRecord } from "./manifest_checks.ts";
import { BookError, type PageSource, type Typography } from "./page_source.ts";
import type { PdfOptions } from "./pdf.ts";
import { type Kind, rareImageType, sniff, sniffLength } from "./sniff.ts";

/** The settings that a format may need. */
export interface FormatOptions extends PdfOptions {
  /** How flowing text is set at first; the default is as the book has it. */
  readonly typography?: Typography;
  /** Base of relative addresses in a file that has no address itself. */
  readonly base: string;
}

/** Opens a file of one format. Rejects with a `BookError`, or with the signal's reason. */
type Open = (file: BookFile, options: FormatOptions) => Promise<PageSource>;

const formats: Readonly<Partial<Record<Kind, Open>>> = {
  pdf: async ({ name, from, length }, options) => {
    const { openPdf } = await loadPart(import("./pdf.ts"));
    return await openPdf({ name, from, ...(length === undefined ? {} : { length }) }, options);
  },
  image: async (file, { signal }) => {
    const { blob } = await file.whole(limits.imageBytes, signal);
    const { name, from } = file;
    const found = await pagesOfImage(blob);
    const isFetched = found.length === 1 && typeof from === "string";
    const pages = isFetched ? [{ src: { name, read: async () => blob } }] : found;
    return await openImages({
      ...{ name, title: name, language: "", direction: "ltr", kind: "scan", pages, file: blob },
    });
  },
  json: async (file, options) => {
    const whole = await file.whole(limits.manifestBytes, options.signal);
    const value = await parseJson(whole, file.name);
    const base = whole.url || options.base;
    if (isIiif(value)) {
      const { openIiif } = await loadPart(import("./iiif/iiif_source.ts"));
      return openIiif(value, base, file.name);
    }
    return await openImages(parseManifest(value, base, file.name));
  },
  text: async (file, { signal, typography }) => {
    const { blob } = await file.whole(limits.markupBytes, signal);
    const { openText } = await loadPart(import("./text/text_book.ts"));
    return await openText(blob, file.name, file.type, typography);
  },
  zip: async (file, options) => {
    const { blob } = await file.whole(limits.archiveBytes, options.signal);
    const { openZip } = await loadPart(import("./archive/zip.ts"));
    return await openArchived(await openZip(blob, file.name), blob, file.name, options);
  },
  tar: async (file, options) => {
    const { blob } = await file.whole(limits.archiveBytes, options.signal);
    const { openTar } = await loadPart(import("./archive/tar.ts"));
    return await openArchived(await openTar(blob, file.name), blob, file.name, options);
  },
  rar: openUnpacked,
  "7z": openUnpacked,
  gzip: openPacked,
  zstd: openPacked,
  xz: openPacked,
  kindle: async (file, { signal, typography }) => {
    const { blob } = await file.whole(limits.archiveBytes, signal);
    const { openKindle } = await loadPart(import("./kindle/kindle.ts"));
    return await openKindle(blob, file.name, typography);
  },
  fb2: async (file, { signal, typography }) => {
    const { blob } = await file.whole(limits.archivedBytes, signal);
    const { openFb2 } = await loadPart(import("./fb2/fb2.ts"));
    return await openFb2(blob, file.name, typography);
  },
};

/** Returns the pages of an image: of a TIFF there may be several. Rejects if it cannot be read. */
export async function pagesOfImage(image: Blob): Promise<readonly ImagePage[]> {
  const start = new Uint8Array(await image.slice(0, sniffLength).arrayBuffer());
  if (rareImageType(start) === "image/tiff") {
    const { pagesOfTiff } = await loadPart(import("./rare_images/tiff_pages.ts"));
    const pages = await pagesOfTiff(image);
    if (pages.length > 1) return pages.map(({ image, size }) => ({ src: image, size }));
  }
  return [{ src: image }];
}

/** Opens a book that is packed by itself, as the tar of a comic may be. */
async function openPacked(file: BookFile, options: FormatOptions): Promise<PageSource> {
  const { blob } = await file.whole(limits.archiveBytes, options.signal);
  const { unpackedFile } = await loadPart(import("./archive/packed_file.ts"));
  const unpacked = await unpackedFile(blob, sniff(file), file.name, options.signal);
  const inner = await fileIn(unpacked, file.name);
  if (formats[sniff(inner)] !== openPacked) return await openFile(inner, options);
  throw new BookError(`${file.name} is packed several times over; unpack it first.`, {
    code: "unsupported",
    source: file.name,
  });
}

/** Opens a book in an archive of RAR or 7-Zip. */
async function openUnpacked(file: BookFile, options: FormatOptions): Promise<PageSource> {
  const { blob } = await file.whole(limits.archiveBytes, options.signal);
  const { openUnpacked } = await loadPart(import("./archive/unpacked_archive.ts"));
  const archive = await openUnpacked(blob, file.name, options.signal);
  return await openArchived(archive, blob, file.name, options);
}

/** Opens the book that the files of an archive are. */
async function openArchived(
  archive: Archive,
  blob: Blob,
  name: string,
  { typography }: FormatOptions,
): Promise<PageSource> {
  const open = archived.find(({ isIn }) => isIn(archive.names))?.open ?? openComic;
  return await open(archive, blob, name, typography);
}

/** Returns the book that a file in an archive is; the book then closes the archive. */
type OpenArchive = (
  archive: Archive,
  file: Blob,
  name: string,
  typography?: Typography,
) => Promise<PageSource>;

const openComic: OpenArchive = async (archive, file, name) => {
  const comic = await loadPart(import("./comics/comic.ts"));
  return await comic.openComic(archive, file, name);
};

/** Formats that are archives of files, but for archives of images. */
const archived: readonly {
  isIn(names: readonly string[]): boolean;
  readonly open: OpenArchive;
}[] = [
  {
    isIn: isEpub,
    open: async (archive, file, name, typography) => {
      const { openEpub } = await loadPart(import("./epub/epub.ts"));
      return await openEpub(archive, file, name, typography);
    },
  },
  {
    isIn: (names) => names.filter(isFictionBookName).length === 1,
    open: async (archive, _file, name, typography) => {
      const { openFb2 } = await loadPart(import("./fb2/fb2.ts"));
      try {
        const bytes = await archive.read(archive.names.find(isFictionBookName) ?? "");
        return await openFb2(new Blob([bytes]), name, typography);
      } finally {
        archive.close();
      }
    },
  },
];

const isFictionBookName = (name: string): boolean => /\.fb2$/i.test(name);

/** The code that files of some names mostly need. */
const likely: readonly (readonly [
  name: RegExp,
  load: (options: PdfOptions) => Promise<unknown>,
])[] = [
  [/\.pdf$/i, async ({ pdfWorker }) => (await import("./pdf.ts")).preparePdf(pdfWorker)],
  [/\.(epub|cbz)$/i, () => import("./archive/zip.ts")],
  [/\.epub$/i, () => import("./epub/epub.ts")],
  [
    /\.(cbr|cb7|rar|7z)$/i,
    async () => (await import("./archive/unpacked_archive.ts")).prepareUnpacking(),
  ],
  [/\.cbt$/i, () => import("./archive/tar.ts")],
  [/\.(cb[zr7t])$/i, () => import("./comics/comic.ts")],
  [/\.(mobi|azw3?)$/i, () => import("./kindle/kindle.ts")],
  [/\.fb2$/i, () => import("./fb2/fb2.ts")],
];

/**
 * Starts loading the code that a file's name makes likely, while its first bytes are awaited.
 * They alone decide what it is.
 */
export function prepareFor(address: string, options: PdfOptions): void {
  const path = address.split(/[?#]/, 1)[0] ?? "";
  for (const [name, load] of likely) {
    // What fails is reported where it is used.
    if (name.test(path)) load(options).catch(() => {});
  }
}

/** Opens a file by the format that its first bytes show, whatever its name. */
export async function openFile(file: BookFile, options: FormatOptions): Promise<PageSource> {
  const kind = sniff(file);
  const open = formats[kind];
  if (open) return await open(file, options);
  throw new BookError(`${file.name} ${reasons[kind] ?? "is of an unknown format"}; ${readable}`, {
    code: "unsupported",
    source: file.name,
  });
}

/** Opens a book of images. */
export async function openImages(book: ImageBook): Promise<PageSource> {
  const { openImageBook } = await loadPart(import("./images.ts"));
  return await openImageBook(book);
}

const readable =
  "PDF, EPUB, MOBI, AZW3, FB2, comics (CBZ, CBR, CB7, CBT), Markdown, text, images (PNG, JPEG, WebP, AVIF, GIF, BMP, SVG, TIFF, JPEG 2000), IIIF and JSON manifests can be read.";

const reasons: Readonly<Partial<Record<Kind, string>>> = {
  html: "is a web page, not a book",
  palmdoc: "is a text of a Palm (PalmDOC), which is not read",
  bzip2: "is packed by bzip2, which is not unpacked here",
  zeros: "has no pages but only zeros, as an empty tar or a file that was not fetched whole",
};

/**
 * Returns whether JSON is of IIIF, by the context that it names: version 1 of Presentation had that of
 * Shared Canvas.
 */
function isIiif(value: unknown): value is Record<string, unknown> {
  const contexts = isRecord(value) ? [value["@context"]].flat() : [];
  const iiif = /iiif\.io\/api\/|shared-canvas\.org\/ns\/context/;
  return contexts.some((one) => typeof one === "string" && iiif.test(one));
}

async function parseJson({ blob }: WholeFile, name: string): Promise<unknown> {
  const bytes = await bytesOf(blob, name);
  try {
    return JSON.parse(new TextDecoder().decode(bytes));
  } catch {
    throw new BookError(`${name} is no valid JSON; correct it and open it again.`, {
      code: "damaged",
      source: name,
    });
  }
}
