import { realpath, stat } from "node:fs/promises";
import { basename, resolve } from "node:path";
import { sniffLength } from "../../turnleaf/src/sources/formats.ts";
import { booksIn, imagePages, listFolder } from "./folder.ts";
import { inspectPdf } from "./inspect_pdf.ts";
import { fileProblem, Problem, printable } from "./problem.ts";
import { openRegular, tooLarge } from "./regular_file.ts";
import { readableImages, servedFormat } from "./served_formats.ts";

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

/**
 * Opens the named file or folder and checks it, so that errors are reported
 * before anything is served.
 *
 * @param warn receives a sentence about something that is left out
 * @param given how the user named it
 * @throws Problem
 */
export async function openBook(
  path: string,
  warn: (sentence: string) => void,
  given = path,
): Promise<ServedBook> {
  const { real, isFolder } = await findBook(path, given);
  return isFolder ? await openFolder(real, given, warn) : await openFile(real, given);
}

/**
 * Opens the images of a folder as one book, whatever books lie beside them.
 *
 * @throws Problem
 */
export async function openImages(
  path: string,
  warn: (sentence: string) => void,
): Promise<ServedBook> {
  const { real } = await findBook(path, path);
  return await imageBook(real, (await listFolder(real, path, warn)).image);
}

/** A book by its name. */
export interface BookName {
  readonly path: string;
  /** Whether the images of a folder are meant, and none of the books beside them. */
  readonly isImages?: true;
}

/**
 * Returns the books that a name stands for: those of a folder that has several,
 * its images being one more, but for the cover of a single book; the name itself otherwise.
 *
 * @param warn receives a sentence about something that is left out
 * @throws Problem
 */
export async function booksAt(
  path: string,
  warn: (sentence: string) => void,
): Promise<readonly BookName[]> {
  const { real, isFolder } = await findBook(path, path);
  if (!isFolder) return [{ path }];
  const warnings: string[] = [];
  const content = await listFolder(real, path, (sentence) => warnings.push(sentence));
  const books: BookName[] = booksIn(content).map((book) => ({ path: book }));
  // A single image beside a single book is its cover.
  const isCover = books.length === 1 && content.image.length === 1;
  if (content.image.length > 0 && !isCover) books.push({ path, isImages: true });
  // One book, or images: `openBook` warns.
  if (books.length < 2) return [{ path }];
  for (const sentence of warnings) warn(sentence);
  return books;
}

/** Finds a file or folder, without links. */
async function findBook(path: string, given: string): Promise<{ real: string; isFolder: boolean }> {
  try {
    const real = await realpath(path);
    const stats = await stat(real);
    if (stats.isFile() || stats.isDirectory()) return { real, isFolder: stats.isDirectory() };
  } catch (error) {
    throw fileProblem(given, error);
  }
  throw new Problem(`${printable(given)} is neither a file nor a folder; name a book.`);
}

async function openFile(file: string, given: string): Promise<ServedBook> {
  const name = basename(file);
  const { start, size } = await readStart(file, given);
  if (start.length === 0) throw new Problem(`${printable(given)} is empty; get the file again.`);
  const format = servedFormat(start, name);
  if ("remedy" in format) {
    throw new Problem(`${printable(given)} ${format.reason}; ${format.remedy}.`);
  }
  const { kind, type, most = 0 } = format;
  if (size > most) throw tooLarge(given, most);
  if (kind === "pdf") return await openPdf(file, given);
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
  const content = await listFolder(folder, given, warn);
  const books = booksIn(content);
  const [book] = books;
  if (book && books.length === 1) return await openFile(book, book);
  if (content.image.length === 0) {
    const name = printable(given);
    throw books.length > 1
      ? new Problem(
          `${name} holds ${books.length} books and no images; name the one that you mean.`,
        )
      : new Problem(`${name} holds no pages; put ${readableImages} or books into it.`);
  }
  return await imageBook(folder, content.image);
}

async function imageBook(folder: string, images: readonly string[]): Promise<ServedBook> {
  const name = basename(resolve(folder)) || "book";
  const files = new Map<string, ServedFile>();
  const pages = await imagePages(images);
  const listed = pages.map(({ file, type, size }, index) => {
    const page = `pages/${index + 1}/${encodeName(basename(file))}`;
    files.set(`/${page}`, { type, path: file });
    // Relative to the manifest's own address.
    return { src: `../${page}`, ...size };
  });
  const src = address(name);
  const manifest = JSON.stringify({ title: name, pages: listed });
  files.set(src, { type: "application/json", text: manifest });
  return { title: printable(name), src, files };
}

/**
 * Returns the first bytes of a file, and its length.
 *
 * @throws Problem
 */
async function readStart(
  file: string,
  given: string,
): Promise<{ start: Uint8Array; size: number }> {
  try {
    const handle = await openRegular(file);
    if (!handle) throw new Problem(`${printable(given)} is not a regular file; name another.`);
    try {
      const { size } = await handle.stat();
      const { bytesRead, buffer } = await handle.read(Buffer.alloc(sniffLength), 0, sniffLength, 0);
      return { start: buffer.subarray(0, bytesRead), size };
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
