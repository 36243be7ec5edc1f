/** Paper that lies on paper, and the light that it keeps off what is under it: the shade at its edge. */

import type { ShaderMaterial } from "three";
import { type Surface, surfaceBounds } from "../engine/shapes.ts";
import { foldedParts, hingesIn, isShut, normalOf } from "./hinges.ts";
import { penumbra } from "./light.ts";
import { mostEdges, outlinesOf, type PartOutline } from "./part_outlines.ts";

/** What shades one side of a sheet, at most. */
export const mostPapers = 6;

/** Vectors of four numbers that describe a paper to the shader. */
const vectors = 2 + 3 * mostEdges;

/** A flat part of a leaf, as it shades what is under it. */
export interface Paper {
  /** As the shader reads it, see `papersChunk`. */
  readonly data: Float32Array;
  readonly low: readonly [x: number, y: number];
  readonly high: readonly [x: number, y: number];
  /** Its highest point, metres. */
  readonly top: number;
}

/** The height, metres, above which what is not carried shades nothing beyond its own leaf. */
const reach = 0.02;

/** Of what shades at any height. */
const boundless = 1e3;

/** More parts than these have no outlines that matter: a ball of paper. */
const mostParts = 12;

/**
 * Returns what is folded over onto the parts of a leaf, on one of its sides: each shades the part
 * that it is creased to, but for one that stands open: bent, it would shade itself.
 *
 * @param sign 1 for the recto, -1 for the verso
 */
export function flapsOn(leaf: Surface, sign: 1 | -1): readonly Paper[] {
  const { creased, positions } = leaf;
  if (!creased || isBall(leaf)) return [];
  return hingesIn(creased).flatMap((hinge) => {
    const { part, parent, sides } = hinge;
    if (!isShut(hinge, creased, positions)) return [];
    return outlinesOf(leaf).flatMap((outline) => {
      if (outline.part !== part) return [];
      // Beside the crease: farther off a bent leaf is on either side of what it is folded to.
      let rise = 0;
      for (const [own, parents] of sides) {
        const normal = normalOf(creased, positions, parents);
        for (let corner = 0; corner < 3; corner++) {
          const [a, b] = [own, parents].map((k) => 3 * creased.triangles[3 * k + corner]);
          for (let axis = 0; axis < 3; axis++) {
            rise += (positions[a + axis] - positions[b + axis]) * normal[axis];
          }
        }
      }
      return rise * sign > 0 ? [paperOf(positions, outline, boundless, parent)] : [];
    });
  });
}

/** Returns what is folded over of a leaf, as it shades other leaves close under it. */
export function flapsOf(leaf: Surface): readonly Paper[] {
  if (!leaf.creased) return [];
  const folded = foldedParts(leaf, leaf.creased);
  return outlinesOf(leaf)
    .filter(({ part }) => folded.includes(part))
    .map((outline) => paperOf(leaf.positions, outline, reach, -1));
}

/**
 * Returns the parts of a loose sheet, as they shade what is under it.
 *
 * @param lies if true, it shades only what it lies on, or nearly so
 */
export function papersOf(sheet: Surface, lies = false): readonly Paper[] {
  const to = lies ? reach : boundless;
  if (isBall(sheet)) return [paperOf(...boxOf(sheet), to, -1)];
  return outlinesOf(sheet).map((outline) => paperOf(sheet.positions, outline, to, -1));
}

/**
 * Returns those that may shade what is between two corners in plan and no lower than a height.
 * Their shade fades with their height, and six times that is beyond what is seen.
 */
export function shading(
  papers: readonly Paper[],
  [x0, y0]: readonly [number, number],
  [x1, y1]: readonly [number, number],
  bottom: number,
): readonly Paper[] {
  return papers.filter(({ low, high, top }) => {
    const margin = 6 * Math.max(top - bottom, 0.001);
    return (
      low[0] < x1 + margin && high[0] > x0 - margin && low[1] < y1 + margin && high[1] > y0 - margin
    );
  });
}

/** Returns those that may shade a sheet. */
export function shadingOn(sheet: Surface, papers: readonly Paper[]): readonly Paper[] {
  if (papers.length === 0) return papers;
  const { low, high } = surfaceBounds(sheet);
  let bottom = Number.POSITIVE_INFINITY;
  for (let at = 2; at < sheet.positions.length; at += 3) {
    bottom = Math.min(bottom, sheet.positions[at]);
  }
  return shading(papers, low, high, bottom);
}

function isBall({ creased }: Surface): boolean {
  return creased !== undefined && hasMany(creased.parts);
}

function hasMany(parts: Uint16Array): boolean {
  return parts.length > 0 && parts.reduce((most, part) => Math.max(most, part)) > mostParts;
}

