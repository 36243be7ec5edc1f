/** A chart of Nantucket: the coast with its water lines, rhumbs, shoals and a rose. */

import { randomNumbers } from "../../../scripts/random_numbers.mjs";
import { drawWhale } from "../whale.mjs";
import { coastDistance, isolines, sample } from "./contours.mjs";
import { box, circle, clamp, inside, pts, smooth, spline } from "./curves.mjs";
import { noise } from "./noise.mjs";

// Longitude west and latitude north of points of the coast, in thousandths of a degree
// after 69 and 41: Great Point, the outer shore southabout, Madaket, the harbour, Coatue.
const NANTUCKET =
  "1047,392 1041,386 1036,371 1026,352 1016,336 998,322 981,303 967,286 963,268 968,256 984,247 1010,242 " +
  "1040,240 1072,241 1102,243 1130,246 1158,251 1184,259 1208,272 1236,287 1228,289 1205,280 1196,283 1203,292 " +
  "1190,290 1172,283 1158,288 1142,296 1122,299 1104,297 1093,292 1097,285 1088,280 1076,282 1064,288 1052,290 " +
  "1046,286 1036,290 1028,298 1016,304 1006,310 1001,319 1009,321 1018,314 1026,318 1034,309 1043,314 1050,304 " +
  "1059,309 1067,299 1077,301 1090,297 1080,305 1062,315 1046,327 1037,338 1039,352 1047,370 1052,384";
const TUCKERNUCK = "1240,300 1252,307 1270,309 1284,303 1276,296 1258,294 1246,295";
const MUSKEGET = "1298,334 1306,339 1314,336 1310,331 1302,330";

const place = ([lon, lat]) => [14 + (1322 - lon) * 0.705, 158 + (392 - lat) * 0.94];
const coast = (text) => spline(pts(text).map(place), { closed: true, step: 2 });

const FRAME = 7;
const ROSE = [72, 88];

export function chart(graver, wide, high) {
  const lands = [NANTUCKET, TUCKERNUCK, MUSKEGET].map(coast);
  graver.within(box(FRAME, FRAME, wide - FRAME, high - FRAME), () => {
    rhumbs(graver);
    waterLines(graver, lands, wide, high);
    for (const land of lands) island(graver, land);
    shoals(graver);
    rose(graver, ROSE[0], ROSE[1], 50);
    drawWhale(graver, { x: 60, y: 340, scale: 0.34, ink: graver.ink, cut: graver.ground });
    swells(graver, 60, 354);
    graver.clear(box(138, 34, 272, 107));
    graver.line(box(138, 34, 272, 107), 0.9, true);
    graver.line(box(140.4, 36.4, 269.6, 104.6), 0.35, true);
  });
  scale(graver, wide - 122, high - 29);
  border(graver, wide, high);
}

/** Names on the chart: [text, x, y, style], set in type by the page; `bare` ones clear their ground. */
export const chartNames = (wide, high) => {
  const italic = { face: "italic", size: 8, align: "centre" };
  const caps = { features: ["lnum"], align: "centre" };
  return [
    ["A CHART", 205, 52, { ...caps, size: 10, track: 2.4 }],
    ["of the island of", 205, 66, { ...italic, size: 9.6 }],
    ["NANTUCKET", 205, 84, { ...caps, size: 15, track: 2.6 }],
    ["and the shoals about it", 205, 98, { ...italic, size: 9 }],
    ["Nantucket", 150, 275, { ...italic, size: 11.5 }],
    ["Great Point", 172, 146, { ...italic, bare: true }],
    ["Siasconset", 257, 291, { ...italic, align: "right" }],
    ["Sankaty Head", 259, 262, { ...italic, size: 7.4, align: "right" }],
    ["Madaket", 82, 292, { ...italic, bare: true }],
    ["Tuckernuck", 50, 262, { ...italic, bare: true }],
    ["Muskeget", 35, 194, { ...italic, bare: true }],
    ["NANTUCKET SOUND", 110, 196, { ...caps, size: 8, track: 2.2, bare: true }],
    ["THE ATLANTIC OCEAN", 190, 336, { ...caps, size: 8, track: 2.6, bare: true }],
    ["Old South Shoal", 224, 321, { ...italic, size: 7.4, bare: true }],
    ["Scale of Miles", wide - 76, high - 34, { ...italic, size: 7.6, bare: true }],
  ];
};

