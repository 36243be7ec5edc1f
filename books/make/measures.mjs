/**
 * The measures of the book, in points (72 to the inch), y down from the head.
 * The page is 140 x 210 mm, 2:3. The block keeps the old proportions: the inner
 * margin is the narrowest, then the head, the fore-edge and the foot.
 */
const MM = 72 / 25.4;
export const mm = (v) => v * MM;

export const PAGE = { width: mm(140), height: mm(210) };

/** How far grounds run past the page. */
export const BLEED = 4;

export const SIZE = 11.3; // body type
export const LEAD = 14.8; // one line of the baseline grid
export const ROWS = 30; // lines on a full page
export const MEASURE = mm(101); // length of a line
export const INDENT = 15;

const INNER = mm(18);
const TOP = mm(23);

/** Left edge of the block: the inner margin lies at the spine. */
export const blockLeft = (recto) => (recto ? INNER : PAGE.width - INNER - MEASURE);
/** Baseline of a row of the grid, row 0 being the first line of a full page. */
export const baseline = (row) => TOP + 9 + row * LEAD;
export const HEAD_LINE = mm(16.2);
export const FOLIO_LINE = mm(192);

export const COLOUR = {
  paper: "#fbf5e8",
  ink: "#211d1a",
  soft: "#6d6257",
  cloth: "#6a2a26",
  gold: "#d8b46a",
  endpaper: "#b9c1b6",
  endLine: "#6f8782",
};

/** A number as short as PDF allows, to a hundredth of a point. */
export const num = (v) => {
  const r = Math.round(v * 100) / 100;
  return Object.is(r, -0) ? "0" : String(r).replace(/^(-?)0\./, "$1.");
};
