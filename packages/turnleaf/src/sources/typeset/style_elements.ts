/** Style sheets as they stand in a drawing. */

import { xmlText } from "../markup/xml.ts";

/** Returns style sheets as elements of an SVG, each its own: a namespace's prefix holds in one sheet only. */
export function styleElements(sheets: readonly string[]): string {
  return sheets.map((css) => `<style>${xmlText(css)}</style>`).join("");
}
