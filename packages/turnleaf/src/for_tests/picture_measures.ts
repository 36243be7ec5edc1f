/** What is measured of a picture of a book: its hues, and its contrast where text is. */

import type { TurnleafBook } from "../element.ts";
import type { PagePicture } from "../sources/page_source.ts";
import { clock } from "./clock.ts";

/** A page of fewer lines is a picture's or nearly empty, and one whose lines are shorter is too small to tell, CSS pixels. */
const leastLines = 8;
const leastPrintWidth = 30;

/** Part of a picture by hue, in steps of 10 degrees, of the pixels that have one. */
export function hues({ data, width, height }: ImageData): number[] {
  const counts = Array.from({ length: 36 }, () => 0);
  for (let k = 0; k < data.length; k += 4) {
    const [r, g, b] = data.subarray(k, k + 3);
    const [most, least] = [Math.max(r, g, b), Math.min(r, g, b)];
    if (most < 60 || (most - least) / most < 0.7) continue;
    const sixth =
      most === r
        ? (g - b) / (most - least)
        : most === g
          ? 2 + (b - r) / (most - least)
          : 4 + (r - g) / (most - least);
    counts[Math.floor((60 * sixth + 360 + 5) / 10) % 36] += 1 / (width * height);
  }
  return counts;
}

/** The part of a picture that has about a hue. */
export function partOf(counts: readonly number[], hue: number): number {
  const middle = Math.floor((hue + 5) / 10);
  return [-1, 0, 1].reduce((sum, by) => sum + counts[(middle + by + 36) % 36], 0);
}

/** Mean difference of brightness, of 255, between a pixel in a box and the one below it. */
export function contrastIn({ data, width, height }: ImageData, box: DOMRect): number {
  const bright = (x: number, y: number): number => data[4 * (y * width + x) + 1];
  let [sum, count] = [0, 0];
  for (let y = Math.max(Math.ceil(box.top), 0); y < Math.min(box.bottom, height - 1) - 1; y++) {
    for (let x = Math.max(Math.ceil(box.left), 0); x < Math.min(box.right, width) - 1; x++) {
      sum += Math.abs(bright(x, y) - bright(x, y + 1));
      count++;
    }
  }
  return sum / Math.max(count, 1);
}

/** Returns the pixels of a page's picture, and closes it. */
export function pixels(picture: PagePicture): ImageData {
  const copy = new OffscreenCanvas(picture.width, picture.height);
  const pen = copy.getContext("2d") as OffscreenCanvasRenderingContext2D;
  pen.drawImage(picture, 0, 0);
  if ("close" in picture) picture.close();
  return pen.getImageData(0, 0, copy.width, copy.height);
}

/** Returns the places of the texts of open pages of a PDF, from the element's upper left corner; none of those that are too small to tell. */
export async function textBoxes(
  element: TurnleafBook,
  pages: readonly number[],
): Promise<Map<number, DOMRect>> {
  const boxes = new Map<number, DOMRect>();
  const home = element.getBoundingClientRect();
  for (const page of pages) {
    const spans = () => {
      const label = element.label(page);
      const groups = element.shadowRoot?.querySelectorAll(".text > [role=group]") ?? [];
      const group = [...groups].find(({ ariaLabel }) => ariaLabel?.split(" ").includes(label));
      return [
        ...(group?.querySelectorAll<HTMLElement>(".print .pieces > span:not([hidden])") ?? []),
      ];
    };
    // A page of few lines has no more later either.
    for (let k = 0; k < 20 && spans().length < leastLines; k++) {
      await clock.pass(20);
    }
    const seen = spans().map((span) => span.getBoundingClientRect());
    if (seen.length < leastLines) continue;
    const [left, top] = [Math.min(...seen.map((s) => s.left)), Math.min(...seen.map((s) => s.top))];
    const right = Math.max(...seen.map((s) => s.right));
    const bottom = Math.max(...seen.map((s) => s.bottom));
    if (right - left < leastPrintWidth) continue;
    boxes.set(page, new DOMRect(left - home.left, top - home.top, right - left, bottom - top));
  }
  return boxes;
}
