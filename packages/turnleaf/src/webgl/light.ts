/**
 * Light on paper, without a shadow map.
 *
 * A point of a page sees the sky through one gap in the plane across the
 * spine, between the page's own rise, the pile opposite and the leaves in flight.
 * The gap's two ends are angles from straight up, positive to the right. From
 * them follow how much of the sky and how much of the key light arrive:
 *
 *   sky = (sin(right - normal) - sin(left - normal)) / 2, each difference at most a quarter turn
 *   key = how far the key light's angle lies inside the gap, over a soft edge
 *
 * The ends are found here, per vertex; the fragment shader (`shading.ts`) does
 * the rest, so that a shadow's edge is as sharp as its angle and hardens where
 * the leaf touches the page.
 */

/** Where the key light comes from, book space, unit length: over the reader's left shoulder, from the head. */
export const keyDirection: readonly [number, number, number] = unit(-0.46, 0.4, 0.8);

/** Angle of the key light from straight up in the plane across the spine, radians. */
export const keyAngle: number = Math.atan2(keyDirection[0], keyDirection[2]);

/** Half the width of a shadow's soft edge, radians. */
export const penumbra = 0.1;

/**
 * How far a leaf's shadow falls toward the foot for each metre that the leaf is
 * above the page, for three points on the key light: their mean is soft along
 * the spine too.
 */
export const shadowSlopes: readonly [number, number, number] = [-0.13, 0, 0.13].map(
  (off) => keyDirection[1] / keyDirection[2] + off,
) as [number, number, number];

/**
 * Returns the direction (dx, dz) as a number that rises with its angle from
 * straight up and needs no arc tangent: 0 up, 1 right, -1 left, 2 or -2 down. A
 * quarter turn is exactly 1.
 */
export function compass(dx: number, dz: number): number {
  const flat = Math.abs(dx);
  if (dz >= 0) return dx / (flat + dz + 1e-20);
  const beyond = flat / (flat - dz);
  return dx >= 0 ? 2 - beyond : beyond - 2;
}

/** Returns a compass number as radians from straight up. */
export function compassToRadians(c: number): number {
  const quarter = Math.floor(c + 0.5);
  const part = c - quarter;
  // Within half a quarter turn of an axis: (part, 1 - |part|) is the direction.
  return quarter * (Math.PI / 2) + Math.atan2(part, 1 - Math.abs(part));
}

/** Returns `c` shifted by whole turns to within half a turn of `center`. */
function near(c: number, center: number): number {
  if (c - center > 2) return c - 4;
  if (c - center < -2) return c + 4;
  return c;
}

/**
 * Computes the gap through which each point of one row of a sheet sees the sky.
 *
 * The sheet is given as if it lay on the right with its lit side up; mirror x
 * for the left. Then points toward the root bound the gap on the left, and
 * points toward the fore-edge bound it on the right.
 *
 * @param x,z the row's points from the root to the fore-edge
 * @param nx,nz its normals on the lit side
 * @param count points in the row
 * @param stride tests every so many points as obstacles; divides count - 1
 * @param opposite x, z of the pile across the gutter, may be empty
 * @param next x, z of a leaf in flight that the lit side faces, may be empty
 * @param out left and right end for each point, as compass numbers
 */
export function gapsOfRow(
  x: Float32Array,
  z: Float32Array,
  nx: Float32Array,
  nz: Float32Array,
  count: number,
  stride: number,
  opposite: Float32Array,
  next: Float32Array,
  out: Float32Array,
): void {
  for (let i = 0; i < count; i++) {
    const px = x[i];
    const pz = z[i];
    let normal = compass(nx[i], nz[i]);
    // A sheet turns from the right over the top to the left, never the other way.
    if (normal > 1) normal -= 4;
    let left = Math.max(-1, normal - 1);
    let right = Math.min(1, normal + 1);
    // What lies below on the left, as most of what a rising leaf looks back on does, is beyond the
    // left end already: it needs no direction.
    for (let k = 0; k < opposite.length; k += 2) {
      const dx = opposite[k] - px;
      const dz = opposite[k + 1] - pz;
      if (dx < 0 && dz <= 0) continue;
      if (Math.abs(dx) + Math.abs(dz) < 1e-6) continue;
      left = Math.max(left, near(compass(dx, dz), normal - 1));
    }
    for (let k = 0; k < next.length; k += 2) {
      const dx = next[k] - px;
      const dz = next[k + 1] - pz;
      if (Math.abs(dx) + Math.abs(dz) < 1e-6) continue;
      // It rises on the left and may reach over the point and beyond.
      left = Math.max(left, near(compass(dx, dz), normal));
    }
    for (let k = 0; k < i; k += stride) {
      const dx = x[k] - px;
      const dz = z[k] - pz;
      if (dx < 0 && dz <= 0) continue;
      left = Math.max(left, near(compass(dx, dz), normal - 1));
    }
    for (let k = (Math.floor(i / stride) + 1) * stride; k < count; k += stride) {
      const dx = x[k] - px;
      const dz = z[k] - pz;
      // Below on the right, likewise.
      if (dx > 0 && dz <= 0 && normal >= -1) continue;
      right = Math.min(right, near(compass(dx, dz), normal + 1));
    }
    // A gap beyond closed makes shadows no darker, but would pull their edges outward.
    out[2 * i] = Math.min(left, normal + 1);
    out[2 * i + 1] = Math.max(right, normal - 1);
  }
}

