/** Small devices: the ornament of the title page and the tailpiece. */
import { drawFluke } from "./fluke.mjs";
import { MEASURE, mm } from "./measures.mjs";
import { Graver } from "./plates/graver.mjs";
import { drawWhale } from "./whale.mjs";

/** A whale, centred at (x, y). */
export function device(paper, x, y) {
  const graver = new Graver();
  drawWhale(graver, { x: 0, y: 0, scale: 0.55, ink: graver.ink, cut: graver.ground });
  paper.op(graver.at(x, y));
}

/** After the last chapter: a whale that sounds, and the end told. */
export function tailpiece(paper, { left }) {
  const x = left + MEASURE / 2;
  const graver = new Graver();
  drawFluke(graver, { x: 0, y: 0, scale: 0.8, ink: graver.ink, cut: graver.ground });
  paper.op(graver.at(x, mm(92)));
  paper.words("Here end the first fourteen chapters", x, mm(112), {
    face: "italic",
    size: 11.5,
    align: "centre",
  });
}
