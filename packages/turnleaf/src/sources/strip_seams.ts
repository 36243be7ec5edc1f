/** Whether images are slices of a strip, as sites cut webtoons: the picture goes on from one into the next. */

import { limits } from "./limits.ts";
import type { PageSize } from "./page_source.ts";

/** An image that may be a slice. */
export interface Slice {
  readonly size: PageSize;
  /** Returns its bytes. Rejects if they cannot be read. */
  read(): Promise<Blob>;
}

/** Two images, of which the second follows the first. */
export type Seam = readonly [above: Slice, below: Slice];

/** Rows at either edge of an image, which show how much rows of a picture differ that touch each other, and rows all over it. */
const sampledRows = 8;

/** Seams that are looked at: as many slices are decoded as a reader turns to at first. */
const mostSeams = 5;

/** Seams that have to go on, where there are so many, as one may do so by chance. */
const leastSeams = 2;

/** How much, on average, two values of a colour differ that lossy packing makes of one: up to 12 of 255, at random. */
const noise = 12 / 3;

/** Rows of an image. */
interface Rows {
  readonly top: ImageData;
  readonly bottom: ImageData;
  /** Some that are far apart, all over it. */
  readonly apart: ImageData;
}

/**
 * Returns whether images are slices of a strip, by seams spread over the book. A book whose first seam with
 * a picture on it is broken costs the decoding of two images.
 */
export async function areSliced(seams: readonly Seam[]): Promise<boolean> {
  // A cover and credits stand at the ends of many strips: there a broken seam says nothing.
  const inner = seams.length > 2 ? seams.slice(1, -1) : seams;
  const count = Math.min(mostSeams, inner.length);
  const wanted = Math.min(leastSeams, count);
  let balance = 0;
  for (let k = 0; k < count && balance >= 0 && balance < wanted; k++) {
    const goesOn = await goesOnAt(inner[Math.floor(((k + 0.5) * inner.length) / count)] as Seam);
    if (goesOn !== null) balance += goesOn ? 1 : -1;
  }
  const ends = inner === seams || balance < 0 ? [] : [seams[0] as Seam, seams.at(-1) as Seam];
  for (const end of ends) if (balance < wanted && (await goesOnAt(end))) balance++;
  return wanted > 0 && balance >= wanted;
}

/**
 * Returns whether a picture goes on over a seam: true if the rows that touch there differ more as rows do
 * that touch within the images than as the most similar ones do that are apart, false if they differ more
 * than those, null where neither is seen, as in one colour.
 */
export async function goesOnAt([first, second]: Seam): Promise<boolean | null> {
  const above = await rowsOf(first);
  const last = sampledRows - 1;
  if (!above || contrast(above.bottom, last) <= noise) return null;
  const below = await rowsOf(second);
  if (!below || below.top.width !== above.bottom.width) return null;
  const touching = (difference(above.bottom) + difference(below.top)) / 2;
  let apart = Math.min(
    rowDifference(above.bottom, last, above.top, 0),
    rowDifference(below.top, 0, below.bottom, last),
  );
  for (const { apart: others } of [above, below]) {
    for (let row = 0; row < others.height; row++) {
      apart = Math.min(apart, rowDifference(above.bottom, last, others, row));
    }
  }
  const seam = rowDifference(above.bottom, last, below.top, 0);
  if (apart - touching > noise && 2 * seam < apart + touching) return true;
  return seam > apart && seam - touching > noise ? false : null;
}

/** Returns rows of an image; null if it cannot be decoded, or is too low for so many. */
async function rowsOf({ size, read }: Slice): Promise<Rows | null> {
  if (size.width * size.height > limits.imagePixels || size.height < 2 * sampledRows) return null;
  const bitmap = await read()
    .then((image) => createImageBitmap(image))
    .catch(() => null);
  if (!bitmap) return null;
  const { width, height } = bitmap;
  const pen = new OffscreenCanvas(width, 3 * sampledRows).getContext("2d", {
    willReadFrequently: true,
  });
  const copy = (y: number, count: number, to: number): void =>
    pen?.drawImage(bitmap, 0, y, width, count, 0, to, width, count);
  copy(0, sampledRows, 0);
  copy(height - sampledRows, sampledRows, sampledRows);
  for (let row = 0; row < sampledRows; row++) {
    copy(Math.floor(((row + 0.5) * height) / sampledRows), 1, 2 * sampledRows + row);
  }
  bitmap.close();
  if (!pen) return null;
  const [top, bottom, apart] = [0, 1, 2].map((k) =>
    pen.getImageData(0, k * sampledRows, width, sampledRows),
  ) as [ImageData, ImageData, ImageData];
  return { top, bottom, apart };
}

/** Returns how much a row's values differ from their mean, on average. */
function contrast(image: ImageData, row: number): number {
  const values = rowOf(image, row);
  const sums = [0, 0, 0, 0];
  values.forEach((value, at) => {
    sums[at & 3] = (sums[at & 3] as number) + value;
  });
  const sum = values.reduce(
    (all, value, at) => all + Math.abs(value - (sums[at & 3] as number) / image.width),
    0,
  );
  return sum / values.length;
}

/** Returns how much rows of an image differ that touch each other, on average. */
function difference(image: ImageData): number {
  let sum = 0;
  for (let row = 1; row < image.height; row++) sum += rowDifference(image, row - 1, image, row);
  return sum / (image.height - 1);
}

/** Returns how much the values of two rows differ, on average. */
function rowDifference(first: ImageData, row: number, second: ImageData, other: number): number {
  const [one, two] = [rowOf(first, row), rowOf(second, other)];
  const sum = one.reduce((all, value, at) => all + Math.abs(value - (two[at] ?? 0)), 0);
  return sum / one.length;
}

function rowOf({ data, width }: ImageData, row: number): Uint8ClampedArray {
  return data.subarray(4 * width * row, 4 * width * (row + 1));
}
