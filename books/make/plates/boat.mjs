/** A whaleboat, fast to a whale: six men, the line taut over the bow, the sea torn up. */

import { randomNumbers } from "../../../scripts/random_numbers.mjs";
import { between, box, clamp, lerp, pts, smooth, spline } from "./curves.mjs";
import { noise } from "./noise.mjs";
import { sea } from "./sea.mjs";
import { heaped, sky } from "./sky.mjs";

const AT = [112, 262];
const PITCH = -0.13; // she is dragged bow up
const SCALE = 1.02;

/** Boat's units (y up from the keel amidships, bow to the right) to the page. */
const put = ([x, y]) => {
  const c = Math.cos(PITCH);
  const s = Math.sin(PITCH);
  return [AT[0] + SCALE * (x * c + y * s), AT[1] + SCALE * (x * s - y * c)];
};
const to = (points) => points.map(put);

export function boat(graver, wide, high) {
  const horizon = high * 0.4;
  graver.within(box(0, 0, wide, high), () => {
    const cloud = heaped({ seed: 62, cover: 0.5, scaleX: 110, scaleY: 34, sun: [-1, -1] });
    sky(graver, {
      x0: 0,
      x1: wide,
      y0: 1.4,
      y1: horizon,
      pitch: 2.5,
      dark(x, y) {
        const { body, relief } = cloud(x, y);
        const clear = lerp(0.6, 0.2, smooth(0, horizon, y));
        return clamp(lerp(clear, 0.06 + 0.75 * (1 - relief), body * 0.92), 0.06, 0.85);
      },
    });
    const rows = sea(graver, {
      x0: -2,
      x1: wide + 2,
      y0: horizon,
      y1: high + 22,
      rows: 15,
      swell: 0.98,
      reach: 4.9,
      lit: -1,
      seed: 21,
      power: 1.5,
      dark: (x, y) => clamp(0.5 + 0.25 * (noise(x / 50, y / 18, 9) - 0.5) - wake(x, y), 0.02, 0.88),
    });
    let whaleSeen = false;
    let afloat = false;
    for (const y of rows) {
      if (!whaleSeen && y > horizon + 17) {
        quarry(graver);
        whaleSeen = true;
      }
      if (!afloat && y > AT[1] - 2) {
        line(graver);
        crew(graver);
        hull(graver);
        bowWave(graver);
        afloat = true;
      }
    }
  });
  graver.line(box(0, 0, wide, high), 0.7, true);
}

const wake = (x, y) => 0.55 * Math.exp(-(((x - 60) / 90) ** 2) - ((y - 276) / 17) ** 2);

/** Far ahead, the hump of him that tows her, and his breath. */
function quarry(graver) {
  graver.fill(
    spline(
      pts("206,186 213,172 228,164 246,161.5 260,164 267,162.4 272,166 279,172 292,178 292,190"),
    ),
  );
  graver.dip(graver.ground);
  for (let k = 0; k < 4; k++) {
    const y = 168 + k * 3;
    graver.swell(
      spline([
        [222 - k, y + 2],
        [242, y - 2.2],
        [264 + k * 3, y + 1.4],
      ]),
      (t) => 0.75 * Math.sin(Math.PI * t),
    );
  }
  const random = randomNumbers(2);
  for (let k = 0; k < 34; k++) {
    const lean = -9 + random() * 24;
    const up = 24 + random() * 22;
    const droop = up * (0.5 + 0.4 * random());
    const jet = spline([
      [258, 165],
      [258 + lean * 0.3, 165 - up * 0.7],
      [258 + lean * 0.9, 165 - up],
      [260 + lean * 1.7, 165 - droop],
    ]);
    graver.swell(jet, (t) => 0.3 + 0.75 * smooth(0, 0.6, t) * (1 - t) * 1.6, 0.1);
  }
  graver.dip(graver.ink);
}

function line(graver) {
  graver.swell(spline([...to(pts("92,27")), [228, 199], [244, 176]]), () => 0.75);
}

const SHEER = pts("-88,27 -66,17.5 -34,12.4 0,10.6 34,12.4 66,18 94,29");
const FOOT = pts("94,29 90,18 80,7 62,0 28,-4 -22,-4 -58,-1 -76,7 -84,17 -88,27");

function hull(graver) {
  const sheer = spline(SHEER);
  const foot = spline(FOOT);
  const shape = to([...sheer, ...foot]);
  graver.clear(shape);
  graver.within(shape, () => {
    // Seven strakes, lapped: each a dark edge over a shaded plank.
    const low = [...foot].reverse();
    const planks = [...between(to(sheer), to(low), 14, 2.5)];
    planks.forEach((plank, k) => {
      const lap = k % 3 === 0;
      graver.swell(
        plank,
        (t) =>
          lap
            ? 1.1
            : 0.12 +
              0.5 * smooth(0.2, 1, k / 14) +
              0.5 * smooth(0.6, 1, t) +
              0.25 * smooth(0.25, 0, t),
        0.1,
      );
    });
  });
  graver.line(shape, 0.9, true);
  graver.swell(to(sheer), (t) => 2.3 - 0.6 * Math.abs(t - 0.5));
  // Loggerhead aft, chocks forward, oars shipped and peaked.
  graver.fill(to(box(-82, 24, -78.6, 33)));
  graver.swell(to(pts("-128,21 -96,27 -70,31")), (t) => 1.2 + 0.5 * t);
  for (const x of [-46, -18, 10, 38]) {
    graver.swell(
      to([
        [x - 4, 12],
        [x + 15, 30],
        [x + 34, 49],
      ]),
      () => 1.15,
    );
    graver.fill(
      to(
        spline(
          [
            [x + 34, 48],
            [x + 44, 55],
            [x + 50, 64],
            [x + 46, 64],
            [x + 38, 57],
          ],
          { closed: true },
        ),
      ),
    );
  }
}

