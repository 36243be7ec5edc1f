/** The plates: which there are, where they stand, and how one is put on its page. */
import { MEASURE, mm } from "../measures.mjs";
import { breach } from "./breach.mjs";
import { Graver } from "./graver.mjs";
import { ship } from "./ship.mjs";

/** Size of a picture, in points; each plate draws within (0, 0) to (WIDE, HIGH). */
export const WIDE = MEASURE;
export const HIGH = mm(134);

export const PLATES = [
  {
    name: "breach",
    title: "One grand hooded phantom",
    draw: breach,
    before: true,
    chapter: 1,
    caption: "“…one grand hooded phantom, like a snow hill in the air.”",
  },
  {
    name: "ship",
    title: "The watery part of the world",
    draw: ship,
    before: true,
    chapter: 1,
    caption: "“…and see the watery part of the world.”",
  },
];

export function drawPlate(paper, name, left) {
  const plate = PLATES.find((p) => p.name === name);
  const graver = new Graver();
  plate.draw(graver, WIDE, HIGH);
  const top = mm(25);
  paper.op(graver.at(left, top));
  paper.words(plate.caption, left + MEASURE / 2, top + HIGH + 24, {
    face: "italic",
    size: 11.6,
    align: "centre",
  });
}
