/**
 * A full-rigged whaleship in her own units: x toward the bow from the mainmast, y up
 * from the water. `put` takes a point to the page.
 */
import { between, box, clamp, lerp, pts, smooth, spline } from "./curves.mjs";
import { noise } from "./noise.mjs";

const MASTS = [
  { x: 46, foot: 12, heads: [66, 108, 138, 158], rake: 0.01, widths: [44, 39, 29, 20] },
  { x: 0, foot: 11, heads: [70, 115, 148, 170], rake: -0.025, widths: [47, 42, 31, 21] },
  { x: -44, foot: 13, heads: [58, 96, 122, 139], rake: -0.05, widths: [34, 31, 23, 16] },
];
const SAIL_FEET = pts("24,60 65,102 106,132 135,152");
const DECK = pts("-79,25.5 -60,21.7 -30,17.7 0,16.4 34,17.8 60,22 80,26.5");
const KEEL = pts("80,26.5 76,13 70,-8 -64,-8 -70,4 -77,16 -79,25.5");

export function vessel(graver, put) {
  const to = (points) => points.map(put);
  const rope = (a, b, width = 0.3) => graver.line(to([a, b]), width);
  stays(rope);
  for (const mast of MASTS) spars(graver, to, mast);
  for (const [a, b, c] of HEADSAILS)
    sail(graver, to, spline([a, mid(a, c, 2.5), c]), spline([a, mid(a, b, -2), b]), 0.25);
  spanker(graver, to);
  for (let m = 2; m >= 0; m--) canvas(graver, to, MASTS[m], m);
  for (const mast of MASTS) shrouds(rope, mast);
  hull(graver, to);
  boats(graver, to);
}

const mid = ([ax, ay], [bx, by], off) => {
  const len = Math.hypot(bx - ax, by - ay);
  return [(ax + bx) / 2 + ((by - ay) / len) * off, (ay + by) / 2 - ((bx - ax) / len) * off];
};
const mastX = (mast, y) => mast.x + mast.rake * y;

const HEADSAILS = [
  pts("50,132 116,46 73,38"),
  pts("49,112 104,39 63,30"),
  pts("48,92 92,33 56,25"),
];

function stays(rope) {
  const [fore, main, mizzen] = MASTS;
  const tip = [122, 47];
  rope([mastX(fore, 158), 156], tip);
  rope([mastX(fore, 138), 137], [116, 45]);
  rope([mastX(fore, 108), 107], [104, 39]);
  rope([mastX(fore, 66), 66], [86, 30], 0.4);
  for (const [hi, lo, to] of [
    [main, fore, 1],
    [mizzen, main, 1],
  ]) {
    rope(
      [mastX(hi, hi.heads[3]), hi.heads[3] - 2],
      [mastX(lo, lo.heads[to + 1]), lo.heads[to + 1] - 4],
    );
    rope([mastX(hi, hi.heads[2]), hi.heads[2] - 2], [mastX(lo, lo.heads[to]), lo.heads[to] - 4]);
    rope([mastX(hi, hi.heads[1]), hi.heads[1] - 2], [mastX(lo, lo.heads[0]), lo.heads[0] - 4]);
    rope([mastX(hi, hi.heads[0]), hi.heads[0] - 2], [lo.x - 2, 14], 0.4);
  }
  for (const mast of MASTS) {
    for (let k = 1; k < 4; k++)
      rope([mastX(mast, mast.heads[k]), mast.heads[k] - 2], [mast.x - 14 - k * 2.4, 14]);
  }
  // Bobstay and martingale under the jib-boom.
  rope([122, 47], [91, 17]);
  rope([91, 17], [75, 6]);
  rope([92, 32], [91, 17], 0.7);
}

function spars(graver, to, mast) {
  const parts = [
    [mast.foot - 6, mast.heads[0] + 6, 2.6],
    [mast.heads[0] - 4, mast.heads[1] + 4, 1.8],
    [mast.heads[1], mast.heads[3] + 7, 1.1],
  ];
  for (const [a, b, width] of parts) {
    graver.swell(
      to([
        [mastX(mast, a), a],
        [mastX(mast, (a + b) / 2), (a + b) / 2],
        [mastX(mast, b), b],
      ]),
      (t) => width * (1 - 0.3 * t),
    );
  }
  for (const k of [0, 1]) {
    const y = mast.heads[k];
    graver.line(
      to([
        [mastX(mast, y) - 4 + k, y],
        [mastX(mast, y) + 4 - k, y],
      ]),
      1.1,
    );
  }
}

