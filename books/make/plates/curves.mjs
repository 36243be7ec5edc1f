/** Curves as lists of points: splines through points, families of lines, and simple measures. */

/** A smooth curve through points (centripetal Catmull-Rom), about `step` points apart. */
export function spline(points, { closed = false, step = 1.5 } = {}) {
  const n = points.length;
  const at = (i) => (closed ? points[(i + n) % n] : points[Math.min(Math.max(i, 0), n - 1)]);
  const out = [];
  const last = closed ? n : n - 1;
  for (let i = 0; i < last; i++) {
    const [p0, p1, p2, p3] = [at(i - 1), at(i), at(i + 1), at(i + 2)];
    const count = Math.max(2, Math.ceil(distance(p1, p2) / step));
    for (let k = 0; k < count; k++) out.push(catmull(p0, p1, p2, p3, k / count));
  }
  if (!closed) out.push(at(n - 1));
  return out;
}

/** A point of the centripetal segment from p1 to p2 (Barry and Goldman's pyramid). */
function catmull(p0, p1, p2, p3, u) {
  const knot = (a, b) => Math.sqrt(distance(a, b)) || 1e-4;
  const t1 = knot(p0, p1);
  const t2 = t1 + knot(p1, p2);
  const t3 = t2 + knot(p2, p3);
  const t = t1 + (t2 - t1) * u;
  const mix = (a, b, ta, tb) => [
    (a[0] * (tb - t) + b[0] * (t - ta)) / (tb - ta),
    (a[1] * (tb - t) + b[1] * (t - ta)) / (tb - ta),
  ];
  const a1 = mix(p0, p1, 0, t1);
  const a2 = mix(p1, p2, t1, t2);
  const a3 = mix(p2, p3, t2, t3);
  return mix(mix(a1, a2, 0, t2), mix(a2, a3, t1, t3), t1, t2);
}

export const distance = (a, b) => Math.hypot(a[0] - b[0], a[1] - b[1]);
export const lerp = (a, b, t) => a + (b - a) * t;
export const clamp = (v, lo = 0, hi = 1) => Math.min(hi, Math.max(lo, v));
export const smooth = (lo, hi, v) => {
  const t = clamp((v - lo) / (hi - lo));
  return t * t * (3 - 2 * t);
};

/** A straight line as points `step` apart, so that its width may vary along it. */
export function straight(a, b, step = 3) {
  const n = Math.max(1, Math.ceil(distance(a, b) / step));
  return Array.from({ length: n + 1 }, (_, i) => [
    lerp(a[0], b[0], i / n),
    lerp(a[1], b[1], i / n),
  ]);
}

/** Level lines over a box, `bend(x, y)` moving each point up or down. */
export function* levels(x0, x1, y0, y1, pitch, bend = () => 0, step = 3) {
  for (let y = y0; y <= y1; y += pitch) {
    yield straight([x0, y], [x1, y], step).map(([x]) => [x, y + bend(x, y)]);
  }
}

/** Lines between two edges (same direction): the family a bent surface carries. */
export function* between(a, b, count, step = 2) {
  const n = Math.ceil(Math.max(length(a), length(b)) / step);
  const p = Array.from({ length: n + 1 }, (_, i) => along(a, i / n));
  const q = Array.from({ length: n + 1 }, (_, i) => along(b, i / n));
  for (let k = 0; k <= count; k++) {
    const t = k / count;
    yield p.map((at, i) => [lerp(at[0], q[i][0], t), lerp(at[1], q[i][1], t)]);
  }
}

export function length(points) {
  let sum = 0;
  for (let i = 1; i < points.length; i++) sum += distance(points[i - 1], points[i]);
  return sum;
}

/** The point a share t of the way along. */
export function along(points, t) {
  let want = length(points) * t;
  for (let i = 1; i < points.length; i++) {
    const d = distance(points[i - 1], points[i]);
    if (want <= d && d > 0) {
      const u = want / d;
      return [lerp(points[i - 1][0], points[i][0], u), lerp(points[i - 1][1], points[i][1], u)];
    }
    want -= d;
  }
  return points[points.length - 1];
}

export function circle(cx, cy, r, n = 72, from = 0, to = Math.PI * 2) {
  return Array.from({ length: n + 1 }, (_, i) => {
    const a = lerp(from, to, i / n);
    return [cx + r * Math.cos(a), cy + r * Math.sin(a)];
  });
}

export const box = (x0, y0, x1, y1) => [
  [x0, y0],
  [x1, y0],
  [x1, y1],
  [x0, y1],
];

/** Is a point inside a polygon (even-odd)? */
export function inside(polygon, x, y) {
  let yes = false;
  for (let i = 0, j = polygon.length - 1; i < polygon.length; j = i++) {
    const [xi, yi] = polygon[i];
    const [xj, yj] = polygon[j];
    if (yi > y !== yj > y && x < ((xj - xi) * (y - yi)) / (yj - yi) + xi) yes = !yes;
  }
  return yes;
}

/** Ramer, Douglas and Peucker on points of any dimension. */
export function simplify(points, tolerance) {
  if (points.length < 3) return points;
  const keep = new Uint8Array(points.length);
  keep[0] = keep[points.length - 1] = 1;
  const stack = [[0, points.length - 1]];
  while (stack.length) {
    const [a, b] = stack.pop();
    let worst = tolerance;
    let at = -1;
    for (let i = a + 1; i < b; i++) {
      const d = offChord(points[i], points[a], points[b]);
      if (d > worst) {
        worst = d;
        at = i;
      }
    }
    if (at > 0) {
      keep[at] = 1;
      stack.push([a, at], [at, b]);
    }
  }
  return points.filter((_, i) => keep[i]);
}

function offChord(p, a, b) {
  let dot = 0;
  let len = 0;
  for (let k = 0; k < p.length; k++) {
    dot += (p[k] - a[k]) * (b[k] - a[k]);
    len += (b[k] - a[k]) ** 2;
  }
  const t = len ? clamp(dot / len) : 0;
  let sum = 0;
  for (let k = 0; k < p.length; k++) sum += (p[k] - lerp(a[k], b[k], t)) ** 2;
  return Math.sqrt(sum);
}

/** Points from "x,y x,y …", the shortest way to write a drawn contour down. */
export const pts = (text) => text.split(" ").map((pair) => pair.split(",").map(Number));
