/** The books to publish, from the command line and a catalogue file, each with a name in the site. */

import { basename, dirname, extname, resolve } from "node:path";
import { Problem, printable, unprintable } from "../problem.ts";
import { readRegular } from "../regular_file.ts";

/** What the publisher says of a book; it goes before what the book's file says. */
export interface GivenDetails {
  readonly title?: string;
  readonly authors?: readonly string[];
  readonly publisher?: string;
  readonly date?: string;
  readonly description?: string;
  /** BCP 47 tag. */
  readonly language?: string;
  readonly direction?: "ltr" | "rtl";
  /** An SPDX or Creative Commons name, an address, or words. */
  readonly licence?: string;
}

/** A book of the list. */
export interface ListedBook {
  /** Its folder in the site and part of its address; unique in the list. */
  readonly id: string;
  /** Absolute. */
  readonly path: string;
  /** As the user named it. */
  readonly given: string;
  readonly details: GivenDetails;
}

/** Maximum of bytes of a catalogue, and of books in a site. */
const mostBytes = 64_000_000;
const mostBooks = 100_000;
/** Maximum of characters of a member. */
const longest = 4000;
/** Bytes of an id: with it no path becomes too long. */
const longestId = 100;

const texts = ["title", "publisher", "date", "description", "licence"] as const;
const members = new Set<string>([...texts, "file", "id", "authors", "language", "direction"]);

/**
 * Returns the books of a site in their order.
 *
 * @param catalogue a JSON file that lists more books, with details
 * @throws Problem naming what cannot be used
 */
export async function listBooks(
  paths: readonly string[],
  catalogue: string | undefined,
): Promise<readonly ListedBook[]> {
  const named = paths.map((given) => ({ given, path: resolve(given), id: "", details: {} }));
  const listed = [...named, ...(catalogue === undefined ? [] : await readCatalogue(catalogue))];
  if (listed.length > mostBooks) throw new Problem(`A site has ${mostBooks} books at most.`);
  const used = new Set<string>();
  for (const { id, given } of listed) {
    if (id === "") continue;
    if (used.has(id)) throw new Problem(`${printable(given)}: the id ${id} is given twice.`);
    used.add(id);
  }
  return listed.map((book) => {
    if (book.id !== "") return book;
    const id = unusedId(idOf(book.path), used);
    used.add(id);
    return { ...book, id };
  });
}

async function readCatalogue(file: string): Promise<ListedBook[]> {
  const name = printable(file);
  let value: unknown;
  try {
    value = JSON.parse((await readRegular(file, mostBytes)).toString());
  } catch (error) {
    if (error instanceof Problem) throw error;
    throw new Problem(`${name} is no valid JSON; correct it.`);
  }
  const books = isRecord(value) ? value.books : value;
  if (!Array.isArray(books)) throw new Problem(`${name} has no list of "books"; add one.`);
  if (books.length > mostBooks) throw new Problem(`${name} lists more than ${mostBooks} books.`);
  return books.map((book, k) => parseBook(book, dirname(file), `${name}: book ${k + 1}`));
}

function parseBook(value: unknown, folder: string, place: string): ListedBook {
  const fields: Record<string, unknown> =
    typeof value === "string" ? { file: value } : isRecord(value) ? value : {};
  const fault = (what: string): Problem => new Problem(`${place} ${what}.`);
  const unknown = Object.keys(fields).find((key) => !members.has(key));
  if (unknown !== undefined) throw fault(`has an unknown member "${printable(unknown)}"`);
  const text = (key: string): string | undefined => {
    const given = fields[key];
    if (given === undefined || given === null) return undefined;
    if (typeof given === "string" && given.length <= longest) return oneLine(given);
    throw fault(`has a ${key} that is no text of at most ${longest} characters`);
  };
  const file = fields.file;
  if (typeof file !== "string" || file === "") throw fault('has no "file"');
  const id = text("id") ?? "";
  if (id !== "" && (id !== slug(id) || !isSafe(id))) {
    throw fault(`has an id that is not of lower-case letters, digits and hyphens`);
  }
  const language = text("language");
  const direction = text("direction");
  if (direction !== undefined && direction !== "ltr" && direction !== "rtl") {
    throw fault('has a direction that is neither "ltr" nor "rtl"');
  }
  const authors = listOf(fields.authors);
  if (authors === null) throw fault("has authors that are no list of names");
  return {
    ...{ id, path: resolve(folder, file), given: file },
    details: {
      ...Object.fromEntries(texts.flatMap((key) => (text(key) ? [[key, text(key)]] : []))),
      ...(authors.length > 0 ? { authors } : {}),
      ...(language ? { language: languageTag(language, fault) } : {}),
      ...(direction ? { direction } : {}),
    },
  };
}

function listOf(value: unknown): string[] | null {
  if (value === undefined || value === null) return [];
  const list = typeof value === "string" ? [value] : value;
  const isList =
    Array.isArray(list) &&
    list.length <= 200 &&
    list.every((name) => typeof name === "string" && name.length <= longest);
  return isList ? list.map(oneLine).filter((name) => name !== "") : null;
}

function languageTag(text: string, fault: (what: string) => Problem): string {
  try {
    return Intl.getCanonicalLocales(text)[0] ?? "";
  } catch {
    throw fault(`has a language that is no tag such as "en"`);
  }
}

function oneLine(text: string): string {
  return text.replace(unprintable, " ").replace(/\s+/g, " ").trim();
}

function isRecord(value: unknown): value is Record<string, unknown> {
  return typeof value === "object" && value !== null && !Array.isArray(value);
}

/** Returns the id of a file by its name. It is one part of a path, whatever the name. */
function idOf(path: string): string {
  const name = basename(path);
  const id = slug(name.slice(0, name.length - extname(name).length) || name);
  return isSafe(id) ? id : `book-${id}`.replace(/-$/, "");
}

/** Returns letters and digits in lower case, with hyphens for everything between them. */
function slug(name: string): string {
  let id = "";
  for (const character of name.normalize("NFKD").toLowerCase().normalize("NFC")) {
    const next = /[\p{L}\p{N}]/u.test(character) ? id + character : id.replace(/-?$/, "-");
    if (Buffer.byteLength(next) > longestId) break;
    id = next;
  }
  return id.replace(/^-|-$/g, "");
}

/** Whether every system takes an id as the name of a folder. */
function isSafe(id: string): boolean {
  return id !== "" && !/^(con|prn|aux|nul|com\d|lpt\d)$/.test(id);
}

function unusedId(id: string, used: ReadonlySet<string>): string {
  if (!used.has(id)) return id;
  for (let number = 2; ; number++) {
    if (!used.has(`${id}-${number}`)) return `${id}-${number}`;
  }
}
