/** What `turnleaf read` has to know of IIIF: which JSON is a book, and which books a collection has. */

import { Problem, printable } from "../problem.ts";

/** A book whose pages are on other sites. */
export interface OnlineBook {
  /** Printable, on one line. */
  readonly title: string;
  /** The absolute address of its manifest. */
  readonly url: string;
}

/** Maximum of books of a collection, of collections in it, and of those within each other. */
const mostBooks = 500;
const mostCollections = 50;
const deepest = 5;

type Value = Readonly<Record<string, unknown>>;

/** JSON that was found at an address. */
export interface FoundJson {
  readonly value: unknown;
  readonly url: string;
  /** Whether it is of the public internet: what it lists must be too. */
  readonly isPublic: boolean;
}

/** Where the members of a collection are. */
export interface CollectionWeb {
  /** Fetches a collection within another. Rejects with a `Problem`. */
  fetchJson(address: string, isNamedByPublic: boolean): Promise<FoundJson>;
  /** Returns whether an address is of this machine or of a network around it. */
  isInner(address: string): Promise<boolean>;
}

/**
 * Returns the books of JSON that was found at an address: one of a manifest,
 * those of a collection in its order. A collection that was listed before, as
 * one within itself, or is beyond the bounds is left out with a sentence, and so
 * is a book at an inner address that a public collection lists: the browser would
 * request it.
 *
 * @param warn receives that sentence
 * @throws Problem if it is neither
 */
export async function iiifBooks(
  { value, url, isPublic }: FoundJson,
  web: CollectionWeb,
  warn: (sentence: string) => void,
): Promise<readonly OnlineBook[]> {
  const name = printable(url);
  if (!isRecord(value) || !isIiif(value)) {
    throw new Problem(`${name} is JSON, and no manifest of IIIF; give another address.`);
  }
  if (!isCollection(value)) return [{ title: labelOf(value) || name, url }];
  const walk = new Walk(web, warn);
  await walk.collect(value, url, isPublic);
  if (walk.books.length > 0) return walk.books;
  throw new Problem(`${name} is a collection without books; give another address.`);
}

class Walk {
  readonly books: OnlineBook[] = [];
  readonly #web: CollectionWeb;
  readonly #warn: (sentence: string) => void;
  /** Addresses of the collections that were read or begun. */
  readonly #seen = new Set<string>();
  /** Whether a host is of this machine or of a network around it. */
  readonly #inner = new Map<string, boolean>();
  /** Collections in this one that were read. */
  #count = 0;

  constructor(web: CollectionWeb, warn: (sentence: string) => void) {
    this.#web = web;
    this.#warn = warn;
  }

  /** @param isPublic whether the document that holds it is of the public internet */
  async collect(collection: Value, url: string, isPublic: boolean, depth = 1): Promise<void> {
    // It may have been redirected to another address than its own.
    for (const address of [url, idOf(collection, url)]) if (address) this.#seen.add(address);
    for (const member of membersOf(collection)) {
      const address = idOf(member, url);
      if (this.books.length >= mostBooks) {
        this.#warn(`${printable(url)} has more than ${mostBooks} books; the rest is left out.`);
        return;
      }
      if (isCollection(member)) await this.#descend(member, address, isPublic, depth + 1);
      else if (address !== "") {
        const title = labelOf(member) || printable(address);
        if (isPublic && (await this.#isInner(address))) {
          this.#warn(
            `${title} is on this machine or its network, and a public collection lists it; it is left out.`,
          );
        } else this.books.push({ title, url: address });
      }
    }
  }

  /** Each host is looked up once. */
  async #isInner(address: string): Promise<boolean> {
    const { host } = new URL(address);
    const known = this.#inner.get(host) ?? (await this.#web.isInner(address));
    this.#inner.set(host, known);
    return known;
  }

  async #descend(member: Value, address: string, isPublic: boolean, depth: number): Promise<void> {
    const name = labelOf(member) || printable(address);
    if (this.#seen.has(address))
      return this.#warn(`${name} is listed again; it is left out there.`);
    if (depth > deepest || this.#count >= mostCollections) {
      return this.#warn(`${name} is a collection too many; it is left out.`);
    }
    this.#count++;
    try {
      const isWhole = membersOf(member).length > 0 || address === "";
      const found = isWhole
        ? { value: member, url: address, isPublic }
        : await this.#web.fetchJson(address, isPublic);
      if (isRecord(found.value)) await this.collect(found.value, address, found.isPublic, depth);
    } catch (error) {
      if (!(error instanceof Problem)) throw error;
      this.#warn(`${error.message} It is left out.`);
    }
  }
}

/** Returns what a collection lists, in the version 3 or 2 of the API. */
function membersOf({ items, members, collections, manifests }: Value): Value[] {
  const lists = items ?? members ?? [...listOf(collections), ...listOf(manifests)];
  return listOf(lists).filter(isRecord);
}

/** Returns whether JSON is of IIIF, as the viewer does: some write no context. */
function isIiif(value: Value): boolean {
  const marks = [value["@context"], value.protocol].flat();
  const iiif = /iiif\.io\/api\/|shared-canvas\.org\/ns\/context/;
  if (marks.some((one) => typeof one === "string" && iiif.test(one))) return true;
  return /^(sc:)?(Manifest|Collection)$/.test(String(value.type ?? value["@type"]));
}

function isCollection(value: Value): boolean {
  return /(^|:)Collection$/.test(String(value.type ?? value["@type"]));
}

/** Returns an absolute address of the web; "" if there is none. */
function idOf(value: Value, base: string): string {
  const id = value.id ?? value["@id"];
  if (typeof id !== "string" || !URL.canParse(id, base)) return "";
  const { protocol, href } = new URL(id, base);
  return protocol === "https:" || protocol === "http:" ? href : "";
}

/** Returns a label in English, or else in the first language that it has. */
function labelOf({ label }: Value): string {
  const named = isRecord(label) ? (label.en ?? label.none ?? Object.values(label)[0]) : label;
  const [first] = listOf(named ?? []);
  const text = isRecord(first) ? first["@value"] : first;
  return typeof text === "string" ? printable(text.replace(/<[^<>]*>/g, "")) : "";
}

function listOf(value: unknown): readonly unknown[] {
  return Array.isArray(value) ? value : value === undefined ? [] : [value];
}

function isRecord(value: unknown): value is Value {
  return typeof value === "object" && value !== null && !Array.isArray(value);
}