/** Returns the rectangle about what is crumpled, along its first row, at its middle height. */
function boxOf({ positions, columns }: Surface): [Float32Array, PartOutline] {
  const [x, y] = [0, 1].map((axis) => positions[3 * columns - 3 + axis] - positions[axis]);
  const length = Math.hypot(x, y) || 1;
  const axes = [
    [x / length, y / length],
    [-y / length, x / length],
  ] as const;
  const [low, high] = [boundless, -boundless].map((far) => axes.map(() => far));
  let z = 0;
  for (let at = 0; at < positions.length; at += 3) {
    for (const [k, [dx, dy]] of axes.entries()) {
      const out = dx * positions[at] + dy * positions[at + 1];
      low[k] = Math.min(low[k], out);
      high[k] = Math.max(high[k], out);
    }
    z += (3 * positions[at + 2]) / positions.length;
  }
  // Six corners, about as far out as it is wide.
  const corners = [0, 1, 2, 3, 4, 5].flatMap((k) => {
    const angle = (k * Math.PI) / 3;
    const [a, b] = [Math.cos(angle), Math.sin(angle)].map(
      (out, axis) => (low[axis] + high[axis] + 1.1 * out * (high[axis] - low[axis])) / 2,
    );
    return [a * axes[0][0] + b * axes[1][0], a * axes[0][1] + b * axes[1][1], z];
  });
  const edges = [0, 1, 2, 3, 4, 5].map((k) => ({ points: [k, (k + 1) % 6], beyond: -1, inset: 0 }));
  return [Float32Array.from(corners), { part: 0, edges }];
}

/** @param onto the part of its leaf that it shades; -1 for any */
function paperOf(positions: Float32Array, { edges }: PartOutline, to: number, onto: number): Paper {
  const at = (point: number) => positions.subarray(3 * point, 3 * point + 3);
  const corners = edges.map(({ points }) => at(points[0]));
  const normal = [0, 0, 0];
  const middle = [0, 0, 0];
  for (const [k, a] of corners.entries()) {
    const b = corners[(k + 1) % corners.length];
    for (let axis = 0; axis < 3; axis++) {
      const [i, j] = [(axis + 1) % 3, (axis + 2) % 3];
      normal[axis] += (a[i] - b[i]) * (a[j] + b[j]);
      middle[axis] += a[axis] / corners.length;
    }
  }
  // Newell's normal turns with the second of the pair: it looks up here.
  const long = Math.hypot(...normal) * (normal[2] < 0 ? -1 : 1) || 1;
  const plane = normal.map((n) => n / long);
  const off = dot(plane, middle);
  const rise = Math.max(plane[2], 1e-3);
  /** How far above the plane a point is, straight up. */
  const over = (p: ArrayLike<number>) => (dot(plane, p) - off) / rise;
  const data = new Float32Array(4 * vectors);
  data.set([...plane.slice(0, 2), rise, off]);
  let wide = Number.POSITIVE_INFINITY;
  for (const [k, { points, beyond, inset }] of edges.entries()) {
    const [a, b] = [corners[k], corners[(k + 1) % corners.length]];
    const along = [0, 1, 2].map((axis) => b[axis] - a[axis]);
    const length = Math.hypot(...along) || 1;
    const to = 4 * (2 + 3 * k);
    const inward = across(
      along.map((x) => x / length),
      middle.map((m, axis) => m - a[axis]),
    );
    const within = dot(inward, a) + inset;
    // Two thirds of its height is the mean of a parabola through both ends.
    let bow = 0;
    for (const p of points) bow += (1.5 * (dot(inward, at(p)) - dot(inward, a))) / points.length;
    wide = Math.min(wide, dot(inward, middle) - within);
    // Of a crease its own leaf sees no edge.
    if (onto >= 0 && beyond === onto) data[to + 3] = -boundless;
    else data.set([...inward, within], to);
    data.set(
      along.map((x) => x / length ** 2),
      to + 4,
    );
    data[to + 7] = dot(along, a) / length ** 2;
    const [p, m, q] = [over(a), over(at(points[points.length >> 1])), over(b)];
    // A parabola through what is over the plane at its ends and its middle.
    const bend = points.length > 2 ? 2 * (p + q - 2 * m) : 0;
    data.set([p, q - p - bend, bend, 4 * bow], to + 8);
  }
  const all = edges.flatMap(({ points }) => points.map(at));
  // What is bent far from its plane, or if only what lies shades, stands, shades nothing in it.
  const bent = all.reduce((most, p) => Math.max(most, Math.abs(over(p))), 0) / Math.max(wide, 1e-4);
  const steep = to > reach ? 0 : (1 - plane[2]) / (1 - Math.SQRT1_2);
  const flat = (1 - smooth(4 * bent - 0.6)) * (1 - smooth(steep));
  data.set([onto < 0 ? -1 - flat : onto, to, Math.max(wide, 1e-4), edges.length], 4);
  const extreme = (axis: number, pick: typeof Math.max) => pick(...all.map((p) => p[axis]));
  return {
    data,
    low: [extreme(0, Math.min), extreme(1, Math.min)],
    high: [extreme(0, Math.max), extreme(1, Math.max)],
    top: extreme(2, Math.max),
  };
}

