/** The files that a reader drops or picks, those of folders too, in the order of a book. */

import { archiveOfName, formatOfName } from "../../turnleaf/src/sources/formats.ts";

/** Maximum of entries that are looked at, and of folders within each other. */
const mostEntries = 20_000;
const deepest = 8;

/** Plain text is no book here: it may be a note beside images. */
const isBook = (name: string): boolean => {
  const format = formatOfName(name);
  const isText = format?.type === "text/plain";
  return archiveOfName(name) !== null || (format !== null && !isImage(name) && !isText);
};

const isImage = (name: string): boolean => formatOfName(name)?.kind === "image";

/** A file of a folder, and the names that lead to it, its own the last. */
interface FoundFile {
  readonly steps: readonly string[];
  readonly file: File;
}

/** Returns files that were picked one by one, in the natural order of their names. */
export function pickedFiles(files: Iterable<File>): readonly File[] {
  return inOrder([...files].map((file) => ({ steps: [file.name], file })));
}

/**
 * Returns what was dropped: as `pickedFiles`, or if folders are among it, as
 * `filesOfFolder`. Call it during the event.
 */
export async function droppedFiles(drop: DataTransfer): Promise<readonly File[]> {
  const loose = [...drop.files];
  const entries = [...drop.items].map((item) => item.webkitGetAsEntry?.() ?? null);
  if (!entries.some((entry) => entry?.isDirectory)) return pickedFiles(loose);
  const found: FoundFile[] = [];
  let count = 0;
  const add = async (entry: FileSystemEntry | null, before: readonly string[]): Promise<void> => {
    if (!entry || ++count > mostEntries) return;
    const steps = [...before, entry.name];
    if (!isLookedAt(steps)) return;
    if (isFile(entry)) {
      if (isBook(entry.name) || isImage(entry.name)) {
        found.push({ steps, file: await fileOf(entry) });
      }
    } else if (isFolder(entry)) {
      for (const inner of await entriesOf(entry)) await add(inner, steps);
    }
  };
  for (const entry of entries) await add(entry, []);
  return bookAmong(found);
}

/**
 * Returns what of a picked folder is a book: its images, those of folders in it
 * too, or the one book in it, without hidden files.
 */
export function filesOfFolder(files: Iterable<File>): readonly File[] {
  const found = [...files]
    .slice(0, mostEntries)
    .map((file) => ({ steps: (file.webkitRelativePath || file.name).split("/"), file }));
  return bookAmong(found.filter(({ steps }) => isLookedAt(steps)));
}

function bookAmong(found: readonly FoundFile[]): readonly File[] {
  const books = found.filter(({ file }) => isBook(file.name));
  const images = found.filter(({ file }) => isImage(file.name));
  return inOrder(books.length === 1 || images.length === 0 ? books : images);
}

/** Returns whether a file or a folder is looked at: it is not hidden, nor too deep. */
function isLookedAt(steps: readonly string[]): boolean {
  return steps.length <= deepest + 1 && !steps.some((step) => step.startsWith("."));
}

/** Returns files in the natural order of their names, folder after folder. */
function inOrder(found: readonly FoundFile[]): readonly File[] {
  const { compare } = new Intl.Collator("en", { numeric: true });
  const order = (a: FoundFile, b: FoundFile): number => {
    const at = a.steps.findIndex((step, k) => step !== b.steps[k]);
    return at < 0 ? 0 : compare(a.steps[at] ?? "", b.steps[at] ?? "");
  };
  return [...found].sort(order).map(({ file }) => file);
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
