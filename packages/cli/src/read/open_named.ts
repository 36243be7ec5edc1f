/** The books that are named on the command line, opened: files, folders and addresses. */

import { mkdir, open } from "node:fs/promises";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { sniff, sniffLength } from "../../../turnleaf/src/sources/formats.ts";
import { type BookName, booksAt, openBook, openImages, type ServedBook } from "../book.ts";
import { fileProblem, Problem, printable } from "../problem.ts";
import { Progress } from "../progress.ts";
import { makeTemporary, removeTemporary } from "../temporary.ts";
import { Warnings } from "../warnings.ts";
import { type Fetched, fetchAddress, isAddress } from "./fetch_address.ts";
import { type CollectionWeb, type FoundJson, iiifBooks } from "./iiif_books.ts";
import { isInnerPlace } from "./network.ts";

/** A book to be read. */
export interface NamedBook extends ServedBook {
  /** Whether `src` is its manifest's address, and its pages are on other sites. */
  readonly isOnline: boolean;
}

/** Maximum of bytes of a book at an address, and of a manifest: the viewer's bounds. */
const mostBytes = 2_000_000_000;
const mostJsonBytes = 32 << 20;

/** Books on a shelf at most, and those that are opened at the same time. */
const mostBooks = 1000;
const atOnce = 4;

/** Opens what is named; holds the files that were fetched until it is closed. */
export class NamedBooks {
  readonly #signal: AbortSignal;
  readonly #progress = new Progress();
  readonly #warnings = new Warnings();
  #folder: Promise<string> | null = null;
  #count = 0;

  /** @param signal ends what is being fetched */
  constructor(signal: AbortSignal) {
    this.#signal = signal;
  }

  /**
   * Opens every book that is named. Of several, one that fails is left out with
   * a sentence.
   *
   * @throws Problem if there is none
   */
  async open(names: readonly string[]): Promise<readonly NamedBook[]> {
    const all = await this.#expand(names);
    if (all.length > mostBooks) {
      throw new Problem(`A shelf has ${mostBooks} books at most, and not ${all.length}.`);
    }
    const found: (readonly NamedBook[] | Problem)[] = [];
    let next = 0;
    const work = async (): Promise<void> => {
      while (next < all.length) {
        const index = next++;
        const name = all[index] as BookName | Problem;
        found[index] = name instanceof Problem ? name : await this.#open(name).catch(asProblem);
      }
    };
    await Promise.all(Array.from({ length: atOnce }, work));
    const failed = found.filter((result) => result instanceof Problem);
    if (all.length === 1 && failed[0]) throw failed[0];
    for (const problem of failed) this.#warn(`${problem.message} It is left out.`);
    this.#warnings.end();
    const books = found.flatMap((result) => (result instanceof Problem ? [] : result));
    if (books.length > 0) return books;
    throw new Problem("None of these books can be read.");
  }

  /** Removes the files that were fetched. */
  async close(): Promise<void> {
    if (this.#folder) await removeTemporary(await this.#folder);
  }

  /** Returns the names with those of a folder's books in its place, and what is wrong with others. */
  async #expand(names: readonly string[]): Promise<readonly (BookName | Problem)[]> {
    const all: (BookName | Problem)[] = [];
    for (const name of names) {
      if (isAddress(name)) all.push({ path: name });
      else {
        const warn = (sentence: string): void => this.#warn(sentence);
        const books = await booksAt(name, warn).catch(asProblem);
        if (books instanceof Problem) all.push(books);
        else all.push(...books);
      }
    }
    return all;
  }

  async #open({ path, isImages }: BookName): Promise<readonly NamedBook[]> {
    if (isAddress(path)) return await this.#fetch(path);
    const open = isImages ? openImages : openBook;
    const book = await open(path, (sentence) => this.#warn(sentence));
    return [{ ...book, isOnline: false }];
  }

