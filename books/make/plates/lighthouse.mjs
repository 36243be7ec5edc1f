/** The lighthouse alone on its rock, its light thrown out over a heavy sea. */

import { randomNumbers } from "../../../scripts/random_numbers.mjs";
import { between, box, circle, clamp, lerp, pts, smooth, spline, straight } from "./curves.mjs";
import { noise } from "./noise.mjs";
import { fleck, sea } from "./sea.mjs";
import { heaped, sky } from "./sky.mjs";

const LIGHT = [138, 92];
const FOOT = 262;

export function lighthouse(graver, wide, high) {
  const horizon = high * 0.66;
  graver.within(box(0, 0, wide, high), () => {
    dusk(graver, wide, horizon);
    const rows = sea(graver, {
      x0: -2,
      x1: wide + 2,
      y0: horizon,
      y1: high + 18,
      rows: 15,
      swell: 0.95,
      reach: 5.2,
      lit: 1,
      seed: 55,
      power: 1.6,
      dark: (x, y) =>
        clamp(
          0.58 +
            0.3 * (noise(x / 40, y / 13, 2) - 0.5) -
            0.34 * Math.exp(-(((x - 138) / 60) ** 2)) * smooth(250, 290, y) -
            0.35 * surf(x, y),
          0.02,
          0.9,
        ),
    });
    let built = false;
    for (const y of rows) {
      if (!built && y > FOOT + 24) {
        rocks(graver);
        tower(graver);
        breakers(graver);
        built = true;
      }
    }
    gulls(graver);
  });
  graver.line(box(0, 0, wide, high), 0.7, true);
}

const surf = (x, y) => Math.exp(-(((x - 140) / 88) ** 2) - ((y - 294) / 12) ** 2);

/** How far a point lies within the beams, which go out level, a little widening. */
function beam(x, y) {
  const dx = Math.abs(x - LIGHT[0]);
  const lift = x < LIGHT[0] ? 0.16 : -0.1;
  const middle = LIGHT[1] - lift * dx;
  const half = 3.5 + dx * 0.15;
  return (1 - smooth(half * 0.62, half, Math.abs(y - middle))) * (1 - 0.35 * smooth(40, 190, dx));
}

function dusk(graver, wide, horizon) {
  const cloud = heaped({ seed: 71, cover: 0.54, scaleX: 125, scaleY: 44, sun: [0.3, -1] });
  sky(graver, {
    x0: 0,
    x1: wide,
    y0: 1.4,
    y1: horizon,
    pitch: 2.4,
    bend: (x, y) => 2.4 * (noise(x / 100, y / 60, 23) - 0.5),
    dark(x, y) {
      const { body, relief } = cloud(x, y);
      const night = lerp(0.84, 0.42, smooth(0, horizon, y));
      const tone = lerp(night, 0.22 + 0.75 * (1 - relief), body * 0.8);
      const halo = 0.55 * Math.exp(-((Math.hypot(x - LIGHT[0], y - LIGHT[1]) / 34) ** 2));
      return clamp(tone - 0.8 * beam(x, y) - halo, 0.05, 0.9);
    },
  });
}

/** A tower like an oak: broad at the foot, waisted, of coursed stone. */
function tower(graver) {
  const [cx] = LIGHT;
  const half = (y) => 15 + 17 * clamp((y - 112) / (FOOT - 112)) ** 2.3 + 3 * clamp((y - 112) / 150);
  const edge = (sign) =>
    Array.from({ length: 51 }, (_, i) => {
      const y = lerp(112, FOOT + 6, i / 50);
      return [cx + sign * half(y), y];
    });
  const [left, right] = [edge(-1), edge(1)];
  const shape = [...left, ...[...right].reverse()];
  graver.clear(shape);
  graver.within(shape, () => {
    const lines = [...between(left, right, 30, 2.4)];
    lines.forEach((line, k) => {
      const u = k / 30;
      const round =
        0.88 * smooth(0.42, 0.96, u) - 0.25 * smooth(0.96, 1, u) + 0.36 * smooth(0.12, 0, u);
      graver.swell(
        line,
        (t) =>
          clamp(round + 0.3 * (1 - smooth(0, 0.06, t))) * 1.5 * (0.85 + 0.3 * noise(t * 24, k, 4)),
        0.12,
      );
    });
    courses(graver, cx, half);
  });
  graver.swell(left, () => 0.7);
  graver.swell(right, () => 1.2);
  for (const [x, y] of [
    [132, 140],
    [142, 172],
    [133, 206],
  ]) {
    graver.fill(
      spline(
        [
          [x - 2.6, y + 8],
          [x - 2.6, y + 1.6],
          [x, y - 1.4],
          [x + 2.6, y + 1.6],
          [x + 2.6, y + 8],
        ],
        { step: 1 },
      ),
    );
  }
  graver.fill(spline(pts("132,262 132,246 138,240.5 144,246 144,262")));
  lantern(graver, cx);
}

