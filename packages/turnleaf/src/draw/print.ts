/**
 * What is printed on a face: its picture, and over a part of it a detail, a
 * sharper picture of that part alone.
 */

import type { IUniform, Texture } from "three";
import type { PageBox } from "../sources/page_source.ts";

/** `printed(uv)`: the print's colour at a place of the picture, from its upper left corner. */
export const printChunk: string = /* glsl */ `
uniform sampler2D picture;
uniform sampler2D detail;
uniform vec4 detailBox;

vec3 printed(vec2 uv) {
  vec2 at = (uv - detailBox.xy) / detailBox.zw;
  vec2 within = step(vec2(0.0), at) * step(at, vec2(1.0));
  return mix(texture2D(picture, uv, -0.4).rgb, texture2D(detail, at, -0.4).rgb, within.x * within.y);
}
`;

/** Beside the picture: no detail is seen. */
const nowhere = [2, 2, 1, 1];

/** The uniforms of a print that shows a picture and no detail. */
export function printUniforms(picture: Texture): Record<string, IUniform> {
  return {
    picture: { value: picture },
    detail: { value: picture },
    detailBox: { value: nowhere },
  };
}

/** Lays a detail over a part of a print's picture; null takes it away. */
export function layDetail(
  uniforms: Record<string, IUniform>,
  texture: Texture,
  box: PageBox | null,
): void {
  uniforms.detail.value = texture;
  uniforms.detailBox.value = box ? [box.x, box.y, box.width, box.height] : nowhere;
}
