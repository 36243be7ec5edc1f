/** Finds the 3D position of a pointer that the screen gives only in 2D. */

import type { Ray, Vec3 } from "../engine/shapes.ts";

/**
 * Height of the pointer's arch over the spine, as a fraction of its reach.
 * Below 1, so that the leaf bows between pointer and spine as a carried page
 * does, instead of swinging over stretched tight as a board.
 */
const archHeight = 0.62;

/**
 * Returns the position of a pointer that carries a leaf over the spine: where
 * the line of sight intersects an elliptic arch of half-width `reach` (metres)
 * about the spine, or the plane of the table beyond it.
 *
 * @param floor height of the pages under x, metres: the pointer stays above
 */
export function handAt(ray: Ray, reach: number, floor: (x: number) => number): Vec3 {
  // The eye looks down steeply, so its x hardly changes with height and the
  // iteration converges to well under a millimetre in a few rounds.
  let place = onPlane(ray, 0);
  for (let round = 0; round < 8; round++) {
    const fraction = Math.min(Math.abs(place[0]) / reach, 1);
    const arch = archHeight * reach * Math.sqrt(1 - fraction * fraction);
    place = onPlane(ray, Math.max(arch, floor(place[0])));
  }
  return place;
}

/** Returns the point of a ray at height z, metres, or the origin's x and y for a level ray. */
export function onPlane(ray: Ray, z: number): Vec3 {
  const t = Math.abs(ray.direction[2]) < 1e-9 ? 0 : (z - ray.origin[2]) / ray.direction[2];
  return [ray.origin[0] + t * ray.direction[0], ray.origin[1] + t * ray.direction[1], z];
}
