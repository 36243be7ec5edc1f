/**
 * The common parts of files of key frames: numbers, their bounds, and a
 * checksum. docs/formats.md describes the format.
 */

/** Bytes that are not a recorded turn; the message gives the reason, in one sentence. */
export class TurnError extends Error {
  override readonly name = "TurnError";
}

/**
 * Length of the header common to all versions, of the whole headers of versions 2
 * and 3, and of the checksum.
 */
export const commonHeader = 36;
export const packedHeader = 48;
export const meshHeader = 56;
export const checksumLength = 8;

/**
 * Bounds of versions 2 and 3: points along a side, points of all frames, and a
 * multiple of the quantum.
 */
export const mostAlong = 256;
export const mostPoints: number = 2 ** 22;
export const mostMultiple: number = 2 ** 24;

/** A quantum of versions 2 and 3 is below this, metres. */
export const mostQuantum = 1e6;

/**
 * Minimum bytes of the packed coefficients of a frame: for each axis 2 bits for
 * the prediction, and 22 for the start of a run.
 */
export const leastPackedFrame = 9;

/** Returns the FNV-1a hash of 64 bits over bytes, as its 8 bytes from the lowest. */
export function checksum(bytes: Uint8Array): Uint8Array<ArrayBuffer> {
  // By halves, as the prime is 2^40 + 435.
  let [high, low] = [0xcbf29ce4, 0x84222325];
  for (const byte of bytes) {
    low = (low ^ byte) >>> 0;
    const product = low * 435;
    const carry = Math.floor(product / 2 ** 32);
    high = (Math.imul(high, 435) + carry + (low << 8)) >>> 0;
    low = product >>> 0;
  }
  const sum = new Uint8Array(checksumLength);
  new DataView(sum.buffer).setUint32(0, low, true);
  new DataView(sum.buffer).setUint32(4, high, true);
  return sum;
}

/** Multiples of one axis in the frame before and in the one before that, if there are such. */
export type EarlierFrames = readonly [Int32Array | undefined, Int32Array | undefined];

/**
 * Returns the prediction of a multiple from the frames before, in one of three
 * ways.
 *
 * @param before multiples of the same axis
 */
export function expected(
  before: EarlierFrames,
  times: ArrayLike<number>,
  frame: number,
  way: number,
  place: number,
): number {
  const b = before[0]?.[place] ?? 0;
  if (way < 2) return way * b;
  const a = before[1]?.[place] ?? 0;
  const [t0, t1, t2] = [times[frame - 2], times[frame - 1], times[frame]];
  const line = b + (b - a) * ((t2 - t1) / (t1 - t0));
  return Math.min(Math.max(Math.floor(line + 0.5), -mostMultiple), mostMultiple);
}
