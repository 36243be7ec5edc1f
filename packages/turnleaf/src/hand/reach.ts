/** Where in space a hand is that a screen shows only from one side. */

import type { Ray, Vec3 } from "../engine/shapes.ts";

/**
 * How high the hand arches over the spine, as a share of its reach. Below 1, so
 * that the leaf bows between hand and spine as a carried page does, instead of
 * swinging over stretched tight as a board.
 */
const archHeight = 0.62;

/**
 * The place of a hand that carries a leaf over the spine: where the line of
 * sight meets an elliptic arch of half-width `reach` (metres) about the spine,
 * and the plane of the table beyond it.
 *
 * @param floor height of the pages under x, metres: the hand stays above
 */
export function handAt(ray: Ray, reach: number, floor: (x: number) => number): Vec3 {
  // The eye looks down steeply, so its x hardly changes with height and the
  // iteration settles to well under a millimetre in a few rounds.
  let place = at(ray, 0);
  for (let round = 0; round < 8; round++) {
    const share = Math.min(Math.abs(place[0]) / reach, 1);
    const arch = archHeight * reach * Math.sqrt(1 - share * share);
    place = at(ray, Math.max(arch, floor(place[0])));
  }
  return place;
}

/** The point of a ray at height z; where the ray runs level, its origin's x and y. */
function at(ray: Ray, z: number): Vec3 {
  const t = Math.abs(ray.direction[2]) < 1e-9 ? 0 : (z - ray.origin[2]) / ray.direction[2];
  return [ray.origin[0] + t * ray.direction[0], ray.origin[1] + t * ray.direction[1], z];
}
