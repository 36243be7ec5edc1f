/** A whale's tail above the water: the device of the back board and the tailpiece. */
import { clamp, pts, spline } from "./plates/curves.mjs";

/** The right half of the flukes from the stock's foot to the notch; the left is its mirror. */
const HALF = [
  pts("10,30 7.5,12 6,-2 8,-12 18,-21 34,-27 54,-29 70,-25"),
  pts("70,-25 60,-33 46,-40 30,-42 14,-39 4,-34 0,-28"),
];

const half = () => HALF.flatMap((part) => spline(part));

/** Draw it about (x, y); the water lies some 34 units below. */
export function drawFluke(graver, { x, y, scale, ink, cut }) {
  const put = (points) => points.map(([px, py]) => [x + px * scale, y + py * scale]);
  const mirror = (points) => points.map(([px, py]) => [-px, py]);
  graver.dip(ink);
  const right = half();
  graver.fill(put([...right, ...mirror(right).reverse()]));
  graver.dip(cut);
  for (const side of [(p) => p, mirror]) {
    for (let k = 0; k < 6; k++) {
      const line = spline([
        [3.4 - k * 0.4, 22 - k * 3],
        [3.2 + k * 0.2, -8 - k],
        [12 + k * 2, -24 - k * 1.6],
        [34 + k, -31 - k * 1.3],
        [60 - k * 6, -30.5 - k * 1.2],
      ]);
      graver.swell(
        put(side(line)),
        (t) => scale * 1.15 * Math.sin(Math.PI * clamp(t * 0.96 + 0.02)) ** 0.8,
      );
    }
  }
  graver.dip(ink);
  for (let k = 0; k < 4; k++) {
    const wide = 62 - Math.abs(k - 1) * 13;
    const rise = 30 + k * 5.4;
    const wave = Array.from({ length: 61 }, (_, i) => {
      const u = i / 30 - 1;
      return [u * wide, rise + 1.7 * Math.sin(u * 9 + k * 1.9) * (1 - Math.abs(u) * 0.5)];
    });
    graver.swell(put(wave), (t) => scale * 2 * Math.sin(Math.PI * t) ** 0.8);
  }
}
