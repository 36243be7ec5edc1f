/** The sky: level lines that thicken and thin, with clouds left bare or worked up. */
import { clamp, levels, smooth } from "./curves.mjs";
import { clouds, noise } from "./noise.mjs";

/** Cut a sky in the box with tone `dark(x, y)`; clouds come from `cloud(x, y)` in [0, 1]. */
export function sky(graver, { x0, x1, y0, y1, pitch = 2.5, dark, bend }) {
  const wobble = bend ?? ((x, y) => 0.5 * (noise(x / 60, y / 9, 7) - 0.5));
  graver.hatch(levels(x0, x1, y0, y1, pitch, wobble, 2.2), dark, pitch, { least: 0.17 });
}

/** Heaped clouds: their lit upper edges stay bare, their undersides are dark. */
export function heaped({ scaleX = 95, scaleY = 42, seed = 3, cover = 0.5, sun = [1, -1] } = {}) {
  const at = (x, y) => clouds(x / scaleX, y / scaleY, seed, 5);
  return (x, y) => {
    const here = at(x, y);
    const body = smooth(1 - cover - 0.06, 1 - cover + 0.1, here);
    const toward = at(x + sun[0] * 9, y + sun[1] * 7);
    const relief = clamp((here - toward) * 4.5 + 0.42);
    return { body, relief };
  };
}
