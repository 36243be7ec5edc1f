/** The inn itself: clapboards, sashes, icicles, and the sign that swings before it. */

import { randomNumbers } from "../../../scripts/random_numbers.mjs";
import { box, clamp, pts, smooth, spline, straight } from "./curves.mjs";
import { noise } from "./noise.mjs";

/** Snow lies along a roof: a band of bare paper. */
export function snowLine(graver, roof, deep) {
  const top = roof.map(([x, y]) => [x, y - deep]);
  const shape = [...top, ...[...roof].reverse()];
  graver.clear(shape);
  graver.line(top, 0.45);
}

const FRONT = pts("142,322 140,150 213,62 288,150 288,322");

/** A queer, palsied old house, leaning over sadly, its gable to the street. */
export function house(graver, glow) {
  const shade = (x, y) =>
    clamp(0.14 + 0.5 * smooth(150, 288, x) + 0.28 * smooth(230, 90, y) - 0.35 * glow(x, y, 90));
  chimney(graver);
  graver.clear(FRONT);
  graver.within(FRONT, () => {
    // Clapboards: each casts its line of shade, more of it away from the lamp.
    for (let y = 60; y < 326; y += 4.6) {
      const slope = (x) => y + 0.018 * (x - 140);
      const board = Array.from({ length: 51 }, (_, i) => [138 + i * 3, slope(138 + i * 3)]);
      graver.swell(board, (_, x) => (0.3 + 2 * shade(x, y)) * (0.75 + 0.5 * noise(x / 16, y, 8)));
      for (const down of [1.55, 3.05]) {
        graver.swell(
          board.map(([px, py]) => [px, py + down]),
          (_, x) => 1.5 * smooth(0.2, 0.9, shade(x, y)),
          0.14,
        );
      }
    }
  });
  graver.line(FRONT, 1, true);
  roof(graver);
  for (const [x, y, w, h] of [
    [201, 104, 22, 27],
    [163, 168, 23, 33],
    [240, 170, 23, 33],
    [244, 240, 24, 34],
  ])
    sash(graver, x, y, w, h);
  door(graver);
}

function chimney(graver) {
  const stack = box(240, 58, 262, 120);
  graver.clear(stack);
  for (let y = 60; y < 122; y += 4) {
    graver.line(
      [
        [240, y],
        [262, y],
      ],
      0.6,
    );
    for (let x = 242 + (y % 8 ? 3 : 0); x < 262; x += 6)
      graver.line(
        [
          [x, y],
          [x, y + 4],
        ],
        0.4,
      );
  }
  for (let y = 58; y < 120; y += 1.7)
    graver.line(
      [
        [253, y],
        [262, y],
      ],
      0.9,
    );
  graver.line(stack, 0.8, true);
  snowLine(graver, pts("238,58 264,58"), 3.4);
  graver.dip(graver.ground);
  for (let k = 0; k < 6; k++) {
    const smoke = spline([
      [246 + k * 2, 52],
      [242 + k * 3, 38 - k],
      [252 + k * 4, 24 - k],
      [244 + k * 7, 8 - k * 2],
    ]);
    graver.swell(
      smoke,
      (t) => 2 * Math.sin(Math.PI * clamp(t * 0.9 + 0.06)) * (0.5 + 0.5 * noise(t * 6, k, 2)),
      0.1,
    );
  }
  graver.dip(graver.ink);
}

function roof(graver) {
  const eaves = [pts("130,160 213,60 214,52 124,158"), pts("296,160 213,60 214,52 304,160")];
  for (const shape of eaves) {
    graver.clear(shape);
    graver.line(shape, 0.8, true);
  }
  for (const [a, b] of [
    [
      [134, 160],
      [213, 66],
    ],
    [
      [292, 160],
      [213, 66],
    ],
  ]) {
    graver.swell(straight(a, b), () => 2.4);
  }
  // Icicles.
  const random = randomNumbers(9);
  for (let k = 1; k < 16; k++) {
    for (const side of [-1, 1]) {
      const x = 213 + side * k * 5;
      const y = 63 + k * 6.15;
      const drop = 3 + random() * 8;
      graver.clear([
        [x - 1.3, y],
        [x + 1.3, y],
        [x, y + drop],
      ]);
      graver.line(
        [
          [x + 1.2, y],
          [x, y + drop],
          [x - 1.2, y],
        ],
        0.35,
      );
    }
  }
}

