/** The flukes of a sounding whale over a following sea, water pouring from them. */

import { randomNumbers } from "../../../scripts/random_numbers.mjs";
import { between, box, clamp, lerp, pts, smooth, spline } from "./curves.mjs";
import { noise } from "./noise.mjs";
import { fleck, sea } from "./sea.mjs";
import { heaped, sky } from "./sky.mjs";

const MIDDLE = 146;
/** One lobe from the stock out to the tip (leading edge) and back to the notch (trailing edge). */
const LEADING = pts("16,140 11.5,118 9.5,98 12,82 22,69 40,60 62,53 86,43 106,28 120,12");
const TRAILING = pts("0,44 4,35 13,28 27,24.5 44,26 62,29.5 80,29 98,23.5 112,16 120,12");

/** Set a lobe on the page, the pair heeled a little to the left. */
const lobe = (side) => (points) =>
  points.map(([x, y]) => {
    const [px, py] = [x * side * (side < 0 ? 1.03 : 0.97), y * 1.16];
    return [MIDDLE + px + py * 0.05 - 7, 124 + py - px * 0.055];
  });

export function flukes(graver, wide, high) {
  const horizon = high * 0.56;
  graver.within(box(0, 0, wide, high), () => {
    const cloud = heaped({ seed: 88, cover: 0.62, scaleX: 120, scaleY: 46, sun: [-0.6, -1] });
    sky(graver, {
      x0: 0,
      x1: wide,
      y0: 1.4,
      y1: horizon,
      pitch: 2.45,
      bend: (x, y) => 2 * (noise(x / 90, y / 60, 3) - 0.5),
      dark(x, y) {
        const { body, relief } = cloud(x, y);
        const clear = lerp(0.66, 0.12, smooth(10, horizon, y));
        const worked = lerp(
          0.08 + 0.95 * (1 - relief),
          0.05 + 0.5 * (1 - relief),
          smooth(60, horizon, y),
        );
        return clamp(lerp(clear, worked, body * 0.9), 0.05, 0.88);
      },
    });
    const rows = sea(graver, {
      x0: -2,
      x1: wide + 2,
      y0: horizon,
      y1: high + 18,
      rows: 15,
      swell: 0.9,
      reach: 5.2,
      lit: -1,
      seed: 33,
      power: 1.55,
      dark: (x, y) =>
        clamp(
          0.54 + 0.25 * (noise(x / 44, y / 15, 9) - 0.5) + 0.28 * under(x, y) - 0.5 * boil(x, y),
          0.02,
          0.9,
        ),
    });
    let shown = false;
    let far = false;
    for (const y of rows) {
      if (!far && y > horizon + 3) {
        farShip(graver, 232, horizon + 5);
        far = true;
      }
      if (!shown && y > 268) {
        tail(graver);
        pour(graver);
        shown = true;
      }
    }
  });
  graver.line(box(0, 0, wide, high), 0.7, true);
}

const under = (x, y) => Math.exp(-(((x - MIDDLE) / 70) ** 2) - ((y - 312) / 28) ** 2);
const boil = (x, y) => Math.exp(-(((x - MIDDLE) / 54) ** 2) - ((y - 284) / 13) ** 2);

function tail(graver) {
  for (const side of [-1, 1]) {
    const put = lobe(side);
    const leading = put(spline(LEADING));
    const trailing = put(spline(TRAILING));
    const shape = [...put([[0, 140]]), ...leading, ...[...trailing].reverse(), ...put([[0, 44]])];
    graver.clear(shape);
    graver.within(shape, () => {
      const inner = put(spline(pts("0,140 0,115 0,88 0,62 0,44")));
      // Lines sweep from the stock out into the lobe.
      const sweep = [...between(leading, [...inner, ...trailing], 40, 2.2)];
      const n = sweep.length - 1;
      sweep.forEach((line, k) => {
        const u = k / n;
        graver.swell(
          line,
          (t, x, y) => {
            const turn = side < 0 ? 0.12 : 0.3;
            const edge = 0.55 * (1 - smooth(0, 0.2, u));
            const root = 0.5 * smooth(0.55, 0.15, t) * smooth(0, 0.4, u) * (side < 0 ? 0.4 : 1);
            const hollow =
              0.45 * smooth(0.35, 0.6, u) * smooth(0.95, 0.62, u) * smooth(0.3, 0.55, t);
            const wet = 0.4 * smooth(0.58, 0.7, noise(x / 30, y / 5, 12));
            return clamp(turn + edge + root + hollow - wet, 0.07, 0.95) * 2.3;
          },
          0.12,
        );
      });
    });
    graver.swell(leading, (t) => 1.5 + 0.8 * Math.sin(Math.PI * t));
    graver.swell(trailing, (t) => 1.1 + 0.6 * Math.sin(Math.PI * t));
  }
}

