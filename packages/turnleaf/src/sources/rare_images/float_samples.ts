/** Pixels of TIFFs whose samples are floating-point numbers, which UTIF reads in one order of bytes and size alone. */

import type { PageSize } from "../page_source.ts";

/** How such a file has its samples. */
export interface FloatSamples extends PageSize {
  readonly data: Uint8Array;
  /** Samples of a pixel, and bits of each. */
  readonly count: number;
  readonly bits: number;
  readonly isLittle: boolean;
  /** Whether the bytes of a row's samples are apart and differences, as Adobe's third predictor has it. */
  readonly isPredicted: boolean;
  /** Whether the least number is white. */
  readonly isNegative: boolean;
}

/** Numbers beyond 1 are light beyond white up to this, and then of 0 to 255, or of a range of their own. */
const [brightest, mostOfByte] = [16, 255];

/** Returns the pixels: red, green, blue and opacity. Throws if the samples are of an unknown size. */
export function floatPixels(samples: FloatSamples): Uint8ClampedArray<ArrayBuffer> {
  const { width, height, count, isNegative } = samples;
  const isColour = count >= 3;
  const numbers = numbersOf(samples);
  const shown = isColour ? 3 : 1;
  let [least, most] = [0, 1];
  for (let k = 0; k < numbers.length; k++) {
    if (k % count >= shown) continue;
    const number = numbers[k] as number;
    least = Math.min(least, number);
    most = Math.max(most, number);
  }
  // Of grey no light is beyond white.
  const isLight = most <= (isColour ? brightest : 1);
  if (isLight) most = 1;
  else if (most <= mostOfByte) most = mostOfByte;
  if (isColour) least = 0;
  const pixels = new Uint8ClampedArray(4 * width * height);
  for (let k = 0, at = 0; k < width * height; k++, at += count) {
    for (let channel = 0; channel < 3; channel++) {
      const number = numbers[at + (isColour ? channel : 0)] as number;
      const part = Math.min(Math.max((number - least) / (most - least), 0), 1);
      const value = isColour && isLight ? encoded(part) : part;
      pixels[4 * k + channel] = 255 * (isNegative ? 1 - value : value);
    }
    const hasOpacity = count === 2 || count >= 4;
    pixels[4 * k + 3] = hasOpacity ? 255 * (numbers[at + shown] as number) : 255;
  }
  return pixels;
}

/** Returns what a screen shows as some light: such files have it as it is, screens by sRGB's curve. */
const encoded = (light: number): number =>
  light <= 0.0031308 ? 12.92 * light : 1.055 * light ** (1 / 2.4) - 0.055;

/** Returns the samples as numbers; those that are none are 0. */
function numbersOf(samples: FloatSamples): Float32Array {
  const { width, height, count, bits, isPredicted } = samples;
  const size = bits / 8;
  const isLittle = isPredicted || bits === 16 ? !isPredicted : samples.isLittle;
  const data = isPredicted ? unpredicted(samples, size) : samples.data;
  const view = new DataView(data.buffer, data.byteOffset, data.byteLength);
  const readers: Readonly<Record<number, (at: number) => number>> = {
    16: (at) => halfFloat(view.getUint16(at, isLittle)),
    32: (at) => view.getFloat32(at, isLittle),
    64: (at) => view.getFloat64(at, isLittle),
  };
  const read = readers[bits];
  if (!read) throw new Error(`its samples are numbers of ${bits} bits`);
  const numbers = new Float32Array(width * height * count);
  const there = Math.min(numbers.length, Math.floor(data.byteLength / size));
  for (let k = 0; k < there; k++) {
    const number = read(k * size);
    numbers[k] = Number.isFinite(number) ? number : 0;
  }
  return numbers;
}

/** Returns a number of 16 bits (IEEE 754, binary16). */
function halfFloat(bits: number): number {
  const [exponent, fraction] = [(bits >> 10) & 31, bits & 1023];
  const size = exponent === 0 ? fraction * 2 ** -24 : (1 + fraction / 1024) * 2 ** (exponent - 15);
  if (exponent === 31) return Number.NaN;
  return bits & 0x8000 ? -size : size;
}

/** Returns the samples with their bytes together, the highest first. */
function unpredicted({ data, width, height, count }: FloatSamples, size: number): Uint8Array {
  const row = width * count;
  const whole = new Uint8Array(height * row * size);
  const bytes = data.slice(0, whole.length);
  for (let from = 0; from + row * size <= bytes.length; from += row * size) {
    for (let k = count; k < row * size; k++) {
      bytes[from + k] = (bytes[from + k] as number) + (bytes[from + k - count] as number);
    }
    for (let k = 0; k < row; k++) {
      for (let byte = 0; byte < size; byte++) {
        whole[from + k * size + byte] = bytes[from + byte * row + k] as number;
      }
    }
  }
  return whole;
}
