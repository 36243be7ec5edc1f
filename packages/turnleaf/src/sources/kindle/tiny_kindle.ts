/** Small Kindle books, MOBI and KF8, by the structure that MobileRead's wiki documents; for tests only. */

/** What is in a small Kindle book. */
export interface TinyKindle {
  /** The text of a MOBI; of a KF8 what is in the `<body>` of each section. */
  readonly text: string | readonly string[];
  /** Lines of the contents: places in bytes of a MOBI, the section's number of a KF8. */
  readonly contents?: readonly {
    readonly title: string;
    readonly at: number;
    readonly parent?: number;
  }[];
  /** Style sheets and drawings of a KF8, from `kindle:flow:0001` on. */
  readonly flows?: readonly string[];
  /** Pictures and fonts, from number 1 on. */
  readonly resources?: readonly Uint8Array[];
  /** Metadata by the types of EXTH; numbers are of four bytes. */
  readonly metadata?: Readonly<Record<number, string | number>>;
  /** 1: none, the default; 2: PalmDoc. */
  readonly compression?: number;
  readonly encryption?: number;
  /** Bytes of text in a record. */
  readonly recordSize?: number;
}

const encoder = new TextEncoder();

const short = (value: number): number[] => [(value >> 8) & 255, value & 255];
const long = (value: number): number[] => [...short(value >>> 16), ...short(value)];
const letters = (text: string): number[] => [...encoder.encode(text)];

/** Returns a number of seven bits a byte, the last one marked. */
function number(value: number): number[] {
  const bytes = [value & 127];
  for (let left = value >> 7; left > 0; left >>= 7) bytes.unshift(left & 127);
  bytes.push((bytes.pop() ?? 0) | 128);
  return bytes;
}

/** Packs bytes by PalmDoc: repeats of three to ten bytes, spaces before letters, and the rest as it is. */
export function packPalmDoc(bytes: Uint8Array): number[] {
  const packed: number[] = [];
  for (let at = 0; at < bytes.length; ) {
    const byte = bytes[at] ?? 0;
    let [best, distance] = [0, 0];
    for (let back = 1; best < 10 && back <= Math.min(at, 2047); back++) {
      let same = 0;
      while (
        same < 10 &&
        at + same < bytes.length &&
        bytes[at + same] === bytes[at + same - back]
      ) {
        same += 1;
      }
      if (same > best) [best, distance] = [same, back];
    }
    const next = bytes[at + 1] ?? 0;
    if (best >= 3) {
      packed.push(...short(0x8000 | (distance << 3) | (best - 3)));
      at += best;
    } else if (byte === 32 && next >= 64 && next < 128) {
      packed.push(next ^ 128);
      at += 2;
    } else {
      if (byte === 0 || (byte > 8 && byte < 128)) packed.push(byte);
      else packed.push(1, byte);
      at += 1;
    }
  }
  return packed;
}

/** A row of a table: its name, and the numbers of each tag. */
type Row = readonly [name: string, numbers: Readonly<Record<number, readonly number[]>>];

/** Returns the records of a table: its head, its rows, its texts. */
function table(rows: readonly Row[], texts: readonly string[]): number[][] {
  const tags = [...new Set(rows.flatMap(([, numbers]) => Object.keys(numbers).map(Number)))].sort(
    (a, b) => a - b,
  );
  const perTag = (tag: number): number =>
    Math.max(...rows.map(([, numbers]) => numbers[tag]?.length ?? 0));
  const tagx = [
    ...[...letters("TAGX"), ...long(16 + 4 * tags.length), ...long(1)],
    ...tags.flatMap((tag, k) => [tag, perTag(tag), 1 << k, 0]),
    ...[0, 0, 0, 1],
  ];
  const head = (own: Readonly<Record<number, number>>): number[] => {
    const bytes = [...letters("INDX"), ...Array<number>(188).fill(0)];
    for (const [at, value] of Object.entries({ 4: 192, ...own })) {
      bytes.splice(Number(at), 4, ...long(value));
    }
    return bytes;
  };
  const body: number[] = [];
  const places: number[] = [];
  for (const [name, numbers] of rows) {
    places.push(192 + body.length);
    const control = tags.reduce((bits, tag, k) => bits | (numbers[tag] ? 1 << k : 0), 0);
    body.push(name.length, ...letters(name), control);
    for (const tag of tags) body.push(...(numbers[tag] ?? []).flatMap(number));
  }
  return [
    [...head({ 24: 1, 28: 65001, 52: texts.length > 0 ? 1 : 0 }), ...tagx],
    [
      ...head({ 20: 192 + body.length, 24: rows.length }),
      ...body,
      ...letters("IDXT"),
      ...places.flatMap(short),
    ],
    ...(texts.length > 0 ? [textRecord(texts).bytes] : []),
  ];
}

/** Returns the texts of a table, and where each begins. */
function textRecord(texts: readonly string[]): { bytes: number[]; places: number[] } {
  const bytes: number[] = [];
  const places = texts.map((text) => {
    const at = bytes.length;
    const own = letters(text);
    bytes.push(...number(own.length), ...own);
    return at;
  });
  return { bytes, places };
}

/** Builds a MOBI. */
export function tinyMobi(book: TinyKindle): Uint8Array<ArrayBuffer> {
  const contents = book.contents ?? [];
  const { places } = textRecord(contents.map(({ title }) => title));
  const rows = contents.map(({ at, parent }, k): Row => {
    const up: Record<number, number[]> = parent === undefined ? {} : { 21: [parent] };
    return [String(k).padStart(4, "0"), { 1: [at], 3: [places[k] ?? 0], ...up }];
  });
  const titles = contents.map(({ title }) => title);
  const text = encoder.encode([book.text].flat().join(""));
  return pack(book, text, 6, (first) => {
    const records = rows.length > 0 ? table(rows, titles) : [];
    const header: Record<number, number> = rows.length > 0 ? { 244: first } : {};
    return { records, header };
  });
}

