/** The plates: which there are, where they stand, and how one is put on its page. */
import { COLOUR, MEASURE, mm, num } from "../measures.mjs";
import { boat } from "./boat.mjs";
import { breach } from "./breach.mjs";
import { chart, chartNames } from "./chart.mjs";
import { flukes } from "./flukes.mjs";
import { Graver } from "./graver.mjs";
import { harpoons } from "./harpoons.mjs";
import { inn } from "./inn.mjs";
import { lighthouse } from "./lighthouse.mjs";
import { ship } from "./ship.mjs";

/** Size of a picture, in points; each plate draws within (0, 0) to (WIDE, HIGH). */
const WIDE = MEASURE;
const HIGH = mm(134);
const TOP = mm(26);

/** `chapter` is the chapter whose opening a plate stands by; the others are placed by name. */
export const PLATES = [
  {
    name: "breach",
    title: "The white whale",
    draw: breach,
    caption: "“…one grand hooded phantom, like a snow hill in the air.”",
  },
  {
    name: "ship",
    title: "The whaleship under the moon",
    draw: ship,
    caption: "“…and see the watery part of the world.”",
  },
  {
    name: "inn",
    title: "The Spouter-Inn",
    draw: inn,
    chapter: 3,
    caption: "“…a queer sort of place—a gable-ended old house…”",
  },
  {
    name: "boat",
    title: "The whaleboat",
    draw: boat,
    chapter: 7,
    caption: "“…towed out of sight by a Whale…”",
  },
  {
    name: "flukes",
    title: "The flukes",
    draw: flukes,
    chapter: 9,
    caption: "“…and all the watery world of woe bowled over him.”",
  },
  {
    name: "harpoons",
    title: "The irons",
    draw: harpoons,
    chapter: 13,
    caption: "“…well tried in many a mortal combat…”",
  },
  {
    name: "chart",
    title: "A chart of Nantucket",
    draw: chart,
    names: chartNames,
    chapter: 14,
    caption: "“Nantucket! Take out your map and look at it.”",
  },
  {
    name: "lighthouse",
    title: "The lighthouse",
    draw: lighthouse,
    caption: "“…more lonely than the Eddystone lighthouse.”",
  },
];

export function drawPlate(paper, name, left) {
  const plate = PLATES.find((p) => p.name === name);
  const graver = new Graver();
  plate.draw(graver, WIDE, HIGH);
  paper.op(graver.at(left, TOP));
  for (const [text, x, y, style] of plate.names?.(WIDE, HIGH) ?? []) {
    if (style.bare) clearGround(paper, text, left + x, TOP + y, style);
    paper.words(text, left + x, TOP + y, style);
  }
  paper.words(plate.caption, left + MEASURE / 2, TOP + HIGH + 25, {
    face: "italic",
    size: 11.8,
    align: "centre",
  });
}

/** Paper behind a name, so that no line runs through it. */
function clearGround(paper, text, x, y, { face = "roman", size, features, track = 0 }) {
  const wide = paper.shape(face, size, text, features).width + track * text.length + 4;
  paper.fill(COLOUR.paper);
  paper.op(`${num(x - wide / 2)} ${num(y - size * 0.78)} ${num(wide)} ${num(size * 1.1)} re f`);
}
