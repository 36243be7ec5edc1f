/** The frontispiece: the white whale, mouth agape, thrown half out of a black sea. */

import { randomNumbers } from "../../../scripts/random_numbers.mjs";
import { between, box, clamp, distance, lerp, pts, smooth, spline } from "./curves.mjs";
import { noise } from "./noise.mjs";
import { fleck, sea } from "./sea.mjs";
import { heaped, sky } from "./sky.mjs";

const SCALE = 1.17;
const SNOUT = [84, 62];
/** The whale in its own measures: s from the snout back, r from the axis, the back being +. */
const BACK = pts("2,-9 0,2 1,14 6,24 16,31 34,34 62,34.5 92,33 120,34 150,35 185,34 220,30 262,25");
const UPPER = pts("2,-9 6,-15 14,-18.5 30,-20 52,-20.5 74,-21 90,-20");
const BELLY = pts("104,-36 125,-38 150,-38.5 185,-36 220,-32 262,-27");
const JAW_TOP = pts("90,-20 76,-25.5 58,-32.5 40,-40 25,-45.5");
const SCARS = [
  "20,22 30,24 40,21",
  "24,19 33,21 42,18.4",
  "44,12 52,15 63,13.5",
  "30,6 38,8 46,6.5",
  "66,21 74,24 82,22.6",
  "120,17 131,20 140,17",
  "124,13.6 134,16 142,14",
  "150,4 158,7 167,5",
  "76,4 84,7 90,5.6",
  "170,20 180,23 190,20",
];
const JAW_LOW = pts("25,-45.5 22,-48.5 27,-50 44,-47.5 64,-43.5 84,-39 104,-36");

/** Its axis bends as it climbs: steep at the head, leaning farther over toward the flukes. */
function put([s, r]) {
  let [x, y] = SNOUT;
  const steps = 24;
  const angle = (at) => 1.19 - at * 0.0013;
  for (let i = 0; i < steps; i++) {
    const at = (s * (i + 0.5)) / steps;
    x += (Math.cos(angle(at)) * SCALE * s) / steps;
    y += (Math.sin(angle(at)) * SCALE * s) / steps;
  }
  const a = angle(s);
  return [x + Math.sin(a) * r * SCALE, y - Math.cos(a) * r * SCALE];
}
const to = (points) => points.map(put);

export function breach(graver, wide, high) {
  const horizon = high * 0.69;
  graver.within(box(0, 0, wide, high), () => {
    stormSky(graver, wide, horizon);
    const rows = sea(graver, {
      x0: -2,
      x1: wide + 2,
      y0: horizon,
      y1: high + 16,
      rows: 16,
      swell: 0.85,
      reach: 5.4,
      lit: 1,
      seed: 8,
      dark: (x, y) => seaTone(x, y),
    });
    let risen = false;
    for (const y of rows) {
      if (!risen && y > horizon + 22) {
        whale(graver);
        spray(graver, y + 3);
        risen = true;
      }
    }
  });
  graver.line(box(0, 0, wide, high), 0.7, true);
}

const seaTone = (x, y) => {
  const foam = Math.exp(-(((x - 176) / 70) ** 2) - ((y - 298) / 16) ** 2);
  const gleam = 0.22 * Math.exp(-(((x - 176) / 50) ** 2)) * smooth(290, 340, y);
  return clamp(0.58 + 0.3 * (noise(x / 40, y / 14, 5) - 0.5) - 0.62 * foam - gleam, 0.02, 0.9);
};

function stormSky(graver, wide, horizon) {
  const cloud = heaped({ seed: 44, cover: 0.6, scaleX: 130, scaleY: 58, sun: [1, -1] });
  sky(graver, {
    x0: 0,
    x1: wide,
    y0: 1.4,
    y1: horizon,
    pitch: 2.4,
    bend: (x, y) => 3 * (noise(x / 100, y / 80, 17) - 0.5),
    dark(x, y) {
      const { body, relief } = cloud(x, y);
      const open = lerp(0.72, 0.5, smooth(0, horizon, y));
      const behind = 0.26 * Math.exp(-((distance([x, y], [140, 170]) / 110) ** 2));
      const dawn = 0.34 * smooth(horizon - 60, horizon, y);
      return clamp(lerp(open, 0.12 + 0.9 * (1 - relief), body * 0.85) + behind - dawn, 0.12, 0.9);
    },
  });
}

function whale(graver) {
  gape(graver);
  const back = spline(BACK);
  const belly = [...spline(UPPER), ...spline(pts("90,-20 98,-28 104,-36")), ...spline(BELLY)];
  const outline = to([...back, ...[...belly].reverse()]);
  graver.clear(outline);
  graver.within(outline, () => {
    model(graver, to(back), to(belly));
    marks(graver);
  });
  graver.swell(to(belly), (t) => 1 + 0.8 * t, 0.1);
  graver.line(to(back), 0.5);
  flipper(graver);
}

/** Light falls on the back, from the right; the flank turns into shade toward the belly. */
function model(graver, back, belly) {
  const lines = [...between(back, belly, 50, 2.3)];
  const n = lines.length - 1;
  lines.forEach((line, k) => {
    const u = k / n;
    graver.swell(
      line,
      (t, x, y) => {
        const round = 0.8 * smooth(0.42, 0.93, u) - 0.32 * smooth(0.95, 1, u);
        const water = 0.3 * smooth(210, 300, y) * smooth(0.15, 0.7, u);
        const brow = 0.24 * (1 - smooth(0, 0.09, t)) * smooth(0.2, 0.8, u);
        const mottle = 0.36 * (noise(x / 13, y / 22, 3) - 0.5) * smooth(0.2, 0.5, u);
        return clamp(round + water + brow + mottle - 0.04, 0, 0.88) * 1.85;
      },
      0.15,
    );
  });
}

