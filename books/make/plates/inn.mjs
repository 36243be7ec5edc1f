/** The Spouter-Inn on a night of hard frost: a gable, a swinging sign, one lamp. */

import { randomNumbers } from "../../../scripts/random_numbers.mjs";
import { box, circle, clamp, distance, lerp, pts, smooth, spline, straight } from "./curves.mjs";
import { house, sign, snowLine } from "./house.mjs";
import { noise } from "./noise.mjs";
import { sky } from "./sky.mjs";

const LAMP = [38, 204];
const GROUND = 318;

export function inn(graver, wide, high) {
  graver.within(box(0, 0, wide, high), () => {
    night(graver, wide);
    street(graver);
    house(graver, glow);
    snow(graver, wide, high);
    lampPost(graver);
    sign(graver);
    flakes(graver, wide, high);
  });
  graver.line(box(0, 0, wide, high), 0.7, true);
}

const glow = (x, y, reach) => Math.exp(-((distance([x, y], LAMP) / reach) ** 2));

function night(graver, wide) {
  sky(graver, {
    x0: 0,
    x1: wide,
    y0: 1.4,
    y1: GROUND,
    pitch: 2.4,
    bend: (x, y) => 2.4 * (noise(x / 120, y / 60, 4) - 0.5),
    dark: (x, y) => {
      const drift = 0.5 * (noise(x / 80, y / 24, 12) - 0.5);
      return clamp(0.76 + drift - 0.2 * smooth(120, 310, y) - 0.75 * glow(x, y, 62), 0.06, 0.9);
    },
  });
  const random = randomNumbers(14);
  for (let k = 0; k < 26; k++) {
    const [x, y] = [random() * 150, 8 + random() * 110];
    const r = 0.5 + random() ** 4 * 1.1;
    graver.fill(circle(x, y, r, 8), graver.ground);
  }
}

/** The lower town going down to the wharves: gables, chimneys, and masts beyond. */
function street(graver) {
  const masts = [
    [22, 178],
    [41, 165],
    [96, 186],
    [110, 172],
  ];
  for (const [x, top] of masts) {
    graver.swell(
      [
        [x, 300],
        [x, 240],
        [x, top],
      ],
      (t) => 1.7 - 1.1 * t,
    );
    for (const [k, half] of [
      [0.2, 9],
      [0.45, 13],
      [0.68, 16],
    ]) {
      const y = lerp(top, 262, k);
      graver.swell(
        straight([x - half, y + 1.5], [x + half, y - 1.5]),
        (t) => 0.3 + 0.9 * Math.sin(Math.PI * t),
      );
    }
    for (const side of [-1, 1])
      graver.line(
        [
          [x, top + 22],
          [x + side * 13, 296],
        ],
        0.3,
      );
  }
  const blocks = [
    { roof: "-6,268 14,244 40,268", wall: [-6, 268, 40, 324], dark: 0.72 },
    { roof: "36,276 56,256 78,276", wall: [36, 276, 78, 324], dark: 0.5 },
    { roof: "74,264 98,238 126,264", wall: [74, 264, 126, 324], dark: 0.62 },
  ];
  for (const { roof, wall, dark } of blocks) {
    const [x0, y0, x1, y1] = wall;
    const shape = [...pts(roof), [x1, y1], [x0, y1]];
    graver.clear(shape);
    graver.within(shape, () => {
      for (let y = y0 - 26; y < y1; y += 2.3) {
        graver.swell(
          straight([x0, y], [x1, y], 3),
          (_, x) => clamp(dark - 0.5 * glow(x, y, 64) + 0.15 * noise(x / 7, y, 3), 0.08, 0.9) * 2.3,
        );
      }
    });
    graver.line(shape, 0.6, true);
    snowLine(graver, pts(roof), 3);
  }
  for (const [x, y] of [
    [8, 284],
    [90, 282],
    [106, 282],
    [52, 290],
  ])
    litWindow(graver, x, y, 6, 8);
}