/** Builds a KF8, as in AZW3: each section is a skeleton with one fragment, its body. */
export function tinyKf8(book: TinyKindle): Uint8Array<ArrayBuffer> {
  const styles = (book.flows ?? []).map(
    (_, k) => `<link rel="stylesheet" href="kindle:flow:${k32(k + 1)}?mime=text/css"/>`,
  );
  const [head, tail] = [
    `<?xml version="1.0"?><html xmlns="http://www.w3.org/1999/xhtml"><head><title>t</title>${styles.join("")}</head><body>`,
    "</body></html>",
  ];
  const bodies = [book.text].flat();
  const skeletons: Row[] = [];
  const fragments: Row[] = [];
  const pieces: Uint8Array[] = [];
  let at = 0;
  bodies.forEach((body, k) => {
    const [skeleton, fragment] = [encoder.encode(head + tail), encoder.encode(body)];
    skeletons.push([`SKEL${k}`, { 1: [1], 6: [at, skeleton.length] }]);
    const insertAt = String(at + head.length).padStart(10, "0");
    fragments.push([insertAt, { 2: [0], 4: [k], 6: [0, fragment.length] }]);
    pieces.push(skeleton, fragment);
    at += skeleton.length + fragment.length;
  });
  const flows = [at];
  for (const flow of book.flows ?? []) {
    const bytes = encoder.encode(flow);
    pieces.push(bytes);
    at += bytes.length;
    flows.push(at);
  }
  const contents = book.contents ?? [];
  const titles = contents.map(({ title }) => title);
  const { places } = textRecord(titles);
  const lines = contents.map(({ at: section, parent }, k): Row => {
    const up: Record<number, number[]> = parent === undefined ? {} : { 21: [parent] };
    return [String(k), { 3: [places[k] ?? 0], 6: [section, 0], ...up }];
  });
  const text = Uint8Array.from(pieces.flatMap((piece) => [...piece]));
  return pack(book, text, 8, (first) => {
    const fdst = [
      ...[...letters("FDST"), ...long(12), ...long(flows.length)],
      ...flows.flatMap((end, k) => [...long(flows[k - 1] ?? 0), ...long(end)]),
    ];
    const tables = [
      table(skeletons, []),
      table(fragments, [""]),
      lines.length > 0 ? table(lines, titles) : [],
    ];
    const [skel, frag] = [first + 1, first + 1 + (tables[0]?.length ?? 0)];
    const ncx = frag + (tables[1]?.length ?? 0);
    const header: Record<number, number> = { 192: first, 196: flows.length, 248: frag, 252: skel };
    if (lines.length > 0) header[244] = ncx;
    return { records: [fdst, ...tables.flat()], header };
  });
}

/** Returns a number as Kindle books write it in addresses. */
export const k32 = (value: number, length = 4): string =>
  value.toString(32).toUpperCase().padStart(length, "0");

/** Puts a book's records together. */
function pack(
  book: TinyKindle,
  text: Uint8Array,
  version: number,
  tablesAt: (first: number) => { records: number[][]; header: Readonly<Record<number, number>> },
): Uint8Array<ArrayBuffer> {
  const size = book.recordSize ?? 4096;
  const chunks = Array.from({ length: Math.ceil(text.length / size) }, (_, k) =>
    text.subarray(k * size, (k + 1) * size),
  );
  const compression = book.compression ?? 1;
  const texts = chunks.map((chunk) => (compression === 2 ? packPalmDoc(chunk) : [...chunk]));
  const resources = (book.resources ?? []).map((bytes) => [...bytes]);
  const firstResource = 1 + texts.length;
  const { records, header } = tablesAt(firstResource + resources.length);
  const metadata = Object.entries({ 503: "A small book", 524: "en", ...book.metadata }).map(
    ([type, value]) => {
      const bytes = typeof value === "number" ? long(value) : letters(value);
      return [...long(Number(type)), ...long(8 + bytes.length), ...bytes];
    },
  );
  const exth = [
    ...letters("EXTH"),
    ...long(12 + metadata.flat().length),
    ...long(metadata.length),
    ...metadata.flat(),
  ];
  const first = [
    ...[...short(compression), ...short(0), ...long(text.length)],
    ...[...short(texts.length), ...short(size), ...short(book.encryption ?? 0), ...short(0)],
    ...[...letters("MOBI"), ...Array<number>(244).fill(0)],
  ];
  const own = { 20: 248, 28: 65001, 36: version, 108: firstResource, 128: 0x40 };
  const missing = { 192: 0xffffffff, 244: 0xffffffff, 248: 0xffffffff, 252: 0xffffffff };
  for (const [at, value] of Object.entries({ ...own, ...missing, 240: 0, ...header })) {
    first.splice(Number(at), 4, ...long(value));
  }
  const all = [[...first, ...exth], ...texts, ...resources, ...records];
  const head = [...letters("small"), ...Array<number>(55).fill(0), ...letters("BOOKMOBI")];
  head.push(...long(0), ...long(0), ...short(all.length));
  let at = head.length + 8 * all.length + 2;
  for (const [k, record] of all.entries()) {
    head.push(...long(at), ...long(2 * k));
    at += record.length;
  }
  return Uint8Array.from([...head, 0, 0, ...all.flat()]);
}
