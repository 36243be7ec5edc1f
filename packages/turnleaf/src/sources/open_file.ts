/** Opens files: the code that reads a kind of them is imported when one is opened. */

import type { Archive } from "./archive/archive.ts";
import { type BookFile, bytesOf, fileIn, type WholeFile } from "./book_file.ts";
import {
  archiveOfName,
  formatOfArchive,
  formatOfFile,
  formatOfName,
  type Kind,
  type OpenedKind,
  rareImageType,
  sniff,
  sniffLength,
} from "./formats.ts";
import { loadPart } from "./load_part.ts";
import { type ImageBook, type ImagePage, parseManifest } from "./manifest.ts";
import { isRecord } from "./manifest_checks.ts";
import { BookError, type PageSource, type Typography } from "./page_source.ts";
import type { PdfOptions } from "./pdf_file.ts";

/** The settings that a format may need. */
export interface FormatOptions extends PdfOptions {
  /** How flowing text is set at first; the default is as the book has it. */
  readonly typography?: Typography;
  /** Base of relative addresses in a file that has no address itself. */
  readonly base: string;
  /** Whether the file was in an archive: one in that is not opened. */
  readonly isInArchive?: boolean;
}

/** What reads files of one kind. Its functions reject with a `BookError`, or with the signal's reason. */
interface FormatReader {
  /** Starts loading what such a file needs, while its first bytes are awaited. */
  prepare?(options: PdfOptions): Promise<unknown>;
  /**
   * Opens a file.
   *
   * @param whole reads all of it, within the bound of its format
   */
  open?(
    file: BookFile,
    whole: () => Promise<WholeFile>,
    options: FormatOptions,
  ): Promise<PageSource>;
  /** Opens the book that an archive is, which then closes the archive. */
  openArchive?(
    archive: Archive,
    file: Blob,
    name: string,
    typography?: Typography,
  ): Promise<PageSource>;
}

/** Archives of RAR and 7-Zip. */
const unpacked: FormatReader = {
  prepare: async () => (await import("./archive/unpacked_archive.ts")).prepareUnpacking(),
  async open({ name }, whole, options) {
    const { blob } = await whole();
    const { openUnpacked } = await loadPart(import("./archive/unpacked_archive.ts"));
    return await openArchived(await openUnpacked(blob, name, options.signal), blob, name, options);
  },
};

/** Books that are packed each by itself, as the tar of a comic may be. */
const packed: FormatReader = {
  async open(file, whole, options) {
    const { blob } = await whole();
    const { unpackedFile } = await loadPart(import("./archive/packed_file.ts"));
    const unpacked = await unpackedFile(blob, sniff(file), file.name, options.signal);
    const inner = await fileIn(unpacked, file.name);
    if (readerOf(sniff(inner)) === packed) throw packedOften(file.name);
    return await openFile(inner, options);
  },
};

function packedOften(name: string): BookError {
  return new BookError(`${name} is packed several times over; unpack it first.`, {
    code: "unsupported",
    source: name,
  });
}

const readers: Readonly<Record<OpenedKind, FormatReader>> = {
  pdf: {
    prepare: async ({ pdfWorker }) => (await import("./pdf.ts")).preparePdf(pdfWorker),
    async open({ name, from, length }, _whole, options) {
      const { openPdf } = await loadPart(import("./pdf.ts"));
      return await openPdf({ name, from, ...(length === undefined ? {} : { length }) }, options);
    },
  },
  image: {
    async open({ name, from }, whole) {
      const { blob } = await whole();
      const found = await pagesOfImage(blob);
      const isFetched = found.length === 1 && typeof from === "string";
      const pages = isFetched ? [{ src: { name, read: async () => blob } }] : found;
      return await openImages({
        ...{ name, title: name, language: "", direction: "ltr", kind: "scan", pages, file: blob },
      });
    },
  },
  json: {
    async open({ name }, whole, options) {
      const file = await whole();
      const value = await parseJson(file, name);
      const base = file.url || options.base;
      if (isIiif(value)) {
        const { openIiif } = await loadPart(import("./iiif/iiif_source.ts"));
        return openIiif(value, base, name);
      }
      return await openImages(parseManifest(value, base, name));
    },
  },
  text: {
    async open({ name, type }, whole, { typography }) {
      const { blob } = await whole();
      const { openText } = await loadPart(import("./text/text_book.ts"));
      return await openText(blob, name, type, typography);
    },
  },
  zip: {
    prepare: () => Promise.all([import("./archive/zip.ts"), import("./comics/comic.ts")]),
    async open({ name }, whole, options) {
      const { blob } = await whole();
      const { openZip } = await loadPart(import("./archive/zip.ts"));
      return await openArchived(await openZip(blob, name), blob, name, options);
    },
  },
  tar: {
    prepare: () => Promise.all([import("./archive/tar.ts"), import("./comics/comic.ts")]),
    async open({ name }, whole, options) {
      const { blob } = await whole();
      const { openTar } = await loadPart(import("./archive/tar.ts"));
      return await openArchived(await openTar(blob, name), blob, name, options);
    },
  },
  rar: unpacked,
  "7z": unpacked,
  gzip: packed,
  zstd: packed,
  xz: packed,
  epub: {
    prepare: () => Promise.all([import("./archive/zip.ts"), import("./epub/epub.ts")]),
    async openArchive(archive, file, name, typography) {
      const { openEpub } = await loadPart(import("./epub/epub.ts"));
      return await openEpub(archive, file, name, typography);
    },
  },
  kindle: {
    prepare: () => import("./kindle/kindle.ts"),
    async open({ name }, whole, { typography }) {
      const { blob } = await whole();
      const { openKindle } = await loadPart(import("./kindle/kindle.ts"));
      return await openKindle(blob, name, typography);
    },
  },
  fb2: {
    prepare: () => import("./fb2/fb2.ts"),
    async open({ name }, whole, { typography }) {
      const { blob } = await whole();
      const { openFb2 } = await loadPart(import("./fb2/fb2.ts"));
      return await openFb2(blob, name, typography);
    },
    async openArchive(archive, _file, name, typography) {
      const { openFb2 } = await loadPart(import("./fb2/fb2.ts"));
      try {
        const inner = archive.names.find((one) => formatOfName(one)?.kind === "fb2");
        return await openFb2(new Blob([await archive.read(inner ?? "")]), name, typography);
      } finally {
        archive.close();
      }
    },
  },
};

