/** Two irons crossed, bent to one line: a vignette without a frame. */
import { between, circle, clamp, lerp, pts, spline } from "./curves.mjs";
import { noise } from "./noise.mjs";
import { rope } from "./rope.mjs";

export function harpoons(graver, wide) {
  const middle = wide / 2;
  coil(graver, middle, 262);
  iron(graver, [middle - 92, 330], [middle + 88, 26], twoFlued);
  iron(graver, [middle + 92, 330], [middle - 88, 26], toggle);
  lashing(graver, middle, 176);
}

/** A frame along the iron: (s, r) is s points from the butt, r to its right. */
function along(butt, tip) {
  const len = Math.hypot(tip[0] - butt[0], tip[1] - butt[1]);
  const [tx, ty] = [(tip[0] - butt[0]) / len, (tip[1] - butt[1]) / len];
  const put = (points) =>
    points.map(([s, r]) => [butt[0] + tx * s - ty * r, butt[1] + ty * s + tx * r]);
  return { len, put };
}

function iron(graver, butt, tip, head) {
  const { len, put } = along(butt, tip);
  const pole = len * 0.56;
  shank(graver, put, pole, len);
  wood(graver, put, pole);
  socket(graver, put, pole);
  head(graver, put, len);
}

/** The pole: ash with its bark on, shaded along the grain, with a knot here and there. */
function wood(graver, put, pole) {
  const half = (s) => 4.6 + 0.35 * Math.sin(s / 11) + 0.8 * (noise(s / 13, 2, 5) - 0.5);
  const edge = (sign) =>
    Array.from({ length: 67 }, (_, i) => [(i / 66) * pole, sign * half((i / 66) * pole)]);
  const [a, b] = [edge(-1), edge(1)];
  const shape = put([...a, ...[...b].reverse()]);
  graver.clear(shape);
  graver.within(shape, () => {
    const lines = [...between(put(a), put(b), 9, 2.4)];
    lines.forEach((line, k) => {
      graver.swell(
        line,
        (t) => clamp(0.12 + 0.1 * k + 0.55 * (noise(t * 26, k * 0.6, 8) - 0.45), 0, 1) * 1.3,
        0.12,
      );
    });
    for (const s of [24, 61, 97, 131]) {
      const knot = spline(
        put([
          [s - 4, 1],
          [s, -1.6],
          [s + 4, 1],
          [s, 3],
        ]),
        { closed: true, step: 1 },
      );
      graver.line(knot, 0.6, true);
      graver.fill(
        spline(
          put([
            [s - 1.6, 0.9],
            [s, 0],
            [s + 1.6, 0.9],
            [s, 1.8],
          ]),
          { closed: true, step: 1 },
        ),
      );
    }
  });
  graver.swell(put(a), () => 0.8);
  graver.swell(put(b), () => 1.5);
  graver.line(
    spline(
      put([
        [0, -4.6],
        [-2.6, 0],
        [0, 4.6],
      ]),
    ),
    0.9,
  );
}

/** The iron's socket, served over with spun yarn. */
function socket(graver, put, pole) {
  const shape = put([
    [pole - 26, -5.6],
    [pole - 4, -5.2],
    [pole + 14, -2.4],
    [pole + 14, 2.4],
    [pole - 4, 5.2],
    [pole - 26, 5.6],
  ]);
  graver.clear(shape);
  graver.within(shape, () => {
    for (let s = -25; s < 14; s += 1.55) {
      const served = s < -4;
      const line = spline(
        put([
          [pole + s, -6],
          [pole + s + 0.9, 0],
          [pole + s, 6],
        ]),
        { step: 1 },
      );
      graver.swell(line, (t) => (served ? 0.35 + 0.75 * t : 0.15 + 1.15 * t ** 1.6));
    }
  });
  graver.line(shape, 0.9, true);
}

function shank(graver, put, pole, len) {
  const a = put([
    [pole, -1.7],
    [len - 10, -1.4],
  ]);
  const b = put([
    [pole, 1.7],
    [len - 10, 1.4],
  ]);
  graver.clear([...a, ...[...b].reverse()]);
  graver.line(a, 0.6);
  graver.line(b, 1.5);
  graver.line(
    put([
      [pole, 0.2],
      [len - 10, 0.2],
    ]),
    0.3,
  );
}

