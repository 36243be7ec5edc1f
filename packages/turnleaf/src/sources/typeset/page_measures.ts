/**
 * How large a page of flowing text is. It is set for the size at which it is shown, so that a CSS
 * pixel of type is one of the screen.
 */

import type { PageSize, Typography } from "../page_source.ts";

/**
 * A page of flowing text whose size on the screen is unknown, CSS pixels: a paperback of 129 by
 * 198 mm (B format). Its width is the unit of places on every page.
 */
export const paperback: PageSize = { width: 488, height: 748 };

/** Usual margins, 14 and 16 mm of a paperback: at the sides as a fraction of the page's width, at head and foot of its height. */
const usualMargin = {
  sides: 14 / 129,
  ends: ((16 / 129) * paperback.width) / paperback.height,
};

/** The usual type: how wide a letter is on the average, with spaces, and how high a line, CSS pixels. */
export const usualType = { letter: 7, line: 23.2 } as const;

/** Letters below which a line is too short to be read with ease. */
const leastLetters = 38;

/** Letters that a line has for good reading, of each of two pages and of one by itself: Bringhurst's 45, and 66. */
const goodLetters = { facing: 45, alone: 66 } as const;

/** How a page of flowing text is set, apart from its size on the screen. */
type PagelessTypography = Omit<Typography, "width" | "height">;

/** A page's measures in CSS pixels. */
export interface PageMeasures extends PageSize {
  /** Margins at the left and right, and at the head and foot. */
  readonly sides: number;
  readonly ends: number;
}

/** Returns how wide a page is whose lines have some letters, CSS pixels. */
function widthFor(
  letters: number,
  { size, margins, letterSpacing }: Pick<PagelessTypography, "size" | "margins" | "letterSpacing">,
): number {
  const letter = (usualType.letter + 16 * letterSpacing) * size;
  return (letters * letter) / (1 - 2 * usualMargin.sides * margins);
}

/**
 * Area below which a page is not there to be read, CSS pixels: that of a paperback whose lines of usual
 * type have half as many letters as they need. It is set as a paperback, and seen as one from afar.
 */
const miniatureArea =
  (widthFor(leastLetters / 2, { size: 1, margins: 1, letterSpacing: 0 }) ** 2 * paperback.height) /
  paperback.width;

/** Returns whether a page that is shown in some size, CSS pixels, is set as a paperback: also if that is 0, as it is unknown. */
export function isMiniature({ width, height }: PageSize): boolean {
  return width * height < miniatureArea;
}

/** Returns in which size a page is shown, CSS pixels; a paperback's if that is not known, or as good as none. */
function shownSize({ width, height }: Pick<Typography, "width" | "height">): PageSize {
  const shown = { width, height: height || (width * paperback.height) / paperback.width };
  return isMiniature(shown) ? paperback : shown;
}

/** Returns the size of a page of flowing text, in the unit of places on it. */
export function leafOf(typography: Pick<Typography, "width" | "height">): PageSize {
  const { width, height } = shownSize(typography);
  return { width: paperback.width, height: (paperback.width * height) / width };
}

/**
 * Returns the measures of a page as it is laid out. Larger type is a smaller page that is shown as
 * large: so everything in it grows alike, whatever units the book uses.
 */
export function measuresOf(typography: Typography): PageMeasures {
  const { size, margins } = typography;
  const shown = shownSize(typography);
  const width = Math.round(shown.width / size);
  const height = Math.round((width * shown.height) / shown.width);
  return {
    width,
    height,
    sides: Math.round(usualMargin.sides * margins * width),
    ends: Math.round(usualMargin.ends * margins * height),
  };
}

/**
 * Returns how wide a page is to be so that its lines are good ones to read, CSS pixels, where a paperback
 * as high would be narrower.
 *
 * @param place beside another, or alone as two have no room
 */
export function wantedWidth(typography: PagelessTypography, place: "facing" | "alone"): number {
  return widthFor(goodLetters[place], typography);
}

/**
 * Returns whether two pages may be shown side by side: whether their lines are read with ease.
 *
 * @param width of each then, CSS pixels
 * @param alone size of a page that is shown alone, likewise
 */
export function mayFace(typography: PagelessTypography, width: number, alone: PageSize): boolean {
  return width >= widthFor(leastLetters, typography) || isMiniature(alone);
}
