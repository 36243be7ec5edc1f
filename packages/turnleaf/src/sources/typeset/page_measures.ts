/**
 * How large a page of flowing text is. It is set for the size at which it is shown, so that a CSS
 * pixel of type is one of the screen.
 */

import type { PageSize, Typography } from "../page_source.ts";

/**
 * A page of flowing text whose size on the screen is unknown, CSS pixels: a paperback of 129 by
 * 198 mm (B format). Every page has its proportions, and its size is the unit of places on it.
 */
export const paperback: PageSize = { width: 488, height: 748 };

/** Usual margins as fractions of the page's width: 14 mm at the sides, 16 at head and foot. */
const usualMargin = { sides: 14 / 129, ends: 16 / 129 };

/** The usual type: how wide a letter is on the average, with spaces, and how high a line, CSS pixels. */
export const usualType = { letter: 7, line: 23.2 } as const;

/** Letters below which a line is too short to be read with ease. */
const leastLetters = 38;

/**
 * Width below which a page is not there to be read, CSS pixels: lines of usual type would have half as
 * many letters. It is set as a paperback, and seen as one from afar.
 */
const miniature = ((leastLetters / 2) * usualType.letter) / (1 - 2 * usualMargin.sides);

/** A page's measures in CSS pixels. */
export interface PageMeasures extends PageSize {
  /** Margins at the left and right, and at the head and foot. */
  readonly sides: number;
  readonly ends: number;
}

/** Returns whether a page that is shown in some width, CSS pixels, is set as a paperback: also if that is 0, as it is unknown. */
export function isMiniature(shown: number): boolean {
  return shown < miniature;
}

/**
 * Returns the measures of a page as it is laid out. Larger type is a smaller page that is shown as
 * large: so everything in it grows alike, whatever units the book uses.
 */
export function measuresOf({ size, margins, width: shown }: Typography): PageMeasures {
  const width = Math.round((isMiniature(shown) ? paperback.width : shown) / size);
  const height = Math.round((width * paperback.height) / paperback.width);
  const scaled = (part: number): number => Math.round(part * margins * width);
  return { width, height, sides: scaled(usualMargin.sides), ends: scaled(usualMargin.ends) };
}

/**
 * Returns whether two pages may be shown side by side: whether their lines are read with ease.
 *
 * @param width of each then, CSS pixels
 * @param alone width of a page that is shown alone, likewise
 */
export function mayFace(
  { size, margins, letterSpacing }: Omit<Typography, "width">,
  width: number,
  alone: number,
): boolean {
  const line = width * (1 - 2 * usualMargin.sides * margins);
  const letter = (usualType.letter + 16 * letterSpacing) * size;
  return line >= leastLetters * letter || isMiniature(alone);
}
