/** The frontispiece: a white sperm whale breaching under a torn sky. */
import { between, box, clamp, distance, lerp, smooth, spline } from "./curves.mjs";
import { noise, stream } from "./noise.mjs";
import { sea } from "./sea.mjs";
import { heaped, sky } from "./sky.mjs";

const HORIZON = 0.7;
/** The whale's back (left, lit) and belly (right), from the water up to the brow. */
const BACK = [
  [92, 306],
  [94, 280],
  [90, 256],
  [82, 232],
  [77, 205],
  [79, 170],
  [88, 135],
  [101, 104],
  [118, 82],
];
const BROW = [
  [118, 82],
  [128, 75],
  [142, 74],
  [157, 79],
  [168, 87],
];
const BELLY = [
  [168, 87],
  [171, 104],
  [168, 128],
  [166, 150],
  [167, 172],
  [172, 200],
  [178, 235],
  [180, 270],
  [176, 306],
];

export function breach(graver, wide, high) {
  const horizon = high * HORIZON;
  graver.within(box(0, 0, wide, high), () => {
    stormSky(graver, wide, horizon);
    const rows = sea(graver, {
      x0: -2,
      x1: wide + 2,
      y0: horizon,
      y1: high + 16,
      rows: 17,
      swell: 0.85,
      reach: 5.4,
      lit: -1,
      seed: 8,
      dark: (x, y) =>
        clamp(
          0.5 +
            0.3 * (noise(x / 40, y / 14, 5) - 0.5) -
            0.55 * Math.exp(-(((x - 134) / 88) ** 2) - ((y - 300) / 26) ** 2),
          0.03,
          0.9,
        ),
    });
    let risen = false;
    for (const y of rows) {
      if (!risen && y > horizon + 15) {
        whale(graver);
        splash(graver);
        risen = true;
      }
    }
    drops(graver);
  });
  graver.line(box(0, 0, wide, high), 0.7, true);
}

function stormSky(graver, wide, horizon) {
  const cloud = heaped({ seed: 31, cover: 0.55, scaleX: 120, scaleY: 62, sun: [-1, -1] });
  sky(graver, {
    x0: 0,
    x1: wide,
    y0: 1.4,
    y1: horizon,
    pitch: 2.45,
    bend: (x, y) => 3.2 * (noise(x / 90, y / 70, 17) - 0.5),
    dark(x, y) {
      const { body, relief } = cloud(x, y);
      const open = lerp(0.5, 0.3, y / horizon);
      const glow = 0.3 * Math.exp(-((distance([x, y], [120, 150]) / 120) ** 2));
      return clamp(
        lerp(open, 0.08 + 0.95 * (1 - relief), body) + 0.06 - glow * (1 - body) * 0.4,
        0.05,
        0.92,
      );
    },
  });
}

function whale(graver) {
  const back = spline(BACK);
  const belly = spline([...BELLY].reverse());
  const outline = [...back, ...spline(BROW), ...[...belly].reverse()];
  flipper(
    graver,
    [
      [172, 196],
      [190, 206],
      [206, 222],
      [213, 238],
      [203, 238],
      [189, 230],
      [176, 222],
    ],
    1,
  );
  graver.clear(outline);
  graver.within(outline, () => {
    // Lines across the body turn with it; light falls from the left and above.
    const lines = [...between(back, belly, 46, 2.4)];
    const n = lines.length - 1;
    lines.forEach((line, k) => {
      const u = k / n;
      graver.swell(
        line,
        (t, x, y) => {
          const round = smooth(0.36, 0.92, u) * 0.9 - 0.3 * smooth(0.93, 1, u);
          const edge = 0.4 * (1 - smooth(0, 0.05, u));
          const low = 0.3 * smooth(190, 300, y) * u;
          const scar = 0.32 * smooth(0.62, 0.75, noise(x / 9, y / 26, 3));
          return clamp(round + edge + low - scar * u - 0.1, 0, 0.9) * 1.95;
        },
        0.14,
      );
    });
    grooves(graver);
  });
  graver.swell(outline, (t) => 0.8 + 0.9 * smooth(0.5, 0.9, t), 0.1);
  jaw(graver);
  flipper(
    graver,
    [
      [118, 208],
      [110, 226],
      [98, 243],
      [84, 252],
      [86, 240],
      [96, 224],
      [106, 206],
    ],
    -1,
  );
}

/** The long jaw, dropped a little open along the throat. */
function jaw(graver) {
  const shape = spline(
    [
      [166, 116],
      [175, 128],
      [183, 146],
      [184, 158],
      [177, 163],
      [169, 160],
      [166, 152],
      [167, 138],
    ],
    { closed: true },
  );
  graver.clear(shape);
  graver.within(shape, () => {
    for (let k = 0; k < 9; k++) {
      graver.swell(
        spline([
          [162 + k * 2.4, 112],
          [168 + k * 2.2, 136],
          [166 + k * 2.4, 166],
        ]),
        (t) => 0.35 + 0.11 * k,
      );
    }
  });
  graver.line(shape, 0.8, true);
  // The mouth within, dark, with teeth.
  graver.swell(
    spline([
      [165, 112],
      [167, 128],
      [166.5, 146],
      [163, 160],
      [157, 170],
    ]),
    (t) => 2.6 * Math.sin(Math.PI * clamp(t * 0.92 + 0.04)),
  );
}

