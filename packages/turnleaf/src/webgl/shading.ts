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

/** Flaps that shade a side of a leaf, at most: a corner at its head and one at its foot. */
export const mostFlaps = 2;

/** Corners of each flap: those of a triangle repeat the last. */
export const flapCorners = 4;

/**
 * `shadeByFlaps(place, strength, sky, key)`: takes away the light that parts folded over onto
 * a leaf keep from a place on it, metres. A shadow's edge softens with the distance of what
 * throws it: of the key light by its penumbra, of the sky over half of it.
 */
export const flapChunk: string = /* glsl */ `
uniform vec3 flaps[${flapCorners * mostFlaps}];
uniform int flapCount;

// How far inside an edge of a part a point of its plane is; its middle is inside.
float insideEdge(vec3 point, vec3 from, vec3 to, vec3 middle) {
  vec3 along = to - from;
  float far = length(along);
  // The corner of a triangle that is repeated: any place is inside of it, by more than a book is wide.
  if (far < 1e-6) return 1e3;
  along /= far;
  vec3 inward = middle - from;
  inward = normalize(inward - dot(inward, along) * along);
  return dot(point - from, inward);
}

// How much of the light from a direction is hidden by what has four corners in turn, as far as they lie in a plane.
float hiddenBy(vec3 a, vec3 b, vec3 c, vec3 d, vec3 place, vec3 direction, float softness) {
  vec3 middle = 0.25 * (a + b + c + d);
  vec3 normal = cross(c - a, d - b);
  float far = dot(middle - place, normal) / dot(direction, normal);
  if (!(far > 0.0)) return 0.0;
  vec3 point = place + far * direction;
  float inside = min(
    min(insideEdge(point, a, b, middle), insideEdge(point, b, c, middle)),
    min(insideEdge(point, c, d, middle), insideEdge(point, d, a, middle)));
  return smoothstep(-softness * far, softness * far, inside);
}

uniform vec3 sheet[4];
uniform float sheetCount;

void shadeByFlaps(vec3 place, float strength, inout vec3 sky, inout float key) {
  for (int k = 0; k < ${mostFlaps}; k++) {
    if (k >= flapCount) return;
    vec3 a = flaps[4 * k];
    vec3 b = flaps[4 * k + 1];
    vec3 c = flaps[4 * k + 2];
    vec3 d = flaps[4 * k + 3];
    key *= 1.0 - strength * hiddenBy(a, b, c, d, place, KEY_DIRECTION, ${glslNumber(penumbra)});
    sky *= 1.0 - strength * 0.5 * hiddenBy(a, b, c, d, place, vec3(0.0, 0.0, 1.0), 1.0);
  }
}

void shadeBySheet(vec3 place, float strength, inout vec3 sky, inout float key) {
  if (sheetCount < 0.5) return;
  key *= 1.0 - strength * hiddenBy(sheet[0], sheet[1], sheet[2], sheet[3], place, KEY_DIRECTION, ${glslNumber(penumbra)});
  sky *= 1.0 - strength * 0.5 * hiddenBy(sheet[0], sheet[1], sheet[2], sheet[3], place, vec3(0.0, 0.0, 1.0), 1.0);
}
`;