/** One sail between its two leeches: lines run down it, darker at the side away from the moon. */
function sail(graver, to, left, right, dark) {
  const outline = to([...left, ...[...right].reverse()]);
  graver.clear(outline);
  graver.within(outline, () => {
    const lines = [...between(to(left), to(right), 12, 2.5)];
    const n = lines.length - 1;
    lines.forEach((line, k) => {
      const u = k / n;
      graver.swell(
        line,
        (t) =>
          clamp(dark + 0.42 * (1 - u) ** 1.4 + 0.22 * (1 - t) ** 3 + 0.12 * t ** 4 - 0.2 * u) * 2.1,
        0.12,
      );
    });
  });
  graver.line(outline, 0.45, true);
}

function canvas(graver, to, mast, m) {
  const bulge = 6.5;
  for (let k = 3; k >= 0; k--) {
    if (m === 2 && k === 0) continue; // the spanker stands there
    const [low, top] = SAIL_FEET[k].map((y) =>
      m === 2 ? y * 0.84 + (k === 1 ? 4 : 2) : m === 1 ? y * 1.06 : y,
    );
    const half = mast.widths[k] / 2;
    const halfTop = (mast.widths[Math.min(k + 1, 3)] / 2) * (k === 3 ? 0.8 : 1.02);
    const cx = mastX(mast, low);
    const tilt = 1.6;
    const left = spline([
      [cx - halfTop, top - tilt],
      [cx - (half + halfTop) / 2 + bulge * 0.75, lerp(top, low, 0.55)],
      [cx - half + 2.2, low],
    ]);
    const right = spline([
      [cx + halfTop, top + tilt],
      [cx + (half + halfTop) / 2 + bulge, lerp(top, low, 0.5)],
      [cx + half + 2.8, low + 1.4],
    ]);
    const foot = spline([
      [cx + half + 2.8, low + 1.4],
      [cx + bulge * 0.8, low + 4.2],
      [cx - half + 2.2, low],
    ]);
    const outline = to([...left, ...[...foot].reverse().slice(1, -1), ...[...right].reverse()]);
    graver.clear(outline);
    graver.within(outline, () => sailLines(graver, to, left, right, m));
    graver.line(outline, 0.5, true);
    graver.swell(
      to([
        [cx - halfTop - 3.5, top - tilt * 1.2],
        [cx, top + 0.2],
        [cx + halfTop + 3.5, top + tilt * 1.25],
      ]),
      (t) => 0.7 + 1.3 * Math.sin(Math.PI * t),
    );
    // Reef points on the topsails.
    if (k === 1) {
      for (let i = 1; i < 8; i++) {
        const u = i / 8;
        const x = lerp(cx - halfTop + 1, cx + halfTop - 0.5, u) + bulge * 0.25;
        graver.line(
          to([
            [x, top - 7 + 2 * u],
            [x + 0.4, top - 11 + 2 * u],
          ]),
          0.4,
        );
      }
    }
  }
}

function sailLines(graver, to, left, right, m) {
  const lines = [...between(to(left), to(right), 15, 2.4)];
  const n = lines.length - 1;
  lines.forEach((line, k) => {
    const u = k / n;
    const side = 0.62 * (1 - smooth(0, 0.75, u)) + 0.3 * smooth(0.82, 1, u);
    graver.swell(
      line,
      (t) =>
        clamp(
          0.07 + side * (0.65 + 0.35 * t) + 0.4 * (1 - smooth(0, 0.22, t)) + 0.05 * m,
          0,
          0.86,
        ) * 2.35,
      0.14,
    );
  });
}