/** Eye, the crease of the mouth, wrinkles of skin, and old scars of the iron. */
function grooves(graver) {
  const cut = (points, w) =>
    graver.swell(spline(points), (t) => w * Math.sin(Math.PI * clamp(t)) + 0.15);
  graver.fill(
    spline(
      [
        [146, 176],
        [149.4, 173.6],
        [153, 176.4],
        [149.2, 178.6],
      ],
      { closed: true },
    ),
  );
  for (let k = 0; k < 3; k++)
    cut(
      [
        [141, 171 - k * 3.4],
        [149, 167.4 - k * 3.6],
        [157, 171.6 - k * 3.4],
      ],
      0.8,
    );
  for (let k = 0; k < 3; k++)
    cut(
      [
        [142, 181 + k * 3],
        [149, 183.4 + k * 3],
        [156, 181 + k * 3],
      ],
      0.6,
    );
  for (let k = 0; k < 10; k++) {
    const x = 120 + k * 5.2;
    cut(
      [
        [x, 214 + (k % 3) * 5],
        [x + 1.5, 240],
        [x + 0.5, 276 - (k % 4) * 7],
      ],
      1.1 + k * 0.06,
    );
  }
  for (const [x, y, dx, dy] of [
    [104, 134, 22, -9],
    [112, 150, 16, 11],
    [96, 186, 24, -5],
    [128, 112, 14, 9],
    [110, 196, 13, 10],
  ]) {
    cut(
      [
        [x, y],
        [x + dx / 2, y + dy / 2 - 2],
        [x + dx, y + dy],
      ],
      0.9,
    );
  }
}

function flipper(graver, points, side) {
  const shape = spline(points, { closed: true });
  graver.clear(shape);
  graver.within(shape, () => {
    for (let k = 0; k < 14; k++) {
      const a = points[0];
      const x = a[0] + side * (k * 3.4 - 6);
      graver.swell(
        spline([
          [x - side * 6, a[1] - 14],
          [x + side * 5, a[1] + 16],
          [x + side * 15, a[1] + 48],
        ]),
        () => (side > 0 ? 1.35 : 0.55 + k * 0.05),
      );
    }
  });
  graver.line(shape, 0.8, true);
}

/** Sheets of water thrown off to either side: bare paper between cut streaks. */
function splash(graver) {
  const random = stream(77);
  for (const side of [-1, 1]) {
    const root = side < 0 ? 96 : 178;
    for (let ring = 4; ring >= 0; ring--) {
      const reach = 16 + ring * 15;
      const tall = 66 - ring * 9 + random() * 8;
      const shape = plume(root, side, reach, tall, random);
      graver.clear(shape);
      graver.line(shape.slice(1, -1), 0.55);
      for (let k = 0; k < 7; k++) {
        const u = (k + 0.4 + random() * 0.4) / 7;
        const x = root + side * reach * u * 1.15;
        const line = spline([
          [root + side * (u * reach - 6), 300],
          [x, 290 - tall * 0.35],
          [x + side * 5, 292 - tall * (0.5 + 0.28 * random())],
        ]);
        graver.swell(line, (t) => 0.95 * Math.sin(Math.PI * clamp(t)) ** 0.8);
      }
    }
  }
}

/** One ragged sheet of spray, its upper edge broken into tongues. */
function plume(root, side, reach, tall, random) {
  const edge = [[root - side * 12, 304]];
  const tongues = 5;
  for (let k = 0; k < tongues; k++) {
    const u = (k + 0.5) / tongues;
    const crown = tall * Math.sin(Math.PI * clamp(0.22 + u * 0.7)) ** 0.7;
    const x = root + side * (u * reach * 1.5 - 6);
    edge.push([x - side * 3, 296 - crown * (0.62 + 0.12 * random())]);
    edge.push([x + side * 2.5, 296 - crown * (0.96 + 0.2 * random())]);
    edge.push([x + side * 5, 296 - crown * (0.66 + 0.1 * random())]);
  }
  edge.push([root + side * (reach * 1.75), 304]);
  return spline(edge);
}

function drops(graver) {
  const random = stream(5);
  for (let k = 0; k < 90; k++) {
    const side = k % 2 ? 1 : -1;
    const x = (side < 0 ? 92 : 180) + side * random() ** 1.4 * 84;
    const y = 276 - random() ** 1.6 * 110;
    const r = 0.5 + random() ** 3 * 1.5;
    const bead = spline(
      [
        [x, y - r * 1.5],
        [x + r, y],
        [x, y + r],
        [x - r, y],
      ],
      { closed: true, step: 1 },
    );
    graver.clear(bead);
    if (r > 0.8) graver.line(bead, 0.35, true);
  }
}
