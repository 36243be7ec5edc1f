/** The text of a Kindle book: its records unpacked, one after the other, within bounds. */

import { limits } from "../limits.ts";
import { type KindleHeader, mark } from "./kindle_header.ts";
import { damaged } from "./palm_database.ts";

/** Bytes of a record with text or codes, packed: these have some thousands. */
export const recordLength = 4_000_000;

/** Entries of the dictionary, and how deep they may be made of each other. */
const mostEntries = 1_000_000;
const deepest = 32;

/** Entries that make up a text. */
const mostSteps = 40_000_000;

/** Returns a record by its number. */
export type ReadRecord = (index: number) => Promise<Uint8Array<ArrayBuffer>>;

/** Bytes that grow up to a bound. */
class Output {
  #bytes = new Uint8Array(1 << 16);
  #length = 0;
  readonly #tooLong: () => Error;

  /** @param tooLong makes the error that is thrown beyond the bound */
  constructor(tooLong: () => Error) {
    this.#tooLong = tooLong;
  }

  get length(): number {
    return this.#length;
  }

  push(byte: number): void {
    this.#reserve(1);
    this.#bytes[this.#length++] = byte;
  }

  append(bytes: Uint8Array): void {
    this.#reserve(bytes.length);
    this.#bytes.set(bytes, this.#length);
    this.#length += bytes.length;
  }

