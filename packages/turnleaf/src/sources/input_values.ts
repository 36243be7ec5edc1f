/** Values that a script gives as a book or a page: which kinds are accepted, and as what. */

import { BookError } from "./page_source.ts";

/** A file's bytes in any of their JavaScript forms. */
export type Bytes = Blob | ArrayBuffer | ArrayBufferView<ArrayBuffer>;

/** Returns bytes as a blob; null if a value is none. */
export function blobOf(value: unknown): Blob | null {
  if (value instanceof Blob) return value;
  if (value instanceof ArrayBuffer) return new Blob([value]);
  if (ArrayBuffer.isView(value)) return new Blob([value as ArrayBufferView<ArrayBuffer>]);
  return null;
}

/**
 * Returns the files of a list, from an input or a drop, in the natural order of
 * their names; null if a value is none.
 */
export function filesOf(value: unknown): File[] | null {
  if (typeof FileList === "undefined" || !(value instanceof FileList)) return null;
  const { compare } = new Intl.Collator(undefined, { numeric: true });
  return [...value].sort((a, b) => compare(a.name, b.name));
}

/** Returns the elements of a list of them, of any document; null if a value is none. */
export function elementsOf(value: unknown): HTMLElement[] | null {
  if (typeof value !== "object" || value === null || !("length" in value)) return null;
  const list = Array.from(value as ArrayLike<unknown>);
  const isElement = (one: unknown): one is HTMLElement =>
    typeof one === "object" && one !== null && "nodeType" in one && one.nodeType === 1;
  return list.length > 0 && list.every(isElement) ? list : null;
}

/** Returns the error for a value that is not a book. */
export function wrongKind(value: unknown): BookError {
  const kind = Object.prototype.toString.call(value).slice(8, -1);
  return new BookError(
    `A book is not made of ${/^(HTML|[AEIOU])/.test(kind) ? "an" : "a"} ${kind}; give an address, a File or FileList, an ArrayBuffer, a list of images or of elements, or a manifest.`,
    { code: "misused" },
  );
}
