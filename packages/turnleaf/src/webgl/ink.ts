/**
 * The ink on a face: its picture, and over a part of it a detail, a sharper
 * picture of that part. Where it lies on the pixels of the screen, these are its texels.
 */

import type { IUniform, Texture } from "three";
import type { PageBox } from "../sources/page_source.ts";
import { type PrintGrid, printGridChunk } from "./print_grid.ts";

/**
 * `printed(uv)`: the ink's colour at a place of the picture, from its upper
 * left corner, and its coverage: 0 where a picture is transparent.
 */
export const inkChunk: string = /* glsl */ `
uniform sampler2D picture;
uniform sampler2D detail;
uniform vec4 detailBox;
${printGridChunk}

// What is clear is black, and takes from the colour of the pixels that it is blended into. What is not quite
// opaque has its colour: so far as the texel at the place has it, "seen" is less opaque only by what is clear.
vec4 solid(sampler2D from, vec2 at, vec4 seen) {
  if (seen.a > 0.99) return seen;
  ivec2 texels = textureSize(from, 0);
  float own = texelFetch(from, clamp(ivec2(floor(at * vec2(texels))), ivec2(0), texels - 1), 0).a;
  float printed = own > 0.0 ? min(seen.a / own, 1.0) : seen.a;
  return vec4(seen.rgb / max(printed, 0.01), seen.a);
}

// A picture of "size" pixels of the screen, where "at" of them is seen.
vec4 onGrid(sampler2D seen, vec2 at, vec2 size, float shortening) {
  ivec2 texels = textureSize(seen, 0);
  if (gridCorner.w > 0.0 && shortening == 1.0 && texels.x == int(size.x + 0.5)) {
    return texelFetch(seen, clamp(ivec2(floor(at)), ivec2(0), texels - 1), 0);
  }
  // Sharper by the same as elsewhere.
  vec2 span = 0.758 * gridCorner.z * mix(vec2(1.0), vec2(shortening), abs(gridSpine.xy)) / size;
  return textureGrad(seen, at / size, vec2(span.x, 0.0), vec2(0.0, span.y));
}

vec4 printedOnGrid() {
  vec3 place = gridPlace();
  vec4 whole = solid(picture, place.xy / gridSize, onGrid(picture, place.xy, gridSize, place.z));
  if (detailBox.x > 1.0) return whole;
  vec2 at = place.xy - detailBox.xy * gridSize;
  vec2 size = detailBox.zw * gridSize;
  if (any(lessThan(at, vec2(0.0))) || any(greaterThanEqual(at, size))) return whole;
  return vec4(onGrid(detail, at, size, place.z).rgb, 1.0);
}

vec4 printed(vec2 uv) {
  if (gridCorner.z > 0.0) return printedOnGrid();
  vec4 whole = solid(picture, uv, texture2D(picture, uv, -0.4));
  if (detailBox.x > 1.0) return whole;
  vec2 at = (uv - detailBox.xy) / detailBox.zw;
  vec2 within = step(vec2(0.0), at) * step(at, vec2(1.0));
  return mix(whole, vec4(texture2D(detail, at, -0.4).rgb, 1.0), within.x * within.y);
}
`;

/** Beside the picture: no detail is visible. */
const nowhere = [2, 2, 1, 1];

/** Returns the uniforms of ink that shows a picture and no detail. */
export function inkUniforms(picture: Texture): Record<string, IUniform> {
  return {
    picture: { value: picture },
    detail: { value: picture },
    detailBox: { value: nowhere },
    gridCorner: { value: [0, 0, 0, 0] },
    gridSize: { value: [1, 1] },
    gridSpine: { value: [1, 0, 0] },
  };
}

/** Lays a detail over a part of a picture; null removes it. */
export function layDetail(
  uniforms: Record<string, IUniform>,
  texture: Texture,
  box: PageBox | null,
): void {
  uniforms.detail.value = texture;
  uniforms.detailBox.value = box ? [box.x, box.y, box.width, box.height] : nowhere;
}

/**
 * Lays a picture on the pixels of the screen; null lays it on its mesh.
 *
 * @param height of the canvas, its pixels
 * @param dots pixels of the canvas across one of the screen
 */
export function layOnGrid(
  uniforms: Record<string, IUniform>,
  grid: PrintGrid | null,
  height: number,
  dots: number,
): void {
  if (grid === null) {
    uniforms.gridCorner.value[2] = 0;
    return;
  }
  const { corner, size, outward, shortened } = grid;
  const isWhole = Number.isInteger(dots) ? 1 : 0;
  uniforms.gridCorner.value = [corner[0] * dots, height - corner[1] * dots, 1 / dots, isWhole];
  uniforms.gridSize.value = size;
  uniforms.gridSpine.value = [...outward, shortened];
}