/** The old two-flued head: a broad arrow. */
function twoFlued(graver, put, len) {
  const right = [
    ...spline([
      [len + 14, 0],
      [len + 2, 4.5],
      [len - 18, 14],
      [len - 25, 16.5],
    ]),
    ...spline([
      [len - 25, 16.5],
      [len - 17, 8.5],
      [len - 12, 1.5],
    ]),
  ];
  const left = right.map(([s, r]) => [s, -r]);
  const shape = put([...right, ...[...left].reverse()]);
  graver.clear(shape);
  graver.within(shape, () => {
    for (let k = 0; k < 18; k++) {
      const s = len + 12 - k * 2.1;
      graver.swell(
        put([
          [s, 0],
          [s - 7.5, 10],
          [s - 13, 18],
        ]),
        (t) => 1.25 - 0.4 * t,
      );
      graver.swell(
        put([
          [s, 0],
          [s - 7.5, -10],
          [s - 13, -18],
        ]),
        () => 0.4,
      );
    }
  });
  graver.line(shape, 0.9, true);
  graver.line(
    put([
      [len + 14, 0],
      [len - 12, 0],
    ]),
    0.7,
  );
}

/** The toggle iron, its head turned a little on the pin. */
function toggle(graver, put, len) {
  const head = [
    ...spline([
      [len + 13, -3],
      [len + 2, 3.6],
      [len - 14, 5],
      [len - 24, 3],
    ]),
    ...spline([
      [len - 24, 3],
      [len - 19, -1.5],
      [len - 26, -10],
      [len - 10, -6.5],
      [len + 4, -5.4],
      [len + 13, -3],
    ]),
  ];
  const shape = put(head);
  graver.clear(shape);
  graver.within(shape, () => {
    for (let k = 0; k < 11; k++) {
      const r = -10 + k * 1.55;
      graver.swell(
        put([
          [len + 14, r * 0.3 - 2],
          [len - 8, r + 1],
          [len - 28, r - 0.5],
        ]),
        (t) => (0.25 + 0.09 * k) * (0.5 + 0.7 * t),
      );
    }
  });
  graver.line(shape, 0.9, true);
  graver.fill(circle(...put([[len - 9, 0]])[0], 1.5, 14));
}

/** Where they cross, turns are passed round both poles, then frapped between them. */
function lashing(graver, x, y) {
  for (let k = -4; k <= 4; k++) {
    const dy = k * 4.5;
    const half = 8.6 + Math.abs(dy) * 0.58;
    const turn = [
      [x - half, y + dy - 1.2],
      [x - half * 0.45, y + dy + 0.9],
      [x + half * 0.45, y + dy + 0.9],
      [x + half, y + dy - 1.2],
    ];
    rope(graver, spline(turn), 5);
  }
  for (const dx of [-2.6, 2.6]) {
    rope(
      graver,
      spline([
        [x + dx * 1.5, y - 12],
        [x + dx, y],
        [x + dx * 1.5, y + 12],
      ]),
      4.8,
    );
  }
}

/** The line, coiled right-handed below, its end led up to the irons. */
function coil(graver, x, y) {
  rope(
    graver,
    spline([
      [x - 6, 182],
      [x - 20, 206],
      [x - 44, 222],
      [x - 66, 244],
      [x - 72, 262],
    ]),
    5.4,
  );
  rope(
    graver,
    spline([
      [x + 6, 182],
      [x + 22, 204],
      [x + 48, 214],
      [x + 63, 230],
      [x + 66, 252],
    ]),
    5.4,
  );
  for (let k = 0; k < 5; k++) {
    const rx = 72 - k * 7.4;
    const ry = 27 - k * 2.9;
    const turn = circle(x, y + 8 - k * 5.2, 1, 90, -0.3, Math.PI * 2 - 0.3).map(([cx, cy]) => [
      x + (cx - x) * rx,
      y + 8 - k * 5.2 + (cy - (y + 8 - k * 5.2)) * ry,
    ]);
    rope(graver, turn, 5.8);
  }
  const [fx, fy] = [x + lerp(0, 1, 0.5) * 34, y - 14];
  rope(
    graver,
    spline(
      pts(
        `${fx},${fy} ${x + 10},${y - 6} ${x - 12},${y - 10} ${x - 8},${y - 20} ${x + 8},${y - 19}`,
      ),
    ),
    5.4,
  );
}
