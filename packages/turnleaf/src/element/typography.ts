/** How flowing text is set, by the element's attributes. */

import { attributeOf, attributesThat } from "../attributes.ts";
import type { Typography } from "../sources/page_source.ts";

/** Attributes that say how flowing text is set. */
export const typographyAttributes: readonly string[] = attributesThat("typeset");

/** What a reader chooses of how text is set; the size is that of the page as it is shown. */
export type ChosenTypography = Omit<Typography, "width" | "height">;

/** Returns what the attributes say; an invalid value counts as missing. */
export function typographyOf(element: Element): ChosenTypography {
  return {
    font: attributeOf(element, "font"),
    size: attributeOf(element, "fontSize"),
    lineHeight: attributeOf(element, "lineHeight"),
    margins: attributeOf(element, "margins"),
    align: attributeOf(element, "textAlign"),
    hyphens: attributeOf(element, "hyphens"),
    letterSpacing: attributeOf(element, "letterSpacing"),
    wordSpacing: attributeOf(element, "wordSpacing"),
  };
}
