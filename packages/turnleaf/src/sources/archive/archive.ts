/** Files in an archive, such as a ZIP: named, read one by one, and bounded. */

import type { BookError } from "../page_source.ts";

/** An open archive. */
export interface Archive {
  /** The names of its files, as paths from its root, in the archive's order. */
  readonly names: readonly string[];
  /** What is written about the whole of it, as a ZIP may have. */
  readonly comment?: string;
  /** What is wrong with the whole of it, although files in it can be read. */
  readonly damage?: BookError | undefined;
  /** Returns the length in bytes that a file claims; 0 if there is none of this name. */
  size(name: string): number;
  /**
   * Returns a file's bytes. Rejects with a `BookError` if there is none of this
   * name, it is damaged or encrypted, or has more than `most` bytes.
   */
  read(name: string, most?: number): Promise<Uint8Array<ArrayBuffer>>;
  /**
   * Returns the first bytes of a file, at least `length` if it has so many.
   * Rejects as `read` does.
   */
  readStart(name: string, length: number): Promise<Uint8Array<ArrayBuffer>>;
  /** Frees memory. Reading afterwards rejects. */
  close(): void;
}
