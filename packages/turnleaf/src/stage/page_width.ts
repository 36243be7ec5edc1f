/** How large a page of an open book is seen. */

import { layoutFor } from "../book/layout.ts";
import type { CoverKind, Layout } from "../book/spreads.ts";
import type { PageSize } from "../sources/page_source.ts";
import { caseSizes } from "./case_sizes.ts";

/** Square root of a page area of 140 x 210 mm, in metres: every book has paper of this size. */
export const paperSize: number = Math.sqrt(0.14 * 0.21);

/** Thickness of a book of 200 leaves, metres. */
const usualThickness = 0.02;

/** What decides, besides its place, how large a page is seen. */
export interface PageFrame {
  /** Its width over its height. */
  readonly aspect: number;
  /** Whether the two pages of a spread lie one above the other. */
  readonly quarterTurned: boolean;
  readonly cover: CoverKind;
  /** As in `BookShape`. */
  readonly margin: number;
}

/**
 * Returns about how wide a page of a book of usual thickness is seen from above, in the unit of `place`,
 * and whether it could be wider if the place were higher: before the book is bound, whose own size the
 * stage knows.
 */
function pageIn(
  place: PageSize,
  layout: Layout,
  { aspect, quarterTurned, cover, margin }: PageFrame,
): { readonly width: number; readonly isHigh: boolean } {
  const [width, height] = [paperSize * Math.sqrt(aspect), paperSize / Math.sqrt(aspect)];
  const rim = cover === "hard" ? caseSizes.rim : 0;
  const [across, along] = quarterTurned ? [height, width] : [width, height];
  const [room, length] = quarterTurned ? [place.height, place.width] : [place.width, place.height];
  const book = layout === "spread" ? 2 * (across + rim) + usualThickness : across + rim;
  const [fromSpine, alongSpine] = [room / book, length / (along + 2 * rim)];
  const isHigh = quarterTurned ? fromSpine < alongSpine : alongSpine < fromSpine;
  return { width: (1 - 2 * margin) * width * Math.min(fromSpine, alongSpine), isHigh };
}

/** Halvings that find proportions to a ten thousandth. */
const halvings = 16;

/**
 * Returns the proportions, width over height, of a page that is to be as wide as it has to: the least
 * from `frame.aspect` on with which it is, and those with which it fills the place if it is not with any.
 *
 * @param wanted width of the page, in the unit of `place`
 * @param most proportions that a page may have
 */
export function aspectIn(
  place: PageSize,
  layout: Layout,
  frame: PageFrame,
  wanted: number,
  most: number,
): number {
  const isEnough = (aspect: number): boolean => {
    const { width, isHigh } = pageIn(place, layout, { ...frame, aspect });
    return width >= wanted || !isHigh;
  };
  if (isEnough(frame.aspect)) return frame.aspect;
  let [less, enough] = [frame.aspect, most];
  for (let k = 0; k < halvings; k++) {
    const middle = (less + enough) / 2;
    if (isEnough(middle)) enough = middle;
    else less = middle;
  }
  return enough;
}

/**
 * Returns in which layout a book is shown in a place, and about how wide each page then is, likewise.
 *
 * @param requested,before as in `layoutFor`
 * @param mayFace as in `PageSource`
 */
export function layoutIn(
  place: PageSize,
  requested: "auto" | Layout,
  before: Layout | null,
  frame: PageFrame,
  mayFace: (width: number, alone: number) => boolean,
): { readonly layout: Layout; readonly width: number } {
  const wide = (layout: Layout): number => pageIn(place, layout, frame).width;
  const { width, height } = place;
  const { aspect, quarterTurned } = frame;
  const mayBoth = mayFace(wide("spread"), wide("single"));
  const layout = layoutFor(requested, aspect, quarterTurned, width, height, before, mayBoth);
  return { layout, width: wide(layout) };
}
