/**
 * Codes integers that become smaller along a run, in few bits: Rice's code,
 * whose parameter adapts to the numbers before.
 */

/** Bits of the length of a run, and of its first parameter. */
const lengthBits = 17;
const parameterBits = 5;

/** Maximum of ones that a number begins with; that many mark a plain number. */
const mostOnes = 24;
const plainBits = 32;

/** Every code is smaller than this. */
const mostCode = 2 ** 27;

/** Returns the parameter for the mean of the numbers before, in sixteenths. */
const parameterOf = (mean: number): number => 32 - Math.clz32(mean >>> 5);
const meanAfter = (mean: number, code: number): number => mean - Math.floor(mean / 4) + 4 * code;

/** Returns 0, -1, 1, -2 ... as 0, 1, 2, 3 ... */
const zigzag = (value: number): number => (value < 0 ? -2 * value - 1 : 2 * value);

/** Writes bits, the lowest first. */
export class BitWriter {
  readonly #bytes: number[] = [];
  #used = 0;

  /** Writes the lowest `count` bits of a number, 32 at most. */
  bits(value: number, count: number): void {
    for (let bit = 0; bit < count; bit++) {
      if (this.#used % 8 === 0) this.#bytes.push(0);
      this.#bytes[this.#used >> 3] |= ((value >>> bit) & 1) << (this.#used % 8);
      this.#used++;
    }
  }

  /** Writes a run of numbers. */
  run(values: Int32Array): void {
    const { length, parameter } = beginningOf(values);
    this.bits(length, lengthBits);
    this.bits(parameter, parameterBits);
    let mean = 16 * 2 ** parameter;
    for (let at = 0; at < length; at++) {
      const code = zigzag(values[at]);
      const k = parameterOf(mean);
      const ones = Math.floor(code / 2 ** k);
      if (ones >= mostOnes) {
        this.bits(-1, mostOnes);
        this.bits(code, plainBits);
      } else {
        this.bits(2 ** ones - 1, ones + 1);
        this.bits(code, k);
      }
      mean = meanAfter(mean, code);
    }
  }

  /** The written bits, in whole bytes. */
  get bytes(): Uint8Array<ArrayBuffer> {
    return Uint8Array.from(this.#bytes);
  }
}

/** Returns the number of bits of a run. */
export function costOf(values: Int32Array): number {
  const { length, parameter } = beginningOf(values);
  let mean = 16 * 2 ** parameter;
  let bits = lengthBits + parameterBits;
  for (let at = 0; at < length; at++) {
    const code = zigzag(values[at]);
    const k = parameterOf(mean);
    const ones = Math.floor(code / 2 ** k);
    bits += ones >= mostOnes ? mostOnes + plainBits : ones + 1 + k;
    mean = meanAfter(mean, code);
  }
  return bits;
}

function beginningOf(values: Int32Array): { length: number; parameter: number } {
  let { length } = values;
  while (length > 0 && values[length - 1] === 0) length--;
  const bitsOfFirst = 32 - Math.clz32(values.length > 0 ? zigzag(values[0]) : 0);
  return { length, parameter: Math.max(bitsOfFirst - 1, 0) };
}

/** Reads what `BitWriter` wrote. */
export class BitReader {
  readonly #bytes: Uint8Array;
  #used = 0;

  constructor(bytes: Uint8Array) {
    this.#bytes = bytes;
  }

  /** Returns the next bits as a number from 0. Throws a RangeError if the bytes end before. */
  bits(count: number): number {
    if (this.#used + count > 8 * this.#bytes.length) throw new RangeError("The bits end early.");
    let value = 0;
    for (let read = 0; read < count; ) {
      const offset = this.#used % 8;
      const wanted = Math.min(8 - offset, count - read);
      const part = (this.#bytes[this.#used >> 3] >> offset) & (2 ** wanted - 1);
      value += part * 2 ** read;
      read += wanted;
      this.#used += wanted;
    }
    return value;
  }

  /** Reads a run into `values`. Throws a RangeError if it is not one. */
  run(values: Int32Array): void {
    values.fill(0);
    const length = this.bits(lengthBits);
    const parameter = this.bits(parameterBits);
    if (length > values.length || parameter > 26) throw new RangeError("The run is too long.");
    let mean = 16 * 2 ** parameter;
    for (let at = 0; at < length; at++) {
      const k = parameterOf(mean);
      let ones = 0;
      while (ones < mostOnes && this.bits(1) === 1) ones++;
      const code = ones === mostOnes ? this.bits(plainBits) : ones * 2 ** k + this.bits(k);
      if (code >= mostCode) throw new RangeError("The number is too large.");
      mean = meanAfter(mean, code);
      values[at] = code % 2 === 0 ? code / 2 : -(code + 1) / 2;
    }
  }

  /** Whether no whole byte is left. */
  get isAtEnd(): boolean {
    return Math.ceil(this.#used / 8) === this.#bytes.length;
  }
}
