/** A Palm database, in which Kindle books are: numbered records, read from the file one by one. */

import { bytesOf } from "../book_file.ts";
import { BookError } from "../page_source.ts";

/** The first bytes: name, dates, type, and the number of records. */
const headLength = 78;

/** Returns the sentence for a book that cannot be read. */
export function damaged(name: string): BookError {
  return new BookError(`${name} is damaged or no Kindle book; repair it or get it again.`, {
    code: "damaged",
    source: name,
  });
}

/** The records of a file. */
export class PalmDatabase {
  /** The number of records. */
  readonly count: number;
  readonly #file: Blob;
  readonly #name: string;
  /** Where each record begins, and the last one ends. */
  readonly #offsets: readonly number[];

  /** Opens a file. Rejects with a `BookError` if it has no records. */
  static async open(file: Blob, name: string): Promise<PalmDatabase> {
    const head = new DataView(await bytesOf(file.slice(0, headLength), name).then(bufferOf));
    if (head.byteLength < headLength) throw damaged(name);
    const count = head.getUint16(76);
    const list = await bytesOf(file.slice(headLength, headLength + 8 * count), name).then(bufferOf);
    if (count === 0 || list.byteLength < 8 * count) throw damaged(name);
    const view = new DataView(list);
    const offsets = Array.from({ length: count }, (_, k) => view.getUint32(8 * k));
    return new PalmDatabase(file, name, [...offsets, file.size]);
  }

  private constructor(file: Blob, name: string, offsets: readonly number[]) {
    this.#file = file;
    this.#name = name;
    this.#offsets = offsets;
    this.count = offsets.length - 1;
  }

  /**
   * Returns a record. Rejects with a `BookError` if there is none, the file ends within it, or it has more than
   * `most` bytes.
   */
  async record(index: number, most: number): Promise<Uint8Array<ArrayBuffer>> {
    const [from = -1, to = -1] = this.#offsets.slice(index < 0 ? Infinity : index, index + 2);
    const isWhole = to <= this.#file.size;
    if (from < 0 || to < from || to - from > most || !isWhole) throw damaged(this.#name);
    return await bytesOf(this.#file.slice(from, to), this.#name);
  }
}

const bufferOf = (bytes: Uint8Array<ArrayBuffer>): ArrayBuffer => bytes.buffer;
