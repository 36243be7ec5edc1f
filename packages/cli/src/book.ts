import { realpath, stat } from "node:fs/promises";
import { basename, resolve } from "node:path";
import { imagePages, listFolder } from "./folder.ts";
import { imageType, sniffLength, textType } from "./image_types.ts";
import { inspectPdf } from "./inspect_pdf.ts";
import { fileProblem, Problem, printable } from "./problem.ts";
import { openRegular, tooLarge } from "./regular_file.ts";

/** A served file: from the disk, or text made at the start. */
export type ServedFile =
  | { readonly type: string; readonly path: string }
  | { readonly type: string; readonly text: string };

/** A book, ready to be served. */
export interface ServedBook {
  /** Printable, on one line. */
  readonly title: string;
  /** Its address for the reader app: one of the addresses of `files`. */
  readonly src: string;
  /** Every file of the book, by the exact path of its address. */
  readonly files: ReadonlyMap<string, ServedFile>;
}

/** Maximum of bytes of a PDF, an image, an archive and text: the bounds of the viewer. */
const mostPdfBytes = 2_000_000_000;
const mostImageBytes = 100_000_000;
const mostArchiveBytes = 1_000_000_000;
const mostTextBytes = 16_000_000;

const isArchive = (type: string): boolean => type === "application/zip";

/**
 * Opens the named file or folder and checks it, so that errors are reported
 * before anything is served.
 *
 * @param warn receives a sentence about something that is left out
 * @throws Problem
 */
export async function openBook(
  path: string,
  warn: (sentence: string) => void,
): Promise<ServedBook> {
  const real = await realpath(path).catch((error: unknown) => {
    throw fileProblem(path, error);
  });
  const stats = await stat(real).catch((error: unknown) => {
    throw fileProblem(path, error);
  });
  if (stats.isFile()) return await openFile(real, path);
  if (stats.isDirectory()) return await openFolder(real, path, warn);
  throw new Problem(`${printable(path)} is neither a file nor a folder; name a book.`);
}

async function openFile(file: string, given: string): Promise<ServedBook> {
  const name = basename(file);
  const { start, size } = await readStart(file, given);
  if (start.length === 0) throw new Problem(`${printable(given)} is empty; get the file again.`);
  if (start.includes("%PDF-")) {
    if (size > mostPdfBytes) throw tooLarge(given, mostPdfBytes);
    return await openPdf(file, given);
  }
  // What is in an archive is the reader's to find out.
  const type = start.startsWith("PK\x03\x04")
    ? "application/zip"
    : (imageType(start) ?? textType(start, name));
  if (!type) {
    throw new Problem(
      `${printable(given)} is of an unknown format; a PDF, an EPUB, a comic (CBZ), Markdown, text, an image (PNG, JPEG, WebP, AVIF, GIF) or a folder of images can be read.`,
    );
  }
  const isText = type.startsWith("text/");
  const most = isText ? mostTextBytes : isArchive(type) ? mostArchiveBytes : mostImageBytes;
  if (size > most) throw tooLarge(given, most);
  const src = address(name);
  return { title: printable(name), src, files: new Map([[src, { type, path: file }]]) };
}

async function openPdf(file: string, given: string): Promise<ServedBook> {
  const found = await inspectPdf(file, given);
  const src = address(basename(file));
  return {
    title: printable(found.title) || printable(basename(file)),
    src,
    files: new Map([[src, { type: "application/pdf", path: file }]]),
  };
}

async function openFolder(
  folder: string,
  given: string,
  warn: (sentence: string) => void,
): Promise<ServedBook> {
  const { pdfs, images } = await listFolder(folder, given, warn);
  const [pdf] = pdfs;
  if (pdf && pdfs.length === 1) return await openFile(pdf, pdf);
  if (images.length === 0) {
    const name = printable(given);
    throw pdfs.length > 1
      ? new Problem(`${name} holds ${pdfs.length} PDFs and no images; name the one to read.`)
      : new Problem(
          `${name} holds no pages; put images (PNG, JPEG, WebP, AVIF, GIF) or one PDF into it.`,
        );
  }
  const name = basename(resolve(folder)) || "book";
  const files = new Map<string, ServedFile>();
  const pages = await imagePages(images);
  const listed = pages.map(({ file, type, size }, index) => {
    const src = `/pages/${index + 1}/${encodeName(basename(file))}`;
    files.set(src, { type, path: file });
    return { src, ...size };
  });
  const src = address(name);
  const manifest = JSON.stringify({ title: name, pages: listed });
  files.set(src, { type: "application/json", text: manifest });
  return { title: printable(name), src, files };
}

/**
 * Returns the first bytes of a file as latin-1 text, and its length.
 *
 * @throws Problem
 */
async function readStart(file: string, given: string): Promise<{ start: string; size: number }> {
  try {
    const handle = await openRegular(file);
    if (!handle) throw new Problem(`${printable(given)} is not a regular file; name another.`);
    try {
      const { size } = await handle.stat();
      const { bytesRead, buffer } = await handle.read(Buffer.alloc(sniffLength), 0, sniffLength, 0);
      return { start: buffer.toString("latin1", 0, bytesRead), size };
    } finally {
      await handle.close();
    }
  } catch (error) {
    throw error instanceof Problem ? error : fileProblem(given, error);
  }
}

/** Returns an address with the file's name in it, because the reader's sentences use that name. */
function address(name: string): string {
  return `/book/${encodeName(name)}`;
}

function encodeName(name: string): string {
  return encodeURIComponent(Buffer.from(name).toString());
}
