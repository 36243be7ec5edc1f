/** The sperm whale of the binding and the title page: one shape, with lines cut into it. */
import { along, clamp, pts, spline } from "./plates/curves.mjs";

const BACK = pts(
  "-100,4 -102,-14 -96,-30 -80,-38 -50,-41 -15,-40 15,-35 36,-28.5 45,-28 53,-22.5 60,-20.5 66,-18.5 72,-19 80,-23 88,-31 95,-43 99,-57",
);
const NEAR_LOBE = pts("99,-57 90,-65 76,-70 58,-68.5");
const NEAR_EDGE = pts("58,-68.5 74,-77 90,-78.5 103,-71");
const FAR_EDGE = pts("103,-71 114,-81 131,-86 150,-80");
const FAR_LOBE = pts("150,-80 135,-76.5 120,-68 111,-55");
const BELLY = pts(
  "111,-55 109,-38 102,-18 89,4 70,20 44,31 10,37 -20,38 -42,35.5 -62,30 -76,24.5 -85,19",
);
const JAW = pts("-85,19 -84,15.5 -91,13.5 -98,10 -100,4");
const FLIPPER = pts("-28,22 -22,36 -10,49 4,55 7,47 2,36 -6,24");

const outline = () =>
  [BACK, NEAR_LOBE, NEAR_EDGE, FAR_EDGE, FAR_LOBE, BELLY, JAW].flatMap((part) => spline(part));

/** Lines that run with the body, from the back's `t` of the way to the belly. */
function grain(t) {
  const back = spline(BACK.slice(1));
  const belly = spline([...BELLY].reverse());
  const n = 90;
  return Array.from({ length: n + 1 }, (_, i) => {
    const u = i / n;
    const a = along(back, u);
    const b = along(belly, u);
    return [a[0] + (b[0] - a[0]) * t, a[1] + (b[1] - a[1]) * t];
  });
}

/** Draw it about (x, y), head to the left; `ink` fills it and `cut` is cut out of it. */
export function drawWhale(graver, { x, y, scale, ink, cut, spout = true }) {
  const put = (points) => points.map(([px, py]) => [x + px * scale, y + py * scale]);
  const groove = (points, width) => {
    graver.dip(cut);
    graver.swell(put(points), (t) => width(t) * scale);
    graver.dip(ink);
  };
  graver.dip(ink);
  graver.fill(put(outline()));
  for (let k = 0; k < 11; k++) {
    const t = 0.42 + k * 0.053;
    const from = 0.3 + 0.09 * Math.sin(k * 2.1) + (k < 4 ? 0.1 : 0);
    const to = 0.93 - 0.012 * k;
    groove(grain(t), (u) =>
      u < from || u > to ? 0 : 0.35 + 1.5 * Math.sin((Math.PI * (u - from)) / (to - from)) ** 0.7,
    );
  }
  for (const side of [-1, 1]) {
    for (let k = 0; k < 4; k++) {
      const far = side > 0;
      const a = [105 + side * (k + 0.6) * 1.3, -60 - k * 1.2];
      const b = far ? [140 - k * 7, -79.5 + k * 0.4] : [70 + k * 7, -71.5 - k * 0.8];
      const mid = [(a[0] + b[0]) / 2, Math.min(a[1], b[1]) + 2.5 - k * 0.4];
      groove(spline([a, mid, b]), (u) => 0.2 + 0.9 * Math.sin(Math.PI * clamp(u)));
    }
  }
  // Mouth, eye and flipper.
  groove(spline(pts("-93,12 -76,15.5 -60,19 -47,20 -42,17")), (u) => 1.5 - u * 0.7);
  const eye = spline(pts("-43,8.5 -39,6.2 -35,8.5 -39,10.4"), { closed: true });
  graver.fill(put(eye), cut);
  for (let k = 0; k < 3; k++) {
    groove(
      spline([
        [-46, 4 - k * 2.6],
        [-39, 1.4 - k * 3],
        [-31, 4.4 - k * 2.6],
      ]),
      (u) => 0.9 * Math.sin(Math.PI * u),
    );
  }
  const flipper = spline(FLIPPER);
  graver.fill(put(flipper.map(([px, py]) => [px + (px + 12) * 0.12, py + (py - 38) * 0.12])), cut);
  graver.fill(put(flipper));
  if (spout) drawSpout(graver, put, scale);
}

/** The blow goes up and forward, as only a sperm whale's does. */
function drawSpout(graver, put, scale) {
  const foot = [-91, -37];
  for (let k = 0; k < 7; k++) {
    const lean = -30 + k * 6.2;
    const high = 34 - Math.abs(k - 2.6) * 3.4;
    const tip = [foot[0] + lean - 6, foot[1] - high + Math.abs(k - 3) * 1.6];
    const knee = [foot[0] + lean * 0.36 - 2, foot[1] - high * 0.78];
    const curl = [tip[0] + (k < 3 ? -5 : 4), tip[1] + 7];
    graver.swell(
      put(spline([foot, knee, tip, curl])),
      (t) => (0.5 + 1.7 * Math.sin(Math.PI * clamp(t * 0.9 + 0.1))) * scale * (t > 0.97 ? 0.4 : 1),
    );
  }
}
