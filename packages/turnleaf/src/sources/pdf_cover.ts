/** Whether the first page of a document is a cover. */

import type { PageSize } from "./page_source.ts";

/** Pixels across a page in which its edges are looked at. */
export const coverPixels = 48;

/**
 * Steps of drawing that its picture may take. Counted, as a clock would find a cover on an idle machine
 * and none on a busy one, and so bind one book in two ways.
 */
export const coverSteps = 30_000;

/** The least of red, green and blue of paper, as it is printed on and as scanners see it: 0 to 255. */
const paper = 200;

/**
 * Returns whether a page is a cover: its print reaches all four edges, so that more than half of each
 * is no bare paper. Slides, which are wider than high, are shown and not bound: none of theirs is one.
 *
 * @param pixels red, green, blue and opacity of its picture, row by row
 */
export function isCover({ width, height }: PageSize, pixels: Uint8ClampedArray): boolean {
  if (width > height) return false;
  // The outermost pixels are of the page only in part.
  const isBare = (x: number, y: number): boolean => {
    const at = 4 * (y * width + x);
    return Math.min(...pixels.subarray(at, at + 3)) >= paper || (pixels[at + 3] ?? 0) < 128;
  };
  const bareOf = (length: number, at: (k: number) => boolean): number =>
    Array.from({ length }, (_, k) => at(k)).filter((bare) => bare).length / length;
  return [
    bareOf(width, (x) => isBare(x, 1)),
    bareOf(width, (x) => isBare(x, height - 2)),
    bareOf(height, (y) => isBare(1, y)),
    bareOf(height, (y) => isBare(width - 2, y)),
  ].every((bare) => bare < 0.5);
}
