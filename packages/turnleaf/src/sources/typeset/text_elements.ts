/** Which elements text stands in. */

/** Elements of text: browsers give them fonts and margins, and neither a place, a cut nor a movement. */
export const textElements: string =
  "html, body, div, section, article, p, li, dd, dt, blockquote, td, th, span, em, i, strong, b, a, small";
