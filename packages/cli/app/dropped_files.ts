/** The files of a drop, those of folders too where the browser tells them. */

import { isArchiveName, isMarkdownName, kindOfName } from "../src/file_names.ts";

/** Maximum of entries that are looked at, and of folders within each other. */
const mostEntries = 20_000;
const deepest = 8;

/** Plain text is no book here: it may be a note beside images. */
const isBook = (name: string): boolean =>
  kindOfName(name) === "book" || isArchiveName(name) || isMarkdownName(name);

const isImage = (name: string): boolean => kindOfName(name) === "image" || /\.svg$/i.test(name);

/**
 * Returns what was dropped. Of folders: their images, or the one book in them,
 * without hidden files. Call it during the event.
 */
export async function droppedFiles(drop: DataTransfer): Promise<readonly File[]> {
  const loose = [...drop.files];
  const entries = [...drop.items].map((item) => item.webkitGetAsEntry?.() ?? null);
  if (!entries.some((entry) => entry?.isDirectory)) return loose;
  const found: File[] = [];
  let count = 0;
  const add = async (entry: FileSystemEntry | null, depth: number): Promise<void> => {
    if (!entry || entry.name.startsWith(".") || ++count > mostEntries || depth > deepest) return;
    if (isFile(entry)) {
      if (isBook(entry.name) || isImage(entry.name)) found.push(await fileOf(entry));
    } else if (isFolder(entry)) {
      for (const inner of await entriesOf(entry)) await add(inner, depth + 1);
    }
  };
  for (const entry of entries) await add(entry, 0);
  const books = found.filter(({ name }) => isBook(name));
  const images = found.filter(({ name }) => isImage(name));
  if (books.length === 1 || images.length === 0) return books;
  return images;
}

function isFile(entry: FileSystemEntry): entry is FileSystemFileEntry {
  return entry.isFile;
}

function isFolder(entry: FileSystemEntry): entry is FileSystemDirectoryEntry {
  return entry.isDirectory;
}

function fileOf(entry: FileSystemFileEntry): Promise<File> {
  return new Promise((resolve, reject) => entry.file(resolve, reject));
}

/** Returns the entries of a folder, which come in parts. */
async function entriesOf(folder: FileSystemDirectoryEntry): Promise<FileSystemEntry[]> {
  const reader = folder.createReader();
  const all: FileSystemEntry[] = [];
  while (all.length < mostEntries) {
    const part = await new Promise<FileSystemEntry[]>((resolve, reject) =>
      reader.readEntries(resolve, reject),
    );
    if (part.length === 0) break;
    all.push(...part);
  }
  return all;
}
