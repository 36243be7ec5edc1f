/** Archives of RAR, 7-Zip, tar and XZ whose files are stored as they are: no free program writes RAR. */

/** Files of an archive by their paths, in order. */
export type StoredFiles = Readonly<Record<string, Uint8Array | string>>;

const table = Uint32Array.from({ length: 256 }, (_, index) => {
  let value = index;
  for (let bit = 0; bit < 8; bit++) value = value & 1 ? (value >>> 1) ^ 0xedb88320 : value >>> 1;
  return value;
});

function crc32(bytes: Uint8Array): number {
  let crc = 0xffffffff;
  for (const byte of bytes) crc = (crc >>> 8) ^ table[(crc ^ byte) & 255];
  return ~crc >>> 0;
}

const utf8 = (text: string): Uint8Array => new TextEncoder().encode(text);

function join(parts: readonly (Uint8Array | readonly number[])[]): Uint8Array<ArrayBuffer> {
  const bytes = new Uint8Array(parts.reduce((length, part) => length + part.length, 0));
  let at = 0;
  for (const part of parts) {
    bytes.set(part, at);
    at += part.length;
  }
  return bytes;
}

/** Returns the lowest `count` bytes of a number, the lowest first. */
function lowBytes(value: number, count: number): number[] {
  return Array.from({ length: count }, (_, index) => Math.floor(value / 256 ** index) & 255);
}

function entriesOf(files: StoredFiles): [name: string, bytes: Uint8Array][] {
  return Object.entries(files).map(([name, file]) => {
    return [name, typeof file === "string" ? utf8(file) : file];
  });
}

/** What a header of a file says other than the truth, for tests of those who read it. */
export interface StoredLies {
  /** Length of a file unpacked. */
  readonly size?: number;
  readonly crc?: number;
}

/** Returns an archive of RAR 2.9 to 4. */
export function rar4(files: StoredFiles, lies: StoredLies = {}): Uint8Array<ArrayBuffer> {
  const block = (type: number, flags: number, body: readonly number[]): Uint8Array => {
    const head = [type, ...lowBytes(flags, 2), ...lowBytes(7 + body.length, 2), ...body];
    return join([lowBytes(crc32(Uint8Array.from(head)), 2), head]);
  };
  const parts = entriesOf(files).flatMap(([name, bytes]) => {
    const path = utf8(name);
    const body = [
      ...lowBytes(bytes.length, 4),
      ...lowBytes(lies.size ?? bytes.length, 4),
      // Made by Unix, at no time, to be unpacked by version 2.0: stored.
      3,
      ...lowBytes(lies.crc ?? crc32(bytes), 4),
      ...lowBytes(0x5a000000, 4),
      ...[20, 0x30],
      ...lowBytes(path.length, 2),
      ...lowBytes(0o100644, 4),
      ...path,
    ];
    return [block(0x74, 0x8000, body), bytes];
  });
  const mark = utf8("Rar!\x1a\x07\0");
  return join([mark, block(0x73, 0, lowBytes(0, 6)), ...parts, block(0x7b, 0x4000, [])]);
}

/** Returns an archive of RAR 5. */
export function rar5(files: StoredFiles, lies: StoredLies = {}): Uint8Array<ArrayBuffer> {
  /** Returns a number in groups of seven bits, the lowest first. */
  const number = (value: number): number[] =>
    value < 128 ? [value] : [(value & 127) | 128, ...number(Math.floor(value / 128))];
  const block = (body: readonly number[]): Uint8Array => {
    const head = [...number(body.length), ...body];
    return join([lowBytes(crc32(Uint8Array.from(head)), 4), head]);
  };
  const parts = entriesOf(files).flatMap(([name, bytes]) => {
    const path = utf8(name);
    const body = [
      // A file with data, of which the check sum is known: stored, made by Unix.
      ...[2, 2, ...number(bytes.length), 4, ...number(lies.size ?? bytes.length)],
      ...number(0o100644),
      ...lowBytes(lies.crc ?? crc32(bytes), 4),
      ...[0, 1, ...number(path.length), ...path],
    ];
    return [block(body), bytes];
  });
  return join([utf8("Rar!\x1a\x07\x01\0"), block([1, 0, 0]), ...parts, block([5, 0, 0])]);
}

/** Returns an archive of 7-Zip, all of whose files are one run of bytes. */
export function sevenZip(files: StoredFiles, lies: StoredLies = {}): Uint8Array<ArrayBuffer> {
  /** Returns a number after as many bits as it has bytes more. */
  const number = (value: number): number[] => {
    for (let more = 0; more < 4; more++) {
      const room = 2 ** (7 - more);
      if (value < room * 256 ** more) {
        const first = (0xff00 >> more) & 255;
        return [first | Math.floor(value / 256 ** more), ...lowBytes(value, more)];
      }
    }
    return [0xf0, ...lowBytes(value, 4)];
  };
  const entries = entriesOf(files);
  const data = join(entries.map(([, bytes]) => bytes));
  const sizes = entries.map(([, bytes]) => bytes.length);
  const names = entries.flatMap(([name]) =>
    [...`${name}\0`].flatMap((letter) => lowBytes(letter.charCodeAt(0), 2)),
  );
  const sums = entries.flatMap(([, bytes]) => lowBytes(lies.crc ?? crc32(bytes), 4));
  const head = Uint8Array.from([
    ...[1, 4],
    // One packed run; one folder, whose coder copies; its length.
    ...[6, 0, 1, 9, ...number(data.length), 0],
    ...[7, 11, 1, 0, 1, 1, 0, 12, ...number(lies.size ?? data.length), 0],
    // The files in it, the lengths of all but the last, and check sums.
    ...[8, 13, ...number(sizes.length), 9, ...sizes.slice(0, -1).flatMap(number)],
    ...[10, 1, ...sums, 0, 0],
    ...[5, ...number(sizes.length), 17, ...number(names.length + 1), 0, ...names, 0, 0],
  ]);
  const place = [...lowBytes(data.length, 8), ...lowBytes(head.length, 8)];
  const start = Uint8Array.from([...place, ...lowBytes(crc32(head), 4)]);
  const mark = [0x37, 0x7a, 0xbc, 0xaf, 0x27, 0x1c, 0, 4];
  return join([mark, lowBytes(crc32(start), 4), start, data, head]);
}

