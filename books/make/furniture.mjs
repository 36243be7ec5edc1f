/** What every page of a book carries besides its text: running heads and folios. */
import { COLOUR, FOLIO_LINE, HEAD_LINE, MEASURE } from "./measures.mjs";

/** The running head, in letterspaced small caps, centred over the block. */
export function runningHead(paper, text, left) {
  paper.words(text.toLowerCase(), left + MEASURE / 2, HEAD_LINE, {
    size: 9.6,
    track: 1.5,
    features: ["smcp", "onum"],
    align: "centre",
    colour: COLOUR.ink,
  });
}

/** The page number, in old-style figures at the foot. */
export function folio(paper, text, left) {
  paper.words(text, left + MEASURE / 2, FOLIO_LINE, {
    size: 10.4,
    track: 0.3,
    features: ["onum", "pnum"],
    align: "centre",
  });
}

const ROMAN = [
  ["x", 10],
  ["ix", 9],
  ["v", 5],
  ["iv", 4],
  ["i", 1],
];

/** A number in small roman numerals. */
export function roman(n) {
  let rest = n;
  let text = "";
  for (const [sign, value] of ROMAN) {
    for (; rest >= value; rest -= value) text += sign;
  }
  return text;
}
