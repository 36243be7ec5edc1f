import {
  BlobReader,
  configure,
  type FileEntry,
  registerCodec,
  ZipReader,
} from "@zip.js/zip.js/lib/zip-core-native.js";
import { unknownFailure } from "../failures.ts";
import { joinBytes } from "../join_bytes.ts";
import { limits } from "../limits.ts";
import { loadPart } from "../load_part.ts";
import { BookError } from "../page_source.ts";
import type { Archive } from "./archive.ts";
import { legacyNames } from "./legacy_names.ts";
import { cleanPath, OwnPaths } from "./names.ts";

// Workers would have to be allowed by the page's policy; the browser inflates in the background. What a
// chunk is inflated to comes at once, before reading can be stopped, and Deflate makes up to 1,032 bytes of
// one: 34 MB of these, where twice as long chunks had a hostile comic of 20,000 images take over 1 GB.
configure({ useWebWorkers: false, chunkSize: 1 << 15 });

/** The number of Zstandard, and of compressions that are not unpacked, with their names (APPNOTE.TXT, 4.4.5). */
const zstandard = 93;
const notUnpacked: ReadonlyMap<number, string> = new Map([
  [1, "Shrink"],
  [2, "Reduce"],
  [3, "Reduce"],
  [4, "Reduce"],
  [5, "Reduce"],
  [6, "Implode"],
  [12, "bzip2"],
  [14, "LZMA"],
  [95, "XZ"],
  [96, "packed JPEG"],
  [97, "WavPack"],
  [98, "PPMd"],
]);

/**
 * Opens a ZIP, of which only the directory is read. Rejects with a `BookError`
 * if it is damaged or has too many files.
 *
 * @param name the file's name in sentences
 */
export async function openZip(file: Blob, name: string): Promise<Archive> {
  const reader = new ZipReader(new BlobReader(file), { strictness: "tolerant" });
  const found: FileEntry[] = [];
  try {
    let count = 0;
    for await (const entry of reader.getEntriesGenerator()) {
      count += 1;
      if (count > limits.archiveEntries) {
        const most = limits.archiveEntries;
        throw new BookError(`${name} has more than ${most} files; split it and open a part.`, {
          code: "tooLarge",
          source: name,
        });
      }
      if (!entry.directory) found.push(entry as FileEntry);
    }
  } catch (error) {
    throw damaged(name, error);
  }
  if (found.some(({ compressionMethod }) => compressionMethod === zstandard)) {
    const { ZstdStream } = await loadPart(import("./zstd_stream.ts"));
    registerCodec({
      compressionMethod: zstandard,
      format: "zstd",
      DecompressionStream: ZstdStream,
    });
  }
  const entries = new Map<string, FileEntry>();
  const paths = new OwnPaths();
  for (const [filename, entry] of named(found)) {
    const path = cleanPath(filename);
    const first = path === null ? undefined : entries.get(path);
    if (path !== null && !(first && isAlike(first, entry))) entries.set(paths.take(path), entry);
  }
  return new ZipArchive(name, entries, new TextDecoder().decode(reader.comment));
}

/** Returns whether a file is a symbolic link, as Unix packs them: by the kind of file in its mode. */
const isLink = ({ externalFileAttributes }: FileEntry): boolean =>
  externalFileAttributes >>> 28 === 0xa;

/** Returns whether two files are the same by their check sums and lengths. */
function isAlike(one: FileEntry, other: FileEntry): boolean {
  return one.signature === other.signature && one.uncompressedSize === other.uncompressedSize;
}

/** Returns files with their names. */
function named(files: readonly FileEntry[]): [name: string, file: FileEntry][] {
  const unsaid = files.filter(({ filenameUTF8 }) => !filenameUTF8);
  const names = legacyNames(
    unsaid.map(({ rawFilename }) => rawFilename),
    unsaid.map(({ filename }) => filename),
  );
  const known = new Map(unsaid.map((file, k) => [file, names[k] as string]));
  return files.map((file) => [known.get(file) ?? file.filename, file]);
}

class ZipArchive implements Archive {
  readonly names: readonly string[];
  readonly comment: string;
  readonly #name: string;
  #entries: ReadonlyMap<string, FileEntry>;

