/** The boards: red cloth stamped in gold. */
import { boardCloth } from "./cloth.mjs";
import { drawFluke } from "./fluke.mjs";
import { COLOUR, mm, PAGE } from "./measures.mjs";
import { Graver } from "./plates/graver.mjs";
import { drawWhale } from "./whale.mjs";

/** Gold is stamped into the cloth: a dark edge falls above it, a light one below. */
const DEPTH = 0.55;
const SHADE = "#45140f";

/** Stamp what `draw(graver, gold, cloth)` draws: first its shade, then itself. */
function stamp(paper, draw) {
  for (const [dx, dy, ink, cut] of [
    [-DEPTH * 0.6, -DEPTH, SHADE, SHADE],
    [0, 0, COLOUR.gold, COLOUR.cloth],
  ]) {
    const graver = new Graver({ ink, ground: cut });
    draw(graver, ink, cut);
    paper.op(graver.at(dx, dy));
  }
}

function letters(paper, text, y, style) {
  const set = { ...style, align: "centre" };
  const x = PAGE.width / 2 + (style.track ?? 0) / 2;
  paper.words(text, x - DEPTH * 0.6, y - DEPTH, { ...set, colour: SHADE });
  paper.words(text, x, y, { ...set, colour: COLOUR.gold });
}

/** Two gold rules near the edge, the outer the stronger, with small corner pieces. */
function frame(graver) {
  for (const [inset, width] of [
    [mm(9), 1.7],
    [mm(11.2), 0.7],
  ]) {
    const w = PAGE.width - inset;
    const h = PAGE.height - inset;
    graver.line(
      [
        [inset, inset],
        [w, inset],
        [w, h],
        [inset, h],
      ],
      width,
      true,
    );
  }
}

export function frontBoard(paper) {
  boardCloth(paper);
  stamp(paper, (graver, ink, cut) => {
    frame(graver);
    drawWhale(graver, { x: PAGE.width / 2 - 17, y: mm(118), scale: 0.9, ink, cut });
  });
  letters(paper, "MOBY-DICK", mm(54), { face: "medium", size: 41, track: 3.4, features: ["lnum"] });
  letters(paper, "or, The Whale", mm(66), { face: "italic", size: 19 });
  letters(paper, "HERMAN MELVILLE", mm(176), { size: 15, track: 3, features: ["lnum"] });
}

export function backBoard(paper) {
  boardCloth(paper);
  stamp(paper, (graver, ink, cut) => {
    frame(graver);
    drawFluke(graver, { x: PAGE.width / 2, y: mm(103), scale: 0.62, ink, cut });
  });
}
