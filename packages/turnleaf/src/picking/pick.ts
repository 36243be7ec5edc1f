/** Intersects a line of sight with resting pages and leaves in flight. */

import type { Pile, Ray, Surface } from "../engine/shapes.ts";

/** A place on a leaf: u from 0 at the spine to 1 at the fore-edge, v from 0 at the foot to 1 at the head. */
export interface Place {
  readonly u: number;
  readonly v: number;
}

/** A place on a leaf, and how far along the line of sight it lies. */
export interface Hit extends Place {
  readonly distance: number;
}

/**
 * Returns where a line of sight intersects the uppermost page of a pile, or the
 * pile's fore-edge, which counts as part of that page.
 *
 * @param sign 1 for the pile on the right, -1 on the left
 * @param u u of the pile's columns
 * @param height of the page, metres
 */
export function pickPile(
  ray: Ray,
  pile: Pile,
  sign: 1 | -1,
  u: Float32Array,
  height: number,
): Hit | null {
  const { curves, columns, layers } = pile;
  const foot = 2 * columns * layers - 2;
  const edge = 2 * columns - 2;
  let best = pickStrip(ray, curves, edge, foot, height);
  if (best !== null) best = { ...best, u: 1 };
  // Each strip between two columns is a plane rectangle along y.
  for (let k = 0; k + 1 < columns; k++) {
    const [from, to] = sign === 1 ? [k, k + 1] : [k + 1, k];
    const hit = pickStrip(ray, curves, 2 * from, 2 * to, height);
    if (hit !== null && (best === null || hit.distance < best.distance)) {
      best = { ...hit, u: u[from] + (u[to] - u[from]) * hit.u };
    }
  }
  return best;
}

/** Intersects a ray with the rectangle along y over two points of a curve; u there is 0 to 1. */
function pickStrip(
  ray: Ray,
  curves: Float32Array,
  from: number,
  to: number,
  height: number,
): Hit | null {
  const [x0, z0] = [curves[from], curves[from + 1]];
  const [dx, dz] = [curves[to] - x0, curves[to + 1] - z0];
  const facing = ray.direction[2] * dx - ray.direction[0] * dz;
  if (Math.abs(facing) < 1e-12) return null;
  const distance = ((z0 - ray.origin[2]) * dx - (x0 - ray.origin[0]) * dz) / facing;
  const x = ray.origin[0] + distance * ray.direction[0] - x0;
  const z = ray.origin[2] + distance * ray.direction[2] - z0;
  const along = (x * dx + z * dz) / (dx * dx + dz * dz);
  const v = (ray.origin[1] + distance * ray.direction[1]) / height;
  if (distance <= 0 || along < 0 || along > 1 || v < 0 || v > 1) return null;
  return { u: along, v, distance };
}

/**
 * Returns where a line of sight intersects a leaf in flight or a loose sheet, from either side
 * (Moeller and Trumbore 1997 for each triangle: those of its mesh if it is creased, else the
 * halves of each cell).
 *
 * @param u u of the surface's columns, if it is not creased
 */
export function pickSurface(ray: Ray, surface: Surface, u: Float32Array): Hit | null {
  const { columns, rows, positions, creased } = surface;
  let best: Hit | null = null;
  const placeOf = (point: number): readonly [u: number, v: number] =>
    creased
      ? [creased.places[2 * point], creased.places[2 * point + 1]]
      : [u[point % columns], Math.floor(point / columns) / (rows - 1)];
  const pick = (a: number, b: number, c: number): void => {
    const hit = pickTriangle(ray, positions, a, b, c);
    if (hit === null || (best !== null && hit.distance >= best.distance)) return;
    const [[ua, va], [ub, vb], [uc, vc]] = [placeOf(a), placeOf(b), placeOf(c)];
    best = {
      u: ua + hit.b * (ub - ua) + hit.c * (uc - ua),
      v: va + hit.b * (vb - va) + hit.c * (vc - va),
      distance: hit.distance,
    };
  };
  if (creased) {
    const { triangles } = creased;
    for (let k = 0; k < triangles.length; k += 3) {
      pick(triangles[k], triangles[k + 1], triangles[k + 2]);
    }
    return best;
  }
  for (let row = 0; row + 1 < rows; row++) {
    for (let column = 0; column + 1 < columns; column++) {
      const here = row * columns + column;
      pick(here, here + 1, here + columns);
      pick(here + columns + 1, here + columns, here + 1);
    }
  }
  return best;
}

/**
 * Returns the weights of corners b and c where the ray intersects triangle abc,
 * and the distance there.
 */
function pickTriangle(ray: Ray, at: Float32Array, a: number, b: number, c: number) {
  const [ax, ay, az] = [at[3 * a], at[3 * a + 1], at[3 * a + 2]];
  const [e1x, e1y, e1z] = [at[3 * b] - ax, at[3 * b + 1] - ay, at[3 * b + 2] - az];
  const [e2x, e2y, e2z] = [at[3 * c] - ax, at[3 * c + 1] - ay, at[3 * c + 2] - az];
  const [dx, dy, dz] = ray.direction;
  const [px, py, pz] = [dy * e2z - dz * e2y, dz * e2x - dx * e2z, dx * e2y - dy * e2x];
  const determinant = e1x * px + e1y * py + e1z * pz;
  if (Math.abs(determinant) < 1e-18) return null;
  const [tx, ty, tz] = [ray.origin[0] - ax, ray.origin[1] - ay, ray.origin[2] - az];
  const weightB = (tx * px + ty * py + tz * pz) / determinant;
  const [qx, qy, qz] = [ty * e1z - tz * e1y, tz * e1x - tx * e1z, tx * e1y - ty * e1x];
  const weightC = (dx * qx + dy * qy + dz * qz) / determinant;
  const distance = (e2x * qx + e2y * qy + e2z * qz) / determinant;
  if (weightB < 0 || weightC < 0 || weightB + weightC > 1 || distance <= 0) return null;
  return { b: weightB, c: weightC, distance };
}
