/** Strips: images many times as tall as wide, as of comics that are scrolled, cut into pages. */

import { cropImage } from "./crop_image.ts";
import type { StripPage, StripSlice } from "./manifest.ts";
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

/** A strip in its pixels, whose rows are decoded as they are needed. */
export interface Strip {
  readonly size: PageSize;
  /** Returns an image that has the rows from `top` to before `bottom`, and the row that its first one is. */
  rows(top: number, bottom: number): Promise<{ image: ImageBitmap; first: number }>;
}

/** A cut through a strip. */
interface Cut {
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

/**
 * Returns the strip that lies in several images.
 *
 * @param decode returns a slice's pixels, which are closed here
 */
export function joinedStrip(
  slices: readonly StripSlice[],
  decode: (slice: StripSlice) => Promise<ImageBitmap>,
): Strip {
  const width = slices[0]?.size.width ?? 0;
  return {
    size: sizeOfSlices(slices),
    async rows(top, bottom) {
      const canvas = new OffscreenCanvas(width, bottom - top);
      const pen = canvas.getContext("2d");
      if (!pen) throw new Error("out of memory");
      let y = 0;
      for (const slice of slices) {
        const { height } = slice.size;
        if (y < bottom && y + height > top) {
          const image = await decode(slice);
          pen.drawImage(image, 0, y - top, width, height);
          image.close();
        }
        y += height;
      }
      return { image: canvas.transferToImageBitmap(), first: top };
    },
  };
}

/** Returns the size of the strip that lies in several images of one width. */
export function sizeOfSlices(slices: readonly StripSlice[]): PageSize {
  const height = slices.reduce((sum, { size }) => sum + size.height, 0);
  return { width: slices[0]?.size.width ?? 0, height };
}

/** Returns how far a cut may move, in pixels of a strip. */
function reachOf(width: number, ratio: number): number {
  return Math.floor(mostMoved * width * ratio);
}

/** Returns where a strip is cut between its pages k - 1 and k, its ends among them, before the cut is moved. */
export function placeOf({ height }: PageSize, { count }: StripPage, k: number): number {
  return Math.round((height * k) / count);
}

/** Returns the rows in which a page lies, with those in which it may be cut. */
function rowsOfPage(size: PageSize, page: StripPage): { top: number; bottom: number } {
  const reach = reachOf(size.width, page.ratio);
  return {
    top: Math.max(placeOf(size, page, page.index) - reach, 0),
    bottom: Math.min(placeOf(size, page, page.index + 1) + reach + 1, size.height),
  };
}

/**
 * Returns a cut: where the strip is of one colour, if that is near, or else where least is cut through; or an
 * end of the strip.
 *
 * @param image an image that has the rows in which the cut may lie
 * @param start the strip's row that is the image's first
 */
function cutOf(image: ImageBitmap, start: number, size: PageSize, page: StripPage, k: number): Cut {
  const place = placeOf(size, page, k);
  const isEnd = k === 0 || k === page.count;
  const reach = isEnd ? 0 : reachOf(size.width, page.ratio);
  const first = Math.max(Math.min(place, size.height - 1) - reach, 0);
  const rows = Math.min(2 * reach + 1, size.height - first);
  const { width } = image;
  const pen = new OffscreenCanvas(width, rows).getContext("2d", { willReadFrequently: true });
  if (!pen) throw new Error("out of memory");
  pen.drawImage(image, 0, first - start, width, rows, 0, 0, width, rows);
  const pixels = pen.getImageData(0, 0, width, rows);
  const colours = coloursOf(pixels);
  if (isEnd) return { y: place, colour: colours[0] ?? paper };
  const row = middleOfNearest(colours, place - first);
  return row === null
    ? { y: first + quietestRow(pixels, place - first, reach), colour: paper }
    : { y: first + row, colour: colours[row] ?? paper };
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
 * Returns the row of an image at which the fewest outlines, as of letters and figures, are cut through; of
 * rows that are much alike the nearest to a row.
 *
 * @param reach how far it may be from there, rows
 */
function quietestRow(image: ImageData, to: number, reach: number): number {
  const edges = Array.from({ length: image.height }, (_, row) => edgesOf(image, row));
  // What lies just beside a cut is seen as cut too.
  const beside = Math.ceil(reach / 32);
  let best = { row: to, cost: Number.POSITIVE_INFINITY };
  for (let row = 0; row < edges.length; row++) {
    const around = edges.slice(Math.max(row - beside, 0), row + beside + 1);
    const crossed = around.reduce((sum, count) => sum + count, 0) / around.length;
    const cost = (1 + crossed) * (1 + Math.abs(row - to) / Math.max(reach, 1));
    if (cost < best.cost) best = { row, cost };
  }
  return best.row;
}

/** Returns how often a row's colour changes by more than noise. */
function edgesOf({ data, width }: ImageData, row: number): number {
  let count = 0;
  for (let x = 1; x < width; x++) {
    const at = 4 * (row * width + x);
    let isEdge = false;
    for (let k = at; k < at + 4; k++) {
      isEdge ||= Math.abs((data[k] as number) - (data[k - 4] as number)) > noise;
    }
    if (isEdge) count += 1;
  }
  return count;
}

/**
 * Draws a part of a page of a strip, with what lies between two cuts in its middle, as wide as the page.
 *
 * @param part the part of the page that is drawn, in the strip's pixels
 * @param pixels how large it is drawn
 */
export async function drawStripPage(
  strip: Strip,
  page: StripPage,
  part: PageBox,
  pixels: PageSize,
): Promise<ImageBitmap> {
  const { top: from, bottom: to } = rowsOfPage(strip.size, page);
  const { image, first } = await strip.rows(from, to);
  try {
    const [top, bottom] = [page.index, page.index + 1].map((k) =>
      cutOf(image, first, strip.size, page, k),
    ) as [Cut, Cut];
    return await drawBetween(image, first, [top, bottom], page, part, pixels);
  } finally {
    image.close();
  }
}

/** As `drawStripPage`, of an image that has the rows between the cuts, which begins at the strip's row `first`. */
async function drawBetween(
  image: ImageBitmap,
  first: number,
  [top, bottom]: readonly [Cut, Cut],
  { ratio }: StripPage,
  part: PageBox,
  pixels: PageSize,
): Promise<ImageBitmap> {
  const canvas = new OffscreenCanvas(pixels.width, pixels.height);
  const pen = canvas.getContext("2d");
  if (!pen) throw new Error("out of memory");
  const scale = pixels.height / part.height;
  const height = image.width * ratio;
  const above = (height - (bottom.y - top.y)) / 2;
  const middle = Math.round((height / 2 - part.y) * scale);
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
    const rows = Math.max(Math.round((to - from) * scale), 1);
    const box = { x: part.x, y: from - first, width: part.width, height: to - from };
    const piece = await cropImage(image, box, { width: pixels.width, height: rows });
    pen.drawImage(piece, 0, y);
    piece.close();
  }
  return canvas.transferToImageBitmap();
}