/** Stones: level joints that bow with the round of the tower, and broken uprights between. */
function courses(graver, cx, half) {
  for (let k = 0; k < 17; k++) {
    const y = 121 + k * 8.8;
    const bow = (u) => y + 2.6 * (1 - u * u) * (y > 150 ? 1 : 0.6);
    graver.swell(
      Array.from({ length: 21 }, (_, i) => {
        const u = i / 10 - 1;
        return [cx + u * half(y), bow(u)];
      }),
      () => 0.5,
    );
    for (let j = -3; j <= 3; j++) {
      const u = Math.sin(((j + (k % 2 ? 0.5 : 0)) / 3.6) * 1.4);
      if (Math.abs(u) < 0.97)
        graver.line(
          [
            [cx + u * half(y), bow(u)],
            [cx + u * half(y + 8.8), bow(u) + 8.6],
          ],
          0.4,
        );
    }
  }
}

function lantern(graver, cx) {
  const gallery = [
    [cx - 20, 112],
    [cx - 22, 107],
    [cx + 22, 107],
    [cx + 20, 112],
  ];
  graver.fill(gallery);
  for (let x = -20; x <= 20; x += 5)
    graver.line(
      [
        [cx + x, 107],
        [cx + x, 99],
      ],
      0.7,
    );
  graver.line(
    [
      [cx - 21, 99],
      [cx + 21, 99],
    ],
    0.8,
  );
  graver.line(
    [
      [cx - 21, 103],
      [cx + 21, 103],
    ],
    0.45,
  );
  const glass = [
    [cx - 10.5, 107],
    [cx - 10.5, 80],
    [cx + 10.5, 80],
    [cx + 10.5, 107],
  ];
  graver.clear(glass);
  graver.line(glass, 1, true);
  for (const x of [-5.2, 0, 5.2])
    graver.line(
      [
        [cx + x, 80],
        [cx + x, 107],
      ],
      0.5,
    );
  for (const y of [88.5, 97.5])
    graver.line(
      [
        [cx - 10.5, y],
        [cx + 10.5, y],
      ],
      0.4,
    );
  graver.fill(
    spline([
      [cx - 14, 80],
      [cx - 11, 73],
      [cx - 5, 67.5],
      [cx, 66],
      [cx + 5, 67.5],
      [cx + 11, 73],
      [cx + 14, 80],
    ]),
  );
  graver.fill(circle(cx, 64, 2.6, 20));
  graver.line(
    [
      [cx, 62],
      [cx, 52],
    ],
    0.8,
  );
  graver.line(
    [
      [cx - 5, 56],
      [cx + 6, 56],
    ],
    0.5,
  );
  graver.clear(circle(cx, 93, 3.6, 30));
  for (let k = 0; k < 12; k++) {
    const a = (k / 12) * Math.PI * 2;
    graver.line(
      [
        [cx + 5 * Math.cos(a), 93 + 5 * Math.sin(a)],
        [cx + 8 * Math.cos(a), 93 + 8 * Math.sin(a)],
      ],
      0.35,
    );
  }
}

const ROCKS = [
  "58,296 66,282 80,276 90,266 102,262 112,258 138,257 166,259 178,266 186,264 198,274 214,280 226,298",
  "80,298 88,286 100,282 106,272 118,270 128,280 136,298",
  "138,298 146,280 158,270 170,276 176,286 192,288 204,298",
  "40,298 50,288 62,287 70,298",
  "206,298 216,286 232,290 242,298",
];