/** Five men bent at the thwarts, one standing in the bow, one at the steering oar. */
function crew(graver) {
  for (const [x, lean] of [
    [-42, 0.1],
    [-15, 0.16],
    [12, 0.13],
    [38, 0.18],
  ])
    seated(graver, x, lean);
  standing(graver, -71, 18, STEERSMAN);
  standing(graver, 70, 17, HARPOONER);
}

function figure(graver, shape, folds) {
  graver.clear(shape);
  graver.within(shape, () => {
    for (const fold of folds) graver.swell(fold, (t) => 0.5 + 0.9 * Math.sin(Math.PI * t), 0.1);
  });
  graver.line(shape, 0.8, true);
}

function seated(graver, x, lean) {
  const at = (points) => to(pts(points).map(([px, py]) => [x + px + py * lean, 10 + py]));
  const body = spline(at("-9,0 -8.5,9 -6.5,17 -1,20.5 4,19 6.5,13 7,6 9,0"), { closed: true });
  const folds = [];
  for (let k = 0; k < 8; k++)
    folds.push(spline(at(`${-8.6 + k * 1.3},0 ${-7.4 + k * 1.25},10 ${-4 + k * 0.9},20`)));
  figure(graver, body, folds);
  graver.fill(spline(at("-3,20.5 -3.6,25 -0.6,28.6 3.8,28 5,24.4 3.6,20.6"), { closed: true }));
  graver.fill(spline(at("-5.2,25.6 -2.6,30.6 3.4,31 6.4,27 3,26.6"), { closed: true }));
  // The arms reach to the loom.
  graver.swell(spline(at("1,17 8,11.5 14,12.5")), (t) => 4.4 - 1.6 * t);
}

const STEERSMAN = {
  legs: "-4,0 -5,12 -1,17 5,12 4,0",
  coat: "-6,14 -7.4,26 -5,35 1,37.6 5.6,34 6.6,24 6,13",
  head: [0.6, 42],
  arms: ["3,33 -4,25 -12,17", "-4,33 -10,26 -14,19"],
};
const HARPOONER = {
  legs: "-6,0 -6,12 -1,17 6,12 9,0",
  coat: "-7,14 -7,25 -3,36 4,38.6 9,35 8.6,25 6.5,13",
  head: [5.6, 43.4],
  arms: ["7,35 14,43 20,50.5", "0,36 -7,44 -8,54"],
  iron: "-32,57 52,47",
};

function standing(graver, x, y, man) {
  const at = (points) => to(pts(points).map(([px, py]) => [x + px, y + py]));
  graver.fill(spline(at(man.legs), { closed: true }));
  if (man.iron) {
    graver.swell(at(man.iron), () => 1.2);
    const [tip] = at("60,46");
    const [a, b] = at("50,50.5 50,44.2");
    graver.fill([tip, a, b]);
  }
  const coat = spline(at(man.coat), { closed: true });
  const folds = [];
  for (let k = 0; k < 8; k++)
    folds.push(spline(at(`${-6.6 + k * 1.2},12 ${-6.4 + k * 1.2},26 ${-3.4 + k * 0.9},39`)));
  figure(graver, coat, folds);
  for (const arm of man.arms) graver.swell(spline(at(arm)), (t) => 4.6 - 1.6 * t);
  const [hx, hy] = man.head;
  graver.fill(
    spline(
      at(
        `${hx - 3.4},${hy - 3} ${hx - 3.8},${hy + 2} ${hx},${hy + 4.4} ${hx + 3.8},${hy + 2} ${hx + 3},${hy - 3.4}`,
      ),
      { closed: true },
    ),
  );
  graver.fill(
    spline(
      at(`${hx - 6},${hy + 1.6} ${hx - 3},${hy + 6.6} ${hx + 3},${hy + 6.4} ${hx + 6},${hy + 1.6}`),
      { closed: true },
    ),
  );
}

/** Water thrown from the bow in sheets: white line over the dark. */
function bowWave(graver) {
  const random = randomNumbers(11);
  graver.dip(graver.ground);
  for (let k = 0; k < 120; k++) {
    const [x, y] = put([84 - random() * 46, -3 + random() * 7]);
    const out = 10 + random() * 44;
    const up = 6 + random() * 30;
    const arc = Array.from({ length: 12 }, (_, i) => {
      const t = (i / 11) * 0.8;
      return [x + out * t, y + 6 - up * 4 * t * (1 - t) + t * 6];
    });
    const heavy = 0.5 + 2 * random() ** 2;
    graver.swell(arc, (t) => heavy * (1 - t) ** 0.6 + 0.1, 0.08);
  }
  for (let k = 0; k < 60; k++) {
    const [x, y] = put([-96 + k * 3.2, -3]);
    const r = 2.5 + random() * 4;
    graver.fill(
      spline(
        [
          [x - r * 1.5, y + 3],
          [x - r, y - r * 0.5],
          [x, y - r * 0.8],
          [x + r, y - r * 0.4],
          [x + r * 1.5, y + 3],
        ],
        { closed: true },
      ),
      graver.ground,
    );
  }
  graver.dip(graver.ink);
  for (let k = 0; k < 34; k++) {
    const [x, y] = put([-92 + random() * 176, -3 + random() * 3]);
    const r = 2 + random() * 4;
    graver.swell(
      spline([
        [x - r, y],
        [x - r * 0.3, y - r * 0.6],
        [x + r * 0.6, y - r * 0.4],
        [x + r, y + 0.4],
      ]),
      (t) => 0.7 * Math.sin(Math.PI * t),
      0.1,
    );
  }
}
