/** Tar: files one after another, unpacked, so that each is read where it lies. */

import { bytesOf } from "../book_file.ts";
import { limits } from "../limits.ts";
import { BookError } from "../page_source.ts";
import type { Archive } from "./archive.ts";
import { BlobArchive } from "./blob_archive.ts";
import { legacyNames } from "./legacy_names.ts";
import { cleanPath } from "./names.ts";
import { readTarHeader, tarBlock } from "./tar_header.ts";

/** Bytes that are read at once: many small files, or descriptions of them, in one piece. */
const pieceLength = 128 * tarBlock;

/** Headers of a file at most: its own, and two that describe it. */
const headersOfFile = 3;

/** Types of entries that are files, and of those that describe the next one. */
const [files, longName, extended] = [/[07]/, "L", "x"] as const;

/**
 * Opens a tar, of which only the headers are read. What is behind a damaged header is not found. Rejects
 * with a `BookError` if it has too many files, or cannot be read.
 *
 * @param name the file's name in sentences
 */
export async function openTar(file: Blob, name: string): Promise<Archive> {
  const found: { path: Uint8Array<ArrayBuffer>; bytes: Blob }[] = [];
  let path: Uint8Array<ArrayBuffer> | null = null;
  let size: number | null = null;
  let [piece, pieceAt] = [new Uint8Array(), 0];
  for (let at = 0, count = 0; at < file.size; count++) {
    if (count > headersOfFile * limits.archiveEntries) throw tooMany(name);
    if (at + tarBlock > pieceAt + piece.length) {
      [piece, pieceAt] = [await bytesOf(file.slice(at, at + pieceLength), name), at];
    }
    const header = readTarHeader(piece.subarray(at - pieceAt, at - pieceAt + tarBlock));
    if (!header) break;
    const length = size !== null && files.test(header.type) ? size : header.size;
    const bytes = file.slice(at + tarBlock, at + tarBlock + length);
    at += tarBlock * (1 + Math.ceil(length / tarBlock));
    if (header.type === longName || header.type === extended) {
      const said = await bytesOf(bytes.slice(0, limits.archivePath), name);
      const about = header.type === extended ? extendedHeader(said) : { path: untilZero(said) };
      path = about.path ?? path;
      size = about.size ?? size;
      continue;
    }
    const own = path ?? header.path;
    [path, size] = [null, null];
    // Before there was a type for folders, their names ended so.
    if (!files.test(header.type) || own.at(-1) === 0x2f) continue;
    found.push({ path: own, bytes });
    if (found.length <= limits.archiveEntries) continue;
    throw tooMany(name);
  }
  const raw = found.map((one) => one.path);
  const names = legacyNames(
    raw,
    raw.map((one) => new TextDecoder("latin1").decode(one)),
  );
  const entries = new Map<string, Blob>();
  for (const [k, { bytes }] of found.entries()) {
    const clean = cleanPath(names[k] ?? "");
    // Of several of one name the last is meant: a tar is added to at its end.
    if (clean !== null) entries.set(clean, bytes);
  }
  return new BlobArchive(name, entries);
}

const tooMany = (name: string): BookError =>
  new BookError(`${name} has more than ${limits.archiveEntries} files; split it and open a part.`, {
    code: "tooLarge",
    source: name,
  });

const untilZero = (bytes: Uint8Array<ArrayBuffer>): Uint8Array<ArrayBuffer> =>
  bytes.includes(0) ? bytes.slice(0, bytes.indexOf(0)) : bytes;

/** Returns what an extended header says: lines of their length, a key, "=" and a value. */
function extendedHeader(bytes: Uint8Array<ArrayBuffer>): {
  path?: Uint8Array<ArrayBuffer>;
  size?: number;
} {
  const said: { path?: Uint8Array<ArrayBuffer>; size?: number } = {};
  const letters = new TextDecoder("latin1").decode(bytes);
  for (let at = 0; at < letters.length; ) {
    const [start, length, key] = /^(\d+) ([^=]*)=/.exec(letters.slice(at)) ?? [];
    if (start === undefined || !(Number(length) > start.length)) break;
    const value = bytes.slice(at + start.length, at + Number(length) - 1);
    if (key === "path") said.path = value;
    if (key === "size") said.size = Number.parseInt(new TextDecoder().decode(value), 10) || 0;
    at += Number(length);
  }
  return said;
}
