/** Where a page of any size lies on its leaf, or on a board. */

import type { PageBox, PageSize } from "../sources/page_source.ts";

/** The edge of a page's picture that lies at the spine. */
export type SpineEdge = "left" | "right" | "top" | "bottom";

/** What a page is printed on: a leaf whose spine lies at an edge of the picture, or a cover's board. */
export type PrintedOn = SpineEdge | "board";

/** Difference of sizes that nobody sees, so that a picture may just be stretched. */
const unseen = 0.015;

/** A page smaller than its leaf by no more than this share has a margin there; a smaller one a smaller leaf. */
const margin = 0.08;

/** From this share of a leaf's width on a page is folded; below it is made to fit. */
const foldFrom = 1.2;

/** Where a fold-out is folded, share of the leaf from the spine; the flap beyond is no wider. */
export const foldAt = 0.98;

/** Widest a page is, in widths of the book; shares of a leaf that a page has at least, the longer way. */
const widest = 1.95;
const least = 0.5;

/** Difference of proportions up to which a cover is cut to its board rather than set upon it. */
const mostCut = 0.2;

/** All of a leaf. */
export const wholeLeaf: PageBox = { x: 0, y: 0, width: 1, height: 1 };

/**
 * The part of a leaf that a page covers, shares of the leaf from its upper left
 * corner: as large beside the book's pages as it says it is, no larger than the
 * book, and at the spine. A page clearly wider than the book reaches beyond the
 * fore-edge; on a board it is as large as the board.
 *
 * @param leaf size of the book's pages in the same unit
 * @param isTrue whether sizes are those of paper; those of scans tell proportions alone
 */
export function placeOnLeaf(
  size: PageSize,
  leaf: PageSize,
  isTrue: boolean,
  on: PrintedOn,
): PageBox {
  const aspect = size.width / size.height / (leaf.width / leaf.height);
  if (on === "board") return placeOnBoard(aspect);
  const [width, height] = sharesOf(size, leaf, aspect, isTrue, on === "left" || on === "right");
  if (width === 1 && height === 1) return wholeLeaf;
  return {
    x: on === "left" ? 0 : on === "right" ? 1 - width : (1 - width) / 2,
    y: on === "top" ? 0 : on === "bottom" ? 1 - height : (1 - height) / 2,
    width,
    height,
  };
}

/** A page's width and height as shares of its leaf's. */
function sharesOf(
  size: PageSize,
  leaf: PageSize,
  aspect: number,
  isTrue: boolean,
  mayFold: boolean,
): [width: number, height: number] {
  const tall = size.height / leaf.height;
  let scale = isTrue ? tall : 1;
  // A scan as high as others and wider is of a wider page; another may be of any.
  const isAsHigh = isTrue || Math.abs(Math.log(tall)) < Math.log(1.3);
  const isWide = aspect * Math.min(scale, 1) > foldFrom;
  const most = mayFold && isAsHigh && isWide ? widest : 1;
  scale = Math.min(Math.max(scale, least / Math.max(aspect, 1)), 1, most / aspect);
  if (Math.abs(aspect - 1) <= unseen && scale > 1 - margin) return [1, 1];
  return [aspect * scale, scale];
}

/** A cover of nearly the board's proportions is cut to them; another lies upon it whole. */
function placeOnBoard(aspect: number): PageBox {
  if (Math.abs(aspect - 1) <= unseen) return wholeLeaf;
  const isCut = Math.abs(Math.log(aspect)) < Math.log(1 + mostCut);
  const [width, height] = isCut === aspect > 1 ? [aspect, 1] : [1, 1 / aspect];
  return { x: (1 - width) / 2, y: (1 - height) / 2, width, height };
}

/** Whether a leaf is cut to a page that covers so much of it, rather than left with a margin. */
export function isTrimmed({ width, height }: PageBox): boolean {
  return Math.min(width, height) < 1 - margin;
}

/** Whether a page that covers a part of a leaf reaches beyond it, folded. */
export function isFoldOut({ width }: PageBox): boolean {
  return width > foldFrom;
}