function spanker(graver, to) {
  const m = MASTS[2];
  const luff = spline([
    [mastX(m, 54) - 1, 54],
    [mastX(m, 22) - 1, 22],
  ]);
  const leech = spline([
    [m.x - 36, 68],
    [m.x - 34, 44],
    [m.x - 42, 20],
  ]);
  sail(graver, to, leech, luff, 0.16);
  graver.swell(
    to([
      [mastX(m, 55), 54],
      [m.x - 39, 70],
    ]),
    (t) => 1.4 - 0.6 * t,
  );
  graver.swell(
    to([
      [mastX(m, 20), 20],
      [m.x - 46, 19],
    ]),
    (t) => 1.5 - 0.6 * t,
  );
}

function hull(graver, to) {
  const deck = spline(DECK);
  const side = [...deck, ...spline(KEEL)];
  graver.fill(to(side));
  // A pale band with dark ports, as merchantmen wore it, and a gleam along two strakes.
  const strake = (down, from = -78, to_ = 78) =>
    Array.from({ length: 53 }, (_, i) => {
      const x = lerp(from, to_, i / 52);
      return [x, sheer(x) - down];
    });
  graver.clear(to([...strake(5.2, -76.5, 76), ...strake(9.8, -74, 73).reverse()]));
  for (let x = -66; x <= 67; x += 11.1) {
    const y = sheer(x);
    graver.fill(to(box(x - 2, y - 5.6, x + 2, y - 9.4)));
  }
  graver.dip(graver.ground);
  for (const down of [2.6, 12.4, 15.2]) {
    graver.swell(to(strake(down, -74, 72)), (t) => 0.5 * (0.5 + noise(t * 18, down, 9)));
  }
  graver.dip(graver.ink);
  graver.line(to(deck), 1);
  // Bowsprit, jib-boom, and the knee of the head.
  graver.swell(to(pts("68,22 92,33.5 122,47.5")), (t) => 3 - 2.1 * t);
  graver.swell(to(spline(pts("77,15 84,21 90,30"))), (t) => 2.2 - 1.2 * t);
  // Deckhouse, tryworks and rail.
  for (const [a, b, up] of [
    [-70, -56, 5],
    [14, 20, 4],
    [56, 64, 4],
  ]) {
    graver.fill(
      to([
        [a, sheer(a)],
        [a, sheer(a) + up],
        [b, sheer(b) + up],
        [b, sheer(b)],
      ]),
    );
  }
}

const sheer = (x) => 16.4 + 0.00152 * x * x;

function shrouds(rope, mast) {
  const top = mast.heads[0] - 1;
  for (let k = 0; k < 5; k++)
    rope([mastX(mast, top), top], [mast.x - 13 + k * 3.8, sheer(mast.x) - 0.5], 0.28);
  for (let y = 17; y < top - 4; y += 3.4) {
    const u = (top - y) / (top - sheer(mast.x));
    rope(
      [lerp(mastX(mast, top), mast.x - 13, u), y],
      [lerp(mastX(mast, top), mast.x + 2.2, u), y],
      0.2,
    );
  }
}

/** Three whaleboats at the davits: what tells a whaler from a merchantman. */
function boats(graver, to) {
  for (const x of [-34, -4, 26]) {
    const y = sheer(x) + 3.4;
    const shape = [
      ...spline([
        [x - 11, y + 3.4],
        [x - 6, y + 1.2],
        [x, y + 0.6],
        [x + 6, y + 1.2],
        [x + 11, y + 3.4],
      ]),
      ...spline([
        [x + 11, y + 3.4],
        [x + 6, y - 2.4],
        [x, y - 3],
        [x - 6, y - 2.4],
        [x - 11, y + 3.4],
      ]),
    ];
    graver.clear(to(shape));
    graver.line(to(shape), 0.7, true);
    graver.line(
      to(
        spline([
          [x - 9, y + 1.6],
          [x, y - 1.2],
          [x + 9, y + 1.6],
        ]),
      ),
      0.5,
    );
    for (const side of [-8.4, 8.4]) {
      graver.line(
        to(
          spline([
            [x + side, y - 4],
            [x + side, y + 7],
            [x + side * 0.86, y + 9.4],
          ]),
        ),
        0.8,
      );
      graver.line(
        to([
          [x + side * 0.9, y + 9],
          [x + side * 0.9, y + 2.2],
        ]),
        0.25,
      );
    }
  }
}
