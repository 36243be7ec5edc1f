/** The books of a collection: files of formats that are read, and EPUBs that lie unpacked. */
import { existsSync, readdirSync, readFileSync, statSync } from "node:fs";
import { basename, join, relative } from "node:path";
import { unzipSync, zipSync } from "fflate";
import { importTs } from "../../scripts/import_ts.mjs";

const { formatOfName } = await importTs("sources/formats.ts");

/** Returns what a collection's report calls the format of a book by its name; undefined if it is no book's. */
function formatByName(name) {
  const { family, kind } = formatOfName(name) ?? {};
  if (family === "comic") return "comic";
  return family === "book" ? kind : undefined;
}

/** Returns the entries of a folder by name. */
const entriesOf = (folder) =>
  readdirSync(folder, { withFileTypes: true }).sort((a, b) => (a.name < b.name ? -1 : 1));

/** Returns whether a folder is an EPUB that lies unpacked. */
const isUnpacked = (folder) => existsSync(join(folder, "META-INF", "container.xml"));

/** Returns the files of an unpacked EPUB by their paths in its archive, `mimetype` first. */
function filesOf(folder) {
  const paths = readdirSync(folder, { recursive: true, withFileTypes: true })
    .filter((entry) => entry.isFile() && !/^\.(DS_Store|git)/.test(entry.name))
    .map((entry) => relative(folder, join(entry.parentPath, entry.name)))
    .sort((a, b) => (b === "mimetype") - (a === "mimetype") || (a < b ? -1 : 1));
  return Object.fromEntries(paths.map((path) => [path, readFileSync(join(folder, path))]));
}

/** One book of a collection. */
class Book {
  #files;

  constructor(root, path, format, isFolder) {
    this.path = relative(root, path) || basename(root);
    this.format = format;
    this.isFolder = isFolder;
    this.address = path;
  }

  /** Its name as a reader has it. */
  get fileName() {
    return this.isFolder ? `${basename(this.address)}.epub` : basename(this.address);
  }

  /** Returns its file. */
  bytes() {
    return this.isFolder
      ? zipSync(this.files(), { level: 0 })
      : new Uint8Array(readFileSync(this.address));
  }

  /** Returns the files in it by their paths; an empty object if its archive cannot be read. */
  files() {
    if (this.#files) return this.#files;
    try {
      this.#files = this.isFolder ? filesOf(this.address) : unzipSync(this.bytes());
    } catch {
      this.#files = {};
    }
    return this.#files;
  }

  /** Lets go of the files. */
  forget() {
    this.#files = undefined;
  }
}

/** Returns the books beneath a folder, or the one that a path is. */
export function booksIn(root, path = root) {
  if (!statSync(path).isDirectory()) {
    const format = formatByName(basename(path));
    return format ? [new Book(root, path, format, false)] : [];
  }
  if (isUnpacked(path)) return [new Book(root, path, "epub", true)];
  return entriesOf(path)
    .filter(({ name }) => !name.startsWith("."))
    .flatMap(({ name }) => booksIn(root, join(path, name)));
}
