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
 * Returns about how wide a page of a book of usual thickness is seen from above, in the unit of `place`:
 * before the book is bound, whose own size the stage knows.
 */
function pageWidthIn(
  place: PageSize,
  layout: Layout,
  { aspect, quarterTurned, cover, margin }: PageFrame,
): number {
  const [width, height] = [paperSize * Math.sqrt(aspect), paperSize / Math.sqrt(aspect)];
  const rim = cover === "hard" ? caseSizes.rim : 0;
  const [across, along] = quarterTurned ? [height, width] : [width, height];
  const [room, length] = quarterTurned ? [place.height, place.width] : [place.width, place.height];
  const book = layout === "spread" ? 2 * (across + rim) + usualThickness : across + rim;
  return (1 - 2 * margin) * width * Math.min(room / book, length / (along + 2 * rim));
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
  const wide = (layout: Layout): number => pageWidthIn(place, layout, frame);
  const { width, height } = place;
  const { aspect, quarterTurned } = frame;
  const mayBoth = mayFace(wide("spread"), wide("single"));
  const layout = layoutFor(requested, aspect, quarterTurned, width, height, before, mayBoth);
  return { layout, width: wide(layout) };
}