  /** Opens what is at an address: a file, or the books of a manifest or collection. */
  async #fetch(address: string): Promise<readonly NamedBook[]> {
    return await fetchAddress(address, this.#signal, async (fetched) => {
      const pieces = fetched.body(mostBytes)[Symbol.asyncIterator]();
      const start = await readStart(pieces);
      if (sniff({ start, type: "" }) === "json") {
        return await this.#openJson(fetched, await readJson(start, pieces, address));
      }
      const file = await this.#save(fetched, start, pieces);
      const book = await openBook(file, (sentence) => this.#warn(sentence), address);
      return [{ ...book, isOnline: false }];
    });
  }

  async #openJson({ url, isPublic }: Fetched, value: unknown): Promise<readonly NamedBook[]> {
    const readAll = async (fetched: Fetched): Promise<FoundJson> => {
      const pieces = fetched.body(mostJsonBytes)[Symbol.asyncIterator]();
      const value = await readJson(await readStart(pieces), pieces, fetched.url);
      return { value, url: fetched.url, isPublic: fetched.isPublic };
    };
    const web: CollectionWeb = {
      fetchJson: (address, isNamedByPublic) =>
        fetchAddress(address, this.#signal, readAll, isNamedByPublic),
      isInner: isInnerPlace,
    };
    const books = await iiifBooks({ value, url, isPublic }, web, (sentence) =>
      this.#warn(sentence),
    );
    return books.map(({ title, url }) => ({ title, src: url, files: new Map(), isOnline: true }));
  }

  /** Writes what is fetched to a file that has the name of its address. */
  async #save({ url, length }: Fetched, start: Buffer, rest: Pieces): Promise<string> {
    const name = fileNameOf(url);
    try {
      this.#folder ??= makeTemporary("read");
      const folder = join(await this.#folder, String(++this.#count));
      await mkdir(folder);
      const file = await open(join(folder, name), "wx", 0o600);
      let count = 0;
      try {
        for (let piece: Uint8Array | null = start; piece; piece = await nextOf(rest)) {
          await file.writeFile(piece);
          count += piece.length;
          const text = `${Math.floor(count / 1e6)} MB of ${name}`;
          if (length !== null) this.#progress.show(count / length, text);
        }
      } finally {
        this.#progress.clear();
        await file.close();
      }
      return join(folder, name);
    } catch (error) {
      throw error instanceof Problem ? error : fileProblem(tmpdir(), error);
    }
  }

  #warn(sentence: string): void {
    this.#progress.clear();
    this.#warnings.add(sentence);
  }
}

type Pieces = AsyncIterator<Uint8Array>;

async function nextOf(pieces: Pieces): Promise<Uint8Array | null> {
  const { done, value } = await pieces.next();
  return done ? null : value;
}

/** Returns the first pieces, as many as show the format. */
async function readStart(pieces: Pieces): Promise<Buffer> {
  const start: Uint8Array[] = [];
  let count = 0;
  while (count < sniffLength) {
    const piece = await nextOf(pieces);
    if (piece === null) break;
    start.push(piece);
    count += piece.length;
  }
  return Buffer.concat(start);
}

/** @throws Problem if it is too large or no JSON */
async function readJson(start: Buffer, rest: Pieces, address: string): Promise<unknown> {
  const name = printable(address);
  const all: Uint8Array[] = [];
  let count = 0;
  for (let piece: Uint8Array | null = start; piece; piece = await nextOf(rest)) {
    all.push(piece);
    count += piece.length;
    if (count > mostJsonBytes) throw new Problem(`${name} is larger than 32 MB; open another.`);
  }
  try {
    return JSON.parse(Buffer.concat(all).toString());
  } catch {
    throw new Problem(`${name} is no valid JSON; give another address.`);
  }
}

/** Returns a file's name for an address: its last part, safe on every system. */
function fileNameOf(url: string): string {
  const last = new URL(url).pathname.split("/").filter(Boolean).pop() ?? "";
  let name = last;
  try {
    name = decodeURIComponent(last);
  } catch {
    // It stays as it is.
  }
  const safe = printable(name).replace(/[^\p{L}\p{N}._ -]/gu, "_");
  const ending = /\.[\p{L}\p{N}]{1,8}$/u.exec(safe)?.[0] ?? "";
  const stem = [...safe.slice(0, safe.length - ending.length)].slice(0, 60).join("");
  return /^\.*$/.test(stem) ? `book${ending}` : `${stem}${ending}`;
}

/** Returns a `Problem`; throws every other error. */
function asProblem(error: unknown): Problem {
  if (error instanceof Problem) return error;
  throw error;
}
