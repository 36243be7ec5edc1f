/** Style sheets as they stand in a drawing. */

/** Returns style sheets as elements of an SVG, each its own: a namespace's prefix holds in one sheet only. */
export function styleElements(sheets: readonly string[]): string {
  return sheets
    .map((css) => `<style>${css.replaceAll("&", "&amp;").replaceAll("<", "&lt;")}</style>`)
    .join("");
}
