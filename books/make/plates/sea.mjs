/**
 * The sea: rows of waves from the horizon to the foot, each hiding the feet of
 * the row behind. A wave is cusped like Gerstner's trochoid, 1 - |sin|, and is
 * modelled by lines that follow its back and fade at its crest.
 */
import { clamp, lerp, smooth, spline } from "./curves.mjs";
import { noise } from "./noise.mjs";

/**
 * Rows of waves in the box. `swell` is a wave's height as a share of its row,
 * `dark(x, y)` the tone of the water, `reach` how long a wave is for its height,
 * `lit` the side light comes from (1 right, -1 left). Yields a row at a time, its
 * y first, so that what floats can be drawn between rows.
 */
export function* sea(
  graver,
  { x0, x1, y0, y1, rows, swell, dark, reach = 6, lit = 1, seed = 1, power = 1.7, pitch = 2.1 },
) {
  const yAt = (r) => lerp(y0, y1, (r / rows) ** power);
  for (let r = 0; r < rows; r++) {
    const y = yAt(r);
    const deep = yAt(r + 1) - y;
    yield y;
    drawRow(graver, {
      x0,
      x1,
      y,
      deep,
      high: deep * swell,
      long: deep * reach,
      dark,
      lit,
      seed: seed + r * 13,
      pitch,
    });
  }
}

function drawRow(graver, { x0, x1, y, deep, high, long, dark, lit, seed, pitch }) {
  const step = clamp(long / 14, 1, 3.2);
  const count = Math.ceil((x1 - x0) / step);
  const xs = Array.from({ length: count + 1 }, (_, i) => lerp(x0, x1, i / count));
  const wave = (x) => {
    const u = x / long + seed * 0.37 + 0.9 * (noise(x / long / 1.3, seed * 0.7, seed) - 0.5);
    return (
      (1 - Math.abs(Math.sin(Math.PI * u))) * (0.25 + 0.95 * noise(x / long / 2, 5.5, seed + 3))
    );
  };
  const h = xs.map(wave);
  const top = xs.map((x, i) => [x, y - high * h[i]]);
  graver.clear([...top, [x1, y + deep * 1.6], [x0, y + deep * 1.6]]);
  const lines = Math.max(1, Math.round(deep / pitch));
  const gap = deep / lines;
  for (let k = 0; k <= lines + 1; k++) {
    const down = k / (lines + 1);
    const line = xs.map((x, i) => [x, y + k * gap * 0.98 - high * h[i] * (1 - 0.55 * down)]);
    graver.swell(
      line,
      (t) => {
        const i = Math.min(count, Math.round(t * count));
        const slope = (h[Math.min(i + 1, count)] - h[Math.max(i - 1, 0)]) * lit;
        const face = clamp(slope * 1.1, -0.34, 0.34);
        const crest = h[i] * (1 - down);
        const hand = 0.55 + 0.9 * noise(line[i][0] / (long * 0.6), k * 1.7, seed + 41);
        const tone = (dark(line[i][0], line[i][1]) + face - 0.5 * smooth(0.5, 0.95, crest)) * hand;
        return k === 0 ? Math.max(0.28, tone * gap * 0.7) : clamp(tone, 0, 0.85) * gap;
      },
      0.16,
    );
  }
}

/** A fleck of ink on foam, a little crest of half-width `r` cut `weight` wide at its middle. */
export function fleck(graver, x, y, r, weight) {
  graver.swell(
    spline([
      [x - r, y],
      [x - r * 0.4, y - r * 0.7],
      [x + r * 0.6, y - r * 0.5],
      [x + r, y + 0.6],
    ]),
    (t) => weight * Math.sin(Math.PI * t),
    0.1,
  );
}