  constructor(name: string, entries: ReadonlyMap<string, FileEntry>, comment: string) {
    this.comment = comment;
    this.#name = name;
    this.#entries = entries;
    this.names = [...entries.keys()];
  }

  size(name: string): number {
    return this.#entries.get(name)?.uncompressedSize ?? 0;
  }

  async read(name: string, most: number = limits.archivedBytes): Promise<Uint8Array<ArrayBuffer>> {
    return await this.#unpack(name, most, Number.POSITIVE_INFINITY);
  }

  async readStart(name: string, length: number): Promise<Uint8Array<ArrayBuffer>> {
    return await this.#unpack(name, limits.archivedBytes, length);
  }

  /** @param enough number of bytes after which the rest is not unpacked */
  async #unpack(name: string, most: number, enough: number): Promise<Uint8Array<ArrayBuffer>> {
    const entry = this.#entries.get(name);
    if (!entry)
      throw new BookError(`${this.#name} has no file ${name}; get it again.`, {
        code: "damaged",
        source: this.#name,
      });
    if (entry.encrypted) {
      throw new BookError(`${this.#name} is protected by a password; unpack it first.`, {
        code: "locked",
        source: this.#name,
      });
    }
    if (isLink(entry)) {
      throw new BookError(
        `${name} in ${this.#name} is a link, which is not followed; pack it again with the whole file.`,
        { code: "unsupported", source: name },
      );
    }
    const packing = notUnpacked.get(entry.compressionMethod);
    if (packing !== undefined) {
      throw new BookError(
        `${name} in ${this.#name} is packed by ${packing}, which cannot be unpacked here; pack it again as usual, by Deflate.`,
        { code: "unsupported", source: name },
      );
    }
    const tooLarge = new BookError(
      `${name} in ${this.#name} is larger than ${Math.floor(most / (1 << 20))} MB when unpacked; make it smaller.`,
      { code: "tooLarge", source: name },
    );
    if (entry.uncompressedSize > most) throw tooLarge;
    const longer = new Error("It is longer than the archive says.");
    // What the directory claims may be wrong: bytes are counted as they come.
    const parts: Uint8Array<ArrayBuffer>[] = [];
    let length = 0;
    const counted = new WritableStream<Uint8Array<ArrayBuffer>>({
      write(part) {
        length += part.length;
        if (length > most) throw tooLarge;
        // What files claim can be added up before they are read.
        if (length > entry.uncompressedSize) throw longer;
        parts.push(part);
        if (length >= enough) stopped.abort();
      },
    });
    const stopped = new AbortController();
    try {
      await entry.getData(counted, { signal: stopped.signal });
    } catch (error) {
      if (!stopped.signal.aborted)
        throw length > most ? tooLarge : damaged(`${name} in ${this.#name}`, error);
    }
    return joinBytes(parts, length);
  }

  close(): void {
    this.#entries = new Map();
  }
}

/** What is wrong with a file, in plain words, by what zip.js says of it. */
const reasons: readonly (readonly [RegExp, string])[] = [
  [/^End of .*not found|data out of bounds/, "its end is missing, as if it was not fetched whole"],
  [
    /format is not recognized|header not found/,
    "it is no ZIP file, or its list of files is damaged",
  ],
  [/Invalid|CRC/, "some of its bytes are wrong"],
];

function damaged(what: string, error: unknown): BookError {
  const said = error instanceof Error ? error.message : "";
  if (/^Split zip/.test(said)) {
    return new BookError(
      `${what} is one part of an archive in several; unpack all its parts together, and pack them as one.`,
      { code: "damaged", source: what, cause: error },
    );
  }
  const reason = reasons.find(([found]) => found.test(said))?.[1];
  if (reason !== undefined && !(error instanceof BookError)) {
    const sentence = `${what} is damaged: ${reason}; repair it or get it again.`;
    return new BookError(sentence, { code: "damaged", source: what, cause: error });
  }
  return unknownFailure(`${what} is damaged`, error, "repair it or get it again", {
    code: "damaged",
    source: what,
  });
}
