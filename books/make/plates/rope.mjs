/** Laid rope: three strands twisted, drawn along any path; later turns cover earlier ones. */
import { length } from "./curves.mjs";

export function rope(graver, path, width) {
  const total = length(path);
  const normals = path.map((_, i) => normal(path, i));
  const side = (s) => path.map(([x, y], i) => [x + normals[i][0] * s, y + normals[i][1] * s]);
  const left = side(width / 2);
  const right = side(-width / 2);
  graver.clear([...left, ...[...right].reverse()]);
  const lay = width * 0.62; // from one strand to the next
  let at = 0;
  let next = 0;
  for (let i = 1; i < path.length; i++) {
    const [ax, ay] = path[i - 1];
    const [bx, by] = path[i];
    const d = Math.hypot(bx - ax, by - ay);
    while (next <= at + d && next < total - lay) {
      const u = d ? (next - at) / d : 0;
      strand(graver, [ax + (bx - ax) * u, ay + (by - ay) * u], normals[i], width);
      next += lay;
    }
    at += d;
  }
  graver.swell(left, () => 0.75);
  graver.swell(right, () => 1.2);
}

/** One strand crossing the rope in an S, with two lines of shade below it. */
function strand(graver, [x, y], [nx, ny], width) {
  const [tx, ty] = [ny, -nx];
  const h = width / 2;
  const point = (a, b) => [x + nx * a * h + tx * b * h, y + ny * a * h + ty * b * h];
  const line = [
    point(1, -0.62),
    point(0.5, -0.32),
    point(0, 0),
    point(-0.5, 0.32),
    point(-1, 0.62),
  ];
  graver.swell(line, (t) => 0.5 + 0.5 * Math.sin(Math.PI * t), 0.1);
  for (const [from, off, w] of [
    [0.1, 0.34, 0.5],
    [-0.3, 0.66, 0.55],
  ]) {
    graver.swell(
      [point(from, off - from * 0.62 * 0.5), point(-0.6, off + 0.37), point(-0.98, off + 0.6)],
      (t) => w * (0.4 + 0.8 * t),
      0.08,
    );
  }
}

function normal(path, i) {
  const [ax, ay] = path[Math.max(i - 1, 0)];
  const [bx, by] = path[Math.min(i + 1, path.length - 1)];
  const len = Math.hypot(bx - ax, by - ay) || 1;
  return [-(by - ay) / len, (bx - ax) / len];
}
