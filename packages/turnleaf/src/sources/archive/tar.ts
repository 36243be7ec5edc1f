/** Tar: files one after another, unpacked, so that each is read where it lies. */

import { bytesOf } from "../book_file.ts";
import { cleanText } from "../book_text.ts";
import { limits } from "../limits.ts";
import { BookError } from "../page_source.ts";
import type { Archive } from "./archive.ts";
import { BlobArchive } from "./blob_archive.ts";
import { legacyNames } from "./legacy_names.ts";
import { cleanPath } from "./names.ts";
import { readTarHeader, tarBlock } from "./tar_header.ts";

/** Bytes that are read at once: many small files, or descriptions of them, in one piece. */
const pieceLength = 128 * tarBlock;

/** Headers of a file at most, on average: its own, and two that describe it. */
const headersOfFile = 3;

/** Types of entries that are files, of those that stand for one, and of those that describe the next one. */
const [files, standins, describing] = [/[07]/, /[12MS]/, /[LKx]/] as const;

/** What is said of the next file before it. */
interface Description {
  readonly path?: Uint8Array<ArrayBuffer>;
  readonly target?: Uint8Array<ArrayBuffer>;
  readonly size?: number;
  readonly isSparse?: boolean;
}

/** A file of a tar, or what stands for one. */
interface Entry {
  readonly path: Uint8Array<ArrayBuffer>;
  readonly target: Uint8Array<ArrayBuffer>;
  readonly bytes: Blob;
  readonly type: string;
}

/**
 * Opens a tar, of which only the headers are read. Links lead to the files that they name. What is behind a
 * damaged header is not found, and the archive says so. Rejects with a `BookError` if it has too many files,
 * or cannot be read.
 *
 * @param name the file's name in sentences
 */
export async function openTar(file: Blob, name: string): Promise<Archive> {
  const found: Entry[] = [];
  let about: Description = {};
  let [piece, pieceAt] = [new Uint8Array(), 0];
  let isWhole = true;
  for (let at = 0, count = 0; at < file.size; count++) {
    if (count > headersOfFile * limits.archiveEntries) throw tooMany(name);
    if (at + tarBlock > pieceAt + piece.length) {
      [piece, pieceAt] = [await bytesOf(file.slice(at, at + pieceLength), name), at];
    }
    const block = piece.subarray(at - pieceAt, at - pieceAt + tarBlock);
    const header = readTarHeader(block);
    if (!header) {
      // One of zeros ends it.
      isWhole = block.every((byte) => byte === 0);
      break;
    }
    const length = files.test(header.type) ? (about.size ?? header.size) : header.size;
    const bytes = file.slice(at + tarBlock, at + tarBlock + length);
    at += tarBlock * (1 + Math.ceil(length / tarBlock));
    isWhole = bytes.size === length;
    if (describing.test(header.type)) {
      const said = await bytesOf(bytes.slice(0, limits.archivePath), name);
      about = { ...about, ...descriptionIn(header.type, said) };
      continue;
    }
    const { path = header.path, target = header.target, isSparse = false } = about;
    about = {};
    const type = isSparse ? "S" : header.type;
    // Before there was a type for folders, their names ended so.
    if (!(files.test(type) || standins.test(type)) || path.at(-1) === 0x2f) continue;
    found.push({ path, target, bytes, type });
    if (found.length <= limits.archiveEntries) continue;
    throw tooMany(name);
  }
  return new BlobArchive(name, filesOf(found, name), isWhole ? undefined : cutOff(name));
}

/** Returns the files of a tar by their paths: each as it is, or why it cannot be read. */
function filesOf(found: readonly Entry[], name: string): ReadonlyMap<string, Blob | BookError> {
  const raw = found.flatMap(({ path, target }) => [path, target]);
  const names = legacyNames(
    raw,
    raw.map((one) => new TextDecoder("latin1").decode(one)),
  );
  const entries = new Map<string, { readonly entry: Entry; readonly target: string }>();
  for (const [k, entry] of found.entries()) {
    const [said = "", target = ""] = names.slice(2 * k, 2 * k + 2);
    const path = cleanPath(said);
    // A symbolic link's target is named from its folder.
    const folder = entry.type === "2" && !target.startsWith("/") ? `${said}/../` : "";
    // Of several of one name the last is meant: a tar is added to at its end.
    if (path !== null) entries.set(path, { entry, target: cleanPath(folder + target) ?? "" });
  }
  const fileAt = (path: string): Blob | BookError => {
    let at = path;
    for (let step = 0; step < mostLinks; step++) {
      const { entry, target } = entries.get(at) ?? {};
      if (entry === undefined) break;
      if (files.test(entry.type)) return entry.bytes;
      if (/[MS]/.test(entry.type)) return unread(path, name, "is stored in parts");
      at = target ?? "";
    }
    return unread(path, name, `is a link to ${cleanText(at, 80)}, which is no file in it`);
  };
  return new Map([...entries.keys()].map((path) => [path, fileAt(path)]));
}

/** Links that lead to each other, at most. */
const mostLinks = 20;

const unread = (path: string, name: string, why: string): BookError =>
  new BookError(`${cleanText(path, 80)} in ${name} ${why}; pack it again with the whole file.`, {
    code: "damaged",
    source: name,
  });

const tooMany = (name: string): BookError =>
  new BookError(`${name} has more than ${limits.archiveEntries} files; split it and open a part.`, {
    code: "tooLarge",
    source: name,
  });

const cutOff = (name: string): BookError =>
  new BookError(`${name} is damaged or breaks off, and pages may be missing; get it again.`, {
    code: "damaged",
    source: name,
  });

const untilZero = (bytes: Uint8Array<ArrayBuffer>): Uint8Array<ArrayBuffer> =>
  bytes.includes(0) ? bytes.slice(0, bytes.indexOf(0)) : bytes;

/** Returns what a header that describes the next file says. */
function descriptionIn(type: string, said: Uint8Array<ArrayBuffer>): Description {
  if (type === "x") return extendedHeader(said);
  return type === "L" ? { path: untilZero(said) } : { target: untilZero(said) };
}

/** Returns what an extended header says: lines of their length, a key, "=" and a value. */
function extendedHeader(bytes: Uint8Array<ArrayBuffer>): Description {
  let said: Description = {};
  const letters = new TextDecoder("latin1").decode(bytes);
  for (let at = 0; at < letters.length; ) {
    const [start, length, key = ""] = /^(\d+) ([^=]*)=/.exec(letters.slice(at)) ?? [];
    if (start === undefined || !(Number(length) > start.length)) break;
    const value = bytes.slice(at + start.length, at + Number(length) - 1);
    if (key === "path") said = { ...said, path: value };
    if (key === "linkpath") said = { ...said, target: value };
    if (key === "size") {
      said = { ...said, size: Number.parseInt(new TextDecoder().decode(value), 10) || 0 };
    }
    if (key.startsWith("GNU.sparse.")) said = { ...said, isSparse: true };
    at += Number(length);
  }
  return said;
}