function rocks(graver) {
  ROCKS.forEach((text, r) => {
    const shape = pts(text);
    graver.clear(shape);
    graver.within(shape, () => {
      // Each facet has its own slant of cut, the far side of the ridge the darker.
      for (let k = -10; k < 70; k++) {
        const x = shape[0][0] + k * 3.1 - 10;
        const line = straight([x, 250], [x + 26, 302], 3);
        graver.swell(
          line,
          (_, px, py) => {
            const facet = noise(px / 13 + r * 7, py / 17, 30 + r);
            return (
              clamp((facet > 0.5 ? 0.85 : 0.28) + 0.4 * smooth(140, 230, px) - 0.25, 0.04, 0.95) *
              2.1
            );
          },
          0.12,
        );
      }
      for (let k = 0; k < 7; k++) {
        const i = 1 + Math.floor(((k + 0.5) / 7) * (shape.length - 2));
        const [x, y] = shape[i];
        graver.swell(
          [
            [x, y],
            [x + 3, y + 8],
            [x - 1, y + 17],
            [x + 5, y + 28],
          ],
          (t) => 1.5 * (1 - t) + 0.2,
        );
      }
    });
    graver.line(shape, 0.8);
  });
}

/** Seas that break on the rock: sheets of white thrown up on either hand. */
function breakers(graver) {
  const random = randomNumbers(15);
  graver.dip(graver.ground);
  for (let k = 0; k < 210; k++) {
    const side = k % 3 ? -1 : 1;
    const x0 = side < 0 ? 52 + random() * 42 : 190 + random() * 40;
    const out = (random() - (side < 0 ? 0.62 : 0.4)) * 52;
    const up = (12 + 62 * random() ** 1.5) * (side < 0 ? 1 : 0.7);
    const arc = Array.from({ length: 14 }, (_, i) => {
      const t = (i / 13) * 0.6;
      return [x0 + out * t, 298 - up * 4 * t * (1 - t)];
    });
    const heavy = 0.5 + 2.3 * random() ** 2;
    graver.swell(arc, (t) => heavy * (1 - t) ** 0.5 + 0.1, 0.08);
  }
  for (let k = 0; k < 44; k++) {
    const x = 40 + k * 4.6;
    const r = 3 + random() * 5;
    graver.fill(
      spline(
        [
          [x - r, 301],
          [x - r * 0.7, 296 - r * 0.7],
          [x, 295 - r],
          [x + r * 0.8, 296 - r * 0.6],
          [x + r, 301],
        ],
        { closed: true },
      ),
      graver.ground,
    );
  }
  for (let k = 0; k < 100; k++) {
    const x = random() < 0.62 ? 36 + random() * 66 : 184 + random() * 62;
    const y = 284 - 62 * random() ** 1.7;
    graver.fill(circle(x, y, 0.35 + 0.8 * random() ** 3, 7), graver.ground);
  }
  graver.dip(graver.ink);
  for (let k = 0; k < 50; k++) {
    const x = 44 + random() * 196;
    const y = 299 - random() * 8;
    const r = 2 + random() * 4;
    fleck(graver, x, y, r, 0.8);
  }
}

function gulls(graver) {
  for (const [x, y, s] of [
    [212, 150, 1],
    [228, 164, 0.75],
    [196, 172, 0.6],
    [60, 176, 0.8],
  ]) {
    const wing = spline([
      [x - 12 * s, y - 3 * s],
      [x - 6 * s, y - 6 * s],
      [x, y],
      [x + 6 * s, y - 6.5 * s],
      [x + 13 * s, y - 4 * s],
    ]);
    graver.dip(graver.ground);
    graver.swell(wing, (t) => 3.4 * s * Math.sin(Math.PI * t));
    graver.dip(graver.ink);
    graver.swell(
      wing.map(([a, b]) => [a, b + 0.9 * s]),
      (t) => 1.1 * s * Math.sin(Math.PI * t),
    );
  }
}
