/** How flowing text is set: the style sheets that follow from what the reader chooses. */

import { areaDeclarations, columnSpan } from "../markup/paged_css.ts";
import type { PageColours, PageSize, Typography } from "../page_source.ts";
import { pieceStyle } from "./divide.ts";
import { generatedStyle } from "./fit_type.ts";
import type { PageMeasures } from "./page_measures.ts";
import { serif } from "./serif.ts";
import { textElements } from "./text_elements.ts";
import { stackOf } from "./typefaces/typefaces.ts";

/** Typography as the book has it. */
export const ownTypography: Typography = {
  font: "",
  size: 1,
  lineHeight: 0,
  margins: 1,
  align: "",
  hyphens: "",
  letterSpacing: 0,
  wordSpacing: 0,
  width: 0,
};

/** The style sheet beneath the book's own. A theme of high contrast colours controls, and not what is printed. */
export const baseStyle: string = `
* { forced-color-adjust: none !important; }
html { font: 16px/1.45 ${serif}; color: #000; }
p { widows: 2; orphans: 2; }
h1, h2, h3, h4, h5, h6 { break-after: avoid; break-inside: avoid; }
figure, tr { break-inside: avoid; }
pre { white-space: pre-wrap; }
dialog { position: static; }
a { color: inherit; }
/* Of words in a formula that are broken, Chromium shows the first line alone. */
:is(mi, mn, mo, ms, mtext) { white-space: nowrap; }
.turnleaf-sound {
  display: inline-block; box-sizing: border-box; width: 300px; max-width: 100%; height: 40px;
  border: 1px solid #8888; border-radius: 20px; background: #8882; vertical-align: middle;
}
.turnleaf-film { display: inline-block; background: #000; }
`;

/** Returns the style sheet above the book's own. */
export function readerStyle(typography: Typography): string {
  const { font, lineHeight, hyphens, letterSpacing, wordSpacing } = typography;
  const rules = [];
  if (font !== "") rules.push(`${textElements} { font-family: ${stackOf(font)} !important; }`);
  if (lineHeight > 0) {
    rules.push(
      `html, body, div, section, article, p, li, dd, dt, blockquote { line-height: ${lineHeight} !important; }`,
    );
  }
  if (hyphens !== "") rules.push(`${textElements} { hyphens: ${hyphens} !important; }`);
  for (const [name, space] of [
    ["letter-spacing", letterSpacing],
    ["word-spacing", wordSpacing],
  ] as const) {
    if (space > 0) rules.push(`${textElements} { ${name}: ${space}em !important; }`);
  }
  return rules.join("\n");
}

/** The attribute of what is read aloud, which is seen in any colours. */
export const spokenAttribute = "data-turnleaf-spoken";

/**
 * Returns the style sheet above all others where the reader chose colours. Pictures keep theirs; on dark
 * paper those that are clear in part lie on white, as they are drawn for it.
 */
export function colourStyle({ ink, link, isDark }: PageColours): string {
  // The page is drawn within an SVG: drawings of the book's own are within its <html>.
  const inDrawing = "html svg *";
  const pictures = "html :is(img, svg, video, canvas, object)";
  return `
:is(html, html *):not(${inDrawing}) { color: ${ink} !important; background: none !important; border-color: currentColor !important; text-shadow: none !important; }
:is(html a[href], html a[href] *):not(${inDrawing}) { color: ${link} !important; }
hr { background: currentColor !important; }
[${spokenAttribute}], [${spokenAttribute}] * { color: #000 !important; background-color: #ffe27a !important; }
${isDark ? `${pictures}:not(${inDrawing}) { color: #000 !important; background: #fff !important; }` : ""}`;
}

/** The body of a section that is set into pages. */
const bodyStyle = `body {
  width: auto !important; height: auto !important; max-width: none !important; max-height: none !important;
  min-width: 0 !important; min-height: 0 !important; position: static !important; float: none !important;
  margin: 0 !important; padding: 0 !important; overflow: visible !important; columns: auto !important;
  transform: none !important; translate: none !important; rotate: none !important; scale: none !important;
  ${columnSpan}: none !important;
}`;

/** Of what moves, a page shows where it ends, at once: words that come into sight are there. */
const stillStyle = `*, ::before, ::after, ::marker {
  animation-duration: 0s !important; animation-delay: 0s !important; animation-play-state: running !important;
  animation-timeline: auto !important; transition: none !important;
}`;

/** Everything in it. */
const everyStyle = `* { text-rendering: geometricPrecision !important; overflow-wrap: break-word; }${stillStyle}${pieceStyle}${generatedStyle}`;

/** Returns the style sheet that sets a section into pages as columns. */
export function columnStyle(page: PageMeasures, isVertical: boolean, direction: string): string {
  const across = page.width - 2 * page.sides;
  const down = page.height - 2 * page.ends;
  const [column, gap] = isVertical ? [down, 2 * page.ends] : [across, 2 * page.sides];
  return `
html {
  ${areaDeclarations(across, down, isVertical)}
  display: block !important; position: absolute !important; box-sizing: content-box !important;
  left: ${page.sides}px !important; top: ${page.ends}px !important;
  width: ${across}px !important; height: ${down}px !important;
  min-width: 0 !important; min-height: 0 !important; max-width: none !important; max-height: none !important;
  margin: 0 !important; padding: 0 !important; border: 0 !important; overflow: visible !important;
  direction: ${direction} !important; column-width: ${column}px !important; column-count: auto !important; column-gap: ${gap}px !important;
  column-fill: auto !important; column-rule: none !important; transform: none !important;
}
${bodyStyle}
img, svg, video, canvas, image, object {
  max-width: ${across}px !important; max-height: ${down}px !important; box-sizing: border-box !important; break-inside: avoid;
}
img, video { object-fit: contain; }
${everyStyle}
`;
}

/** Returns the style sheet that sets a section into one column, as high as it takes. */
export function rollStyle(page: PageMeasures): string {
  const across = page.width - 2 * page.sides;
  return `
html {
  ${areaDeclarations(across, page.height - 2 * page.ends, false)}
  display: flow-root !important; position: absolute !important; box-sizing: content-box !important;
  left: ${page.sides}px !important; top: ${page.ends}px !important;
  width: ${across}px !important; height: auto !important;
  min-width: 0 !important; min-height: 0 !important; max-width: none !important; max-height: none !important;
  margin: 0 !important; padding: 0 !important; border: 0 !important; overflow: visible !important;
  columns: auto !important; transform: none !important;
}
${bodyStyle}
img, svg, video, canvas, image, object { max-width: ${across}px !important; box-sizing: border-box !important; }
${everyStyle}
`;
}

/** Returns the style sheet of a page of fixed layout. */
export function fixedStyle({ width, height }: PageSize): string {
  return `
html {
  ${areaDeclarations(width, height, false)}
  display: block !important; position: absolute !important; left: 0 !important; top: 0 !important;
  width: ${width}px; height: ${height}px; overflow: hidden !important;
}
* { text-rendering: geometricPrecision !important; }
${stillStyle}
`;
}
