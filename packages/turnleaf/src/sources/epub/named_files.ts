/**
 * Addresses in an EPUB's package and contents, each in place of the file that it leads to. foliate-js
 * resolves them by the rules of URLs alone, after which it is no longer known what the book meant.
 */

import type { FilePaths } from "../archive/file_paths.ts";

/** The attributes that name files, by the elements of packages, navigation documents and NCX. */
const addresses: Readonly<Record<string, string>> = {
  item: "href",
  reference: "href",
  a: "href",
  content: "src",
};

/** The files of a book by marks that are the same in any address. */
export class NamedFiles {
  readonly #paths: FilePaths;
  readonly #names: string[] = [];
  readonly #marks = new Map<string, string>();

  constructor(paths: FilePaths) {
    this.#paths = paths;
  }

  /** Returns the mark of a file: a path from the root. */
  markOf(name: string): string {
    let mark = this.#marks.get(name);
    if (mark === undefined) {
      mark = `file-${this.#names.length}`;
      this.#names.push(name);
      this.#marks.set(name, mark);
    }
    return mark;
  }

  /** Returns the file of a mark; the mark itself if it is none. */
  nameOf(mark: string): string {
    return this.#names[Number(/^file-(\d{1,9})$/.exec(mark)?.[1])] ?? mark;
  }

  /** Puts marks in place of the addresses in a document; what is no file of the book keeps its own. */
  mark(document: Document, from: string): Document {
    for (const element of document.getElementsByTagName("*")) {
      const attribute = addresses[element.localName];
      const address = attribute && element.getAttribute(attribute);
      if (!attribute || !address) continue;
      const name = this.#paths.resolve(address, from);
      if (name === null) continue;
      const [, fragment] = address.split("#", 2);
      // An item of the manifest is a file, whatever place in it is named.
      const isWhole = fragment === undefined || element.localName === "item";
      const behind = isWhole ? "" : `#${fragment}`;
      element.setAttribute(attribute, `/${this.markOf(name)}${behind}`);
    }
    return document;
  }
}