function rhumbs(graver) {
  for (let k = 0; k < 32; k++) {
    const a = (k / 32) * Math.PI * 2;
    const width = k % 8 === 0 ? 0.4 : k % 4 === 0 ? 0.3 : 0.18;
    graver.line([ROSE, [ROSE[0] + 460 * Math.cos(a), ROSE[1] + 460 * Math.sin(a)]], width);
  }
}

/** Lines that follow the shore, ever fainter and farther apart. */
function waterLines(graver, lands, wide, high) {
  const grid = sample(coastDistance(lands), [0, 0, wide, high], 2);
  let off = 1.7;
  for (let k = 0; k < 9; k++) {
    const width = 0.62 * 0.84 ** k;
    for (const line of isolines(grid, off)) {
      const [x, y] = line[0];
      if (lands.some((land) => inside(land, x, y))) continue;
      graver.swell(line, (_, px, py) => width * (0.75 + 0.5 * noise(px / 14, py / 14, k)));
    }
    off += 1.9 + k * 0.42;
  }
}

function island(graver, land) {
  graver.clear(land);
  graver.within(land, () => {
    const random = randomNumbers(land.length);
    // Short cuts of grass on sand hills, thicker inland.
    for (let k = 0; k < 520; k++) {
      const x = 14 + random() * 262;
      const y = 158 + random() * 160;
      if (!inside(land, x, y)) continue;
      const heath = noise(x / 26, y / 18, 8);
      if (heath < 0.37 || Math.abs(y - 270) + Math.abs(x - 152) * 0.3 < 13) continue;
      const s = 0.7 + heath;
      graver.line(
        [
          [x - 1.6 * s, y],
          [x - 0.6 * s, y - 1.5 * s],
          [x + 0.2 * s, y],
        ],
        0.3,
      );
      graver.line(
        [
          [x - 0.1 * s, y],
          [x + 0.8 * s, y - 1.9 * s],
          [x + 1.5 * s, y],
        ],
        0.3,
      );
    }
  });
  graver.line(land, 1, true);
  // The shore is shaded on the sides away from the light.
  graver.swell(
    [...land, land[0]],
    (t) => {
      const i = Math.min(land.length - 1, Math.floor(t * land.length));
      const [ax, ay] = land[i];
      const [bx, by] = land[(i + 1) % land.length];
      const len = Math.hypot(bx - ax, by - ay) || 1;
      return 1.5 * clamp(((bx - ax) / len) * -0.7 + ((by - ay) / len) * 0.7);
    },
    0.2,
  );
}

/** Shoals: a dotted edge, and sand within. */
function shoals(graver) {
  for (const [cx, cy, rx, ry] of [
    [232, 310, 34, 5],
    [214, 168, 15, 8],
    [40, 232, 17, 6],
    [258, 204, 8, 19],
  ]) {
    for (let k = 0; k < 46; k++) {
      const a = (k / 46) * Math.PI * 2;
      const r = 1 + 0.22 * (noise(k / 5, cx, 6) - 0.5);
      graver.fill(circle(cx + rx * r * Math.cos(a), cy + ry * r * Math.sin(a), 0.4, 6));
    }
    const random = randomNumbers(Math.round(cx));
    for (let k = 0; k < 34; k++) {
      const a = random() * 6.283;
      const r = Math.sqrt(random()) * 0.85;
      graver.fill(circle(cx + rx * r * Math.cos(a), cy + ry * r * Math.sin(a), 0.24, 5));
    }
  }
}

