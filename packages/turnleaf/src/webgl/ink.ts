/**
 * The ink on a face: its picture, and over a part of it a detail, a sharper
 * picture of that part.
 */

import type { IUniform, Texture } from "three";
import type { PageBox } from "../sources/page_source.ts";

/**
 * `printed(uv)`: the ink's colour at a place of the picture, from its upper
 * left corner, and its coverage: 0 where a picture is transparent.
 */
export const inkChunk: string = /* glsl */ `
uniform sampler2D picture;
uniform sampler2D detail;
uniform vec4 detailBox;

vec4 solid(vec4 seen) {
  // What is clear is black, and takes from the colour of the pixels that it is blended into.
  return vec4(seen.rgb / max(seen.a, 0.01), seen.a);
}

vec4 printed(vec2 uv) {
  vec4 whole = solid(texture2D(picture, uv, -0.4));
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
