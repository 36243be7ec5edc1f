/** Tables of a Kindle book ("INDX"): entries with numbers by tags, and texts that these name. */

import { mark } from "./kindle_header.ts";
import { damaged } from "./palm_database.ts";
import type { ReadRecord } from "./text_records.ts";

/** Entries of a table, numbers of one entry, and records of one table. */
const mostEntries = 100_000;
const mostNumbers = 1000;
const mostRecords = 1000;

/** An entry of a table. */
export interface IndexEntry {
  readonly name: string;
  /** Returns the numbers of a tag; none if it has none. */
  readonly numbers: (tag: number) => readonly number[];
}

/** A table. */
export interface IndexTable {
  readonly entries: readonly IndexEntry[];
  /** Returns the text that a number names; "" if there is none. */
  readonly text: (at: number | undefined) => string;
}

/** How the numbers of a tag are written. */
interface Tag {
  readonly tag: number;
  readonly perValue: number;
  readonly mask: number;
  readonly isEnd: boolean;
}

/** Returns the table at a record. Rejects with a `BookError`. */
export async function readIndex(
  first: number,
  read: ReadRecord,
  encoding: string,
  name: string,
): Promise<IndexTable> {
  const head = await read(first);
  const view = viewOf(head, name);
  const [tagsAt, records, texts] = [view.getUint32(4), view.getUint32(24), view.getUint32(52)];
  if (records > mostRecords || texts > mostRecords) throw damaged(name);
  const { tags, controlBytes } = readTags(head, tagsAt, name);
  const entries: IndexEntry[] = [];
  for (let k = 1; k <= records; k++) {
    addEntries(await read(first + k), tags, controlBytes, entries, name);
  }
  const strings: Uint8Array[] = [];
  for (let k = 1; k <= texts; k++) strings.push(await read(first + records + k));
  const decoder = new TextDecoder(encoding);
  return {
    entries,
    text: (at) => {
      if (at === undefined) return "";
      const bytes = strings[at >>> 16] ?? new Uint8Array();
      const [length, from] = numberAt(bytes, at & 0xffff);
      return decoder.decode(bytes.subarray(from, from + length));
    },
  };
}

function viewOf(bytes: Uint8Array<ArrayBuffer>, name: string): DataView {
  const view = new DataView(bytes.buffer);
  if (bytes.length < 56 || view.getUint32(0) !== mark("INDX")) throw damaged(name);
  return view;
}

function readTags(
  bytes: Uint8Array<ArrayBuffer>,
  at: number,
  name: string,
): { readonly tags: readonly Tag[]; readonly controlBytes: number } {
  const view = new DataView(bytes.buffer);
  if (at + 12 > bytes.length || view.getUint32(at) !== mark("TAGX")) throw damaged(name);
  const [length, controlBytes] = [view.getUint32(at + 4), view.getUint32(at + 8)];
  if (at + length > bytes.length || controlBytes > 16 || length > 4096) throw damaged(name);
  const tags: Tag[] = [];
  for (let from = at + 12; from + 4 <= at + length; from += 4) {
    const [tag = 0, perValue = 0, mask = 0, end = 0] = bytes.subarray(from, from + 4);
    tags.push({ tag, perValue, mask, isEnd: (end & 1) !== 0 });
  }
  return { tags, controlBytes };
}

function addEntries(
  bytes: Uint8Array<ArrayBuffer>,
  tags: readonly Tag[],
  controlBytes: number,
  entries: IndexEntry[],
  name: string,
): void {
  const view = viewOf(bytes, name);
  const [list, count] = [view.getUint32(20) + 4, view.getUint32(24)];
  if (list + 2 * count > bytes.length || entries.length + count > mostEntries) throw damaged(name);
  for (let k = 0; k < count; k++) {
    const at = view.getUint16(list + 2 * k);
    const from = at + 1 + (bytes[at] ?? 0);
    const label = String.fromCharCode(...bytes.subarray(at + 1, from));
    const found = readNumbers(bytes, from, tags, controlBytes, name);
    entries.push({ name: label, numbers: (tag) => found.get(tag) ?? [] });
  }
}

/** Returns the numbers of an entry by their tags. */
function readNumbers(
  bytes: Uint8Array,
  from: number,
  tags: readonly Tag[],
  controlBytes: number,
  name: string,
): Map<number, number[]> {
  let control = from;
  let at = from + controlBytes;
  let left = mostNumbers;
  const next = (): number => {
    // Each takes a byte at least: behind the end there would be no end.
    if (at >= bytes.length || --left < 0) throw damaged(name);
    const [number, to] = numberAt(bytes, at);
    at = to;
    return number;
  };
  // What is written in the control bytes comes first, then the numbers themselves.
  const plans: { readonly tag: number; readonly count?: number; readonly length?: number }[] = [];
  for (const { tag, perValue, mask, isEnd } of tags) {
    if (isEnd) {
      control += 1;
      continue;
    }
    const value = (bytes[control] ?? 0) & mask;
    if (value === 0) continue;
    // All bits of a mask of several say that the length in bytes follows.
    if (value === mask && (mask & (mask - 1)) !== 0) plans.push({ tag, length: next() });
    else plans.push({ tag, count: (value / (mask & -mask)) * perValue });
  }
  const found = new Map<number, number[]>();
  for (const { tag, count = 0, length } of plans) {
    const numbers: number[] = [];
    if (length === undefined) for (let k = 0; k < count; k++) numbers.push(next());
    else for (const end = at + length; at < end; ) numbers.push(next());
    found.set(tag, numbers);
  }
  return found;
}

/** Returns the number at a place, seven bits a byte of which the last is marked, and where it ends. */
function numberAt(bytes: Uint8Array, at: number): [number: number, end: number] {
  let number = 0;
  let end = at;
  while (end < Math.min(at + 4, bytes.length)) {
    const byte = bytes[end++] ?? 0;
    number = (number << 7) | (byte & 0x7f);
    if (byte & 0x80) break;
  }
  return [number, end];
}