function litWindow(graver, x, y, w, h) {
  graver.clear(box(x, y, x + w, y + h));
  graver.line(box(x, y, x + w, y + h), 0.7, true);
  graver.line(
    [
      [x + w / 2, y],
      [x + w / 2, y + h],
    ],
    0.45,
  );
  graver.line(
    [
      [x, y + h / 2],
      [x + w, y + h / 2],
    ],
    0.45,
  );
}

function lampPost(graver) {
  const [x, y] = LAMP;
  graver.swell(straight([x, GROUND + 22], [x, y + 12]), (t) => 4.6 - 2.4 * t);
  graver.fill(box(x - 4.4, GROUND + 14, x + 4.4, GROUND + 24));
  graver.line(
    [
      [x - 8, y + 26],
      [x + 8, y + 26],
    ],
    1.2,
  );
  const lantern = [
    [x - 5, y + 12],
    [x - 8, y - 7],
    [x + 8, y - 7],
    [x + 5, y + 12],
  ];
  graver.clear(lantern);
  graver.line(lantern, 1, true);
  graver.line(
    [
      [x - 1.6, y - 7],
      [x - 1, y + 12],
    ],
    0.4,
  );
  graver.line(
    [
      [x + 1.6, y - 7],
      [x + 1, y + 12],
    ],
    0.4,
  );
  graver.fill([
    [x - 9, y - 7],
    [x - 4, y - 12],
    [x + 4, y - 12],
    [x + 9, y - 7],
  ]);
  graver.fill(circle(x, y - 13.5, 2, 14));
  graver.fill(
    spline(
      [
        [x, y - 2],
        [x + 1.6, y + 3],
        [x, y + 5.5],
        [x - 1.6, y + 3],
      ],
      { closed: true },
    ),
  );
}

/** The street under snow: ruts that lead away, long shadows, one track of feet. */
function snow(graver, wide, high) {
  const edge = spline([
    [-4, 320],
    [40, 316],
    [90, 319],
    [150, 317],
    [220, 321],
    [wide + 4, 318],
  ]);
  graver.clear([...edge, [wide + 4, high + 4], [-4, high + 4]]);
  for (let k = 0; k < 26; k++) {
    const y = 321 + k * 2.5;
    const drift = Array.from({ length: 73 }, (_, i) => {
      const x = -2 + (i * (wide + 4)) / 72;
      return [x, y + 3.4 * (noise(x / 70, k / 5, 6) - 0.5) * (1 + k / 12)];
    });
    graver.swell(
      drift,
      (_, x, yy) => {
        const pool = Math.exp(-(((x - LAMP[0]) / 78) ** 2) - ((yy - 345) / 34) ** 2);
        const lee = smooth(0.5, 0.72, noise(x / 46, yy / 9, 19));
        return clamp(0.16 + 0.5 * lee + 0.3 * smooth(150, 290, x) - 0.75 * pool) * 1.9;
      },
      0.16,
    );
  }
  for (let k = 0; k < 15; k++) {
    const t = k / 14;
    const x = lerp(20, 186, t) + 9 * Math.sin(t * 5);
    const y = lerp(376, 329, t ** 0.8) + (k % 2 ? 2.4 : -1.6) * (1 - t * 0.5);
    graver.fill(
      spline(
        [
          [x - 2.6 * (1.3 - t), y],
          [x, y - 1],
          [x + 2.8 * (1.3 - t), y - 0.5],
          [x, y + 1],
        ],
        { closed: true, step: 1 },
      ),
    );
  }
}

function flakes(graver, wide, high) {
  const random = randomNumbers(41);
  for (let k = 0; k < 210; k++) {
    const [x, y] = [random() * wide, random() * high];
    graver.fill(circle(x, y, 0.45 + 0.75 * random() ** 2, 7), graver.ground);
  }
}