/**
 * Returns bytes as XZ has those that it does not pack: in chunks as they are.
 *
 * @param dictionary what it asks to keep of them, as its header says it: 40 is 4 GB
 */
export function xz(bytes: Uint8Array, dictionary = 0): Uint8Array<ArrayBuffer> {
  const withSum = (part: readonly number[]): number[] => [
    ...part,
    ...lowBytes(crc32(Uint8Array.from(part)), 4),
  ];
  const padded = (part: readonly number[]): number[] => [
    ...part,
    ...new Array<number>(-part.length & 3).fill(0),
  ];
  /** Returns a number in groups of seven bits, the lowest first. */
  const number = (value: number): number[] =>
    value < 128 ? [value] : [(value & 127) | 128, ...number(Math.floor(value / 128))];
  const most = 1 << 16;
  const chunks: (Uint8Array | number[])[] = [];
  for (let at = 0; at < bytes.length; at += most) {
    const part = bytes.subarray(at, at + most);
    // The first chunk begins a dictionary.
    chunks.push([at === 0 ? 1 : 2, ...lowBytes(part.length - 1, 2).reverse()], part);
  }
  const data = join([...chunks, [0]]);
  // Sums are CRC-32; the one filter of the block is LZMA2.
  const flags = [0, 1];
  const head = withSum([2, 0, 0x21, 1, dictionary, 0, 0, 0]);
  const length = head.length + data.length + 4;
  const index = withSum(padded([0, 1, ...number(length), ...number(bytes.length)]));
  return join([
    ...[[0xfd, 0x37, 0x7a, 0x58, 0x5a, 0], withSum(flags)],
    ...[head, data, new Uint8Array(-data.length & 3), lowBytes(crc32(bytes), 4), index],
    lowBytes(crc32(Uint8Array.from([...lowBytes(index.length / 4 - 1, 4), ...flags])), 4),
    ...[lowBytes(index.length / 4 - 1, 4), flags, utf8("YZ")],
  ]);
}

/** How a tar writes paths of more than 100 bytes. */
export type TarPaths = "GNU" | "POSIX";

/** Returns a tar. */
export function tar(files: StoredFiles, paths: TarPaths = "POSIX"): Uint8Array<ArrayBuffer> {
  const parts = entriesOf(files).flatMap(([path, bytes]) => {
    const name = utf8(path);
    if (name.length <= 100) return tarEntry(name, "0", bytes);
    const before =
      paths === "GNU"
        ? tarEntry(utf8("././@LongLink"), "L", join([name, [0]]))
        : tarEntry(utf8("PaxHeader"), "x", extendedLine("path", name));
    return [...before, ...tarEntry(name.subarray(0, 100), "0", bytes)];
  });
  return join([...parts, new Uint8Array(1024)]);
}

/** A link in a tar: its own path, hard ("1") or symbolic ("2"), and the path that it says. */
export type TarLink = readonly [path: string, type: "1" | "2", target: string];

/** Returns a tar as `tar` does, with links behind the files. */
export function tarWithLinks(
  files: StoredFiles,
  links: readonly TarLink[],
): Uint8Array<ArrayBuffer> {
  const bytes = tar(files);
  const parts = links.flatMap(([path, type, target]) =>
    target.length <= 100
      ? tarEntry(utf8(path), type, new Uint8Array(), utf8(target))
      : [
          ...tarEntry(utf8("PaxHeader"), "x", extendedLine("linkpath", utf8(target))),
          ...tarEntry(utf8(path), type, new Uint8Array()),
        ],
  );
  return join([bytes.subarray(0, -1024), ...parts, new Uint8Array(1024)]);
}

function tarEntry(
  name: Uint8Array,
  type: string,
  bytes: Uint8Array,
  target: Uint8Array = new Uint8Array(),
): Uint8Array[] {
  const block = new Uint8Array(512);
  block.set(name);
  block.set(utf8("0000644\x000000\x000000\0"), 100);
  block.set(
    utf8(`${bytes.length.toString(8).padStart(11, "0")}\0${"0".repeat(11)}\0        `),
    124,
  );
  block.set(utf8(`${type}${"\0".repeat(100)}ustar\x0000`), 156);
  block.set(target, 157);
  const sum = block.reduce((all, byte) => all + byte, 0);
  block.set(utf8(`${sum.toString(8).padStart(6, "0")}\0 `), 148);
  return [block, bytes, new Uint8Array(-bytes.length & 511)];
}

/** Returns a line of an extended header, which says its own length. */
function extendedLine(key: string, value: Uint8Array): Uint8Array {
  const rest = join([utf8(` ${key}=`), value, [10]]);
  const length = [2, 3, 4].map((digits) => digits + rest.length);
  const own = length.find((one, k) => String(one).length === k + 2) ?? 0;
  return join([utf8(String(own)), rest]);
}