function smooth(x: number): number {
  const t = Math.min(Math.max(x, 0), 1);
  return t * t * (3 - 2 * t);
}

const dot = (a: ArrayLike<number>, b: ArrayLike<number>): number =>
  a[0] * b[0] + a[1] * b[1] + a[2] * b[2];

/** Returns the direction of what is left of a way across another of unit length. */
function across(along: readonly number[], way: readonly number[]): readonly number[] {
  const part = dot(along, way);
  const rest = way.map((x, axis) => x - part * along[axis]);
  const length = Math.hypot(...rest) || 1;
  return rest.map((x) => x / length);
}

/** Returns the uniforms of `papersChunk` but `pixel`. */
export function paperUniforms() {
  return {
    papers: { value: new Float32Array(4 * vectors * mostPapers) },
    paperCount: { value: 0 },
  };
}

/** Sets them: those that are nearest, which come first, where there are too many. */
export function layPapers(uniforms: ShaderMaterial["uniforms"], papers: readonly Paper[]): void {
  const laid = papers.slice(0, mostPapers);
  for (const [k, { data }] of laid.entries()) uniforms.papers.value.set(data, k * data.length);
  uniforms.paperCount.value = laid.length;
}

/**
 * `shadeByPapers(place, part, strength, sky, key)`: takes away the light that paper keeps from a
 * place under it, metres. All of it is above, wherever its plane is.
 */
export const papersChunk: string = /* glsl */ `
uniform vec4 papers[${vectors * mostPapers}];
uniform int paperCount;
uniform float pixel;

void shadeByPapers(vec3 place, float part, float strength, inout vec3 sky, inout float key) {
  // What is lower is seen as if it were as high.
  float least = 3.0 * pixel;
  for (int k = 0; k < ${mostPapers}; k++) {
    if (k >= paperCount) return;
    int at = ${vectors} * k;
    vec4 plane = papers[at];
    // Of these: the part of its leaf that it shades, to what height, half its width, its edges.
    vec4 about = papers[at + 1];
    if (about.x > -0.5 && abs(about.x - part) > 0.5) continue;
    float under = plane.w - dot(plane.xyz, place);
    float up = under / plane.z;
    float slant = dot(plane.xyz, KEY_DIRECTION);
    float open = 1.0;
    float dark = slant > 0.0 ? 1.0 : 0.0;
    float near = max(least, up);
    float deep = 1e3;
    float tall = pixel;
    for (int edge = 0; edge < ${mostEdges}; edge++) {
      if (float(edge) >= about.w) break;
      vec4 inward = papers[at + 2 + 3 * edge];
      vec4 along = papers[at + 3 + 3 * edge];
      vec4 bend = papers[at + 4 + 3 * edge];
      float t = clamp(dot(along.xyz, vec3(place.xy, place.z + up)) - along.w, 0.0, 1.0);
      float height = up + bend.x + t * (bend.y + t * bend.z);
      float high = max(least, height);
      float rim = inward.w + t * (1.0 - t) * bend.w;
      float from = dot(inward.xyz, vec3(place.xy, place.z + up)) - rim;
      deep = min(deep, from);
      tall = max(tall, height);
      open *= 0.5 + 0.5 * from * inversesqrt(from * from + high * high);
      float far = max(pixel, under / max(slant, 1e-3) + (height - up) / KEY_DIRECTION.z);
      float soft = ${penumbra} * far;
      dark *= smoothstep(-soft, soft, dot(inward.xyz, place + far * KEY_DIRECTION) - rim);
    }
    // Nobody looks as far in under it; where what is under it is drawn through it, no dark spot shows.
    float here = strength * (about.x < -0.5 ? -1.0 - about.x : 1.0) * (1.0 - smoothstep(0.0, about.y, up)) * (1.0 - smoothstep(1.0, 2.0, deep / tall));
    key *= 1.0 - here * dark;
    sky *= 1.0 - here * open * (1.0 - mix(THROUGH, vec3(0.5), min(1.0, near / about.z)));
  }
}
`;
