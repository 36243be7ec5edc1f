/** What a script gives as a book or a page: which kinds are taken, and as what. */

import { BookError } from "./page_source.ts";

/** A file's bytes as a script may have them. */
export type Bytes = Blob | ArrayBuffer | ArrayBufferView<ArrayBuffer>;

/** Bytes as a blob; null where a value is none. */
export function blobOf(value: unknown): Blob | null {
  if (value instanceof Blob) return value;
  if (value instanceof ArrayBuffer) return new Blob([value]);
  if (ArrayBuffer.isView(value)) return new Blob([value as ArrayBufferView<ArrayBuffer>]);
  return null;
}

/** The files of a list, as an input or a drop gives it, in the natural order of their names; null where a value is none. */
export function filesOf(value: unknown): File[] | null {
  if (typeof FileList === "undefined" || !(value instanceof FileList)) return null;
  const { compare } = new Intl.Collator(undefined, { numeric: true });
  return [...value].sort((a, b) => compare(a.name, b.name));
}

/** The sentence for a value that is no book. */
export function wrongKind(value: unknown): BookError {
  const kind = Object.prototype.toString.call(value).slice(8, -1);
  return new BookError(
    `A book is not made of ${/^(HTML|[AEIOU])/.test(kind) ? "an" : "a"} ${kind}; give an address, a File or FileList, an ArrayBuffer, a list of images or a manifest.`,
  );
}
