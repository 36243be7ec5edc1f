/** Pixels of an image that a decoder has made. */

import type { PageSize } from "../page_source.ts";

/** An image's pixels: red, green, blue and opacity of each, by rows. */
export interface Pixels extends PageSize {
  readonly data: Uint8ClampedArray<ArrayBuffer>;
}

/** An image that has more pixels than its reader may have. */
export class TooManyPixels extends Error {
  readonly size: PageSize;

  constructor(size: PageSize) {
    super(`${size.width} x ${size.height} pixels`);
    this.size = size;
  }
}

/** Throws if an image has no size, or more pixels than `most`. */
export function checkSize(size: PageSize, most: number): void {
  if (!(size.width > 0 && size.height > 0)) throw new Error("it has no size");
  if (size.width * size.height > most) throw new TooManyPixels(size);
}

/**
 * Returns an image as it is to be seen.
 *
 * @param orientation how its rows and columns lie, as EXIF and TIFF number it: 1 to 8
 */
export function upright(pixels: Pixels, orientation: number): Pixels {
  if (!(orientation >= 2 && orientation <= 8)) return pixels;
  const { width, height } = pixels;
  const isTurned = orientation >= 5;
  const size = isTurned ? { width: height, height: width } : { width, height };
  const isFromRight = [2, 3, 7, 8].includes(orientation);
  const isFromBottom = [3, 4, 6, 7].includes(orientation);
  const from = new Uint32Array(pixels.data.buffer, pixels.data.byteOffset, width * height);
  const to = new Uint32Array(from.length);
  let at = 0;
  for (let row = 0; row < size.height; row++) {
    for (let column = 0; column < size.width; column++) {
      const [along, down] = isTurned ? [row, column] : [column, row];
      const x = isFromRight ? width - 1 - along : along;
      const y = isFromBottom ? height - 1 - down : down;
      to[at++] = from[y * width + x] as number;
    }
  }
  return { ...size, data: new Uint8ClampedArray(to.buffer) };
}