function sash(graver, x, y, w, h) {
  graver.clear(box(x - 2.6, y - 2.6, x + w + 2.6, y + h + 2.6));
  graver.line(box(x - 2.6, y - 2.6, x + w + 2.6, y + h + 2.6), 0.7, true);
  const lit = y > 150;
  graver.fill(box(x, y, x + w, y + h));
  for (let i = 0; i < 3; i++) {
    for (let j = 0; j < 4; j++) {
      const px = x + 1 + (i * (w - 1)) / 3;
      const py = y + 1 + (j * (h - 1)) / 4;
      const pane = box(px, py, px + (w - 1) / 3 - 1, py + (h - 1) / 4 - 1);
      if (lit) graver.clear(pane);
      if (lit && (i + j) % 3 === 0)
        graver.line(
          [
            [px + 0.6, py + 4.5],
            [px + 4.6, py + 0.8],
          ],
          0.35,
        );
    }
  }
  snowLine(
    graver,
    [
      [x - 4, y + h + 2.8],
      [x + w + 4, y + h + 2.8],
    ],
    2.6,
  );
}

function door(graver) {
  const frame = box(172, 248, 212, 322);
  graver.clear(frame);
  graver.line(frame, 0.9, true);
  const inner = box(178, 256, 206, 322);
  graver.fill(inner);
  for (const [x0, y0, x1, y1] of [
    [181, 276, 190, 294],
    [194, 276, 203, 294],
    [181, 298, 190, 318],
    [194, 298, 203, 318],
  ]) {
    for (let y = y0; y < y1; y += 1.7) {
      graver.dip(graver.ground);
      graver.line(
        [
          [x0, y],
          [x1, y],
        ],
        0.45,
      );
    }
  }
  for (let k = 0; k < 4; k++)
    graver.fill(box(179.5 + k * 6.4, 259, 184.5 + k * 6.4, 270), graver.ground);
  graver.dip(graver.ink);
  const hood = pts("164,250 192,236 220,250");
  graver.fill(hood);
  snowLine(graver, hood, 3.2);
  const step = box(166, 318, 218, 326);
  graver.clear(step);
  graver.line(step, 0.7, true);
}

/** The swinging sign: a tall straight jet of misty spray. */
export function sign(graver) {
  graver.swell(straight([141, 190], [86, 190]), () => 1.9);
  graver.swell(spline(pts("141,212 126,206 112,192")), () => 1.3);
  graver.line(spline(pts("118,190 114,197 119,200 123,195")), 0.9);
  const tilt = 0.07;
  const at = ([x, y]) => [
    106 + (x - 106) * Math.cos(tilt) - (y - 192) * Math.sin(tilt),
    192 + (x - 106) * Math.sin(tilt) + (y - 192) * Math.cos(tilt),
  ];
  for (const x of [92, 120]) graver.line([[x, 190], at([x, 199])], 0.7);
  const board = box(84, 199, 128, 243).map(at);
  graver.fill(board);
  const put = (points) => pts(points).map(at);
  graver.dip(graver.ground);
  graver.line(box(86, 201, 126, 241).map(at), 0.5, true);
  graver.fill(
    spline(
      put(
        "90,229 93,223.6 101,221.4 110,223 116,227 120,223 124,222 121.6,227 117,231 108,232.6 97,232.4",
      ),
      { closed: true, step: 1 },
    ),
  );
  for (let k = 0; k < 5; k++) {
    const lean = (k - 2) * 1.5;
    graver.swell(
      spline(
        [
          [97, 222],
          [97 + lean * 0.5, 214],
          [97 + lean * 1.2, 206],
          [97 + lean * 2.6, 209],
        ].map(at),
      ),
      (t) => 0.5 + 0.9 * Math.sin(Math.PI * t),
    );
  }
  for (let k = 0; k < 3; k++)
    graver.line(
      spline(
        [
          [88, 235.4 + k * 1.9],
          [100, 234.4 + k * 1.9],
          [112, 236 + k * 1.9],
          [124, 235 + k * 1.9],
        ].map(at),
      ),
      0.4,
    );
  graver.dip(graver.ink);
}