/** Water falls in threads from the trailing edges, and smokes where it strikes. */
function pour(graver) {
  const random = randomNumbers(60);
  for (const side of [-1, 1]) {
    const edge = lobe(side)(spline(LEADING.slice(3)));
    for (let k = 0; k < 46; k++) {
      const share = random() ** 1.7;
      const [x, y] = edge[Math.floor(share * (edge.length - 1))];
      const fall = (5 + 62 * random() ** 2.4) * (1 - 0.6 * share);
      const drift = side * (2 + 5 * random()) * (fall / 40);
      const thread = spline([
        [x, y - 1],
        [x + drift * 0.3, y + fall * 0.5],
        [x + drift, y + fall],
      ]);
      const w = 0.5 + 1.5 * random() ** 2;
      graver.dip(graver.ground);
      graver.swell(thread, (t) => w * Math.sin(Math.PI * (0.12 + 0.88 * t)) ** 0.7 + 0.05, 0.06);
      if (k % 3) continue;
      graver.dip(graver.ink);
      graver.swell(
        thread.map(([px, py]) => [px + w * 0.6, py]),
        (t) => 0.45 * Math.sin(Math.PI * t),
        0.06,
      );
    }
  }
  graver.dip(graver.ground);
  for (let k = 0; k < 40; k++) {
    const x = MIDDLE - 70 + k * 3.6;
    const r = 3 + random() * 6 * Math.exp(-(((x - MIDDLE) / 50) ** 2));
    graver.fill(
      spline(
        [
          [x - r, 287],
          [x - r * 0.7, 283 - r * 0.9],
          [x, 282 - r * 1.4],
          [x + r * 0.8, 283 - r * 0.8],
          [x + r, 287],
        ],
        { closed: true },
      ),
      graver.ground,
    );
  }
  for (let k = 0; k < 120; k++) {
    const side = random() < 0.5 ? -1 : 1;
    const x = MIDDLE + side * (8 + 60 * random());
    const y = 276 - 34 * random() ** 1.6;
    const r = 0.35 + 0.8 * random() ** 3;
    graver.fill(
      spline(
        [
          [x, y - r * 1.3],
          [x + r, y],
          [x, y + r],
          [x - r, y],
        ],
        { closed: true, step: 1 },
      ),
      graver.ground,
    );
  }
  graver.dip(graver.ink);
  for (let k = 0; k < 46; k++) {
    const x = MIDDLE - 66 + random() * 132;
    const y = 283 - random() * 9;
    const r = 2 + random() * 4;
    fleck(graver, x, y, r, 0.8);
  }
}

/** A ship hull down on the horizon, under topsails. */
function farShip(graver, x, y) {
  graver.fill(
    spline(
      [
        [x - 17, y - 3.4],
        [x, y - 2.2],
        [x + 19, y - 4.2],
        [x + 15, y + 2.6],
        [x - 15, y + 2.6],
      ],
      { closed: true, step: 1 },
    ),
  );
  graver.line(
    [
      [x + 15, y - 3],
      [x + 29, y - 9],
    ],
    0.7,
  );
  for (const [mx, tall] of [
    [-10, 27],
    [1, 33],
    [11, 29],
  ]) {
    graver.line(
      [
        [x + mx, y - 2],
        [x + mx, y - tall - 4],
      ],
      0.6,
    );
    for (let k = 0; k < 3; k++) {
      const [a, b] = [tall * (0.2 + 0.29 * k), tall * (0.44 + 0.29 * k)];
      const w = 5.2 - k * 1.1;
      const sail = [
        [x + mx - w + 0.8, y - b],
        [x + mx + w - 0.4, y - b - 0.4],
        [x + mx + w + 1.2, y - a],
        [x + mx - w + 0.8, y - a - 0.6],
      ];
      graver.clear(sail);
      graver.line(sail, 0.45, true);
      for (let i = 0; i < 4; i++)
        graver.line(
          [
            [x + mx - w + 1.2 + i * 1.1, y - b],
            [x + mx - w + 1.4 + i * 1.1, y - a - 0.5],
          ],
          0.55,
        );
    }
  }
}
