/** Where a page of any size lies on its leaf, or on a board. */

import type { PageBox, PageSize } from "../sources/page_source.ts";

/** The edge of a page's bitmap that lies at the spine. */
export type SpineEdge = "left" | "right" | "top" | "bottom";

/**
 * What a page is printed on: a leaf whose spine lies at an edge of the bitmap,
 * or a cover's board.
 */
export type PrintedOn = SpineEdge | "board";

/** Imperceptible difference of sizes, for which a bitmap may simply be stretched. */
const unseen = 0.015;

/**
 * A page smaller than its leaf by no more than this fraction gets a margin
 * there; for a smaller one the leaf is trimmed.
 */
const margin = 0.08;

/** From this fraction of a leaf's width on a page is folded; below it is made to fit. */
const foldFrom = 1.2;

/**
 * Position of a fold-out's fold, as a fraction of the leaf from the spine; no
 * panel beyond is wider, so that shut it lies on its page.
 */
export const foldAt = 0.98;

/**
 * Maximum width of a panel of a fold-out, as a fraction of the leaf, and of
 * panels, as the engine folds no more.
 */
const widestPanel = 0.97;
const mostPanels = 3;

/**
 * Maximum width of a page, in widths of the book; and the minimum fraction of a
 * leaf that a page has in the longer direction.
 */
const widest = foldAt + mostPanels * widestPanel;
const least = 0.5;

/** Far below a pixel: widths that rounding makes larger count as they were. */
const rounded = 1e-6;

/** Difference of proportions up to which a cover is cropped to its board rather than set on it. */
const mostCut = 0.2;

/** The whole leaf. */
export const wholeLeaf: PageBox = { x: 0, y: 0, width: 1, height: 1 };

/**
 * Returns the part of a leaf that a page covers, in fractions of the leaf from
 * its upper left corner: at its own size relative to the book's pages, no
 * larger than the book, and at the spine. A page clearly wider than the book
 * reaches beyond the fore-edge; on a board it is as large as the board.
 *
 * @param leaf size of the book's pages in the same unit
 * @param isTrue whether sizes are those of paper; those of scans give only
 * proportions
 */
export function placeOnLeaf(
  size: PageSize,
  leaf: PageSize,
  isTrue: boolean,
  on: PrintedOn,
): PageBox {
  const aspect = size.width / size.height / (leaf.width / leaf.height);
  if (on === "board") return placeOnBoard(aspect);
  const [width, height] = fractionsOf(size, leaf, aspect, isTrue, on === "left" || on === "right");
  if (width === 1 && height === 1) return wholeLeaf;
  return {
    x: on === "left" ? 0 : on === "right" ? 1 - width : (1 - width) / 2,
    y: on === "top" ? 0 : on === "bottom" ? 1 - height : (1 - height) / 2,
    width,
    height,
  };
}

/** Returns a page's width and height as fractions of its leaf's. */
function fractionsOf(
  size: PageSize,
  leaf: PageSize,
  aspect: number,
  isTrue: boolean,
  mayFold: boolean,
): [width: number, height: number] {
  const tall = size.height / leaf.height;
  let scale = isTrue ? tall : 1;
  // A scan as high as others and wider is of a wider page; another may be of any size.
  const isAsHigh = isTrue || Math.abs(Math.log(tall)) < Math.log(1.3);
  const isWide = aspect * Math.min(scale, 1) > foldFrom;
  const most = mayFold && isAsHigh && isWide ? widest : 1;
  scale = Math.min(Math.max(scale, least / Math.max(aspect, 1)), 1, most / aspect);
  if (Math.abs(aspect - 1) <= unseen && scale > 1 - margin) return [1, 1];
  return [aspect * scale, scale];
}

/** Crops a cover of nearly the board's proportions; another lies on it whole. */
function placeOnBoard(aspect: number): PageBox {
  if (Math.abs(aspect - 1) <= unseen) return wholeLeaf;
  const isCut = Math.abs(Math.log(aspect)) < Math.log(1 + mostCut);
  const [width, height] = isCut === aspect > 1 ? [aspect, 1] : [1, 1 / aspect];
  return { x: (1 - width) / 2, y: (1 - height) / 2, width, height };
}

/**
 * Returns whether a leaf is trimmed to a page that covers this part of it,
 * rather than left with a margin.
 */
export function isTrimmed({ width, height }: PageBox): boolean {
  return Math.min(width, height) < 1 - margin;
}

/**
 * Returns into how many panels the flap of a fold-out is folded, as few as
 * there can be, and how wide each is, as a fraction of the leaf. More than one
 * are folded to both sides by turns.
 */
export function panelsOf({ width }: PageBox): { readonly panels: number; readonly across: number } {
  const flap = width - foldAt;
  const panels = Math.max(Math.ceil(flap / widestPanel - rounded), 1);
  return { panels, across: flap / panels };
}

/** Returns whether a page that covers a part of a leaf reaches beyond it, folded. */
export function isFoldOut({ width }: PageBox): boolean {
  return width > foldFrom;
}
