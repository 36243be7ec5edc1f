/** A whaleship under the moon, boats at her davits, all plain sail set. */
import { box, circle, clamp, distance, lerp, smooth, spline } from "./curves.mjs";
import { noise } from "./noise.mjs";
import { sea } from "./sea.mjs";
import { heaped, sky } from "./sky.mjs";
import { vessel } from "./vessel.mjs";

const MOON = [206, 92, 25];

export function ship(graver, wide, high) {
  const horizon = high * 0.635;
  graver.within(box(0, 0, wide, high), () => {
    nightSky(graver, wide, horizon);
    const water = 26;
    const [sx, sy] = [128, horizon + water];
    const scale = 1.02;
    const rows = sea(graver, {
      x0: -2,
      x1: wide + 2,
      y0: horizon,
      y1: high + 14,
      rows: 21,
      swell: 0.62,
      reach: 6.2,
      lit: 1,
      seed: 5,
      dark: (x, y) => waterTone(x, y, horizon, high, sx),
    });
    let afloat = false;
    for (const y of rows) {
      if (!afloat && y > sy - 3) {
        vessel(graver, (p) => place(p, sx, sy, scale, -0.035));
        bowWave(graver, sx, sy, scale);
        afloat = true;
      }
    }
  });
  graver.line(box(0, 0, wide, high), 0.7, true);
}

/** Ship's units (y up from the waterline, bow to the right) to the page, heeling a little. */
function place([x, y], sx, sy, scale, heel) {
  const c = Math.cos(heel);
  const s = Math.sin(heel);
  return [sx + scale * (x * c + y * s), sy - scale * (y * c - x * s)];
}

function nightSky(graver, wide, horizon) {
  const cloud = heaped({ seed: 9, cover: 0.46, scaleX: 105, scaleY: 38 });
  sky(graver, {
    x0: 0,
    x1: wide,
    y0: 1.4,
    y1: horizon - 0.6,
    pitch: 2.45,
    dark(x, y) {
      const d = distance([x, y], MOON);
      if (d < MOON[2]) return 0;
      const halo = 0.34 * Math.exp(-((d - MOON[2]) / 34)) + 0.16 * Math.exp(-((d - MOON[2]) / 120));
      const night = lerp(0.78, 0.3, smooth(0, horizon, y));
      const { body, relief } = cloud(x, y);
      const tone = lerp(night, 0.1 + 0.62 * (1 - relief), body * 0.9);
      return clamp(tone - halo, 0.13, 0.88);
    },
  });
  graver.clear(circle(...MOON));
}

function waterTone(x, y, horizon, high, sx) {
  const depth = (y - horizon) / (high - horizon);
  const path = Math.exp(-(((x - MOON[0]) / (16 + 70 * depth)) ** 2));
  const glitter = path * (0.75 + 0.4 * noise(x / 9, y / 2.4, 77));
  const shadow = 0.4 * Math.exp(-(((x - sx - 2) / 62) ** 2)) * smooth(0.55, 0.05, depth);
  return clamp(0.5 + 0.1 * depth + shadow - 0.6 * glitter, 0.02, 0.9);
}

function bowWave(graver, sx, sy, scale) {
  const at = (x, y) => [sx + x * scale, sy - y * scale];
  for (let k = 0; k < 5; k++) {
    const curl = spline([
      at(64 - k * 3, 1 - k * 0.4),
      at(72 - k, 4 - k * 0.9),
      at(79 + k * 2, 2.4 - k * 0.8),
      at(84 + k * 3, -1.5 - k),
    ]);
    graver.swell(curl, (t) => 0.8 * Math.sin(Math.PI * t));
  }
}
