/** The blocks of a tar that describe its files (POSIX.1-1988, "ustar", and what came before and after it). */

/** Bytes of a block: a file's description is one, its bytes fill whole ones. */
export const tarBlock = 512;

/** Where in a block its checksum is, and its length. */
const [sumAt, sumLength] = [148, 8];

/** What a block says of the file behind it. */
export interface TarHeader {
  /** The bytes of its path. */
  readonly path: Uint8Array<ArrayBuffer>;
  /** Its length in bytes. */
  readonly size: number;
  /**
   * What it is: "0" and "7" a file, "1" a hard and "2" a symbolic link, "5" a folder; "L", "K" and "x" the path of the
   * next file, what it links to, and more about it.
   */
  readonly type: string;
  /** The bytes of the path to which it links. */
  readonly target: Uint8Array<ArrayBuffer>;
}

/** Returns what a block says; null if it is no header, by its checksum. */
export function readTarHeader(block: Uint8Array): TarHeader | null {
  if (block.length < tarBlock) return null;
  const spaces = 32 * sumLength;
  let sum = spaces;
  for (let k = 0; k < tarBlock; k++) {
    if (k < sumAt || k >= sumAt + sumLength) sum += block[k] as number;
  }
  // A block of zeros, which ends a tar, has no checksum.
  if (sum === spaces || numberIn(block, sumAt, sumLength) !== sum) return null;
  const type = block[156] ? String.fromCharCode(block[156]) : "0";
  const isUstar = String.fromCharCode(...block.subarray(257, 263)) === "ustar\0";
  const [name, prefix] = [textIn(block, 0, 100), isUstar ? textIn(block, 345, 155) : []];
  const path = Uint8Array.from(prefix.length > 0 ? [...prefix, 0x2f, ...name] : name);
  const target = Uint8Array.from(textIn(block, 157, 100));
  return { path, size: numberIn(block, 124, 12), type, target };
}

/** Returns the bytes of a field up to a zero. */
function textIn(block: Uint8Array, at: number, length: number): Uint8Array {
  const field = block.subarray(at, at + length);
  const end = field.indexOf(0);
  return end < 0 ? field : field.subarray(0, end);
}

/** Returns a number: octal digits, or, if its first bit is set, binary, as GNU's tar writes large ones. */
function numberIn(block: Uint8Array, at: number, length: number): number {
  const field = block.subarray(at, at + length);
  const first = field[0] ?? 0;
  if (first & 0x80) return field.subarray(1).reduce((sum, byte) => sum * 256 + byte, first & 0x7f);
  const digits = /[0-7]+/.exec(String.fromCharCode(...field));
  return digits ? Number.parseInt(digits[0], 8) : 0;
}
