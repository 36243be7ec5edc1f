/** Pixels of TIFFs whose samples are lightness and colour differences (YCbCr), not packed as JPEG. */

import type { PageSize } from "../page_source.ts";

/** How such a file has its samples. */
export interface LumaSamples extends PageSize {
  readonly data: Uint8Array;
  /** Rows of a strip; each strip begins where its first row would, were all samples there. */
  readonly rows: number;
  /** Pixels that have one pair of colour differences, across and down. */
  readonly across: number;
  readonly down: number;
  /** The weights of red, green and blue in lightness. */
  readonly weights: readonly number[];
  /** The numbers of black and white, of lightness and of either difference. */
  readonly range: readonly number[];
}

/** Returns the pixels: red, green, blue and opacity. */
export function lumaPixels(samples: LumaSamples): Uint8ClampedArray<ArrayBuffer> {
  const { width, height, data, rows, across, down, range } = samples;
  const [ofRed = 0.299, ofGreen = 0.587, ofBlue = 0.114] = samples.weights;
  const scaled = (code: number, at: number, full: number): number => {
    const [black = 0, white = 255] = range.slice(at, at + 2);
    return ((code - black) * full) / (white - black || 1);
  };
  const pixels = new Uint8ClampedArray(4 * width * height);
  const unit = across * down + 2;
  const units = Math.ceil(width / across);
  for (let y = 0; y < height; y++) {
    const inStrip = y % rows;
    const strip = (y - inStrip) * width * 3 + Math.floor(inStrip / down) * units * unit;
    for (let x = 0; x < width; x++) {
      const from = strip + Math.floor(x / across) * unit;
      const luma = scaled(data[from + (inStrip % down) * across + (x % across)] ?? 0, 0, 255);
      const blueness = scaled(data[from + unit - 2] ?? 128, 2, 127);
      const redness = scaled(data[from + unit - 1] ?? 128, 4, 127);
      const red = luma + 2 * (1 - ofRed) * redness;
      const blue = luma + 2 * (1 - ofBlue) * blueness;
      const green = (luma - ofRed * red - ofBlue * blue) / ofGreen;
      pixels.set([red, green, blue, 255], 4 * (y * width + x));
    }
  }
  return pixels;
}
