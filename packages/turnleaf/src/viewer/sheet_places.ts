/** Places of loose sheets: where points of their pages are, and which side is up. */

import type { UV } from "../engine/book_engine.ts";
import { columnAt, type Surface, type Vec3 } from "../engine/shapes.ts";

/** Returns u and v on the page of a place on a surface, in parts of its rows and columns if these are even. */
export function placeOnPage({ creased, columns, rows }: Surface, [u, v]: UV): UV {
  if (!creased) return [u, v];
  const point = Math.round(v * (rows - 1)) * columns + Math.round(u * (columns - 1));
  return [creased.places[2 * point], creased.places[2 * point + 1]];
}

/** Returns where the point of a sheet is that lies next to a place on the page. */
export function pointAt({ positions, columns, rows, creased }: Surface, [u, v]: UV): Vec3 {
  let best = Math.round(v * (rows - 1)) * columns + Math.round(columnAt(u, columns));
  let least = Infinity;
  const places = creased?.places ?? [];
  for (let point = 0; 2 * point < places.length; point++) {
    const away = Math.hypot(places[2 * point] - u, places[2 * point + 1] - v);
    if (away < least) [best, least] = [point, away];
  }
  return [positions[3 * best], positions[3 * best + 1], positions[3 * best + 2]];
}

/** Returns the part of its page that a sheet is, from its lower to its upper place. */
export function partOfPage({ creased }: Surface): readonly [low: UV, high: UV] {
  const low: [number, number] = creased ? [1, 1] : [0, 0];
  const high: [number, number] = creased ? [0, 0] : [1, 1];
  for (const [at, place] of (creased?.places ?? []).entries()) {
    low[at % 2] = Math.min(low[at % 2], place);
    high[at % 2] = Math.max(high[at % 2], place);
  }
  return [low, high];
}

/** Returns the place on its page of a sheet's middle. */
export function middlePlace(surface: Surface): UV {
  return placeOnPage(surface, [0.5, 0.5]);
}

/** Returns whether a sheet shows its recto from above. */
export function facesUp({ normals }: Surface): boolean {
  let sum = 0;
  for (let at = 2; at < normals.length; at += 3) sum += normals[at];
  return sum >= 0;
}

/** Returns the middle of a surface. */
export function middleOf({ positions, columns, rows, creased }: Surface): Vec3 {
  const column = creased ? columns >> 1 : Math.round(columnAt(0.5, columns));
  const at = 3 * ((rows >> 1) * columns + column);
  return [positions[at], positions[at + 1], positions[at + 2]];
}