/** Thirty-two points: each a kite with one side dark. */
function rose(graver, cx, cy, r) {
  graver.clear(circle(cx, cy, r * 0.86));
  graver.line(circle(cx, cy, r * 0.86), 0.6, true);
  graver.line(circle(cx, cy, r * 0.8), 0.3, true);
  for (let k = 0; k < 64; k++) {
    const a = (k / 64) * Math.PI * 2;
    const inner = k % 2 ? 0.83 : 0.8;
    graver.line(
      [
        [cx + r * inner * Math.cos(a), cy + r * inner * Math.sin(a)],
        [cx + r * 0.86 * Math.cos(a), cy + r * 0.86 * Math.sin(a)],
      ],
      0.4,
    );
  }
  for (const [step, off, long, waist] of [
    [16, 0.5, 0.62, 0.1],
    [8, 0.5, 0.7, 0.13],
    [4, 0.5, 0.8, 0.17],
    [4, 0, 1, 0.21],
  ]) {
    for (let k = 0; k < step; k++) {
      const a = ((k + off) / step) * Math.PI * 2 - Math.PI / 2;
      const half = Math.PI / step / (step === 4 ? 1 : 1.2);
      const at = (angle, q) => [cx + r * q * Math.cos(angle), cy + r * q * Math.sin(angle)];
      const tip = at(a, long);
      const left = [tip, at(a - half, waist), [cx, cy]];
      const right = [tip, at(a + half, waist), [cx, cy]];
      graver.clear([...left, ...[...right].reverse()]);
      graver.fill(right);
      graver.line([...left, right[1]], 0.45, true);
    }
  }
  graver.clear(circle(cx, cy, r * 0.07));
  graver.line(circle(cx, cy, r * 0.07), 0.6, true);
  lily(graver, cx, cy - r - 1);
}

/** North, by the lily. */
function lily(graver, x, y) {
  const petal = spline(
    [
      [x, y - 13],
      [x + 2.6, y - 8],
      [x + 1.5, y - 3],
      [x, y],
      [x - 1.5, y - 3],
      [x - 2.6, y - 8],
    ],
    { closed: true, step: 0.8 },
  );
  graver.fill(petal);
  for (const s of [-1, 1]) {
    graver.swell(
      spline([
        [x + s * 0.8, y - 1],
        [x + s * 2.6, y - 6],
        [x + s * 6, y - 8.6],
        [x + s * 7.4, y - 5.6],
        [x + s * 5.4, y - 4.4],
      ]),
      (t) => 0.5 + 1.9 * Math.sin(Math.PI * t),
    );
  }
  graver.line(
    [
      [x - 4, y - 2.4],
      [x + 4, y - 2.4],
    ],
    0.9,
  );
}

function swells(graver, x, y) {
  for (let k = 0; k < 3; k++) {
    const wave = Array.from({ length: 41 }, (_, i) => {
      const u = i / 20 - 1;
      return [x + u * (44 - k * 9), y + k * 3 + 1.1 * Math.sin(u * 10 + k * 2)];
    });
    graver.swell(wave, (t) => 0.9 * smooth(0, 0.2, t) * smooth(1, 0.8, t));
  }
}

function scale(graver, x, y) {
  const step = 18.5;
  for (let k = 0; k < 5; k++) {
    const bar = box(x + k * step, y, x + (k + 1) * step, y + 3);
    if (k % 2) graver.clear(bar);
    else graver.fill(bar);
    graver.line(bar, 0.4, true);
  }
}

/** The border of degrees, black and white by turns between two rules. */
function border(graver, wide, high) {
  graver.line(box(0, 0, wide, high), 1.2, true);
  graver.line(box(2, 2, wide - 2, high - 2), 0.35, true);
  graver.line(box(5, 5, wide - 5, high - 5), 0.35, true);
  graver.line(box(FRAME, FRAME, wide - FRAME, high - FRAME), 0.7, true);
  const bars = (n, draw) => {
    for (let k = 0; k < n; k += 2) draw(k);
  };
  const w = (wide - 14) / 24;
  const h = (high - 14) / 32;
  bars(24, (k) => {
    graver.fill(box(7 + k * w, 2, 7 + (k + 1) * w, 5));
    graver.fill(box(7 + (k + 1) * w, high - 5, 7 + (k + 2) * w, high - 2));
  });
  bars(32, (k) => {
    graver.fill(box(2, 7 + k * h, 5, 7 + (k + 1) * h));
    graver.fill(box(wide - 5, 7 + (k + 1) * h, wide - 2, 7 + (k + 2) * h));
  });
}
