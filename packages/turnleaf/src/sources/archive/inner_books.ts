/** Books that are packed in an archive, as mails, servers and programs that sort books pack them. */

import { cleanText } from "../book_text.ts";
import { archiveOfName, type FileFormat, formatOfName } from "../formats.ts";
import { limits } from "../limits.ts";
import { BookError, type PageSource } from "../page_source.ts";
import type { Archive } from "./archive.ts";
import { isLitter } from "./litter.ts";

/** Of one book in several formats the first of these is read, as it has the most of the book; then any other. */
const preferred: readonly FileFormat["kind"][] = ["epub", "fb2", "kindle", "pdf"];

/** Letters of the name of a file in an archive that a sentence has. */
const mostNamed = 80;

/** Opens a book that is packed in an archive. */
export type OpenInner = (file: Blob, name: string) => Promise<PageSource>;

/**
 * Opens the book that is packed in an archive. Returns null if there is none. Rejects with a `BookError` if
 * there are several.
 *
 * @param name the archive's name in sentences
 */
export async function openInnerBook(
  archive: Archive,
  name: string,
  open: OpenInner,
): Promise<PageSource | null> {
  const [book, ...others] = innerBooks(archive.names, name);
  if (book === undefined) return null;
  const own = cleanText(book.split("/").at(-1), mostNamed) || name;
  if (others.length > 0) {
    throw new BookError(
      `${name} holds several books; unpack it and open one of them, such as ${own}.`,
      { code: "unsupported", source: name },
    );
  }
  const bytes = await archive.read(book, limits.unpackedBytes);
  archive.close();
  return await open(new Blob([bytes], { type: formatOfName(book)?.type ?? "" }), own);
}

/**
 * Returns the books in an archive, by the names of its files: one file of each. Empty if it is a comic, which
 * has images; one image may be a book's cover. An archive is one where there is no other, and so is a text
 * alone, unless the archive is named as a comic.
 *
 * @param name of the archive
 */
function innerBooks(names: readonly string[], name: string): readonly string[] {
  const files = names.filter((file) => !isLitter(file));
  const ofFamily = (...families: readonly FileFormat["family"][]): string[] =>
    files.filter((file) => families.includes(formatOfName(file)?.family));
  const images = ofFamily("image").length;
  if (images > 1) return [];
  const books = new Map<string, string>();
  for (const file of ofFamily("book", "comic")) {
    const title = file.replace(/\.[^./]*$/, "").toLowerCase();
    const other = books.get(title);
    if (other === undefined || rankOf(file) < rankOf(other)) books.set(title, file);
  }
  if (books.size > 0) return [...books.values()];
  const archives = files.filter((file) => archiveOfName(file) !== null);
  if (archives.length > 0 && images === 0) return archives;
  const texts = ofFamily("text");
  const isText = texts.length === 1 && images === 0 && formatOfName(name)?.family !== "comic";
  return isText ? texts : [];
}

/** Returns the place of a file's format among those that are preferred. */
function rankOf(file: string): number {
  const place = preferred.indexOf(formatOfName(file)?.kind ?? "unknown");
  return place < 0 ? preferred.length : place;
}
