/** The endpapers: overlapping waves in fan shape, two quiet inks on a muted ground. */
import { COLOUR, mm, PAGE } from "./measures.mjs";
import { circle } from "./plates/curves.mjs";
import { Graver } from "./plates/graver.mjs";

const RADIUS = mm(10);
const RINGS = [1, 0.8, 0.62, 0.45, 0.29];

export function drawEndpaper(paper) {
  const row = new Graver({ ink: COLOUR.endLine, ground: COLOUR.endpaper });
  for (let x = 0; x < PAGE.width + RADIUS * 3; x += RADIUS * 2) fan(row, x, 0);
  paper.form("Fans", row.at(0, 0));
  paper.ground(COLOUR.endpaper);
  // Rows from the head down: each row of fans covers the feet of the one above it.
  const step = RADIUS / 2;
  for (let k = 0; k * step - RADIUS < PAGE.height; k++) {
    paper.show("Fans", k % 2 ? -RADIUS : 0, k * step);
  }
}

function fan(graver, x, y) {
  graver.clear(circle(x, y, RADIUS, 48, Math.PI, 2 * Math.PI));
  RINGS.forEach((share, i) => {
    const arc = circle(x, y, RADIUS * share, 40, Math.PI, 2 * Math.PI);
    const width = i === 0 ? 1.15 : 0.75;
    graver.swell(arc, (t) => width * (0.55 + 0.6 * Math.sin(Math.PI * t)));
  });
}
