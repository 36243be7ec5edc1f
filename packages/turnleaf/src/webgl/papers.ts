/** Paper that lies on paper, and the light that it keeps off what is under it: the shade at its edge. */

import type { IUniform } from "three";
import {
  mostPaperEdges,
  type Paper,
  paperNumbers,
  type Surface,
  surfaceBounds,
} from "../engine/shapes.ts";
import { penumbra } from "./light.ts";

/** What shades one side of a sheet, at most. */
const mostPapers = 6;

/** Vectors that describe one to the shader. */
const vectors = paperNumbers / 4;

/** Returns those that may shade a sheet: their shade fades with their height, and six times that is beyond what is seen. */
export function shading(
  papers: readonly Paper[],
  sheet: Pick<Surface, "positions">,
): readonly Paper[] {
  if (papers.length === 0) return papers;
  const { low, high } = surfaceBounds(sheet);
  const apart = ([x, y]: readonly number[], [u, v]: readonly number[]) => Math.max(x - u, y - v);
  const bottom = sheet.positions.reduce(
    (least, z, k) => (k % 3 === 2 ? Math.min(least, z) : least),
    1,
  );
  return papers.filter(
    (paper) =>
      Math.max(apart(paper.low, high), apart(low, paper.high)) <
      6 * Math.max(paper.top - bottom, 0.001),
  );
}

/** Returns the uniforms of `papersChunk` but `pixel`. */
export function paperUniforms(): Record<string, IUniform> {
  return {
    papers: { value: new Float32Array(paperNumbers * mostPapers) },
    paperCount: { value: 0 },
  };
}

/** Sets them: those that are nearest, which come first, where there are too many. */
export function layPapers(uniforms: Record<string, IUniform>, papers: readonly Paper[]): void {
  const count = Math.min(papers.length, mostPapers);
  for (let k = 0; k < count; k++) uniforms.papers.value.set(papers[k].data, paperNumbers * k);
  uniforms.paperCount.value = count;
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
    float here = strength * (about.x < -0.5 ? -1.0 - about.x : float(abs(about.x - part) < 0.5));
    float under = plane.w - dot(plane.xyz, place);
    float up = under / plane.z;
    here *= 1.0 - smoothstep(0.0, about.y, up);
    // Most of a picture is far from all paper that lies, and drawn by a processor each edge takes time.
    if (here <= 0.0) continue;
    float slant = dot(plane.xyz, KEY_DIRECTION);
    float open = 1.0;
    float dark = slant > 0.0 ? 1.0 : 0.0;
    float near = max(least, up);
    float deep = 1e3;
    float tall = 0.5 * pixel;
    for (int edge = 0; edge < ${mostPaperEdges}; edge++) {
      if (float(edge) >= about.w) break;
      vec4 inward = papers[at + 2 + 3 * edge];
      vec4 along = papers[at + 3 + 3 * edge];
      vec4 bend = papers[at + 4 + 3 * edge];
      float t = clamp(dot(along.xyz, vec3(place.xy, place.z + up)) - along.w, 0.0, 1.0);
      float height = up + bend.x + t * (bend.y + t * bend.z);
      float high = max(least, height);
      float rim = inward.w + t * (1.0 - t) * bend.w;
      float from = dot(inward.xyz, vec3(place.xy, place.z + up)) - rim;
      if (from < -8.0 * max(high, up)) {
        here = 0.0;
        break;
      }
      deep = min(deep, from);
      tall = max(tall, height);
      // The first pixel beside it is shaded as its edge is.
      float past = from + pixel;
      open *= 0.5 + 0.5 * past * inversesqrt(past * past + high * high);
      float far = max(1.5 * pixel, under / max(slant, 1e-3) + (height - up) / KEY_DIRECTION.z);
      float soft = max(${penumbra} * far, 0.5 * pixel);
      dark *= smoothstep(-soft, soft, dot(inward.xyz, place + far * KEY_DIRECTION) - rim);
    }
    // Nobody looks as far in under it; where what is under it is drawn through it, no dark spot shows.
    here *= 1.0 - smoothstep(1.0, 2.0, deep / tall);
    key *= 1.0 - here * dark;
    sky *= 1.0 - here * open * (1.0 - mix(THROUGH, vec3(0.5), min(1.0, near / about.z)));
  }
}
`;
