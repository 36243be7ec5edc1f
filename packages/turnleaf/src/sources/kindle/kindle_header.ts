/** The first record of a Kindle book: how its text is packed, where its parts are, and what it says of itself. */

import { limits } from "../limits.ts";
import { languages } from "./languages.ts";

/** A number that stands for no record. */
const none = 0xffffffff;

/** What the first record says. Records are counted from the first one of its part of the file. */
export interface KindleHeader {
  /** 1: none, 2: PalmDoc, 17480: Huffman codes with a dictionary. */
  readonly compression: number;
  /** The number of records with text, from record 1 on. */
  readonly textRecords: number;
  readonly isEncrypted: boolean;
  /** 8 and more for KF8, as in AZW3. */
  readonly version: number;
  /** What follows the text in each of its records, as bits. */
  readonly trailing: number;
  /** The first record with a picture or a font, counted from the file's first one. */
  readonly firstResource: number;
  /** The first record of the codes, and their number. */
  readonly huffman: { readonly first: number; readonly count: number };
  /** Records of tables; null where there is none. */
  readonly contents: number | null;
  readonly flows: number | null;
  readonly fragments: number | null;
  readonly skeletons: number | null;
  /** As browsers call it. */
  readonly encoding: string;
  readonly title: string;
  /** BCP 47, may be empty. */
  readonly language: string;
  readonly authors: readonly string[];
  readonly direction: string;
  readonly isFixed: boolean;
  /** The size of pages of fixed layout, such as "800x1200"; may be empty. */
  readonly resolution: string;
  /** The cover among the resources; null if it has none. */
  readonly cover: number | null;
  /** Where a second book begins in the same file, in KF8; null if there is none. */
  readonly boundary: number | null;
}

/** Returns what the first record of a book says; null if it is none. */
export function readHeader(bytes: Uint8Array<ArrayBuffer>): KindleHeader | null {
  const view = new DataView(bytes.buffer);
  const long = (at: number): number => (at + 4 <= bytes.length ? view.getUint32(at) : none);
  const record = (at: number): number | null => (long(at) === none ? null : long(at));
  if (bytes.length < 132 || long(16) !== mark("MOBI")) return null;
  const length = long(20);
  const version = long(36);
  const isNew = version >= 8;
  const encoding = encodingOf(long(28));
  const decoder = new TextDecoder(encoding);
  const said =
    long(128) & 0x40 ? readMetadata(bytes, 16 + length) : new Map<number, Uint8Array[]>();
  const all = (type: number): string[] => (said.get(type) ?? []).map((one) => decoder.decode(one));
  const text = (type: number): string => all(type)[0] ?? "";
  const number = (type: number): number | null => {
    const value = said.get(type)?.[0];
    if (value?.length !== 4) return null;
    const read = new DataView(value.buffer, value.byteOffset).getUint32(0);
    return read === none ? null : read;
  };
  const [titleAt, titleLength] = [long(84), long(88)];
  return {
    compression: view.getUint16(0),
    textRecords: view.getUint16(8),
    isEncrypted: view.getUint16(12) !== 0,
    version,
    trailing: length >= 0xe4 && version >= 5 && bytes.length >= 244 ? view.getUint16(242) : 0,
    firstResource: long(108),
    huffman: { first: long(112), count: long(116) },
    contents: length >= 0xe8 ? record(244) : null,
    flows: isNew ? record(192) : null,
    fragments: isNew ? record(248) : null,
    skeletons: isNew ? record(252) : null,
    encoding,
    title: text(503) || decoder.decode(bytes.subarray(titleAt, titleAt + titleLength)),
    language: text(524) || (languages[long(92) & 0xff] ?? ""),
    authors: all(100).slice(0, limits.authors),
    direction: text(527),
    isFixed: text(122) === "true",
    resolution: text(126),
    cover: number(201),
    boundary: isNew ? null : number(121),
  };
}

/** Returns the encoding of a code page of Windows; UTF-8 if it is of none that books were written in. */
function encodingOf(codePage: number): string {
  return codePage >= 1250 && codePage <= 1258 ? `windows-${codePage}` : "utf-8";
}

/** Returns the values of the metadata ("EXTH") by their types; of a damaged list what comes before. */
function readMetadata(bytes: Uint8Array<ArrayBuffer>, from: number): Map<number, Uint8Array[]> {
  const found = new Map<number, Uint8Array[]>();
  const view = new DataView(bytes.buffer);
  if (from + 12 > bytes.length || view.getUint32(from) !== mark("EXTH")) return found;
  const count = view.getUint32(from + 8);
  let at = from + 12;
  for (let k = 0; k < count && at + 8 <= bytes.length; k++) {
    const [type, length] = [view.getUint32(at), view.getUint32(at + 4)];
    // Less than its own head would never end.
    if (length < 8) break;
    const values = found.get(type) ?? [];
    values.push(bytes.subarray(at + 8, at + length));
    found.set(type, values);
    at += length;
  }
  return found;
}

/** Returns four letters as a number. */
export function mark(letters: string): number {
  return [...letters].reduce((number, letter) => number * 256 + letter.charCodeAt(0), 0);
}
