/** How flowing text is set, by the element's attributes. */

import type { Typography } from "../sources/page_source.ts";

/** Attributes that say how flowing text is set. */
export const typographyAttributes = [
  "font",
  "font-size",
  "line-height",
  "margins",
  "text-align",
  "hyphens",
  "letter-spacing",
  "word-spacing",
] as const;

/** What a reader chooses of how text is set; the size is that of the page as it is shown. */
export type ChosenTypography = Omit<Typography, "width" | "height">;

/** Returns what the attributes say; an invalid value counts as missing. */
export function typographyOf(element: Element): ChosenTypography {
  const word = <W extends string>(name: string, words: readonly W[]): W | "" =>
    words.find((known) => known === element.getAttribute(name)) ?? "";
  const number = (name: string, least: number, most: number, usual: number): number => {
    const given = Number(element.getAttribute(name)?.trim() || usual);
    return given >= least && given <= most ? given : usual;
  };
  return {
    font: word("font", ["serif", "sans-serif", "legible", "dyslexic"]),
    size: number("font-size", 0.5, 3, 1),
    lineHeight: number("line-height", 1, 3, 0),
    margins: number("margins", 0, 2, 1),
    align: word("text-align", ["justify", "start"]),
    hyphens: word("hyphens", ["auto", "none"]),
    letterSpacing: number("letter-spacing", 0, 1, 0),
    wordSpacing: number("word-spacing", 0, 1, 0),
  };
}