/** The open mouth: black within, the long jaw below it set with teeth. */
function gape(graver) {
  const jawTop = spline(JAW_TOP);
  const mouth = to([...spline(UPPER.slice(3)), ...jawTop.slice(1, -18), ...pts("36,-24")]);
  graver.fill(mouth);
  const jaw = to([...jawTop, ...spline(JAW_LOW)]);
  graver.clear(jaw);
  graver.within(jaw, () => {
    const lines = [...between(to([...jawTop].reverse()), to(spline(JAW_LOW.slice(1))), 9, 2)];
    for (const [k, line] of lines.entries()) {
      graver.swell(line, (t) => (0.16 + 0.1 * k) * (0.5 + t), 0.14);
    }
  });
  graver.line(jaw, 0.8, true);
  for (let k = 0; k < 9; k++) {
    const s = 31 + k * 5.4;
    const base = lerp(-43, -22.5, (s - 31) / 51);
    const tooth = to([
      [s - 1.5, base - 1.6],
      [s - 0.6, base + 3.6],
      [s + 1.7, base - 0.6],
    ]);
    graver.clear(tooth);
    graver.line(tooth, 0.35, true);
  }
}

/** Eye and wrinkles, pleats of the throat, old scars. */
function marks(graver) {
  const cut = (points, w) =>
    graver.swell(spline(to(points)), (t) => w * Math.sin(Math.PI * clamp(t)) + 0.12);
  graver.clear(spline(to(pts("96,-13 101,-9.6 107,-12.6 101.5,-16")), { closed: true }));
  graver.fill(spline(to(pts("98,-12.8 101,-10.6 104.6,-12.6 101.4,-14.8")), { closed: true }));
  for (let k = 0; k < 3; k++) {
    cut(
      [
        [93, -10 + k * 2.6],
        [101, -6.6 + k * 2.7],
        [110, -10 + k * 2.4],
      ],
      0.9,
    );
    cut(
      [
        [95, -16 - k * 2.2],
        [101, -18.4 - k * 2],
        [107, -16 - k * 2.4],
      ],
      0.7,
    );
  }
  for (let k = 0; k < 6; k++) {
    cut(
      [
        [106 + k * 2, -31 + k * 3.4],
        [124 + k, -32 + k * 3.5],
        [150 - k * 3, -30.5 + k * 3.4],
      ],
      1,
    );
  }
  for (const scar of SCARS) cut(pts(scar), 0.55);
}

function flipper(graver) {
  const shape = spline(
    to(pts("124,-22 128,-34 138,-52 151,-66 160,-70 160,-60 154,-44 146,-30 138,-22")),
    { step: 1.5 },
  );
  graver.clear(shape);
  graver.within(shape, () => {
    const left = to(pts("122,-20 130,-44 158,-72"));
    const right = to(pts("142,-18 152,-36 166,-66"));
    const lines = [...between(spline(left), spline(right), 12, 2)];
    for (const [k, line] of lines.entries()) {
      graver.swell(line, (t) => (1.5 - k * 0.085) * (0.7 + 0.3 * t), 0.1);
    }
  });
  graver.line(shape, 0.9, false);
}

/** Spray is white line: streaks of bare paper thrown up across what was cut before. */
function spray(graver, foot) {
  const random = randomNumbers(20);
  graver.dip(graver.ground);
  for (let k = 0; k < 190; k++) {
    const side = k % 5 < 2 ? 1 : -1;
    const root = side < 0 ? 158 + random() * 20 : 222 + random() * 14;
    const out = (4 + 74 * random() ** 1.25) * side;
    const up = (26 + 84 * random() ** 1.5) * (1 - (0.35 * Math.abs(out)) / 80);
    const x0 = root + out * 0.22;
    const arc = Array.from({ length: 15 }, (_, i) => {
      const t = (i / 14) * 0.55;
      return [x0 + out * t * 1.1, foot + 4 - up * 4 * t * (1 - t) * 0.98];
    });
    const heavy = 0.6 + 2.6 * random() ** 2;
    graver.swell(arc, (t) => heavy * (1 - t) ** 0.5 * smooth(-0.1, 0.25, t) + 0.12, 0.1);
  }
  foam(graver, foot, random);
  for (let k = 0; k < 130; k++) {
    const side = random() < 0.55 ? -1 : 1;
    const x = (side < 0 ? 162 : 230) + side * random() ** 1.2 * 92;
    const y = foot - 14 - random() ** 1.5 * 96;
    const r = 0.35 + 0.95 * random() ** 3;
    graver.fill(
      spline(
        [
          [x, y - r * 1.4],
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
  const lines = randomNumbers(3);
  for (let k = 0; k < 46; k++) {
    const x = 118 + lines() * 150;
    const y = foot - lines() * 9;
    const r = 2 + lines() * 4;
    fleck(graver, x, y, r, 0.75);
  }
}

/** Heaped foam about the body at the waterline. */
function foam(graver, foot, random) {
  for (let k = 0; k < 26; k++) {
    const x = 112 + k * 6.4;
    const r = 4 + random() * 6 * (1 - Math.abs(k - 12.5) / 16);
    graver.fill(
      spline(
        [
          [x - r, foot + 3],
          [x - r * 0.7, foot - r * 0.8],
          [x, foot - r * 1.3],
          [x + r * 0.8, foot - r * 0.7],
          [x + r, foot + 3],
        ],
        { closed: true },
      ),
      graver.ground,
    );
  }
}