const readerOf = (kind: Kind): FormatReader | undefined =>
  (readers as Readonly<Partial<Record<Kind, FormatReader>>>)[kind];

/**
 * Starts loading the code that a file's name makes likely, while its first bytes are awaited.
 * They alone decide what it is.
 */
export function prepareFor(address: string, options: PdfOptions): void {
  const path = address.split(/[?#]/, 1)[0] ?? "";
  const format = formatOfName(path) ?? archiveOfName(path);
  // What fails is reported where it is used.
  if (format)
    readerOf(format.kind)
      ?.prepare?.(options)
      .catch(() => {});
}

/** Opens a file by the format that `formatOfFile` finds. */
export async function openFile(file: BookFile, options: FormatOptions): Promise<PageSource> {
  const format = formatOfFile(file);
  const { most } = format ?? {};
  const open = format && readerOf(format.kind)?.open;
  if (open && most !== undefined) {
    try {
      return await open(file, () => file.whole(most, options.signal), options);
    } catch (error) {
      throw await asPart(error, file.name);
    }
  }
  const { rejectionOf } = await loadPart(import("./unread_formats.ts"));
  const { reason, remedy } = rejectionOf(file);
  throw new BookError(`${file.name} ${reason}; ${remedy}.`, {
    code: "unsupported",
    source: file.name,
  });
}

/** Returns an error, or one that says how to join the file if it is damaged as part of one that was cut. */
async function asPart(error: unknown, name: string): Promise<unknown> {
  if (!(error instanceof BookError) || error.code !== "damaged") return error;
  const { joiningOf } = await loadPart(import("./unread_formats.ts"));
  const joining = joiningOf(name);
  if (joining === null) return error;
  return new BookError(`${name} ${joining}`, { code: "damaged", source: name, cause: error });
}

/**
 * Opens the book that the files of an archive are, or the one that is packed in it: a comic, if no format says
 * that it is one of its own.
 */
async function openArchived(
  archive: Archive,
  blob: Blob,
  name: string,
  options: FormatOptions,
): Promise<PageSource> {
  const format = formatOfArchive(archive.names);
  const reader = format && readerOf(format.kind);
  if (reader?.openArchive) return await reader.openArchive(archive, blob, name, options.typography);
  const openInner = async (file: Blob, own: string): Promise<PageSource> => {
    if (options.isInArchive) throw packedOften(name);
    return await openFile(await fileIn(file, own), { ...options, isInArchive: true });
  };
  const { openComic } = await loadPart(import("./comics/comic.ts"));
  return await openComic(archive, blob, name, openInner);
}

/** Opens a book of images. */
export async function openImages(book: ImageBook): Promise<PageSource> {
  const { openImageBook } = await loadPart(import("./images.ts"));
  return await openImageBook(book);
}

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

/**
 * Returns whether JSON is of IIIF, by the context that it names (version 1 of Presentation had that of Shared
 * Canvas), or by the type or the protocol that nothing else has: some write no context.
 */
function isIiif(value: unknown): value is Record<string, unknown> {
  if (!isRecord(value)) return false;
  const marks = [value["@context"], value.protocol].flat();
  const iiif = /iiif\.io\/api\/|shared-canvas\.org\/ns\/context/;
  if (marks.some((one) => typeof one === "string" && iiif.test(one))) return true;
  return /^(sc:)?(Manifest|Collection)$/.test(String(value.type ?? value["@type"]));
}

async function parseJson({ blob }: WholeFile, name: string): Promise<unknown> {
  const bytes = await bytesOf(blob, name);
  const { decodeText } = await loadPart(import("./decode_text.ts"));
  try {
    return JSON.parse(await decodeText(bytes));
  } catch {
    throw new BookError(`${name} is no valid JSON; correct it and open it again.`, {
      code: "damaged",
      source: name,
    });
  }
}
