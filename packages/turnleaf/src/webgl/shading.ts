/** The shader code that every part of the book uses: one light for paper, cloth and board. */

import { keyAngle, keyDirection, penumbra } from "./light.ts";

const glslNumber = (n: number): string => (Number.isInteger(n) ? `${n}.0` : `${n}`);
const glslVector = (v: readonly number[]): string => `vec3(${v.map(glslNumber).join(", ")})`;

/**
 * `litColour(normal, sky, key)`: light in units of what a flat, open page
 * receives, so that such a page is exactly its own picture.
 *
 * Paper lights paper: light missing in a gutter is partly made up by the
 * neighbouring page, more of its red than of its blue. A shadow's floor is the
 * part of the key light that comes through the sheet which throws it.
 */
export const lightChunk: string = /* glsl */ `
const vec3 KEY_DIRECTION = ${glslVector(keyDirection)};
const float KEY_ANGLE = ${glslNumber(keyAngle)};
const vec3 KEY = 0.52 * vec3(1.0, 1.0, 0.995);
const vec3 SKY = 0.48 * vec3(1.0, 0.962, 0.905);
const vec3 BOUNCE = 0.17 * vec3(0.70, 0.62, 0.52);
const vec3 THROUGH = vec3(0.30, 0.245, 0.17);
const vec3 PAPER_ALBEDO = vec3(0.80, 0.755, 0.68);
const float WRAP = 0.22;

vec3 arriving(vec3 normal, vec3 sky, float key) {
  float facing = max(0.0, dot(normal, KEY_DIRECTION) + WRAP) / (KEY_DIRECTION.z + WRAP);
  vec3 direct = KEY * facing * mix(THROUGH, vec3(1.0), key);
  vec3 bounce = BOUNCE * (0.5 - 0.5 * normal.z);
  return (direct + SKY * sky + bounce) / (KEY + SKY);
}

vec3 amongPaper(float sky) {
  return sky / (1.0 - PAPER_ALBEDO * (1.0 - sky));
}

// Less than half a step of 8 bits: breaks up bands, and leaves an exact value as it is.
vec3 dithered(vec3 colour) {
  float noise = fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715))));
  return colour + (noise - 0.5) * (0.98 / 255.0);
}
`;

/**
 * `onPicture(uv)`: the place on a page's picture that is printed on a place of
 * its leaf, both from the upper left corner as seen in a book bound at the
 * left.
 */
export const pictureChunk: string = /* glsl */ `
vec2 onPicture(vec2 uv) {
#ifdef QUARTER_TURNED
  return vec2(1.0 - uv.y, uv.x);
#else
  return uv;
#endif
}
`;

/** Fractions of sky and key light seen through a gap (left, right), radians from straight up. */
export const gapChunk: string = /* glsl */ `
float edgeSine(float angle, vec2 across) {
  float s = sin(angle) * across.y - cos(angle) * across.x;
  float c = cos(angle) * across.y + sin(angle) * across.x;
  return c >= 0.0 ? s : sign(s);
}

float skyFraction(vec2 gap, vec3 normal) {
  vec2 across = normal.xz / max(length(normal.xz), 1e-4);
  return max(0.0, 0.5 * (edgeSine(gap.y, across) - edgeSine(gap.x, across)));
}

const float PENUMBRA = ${glslNumber(penumbra)};

// Of three gaps, by their left and right ends.
vec3 keyFractions(vec3 left, vec3 right) {
  return smoothstep(-PENUMBRA, PENUMBRA, KEY_ANGLE - left) * smoothstep(-PENUMBRA, PENUMBRA, right - KEY_ANGLE);
}

float keyFraction(vec2 gap) {
  return keyFractions(gap.xxx, gap.yyy).x;
}
`;