  /** Repeats bytes that lie `distance` back. Returns whether there are such. */
  repeat(distance: number, count: number): boolean {
    if (distance < 1 || distance > this.#length) return false;
    for (let k = 0; k < count; k++) this.push(this.#bytes[this.#length - distance] ?? 0);
    return true;
  }

  done(): Uint8Array<ArrayBuffer> {
    return this.#bytes.slice(0, this.#length);
  }

  #reserve(count: number): void {
    const needed = this.#length + count;
    if (needed > limits.markupBytes) throw this.#tooLong();
    if (needed <= this.#bytes.length) return;
    const larger = new Uint8Array(Math.max(needed, 2 * this.#bytes.length));
    larger.set(this.#bytes.subarray(0, this.#length));
    this.#bytes = larger;
  }
}

/**
 * Returns all text of a book. Rejects with a `BookError` if it is damaged, or
 * longer than `limits.markupBytes`.
 *
 * @param tooLong makes the error for the latter
 */
export async function readText(
  header: KindleHeader,
  read: ReadRecord,
  name: string,
  tooLong: () => Error,
): Promise<Uint8Array<ArrayBuffer>> {
  const output = new Output(tooLong);
  const unpack = await unpackerOf(header, read, output, name);
  for (let index = 1; index <= header.textRecords; index++) {
    unpack(withoutTrailing(await read(index), header.trailing));
  }
  return output.done();
}

/** Returns a record without what follows its text: sizes are written at its end, backwards. */
function withoutTrailing(bytes: Uint8Array, trailing: number): Uint8Array {
  let length = bytes.length;
  for (let bits = trailing >> 1; bits > 0; bits >>= 1) {
    if (bits & 1) length -= sizeAtEnd(bytes.subarray(0, Math.max(length, 0)));
  }
  if (trailing & 1) length -= ((bytes[length - 1] ?? 0) & 3) + 1;
  return bytes.subarray(0, Math.max(length, 0));
}

/** Returns the number that ends there: seven bits a byte, of which the first is marked. */
function sizeAtEnd(bytes: Uint8Array): number {
  let size = 0;
  for (const byte of bytes.subarray(-4)) size = ((byte & 0x80 ? 0 : size) << 7) | (byte & 0x7f);
  return size;
}

/** Returns what unpacks one record into the output. */
async function unpackerOf(
  { compression, huffman }: KindleHeader,
  read: ReadRecord,
  output: Output,
  name: string,
): Promise<(bytes: Uint8Array) => void> {
  if (compression === 1) return (bytes) => output.append(bytes);
  if (compression === 2) {
    return (bytes) => {
      if (!unpackPalmDoc(bytes, output)) throw damaged(name);
    };
  }
  if (compression !== 17480) throw damaged(name);
  const codes = await HuffmanCodes.read(huffman, read, name);
  return (bytes) => codes.unpack(bytes, output, 0);
}

/** Unpacks a record of PalmDoc's LZ77. Returns whether it is valid. */
function unpackPalmDoc(bytes: Uint8Array, output: Output): boolean {
  for (let at = 0; at < bytes.length; at++) {
    const byte = bytes[at] ?? 0;
    if (byte >= 1 && byte <= 8) {
      output.append(bytes.subarray(at + 1, at + 1 + byte));
      at += byte;
    } else if (byte < 0x80) output.push(byte);
    else if (byte >= 0xc0) {
      output.push(0x20);
      output.push(byte ^ 0x80);
    } else {
      at += 1;
      const pair = ((byte << 8) | (bytes[at] ?? 0)) & 0x3fff;
      if (!output.repeat(pair >> 3, (pair & 7) + 3)) return false;
    }
  }
  return true;
}

/** An entry of the dictionary: bytes, or a record that is packed itself. */
interface Entry {
  readonly bytes: Uint8Array;
  readonly isPlain: boolean;
}

/** What the first eight bits of a code say. */
interface QuickCode {
  readonly length: number;
  /** Whether the code ends there. */
  readonly isEnd: boolean;
  readonly largest: number;
}

/** The codes of one length. */
interface CodeRange {
  readonly smallest: number;
  readonly largest: number;
}

/** Huffman codes ("HUFF") for the entries of a dictionary ("CDIC"). */
class HuffmanCodes {
  /** By the first eight bits. */
  readonly #quick: readonly QuickCode[];
  /** By length. */
  readonly #ranges: readonly CodeRange[];
  readonly #entries: readonly Entry[];
  readonly #name: string;
  #steps = 0;

  static async read(
    { first, count }: KindleHeader["huffman"],
    read: ReadRecord,
    name: string,
  ): Promise<HuffmanCodes> {
    const head = await read(first);
    const view = new DataView(head.buffer);
    if (head.length < 24 || view.getUint32(0) !== mark("HUFF")) throw damaged(name);
    const [quickAt, rangesAt] = [view.getUint32(8), view.getUint32(12)];
    if (quickAt + 1024 > head.length || rangesAt + 256 > head.length) throw damaged(name);
    const quick = Array.from({ length: 256 }, (_, k) => {
      const value = view.getUint32(quickAt + 4 * k);
      return { length: value & 31, isEnd: (value & 128) !== 0, largest: value >>> 8 };
    });
    const ranges = Array.from({ length: 33 }, (_, length) => {
      if (length === 0) return { smallest: 0, largest: 0 };
      const at = rangesAt + 8 * (length - 1);
      return { smallest: view.getUint32(at), largest: view.getUint32(at + 4) };
    });
    const entries: Entry[] = [];
    for (let k = 1; k < count; k++) addEntries(await read(first + k), entries, name);
    return new HuffmanCodes(quick, ranges, entries, name);
  }

  private constructor(
    quick: readonly QuickCode[],
    ranges: readonly CodeRange[],
    entries: readonly Entry[],
    name: string,
  ) {
    this.#quick = quick;
    this.#ranges = ranges;
    this.#entries = entries;
    this.#name = name;
  }

  /** Unpacks a record into the output. Throws a `BookError`. */
  unpack(bytes: Uint8Array, output: Output, depth: number): void {
    if (depth > deepest) throw damaged(this.#name);
    const bits = 8 * bytes.length;
    for (let at = 0; at < bits; ) {
      const next = bitsAt(bytes, at);
      const found = this.#quick[next >>> 24];
      if (!found || found.length === 0) throw damaged(this.#name);
      let { length, largest } = found;
      if (!found.isEnd) {
        while (length < 32 && next >>> (32 - length) < (this.#ranges[length]?.smallest ?? 0))
          length++;
        largest = this.#ranges[length]?.largest ?? 0;
      }
      at += length;
      if (at > bits) return;
      const entry = this.#entries[largest - (next >>> (32 - length))];
      if (!entry) throw damaged(this.#name);
      // Entries of no bytes, made of each other, would cost time that the bound of the text does not see.
      if (++this.#steps > mostSteps) throw damaged(this.#name);
      if (entry.isPlain) output.append(entry.bytes);
      else this.unpack(entry.bytes, output, depth + 1);
    }
  }
}

/** Adds the entries of one record of a dictionary. */
function addEntries(bytes: Uint8Array<ArrayBuffer>, entries: Entry[], name: string): void {
  const view = new DataView(bytes.buffer);
  if (bytes.length < 16 || view.getUint32(0) !== mark("CDIC")) throw damaged(name);
  const [from, total, width] = [view.getUint32(4), view.getUint32(8), view.getUint32(12)];
  const count = Math.min(width < 31 ? 2 ** width : 0, total - entries.length, mostEntries);
  for (let k = 0; k < count; k++) {
    const at = from + 2 * k;
    const start = at + 2 <= bytes.length ? from + view.getUint16(at) : bytes.length;
    if (start + 2 > bytes.length || entries.length >= mostEntries) throw damaged(name);
    const head = view.getUint16(start);
    const body = bytes.subarray(start + 2, start + 2 + (head & 0x7fff));
    entries.push({ bytes: body, isPlain: (head & 0x8000) !== 0 });
  }
}

/** Returns 32 bits from bit `at` on, with zeros behind the last one. */
function bitsAt(bytes: Uint8Array, at: number): number {
  const [byte, shift] = [at >> 3, at & 7];
  const [a = 0, b = 0, c = 0, d = 0, e = 0] = bytes.subarray(byte, byte + 5);
  const whole = ((a << 24) | (b << 16) | (c << 8) | d) >>> 0;
  return shift === 0 ? whole : ((whole << shift) | (e >> (8 - shift))) >>> 0;
}