/**
 * Returns the left end of the gap of a resting page's point where a leaf or a
 * board rises from the spine: the direction of its point farthest to the right.
 * Given for the right side; mirror x for the left.
 *
 * @param points x, z of the leaf's section
 * @param count numbers of `points` in use
 */
export function leftEndUnder(px: number, pz: number, points: Float32Array, count: number): number {
  // The direction farthest to the right of those above the horizon: products tell which of
  // two it is, without a division for each of very many points. Two numbers, not a pair: pairs
  // are made anew each time until this is compiled, and a turn cost a tenth more of scripts.
  let x = -1;
  let z = 0;
  let below = 1;
  for (let k = 0; k < count; k += 2) {
    const dx = points[k] - px;
    const dz = points[k + 1] - pz;
    if (dz >= 0) {
      if (dx * z > x * dz) {
        x = dx;
        z = dz;
      }
    } else if (dx > 0) below = Math.max(below, compass(dx, dz));
  }
  return below > 1 ? Math.min(below, 1.05) : compass(x, z);
}

/** The gap over a point, radians, and the fractions of sky and key light that come through it. */
export interface LightFractions {
  left: number;
  right: number;
  sky: number;
  key: number;
}

/**
 * Computes the fractions of sky and key light that reach a point of a stiff
 * face between the piles.
 *
 * @param normal angle of the face's normal from straight up, radians
 * @param piles x, z of points of each pile, book space
 * @param lid x, z of the outer edge of a board that stands over the point, and
 * 1 where it rises from the left, -1 from the right; 0 for none
 * @param out the result
 */
export function lightBetween(
  x: number,
  z: number,
  normal: number,
  piles: readonly Float32Array[],
  lid: readonly [x: number, z: number, from: number],
  out: LightFractions,
): void {
  let left = Math.max(-Math.PI / 2, normal - Math.PI / 2);
  let right = Math.min(Math.PI / 2, normal + Math.PI / 2);
  for (const pile of piles) {
    for (let k = 0; k < pile.length; k += 2) {
      const c = compassToRadians(compass(pile[k] - x, pile[k + 1] - z + 1e-6));
      if (pile[k] > x) right = Math.min(right, c);
      else left = Math.max(left, c);
    }
  }
  if (lid[2] !== 0) {
    const c = compassToRadians(compass(lid[0] - x, lid[1] - z));
    if (lid[2] > 0) left = Math.max(left, c);
    else right = Math.min(right, c);
  }
  out.left = left;
  out.right = right;
  out.sky = skyFraction(left, right, normal);
  out.key = keyFraction(left, right);
}

/**
 * Returns the fraction of the sky seen through the gap between two angles,
 * radians, by a surface with the normal's angle.
 */
export function skyFraction(left: number, right: number, normal: number): number {
  return Math.max(0, 0.5 * (edgeSine(right - normal) - edgeSine(left - normal)));
}

/** Returns the fraction of the key light that comes through the gap between two angles, radians. */
export function keyFraction(left: number, right: number): number {
  return (
    smooth((keyAngle - left + penumbra) / (2 * penumbra)) *
    smooth((right - keyAngle + penumbra) / (2 * penumbra))
  );
}

function edgeSine(angle: number): number {
  if (Math.cos(angle) < 0) return Math.sign(Math.sin(angle));
  return Math.sin(angle);
}

function smooth(t: number): number {
  const c = Math.min(1, Math.max(0, t));
  return c * c * (3 - 2 * c);
}

function unit(x: number, y: number, z: number): [number, number, number] {
  const length = Math.hypot(x, y, z);
  return [x / length, y / length, z / length];
}
