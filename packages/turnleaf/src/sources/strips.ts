/** Strips: images many times as tall as wide, as of comics that are scrolled, cut into pages. */

import { cropImage } from "./crop_image.ts";
import type { PageBox, PageSize } from "./page_source.ts";

/**
 * How far from its place a cut may move to lie between two pictures, over a page's height. A page is filled
 * to all but two such lengths on average, so that it holds what lies between two cuts that moved apart.
 */
const mostMoved = 1 / 8;

/** The difference of two values of a colour, of 255, that lossy packing makes of one. */
const noise = 12;

/** The paper where a strip is cut through a picture. */
const paper = "#fff";

/** A page of a strip. */
export interface StripPage {
  /** Which of the strip's pages it is, from 0, and how many there are. */
  readonly index: number;
  readonly count: number;
  /** Its height over its width. */
  readonly ratio: number;
}

/** A cut through a strip. */
export interface Cut {
  /** Where it is, in pixels from the top. */
  readonly y: number;
  /** The colour of the strip there, if it is one; white if it is several. */
  readonly colour: string;
}

/**
 * Returns how many pages a strip takes, which may be more than there can be.
 *
 * @param size of the strip in pixels
 * @param ratio the height of a page over its width
 */
export function countOfStrip({ width, height }: PageSize, ratio: number): number {
  return Math.max(Math.ceil(height / (width * ratio * (1 - 2 * mostMoved))), 1);
}

/** Returns the pages of a strip, as many as `countOfStrip` says. */
export function pagesOfStrip(size: PageSize, ratio: number): StripPage[] {
  const count = countOfStrip(size, ratio);
  return Array.from({ length: count }, (_, index) => ({ index, count, ratio }));
}

/** Returns where a strip is cut, with its top and its bottom: where it is of one colour, if that is near. */
export function cutsOf(strip: ImageBitmap, { count, ratio }: StripPage): Cut[] {
  const { width, height } = strip;
  const reach = Math.floor(mostMoved * width * ratio);
  const pen = new OffscreenCanvas(width, 2 * reach + 1).getContext("2d", {
    willReadFrequently: true,
  });
  if (!pen) throw new Error("out of memory");
  return Array.from({ length: count + 1 }, (_, k) => {
    const place = Math.round((height * k) / count);
    const isEnd = k === 0 || k === count;
    const first = Math.max(isEnd ? Math.min(place, height - 1) : place - reach, 0);
    const rows = isEnd ? 1 : Math.min(2 * reach + 1, height - first);
    pen.drawImage(strip, 0, first, width, rows, 0, 0, width, rows);
    const colours = coloursOf(pen.getImageData(0, 0, width, rows));
    if (isEnd) return { y: place, colour: colours[0] ?? paper };
    const row = middleOfNearest(colours, place - first);
    return row === null
      ? { y: place, colour: paper }
      : { y: first + row, colour: colours[row] ?? paper };
  });
}

/** Returns the colour of each row of an image; null for one that has several. */
function coloursOf({ data, width, height }: ImageData): (string | null)[] {
  return Array.from({ length: height }, (_, row) => {
    const start = 4 * row * width;
    for (let at = start; at < start + 4 * width; at++) {
      const first = data[start + (at & 3)] as number;
      if (Math.abs((data[at] as number) - first) > noise) return null;
    }
    const [red, green, blue, opacity] = data.subarray(start, start + 4);
    return opacity === 0 ? paper : `rgb(${red} ${green} ${blue})`;
  });
}

/** Returns the middle of the rows of one colour that are nearest to a row; null if there are none. */
function middleOfNearest(colours: readonly (string | null)[], to: number): number | null {
  let best: { readonly row: number; readonly distance: number } | null = null;
  for (let start = 0; start < colours.length; start++) {
    if (colours[start] === null) continue;
    let end = start;
    while (end < colours.length && colours[end] !== null) end++;
    const row = (start + end - 1) >> 1;
    const distance = to < start ? start - to : to >= end ? to - end + 1 : 0;
    if (!best || distance < best.distance) best = { row, distance };
    start = end;
  }
  return best?.row ?? null;
}

/**
 * Draws a part of a page of a strip, with what lies between two cuts in its middle, as wide as the page.
 *
 * @param page the page's size in the strip's pixels
 * @param part the part of the page that is drawn, in the same
 * @param pixels how large it is drawn
 */
export async function drawStripPage(
  strip: ImageBitmap,
  [top, bottom]: readonly [Cut, Cut],
  page: PageSize,
  part: PageBox,
  pixels: PageSize,
): Promise<ImageBitmap> {
  const canvas = new OffscreenCanvas(pixels.width, pixels.height);
  const pen = canvas.getContext("2d");
  if (!pen) throw new Error("out of memory");
  const scale = pixels.height / part.height;
  const above = (page.height - (bottom.y - top.y)) / 2;
  const middle = Math.round((page.height / 2 - part.y) * scale);
  pen.fillStyle = top.colour;
  pen.fillRect(0, 0, pixels.width, middle);
  pen.fillStyle = bottom.colour;
  pen.fillRect(0, middle, pixels.width, pixels.height - middle);
  const [from, to] = [
    Math.max(top.y, Math.floor(top.y + part.y - above)),
    Math.min(bottom.y, Math.ceil(top.y + part.y + part.height - above)),
  ];
  if (to > from) {
    const y = Math.round((from - top.y + above - part.y) * scale);
    const height = Math.max(Math.round((to - from) * scale), 1);
    const box = { x: part.x, y: from, width: part.width, height: to - from };
    const piece = await cropImage(strip, box, { width: pixels.width, height });
    pen.drawImage(piece, 0, y);
    piece.close();
  }
  return canvas.transferToImageBitmap();
}
