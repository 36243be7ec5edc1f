/** The material of a printed sheet: a resting page, or one side of a leaf in flight. */

import { BackSide, Color, FrontSide, ShaderMaterial, type Texture } from "three";
import type { Paper } from "../engine/shapes.ts";
import type { BookShape } from "../stage/book_pose.ts";
import { lookOf } from "../themes.ts";
import { inkChunk, inkUniforms } from "./ink.ts";
import { layPapers, papersChunk, paperUniforms } from "./papers.ts";
import { gapChunk, lightChunk, pictureChunk } from "./shading.ts";

/** Values passed from the vertex to the fragment shader. */
const varyings = /* glsl */ `
varying vec3 vNormal;
varying vec3 vPlace;
varying vec2 vUv;
varying vec2 vGapSky;
varying vec4 vGapKey;
varying vec2 vGapBehind;
#ifdef TORN
varying vec3 vTear;
#endif
#ifdef SHADED
varying float vPart;
#endif
`;

const vertexShader = /* glsl */ `
attribute vec2 gapSky;
attribute vec4 gapKey;
attribute vec2 gapBehind;
uniform float lit;
uniform vec2 ahead;
uniform float thick;
#ifdef TORN
attribute vec3 tear;
#endif
#ifdef SHADED
attribute float part;
#endif
${varyings}
void main() {
  vNormal = normal * lit;
  vPlace = position + 0.5 * thick * vNormal;
  vUv = uv;
  vGapSky = gapSky;
  vGapKey = gapKey;
  vGapBehind = gapBehind;
  #ifdef TORN
  vTear = tear;
  #endif
  #ifdef SHADED
  vPart = part;
  #endif
  vec4 seen = viewMatrix * vec4(vPlace, 1.0);
  gl_Position = projectionMatrix * seen;
  // Only the depth comes nearer, not the picture.
  float lead = mix(ahead.x, ahead.y, smoothstep(-0.008, 0.008, position.x));
  vec4 nearer = projectionMatrix * (seen + vec4(0.0, 0.0, lead, 0.0));
  gl_Position.z = nearer.z / nearer.w * gl_Position.w;
}
`;

/**
 * What only some pages need is compiled in, or not: drawn in software, the light that flaps and
 * sheets keep off would cost each pixel much of its time also where no branch leads there.
 */
const fragmentShader = /* glsl */ `
uniform sampler2D pictureBehind;
uniform sampler2D beneath;
uniform float mirrored;
uniform float thin;
uniform float ceiling;
uniform float pool;
uniform float shadows;
uniform vec2 size;
uniform vec3 bare;
#ifdef TORN
uniform float opened;
#endif
${varyings}
${lightChunk}
${gapChunk}
${papersChunk}
${pictureChunk}
${inkChunk}

// What shines through a leaf from its other side, with that side's print in it.
vec3 throughLeaf(vec3 normal, vec2 uv) {
  float away = max(0.0, (0.35 - dot(normal, KEY_DIRECTION)) / 1.35);
  float key = away * keyFraction(vGapBehind);
  float sky = skyFraction(vGapBehind, -normal);
  vec3 light = 0.46 * key * vec3(1.05, 0.93, 0.76) + 0.09 * sky * vec3(1.0, 0.93, 0.80);
  vec3 print = texture2D(pictureBehind, onPicture(vec2(1.0 - uv.x, uv.y)), 2.2).rgb;
  return light * mix(vec3(1.0), print, 0.75);
}

// A page on its pile has one end of its gap for each of three places on the key light.
float keyHere() {
  vec3 left = mix(vGapKey.xyz, vGapKey.www, mirrored);
  vec3 right = mix(vGapKey.www, vGapKey.xyz, mirrored);
  if (thin > 0.5) {
    left = vGapKey.xxx;
    right = vGapKey.yyy;
  }
  return dot(keyFractions(left, right), vec3(1.0 / 3.0));
}

// Beside a page that is smaller than the book its leaf is cut, or bare where its other side is larger.
vec3 besidePrint(vec4 print, vec2 uv) {
  float behind = texture2D(pictureBehind, onPicture(vec2(1.0 - uv.x, uv.y))).a;
  float leaf = max(print.a, behind);
  if (thin > 0.5 && leaf < 0.5) discard;
  vec3 ink = mix(bare, print.rgb, smoothstep(0.4, 0.6, print.a));
  if (thin > 0.5) return ink;
  vec4 under = solid(beneath, onPicture(uv), texture2D(beneath, onPicture(uv), -0.4));
  // The edge shades what lies under it.
  float near = texture2D(picture, onPicture(uv), 4.0).a;
  vec3 lower = mix(bare, under.rgb, under.a) * (1.0 - 0.3 * near);
  return mix(lower, ink, smoothstep(0.4, 0.6, leaf));
}

#ifdef TORN
// Paper tears along its fibres: an edge that wanders by a millimetre or so, in whole numbers, so
// that every machine draws the same.
float wander(float at) {
  uint cell = uint(at);
  vec2 ends;
  for (int k = 0; k < 2; k++) {
    uint n = (cell + uint(k)) * 0x9e3779b9u;
    n = (n ^ (n >> 16)) * 0x21f0aaadu;
    n = (n ^ (n >> 15)) * 0x735a2d97u;
    ends[k] = float((n ^ (n >> 15)) >> 8) / 16777216.0;
  }
  return mix(ends.x, ends.y, smoothstep(0.0, 1.0, fract(at)));
}

// Cuts what is "from" metres off a ragged edge, and bares fibres so far beside it.
vec3 fibresAt(vec3 ink, float from, float along, float reach) {
  if (from < 0.0) discard;
  float fibres = 1.0 - smoothstep(0.0, reach, from - 0.5 * reach * wander(2000.0 + along / 0.0006));
  return mix(ink, bare * vec3(1.02, 1.06, 1.15), 0.8 * fibres);
}

float raggedness(float along) {
  return 0.0012 * wander(along / 0.005) + 0.0005 * wander(1000.0 + along / 0.0009);
}

// The edge at the spine, from which it is "from" metres.
vec3 tearEdge(vec3 ink, float from, float along) {
  return fibresAt(ink, from - raggedness(along), along, 0.0012);
}

// The edge where a sheet is torn across: one line cuts both pieces, and one has more of its
// fibres bared on this side of the paper, the other on that.
vec3 tearAcross(vec3 ink) {
  if (vTear.y > opened) return ink;
  float edge = vTear.z * (raggedness(5.0 + vTear.y) - 0.00085);
  float reach = vTear.z * (1.0 - 2.0 * mirrored) > 0.0 ? 0.0022 : 0.0009;
  return fibresAt(ink, vTear.x - edge, vTear.y, reach);
}
#endif

#ifdef SHADED
// The cut edge of what is folded over, or loose, catches light: as far as a page may be brighter than its picture.
float paperEdge() {
  #ifndef TORN
  if (vPart < 0.5) return 0.0;
  #endif
  vec2 within = min(vUv, 1.0 - vUv) * size;
  return 1.0 - smoothstep(0.0, 2.0 * pixel, min(within.x, within.y));
}
#endif

#ifdef DARK
// What dark paper gives back is too little to tell a leaf in the air from the page under it: shadows
// are lost, and the light on a slope. Its surface does, whatever its colour: more of the light the more
// it slopes, and most of all where it is cut. Flat it has its own colour.
vec3 glint(vec3 normal) {
  float slope = 1.0 - normal.z;
  float facing = max(0.0, dot(normal, KEY_DIRECTION) + WRAP) / (1.0 + WRAP);
  // As wide however much it slopes.
  vec2 from = vec2(1.0 - vUv.x, min(vUv.y, 1.0 - vUv.y)) / max(vec2(pixel) / size, fwidth(vUv));
  float cut = 1.0 - smoothstep(0.5, 1.5, min(from.x, from.y));
  float sheen = 0.04 * smoothstep(0.0, 0.8, slope) * (0.4 + 0.6 * facing);
  return (sheen + 0.11 * cut * smoothstep(0.0, 0.03, slope)) * vec3(1.0, 0.965, 0.91);
}
#endif

// Of the sky that other leaves shut out as much comes through them as of the key light.
vec3 skyHere(vec3 normal) {
  float open = skyFraction(vGapSky, normal);
  float all = 0.5 + 0.5 * normal.z;
  return amongPaper(open) + thin * THROUGH * max(0.0, all - open);
}

void main() {
  vec3 normal = normalize(vNormal);
  vec2 uv = vec2(mix(vUv.x, 1.0 - vUv.x, mirrored), vUv.y);
  vec4 print = printed(onPicture(uv));
  vec3 ink = print.rgb;
  if (print.a < 0.99) ink = besidePrint(print, uv);
  #ifdef TORN
  ink = tearEdge(ink, vUv.x * size.x, vUv.y * size.y);
  ink = tearAcross(ink);
  #endif
  vec3 sky = vec3(0.5 + 0.5 * normal.z);
  float key = 1.0;
  if (shadows > 0.0) {
    sky = mix(sky, skyHere(normal), shadows);
    key = mix(key, keyHere(), shadows);
    #ifdef SHADED
    shadeByPapers(vPlace, vPart, shadows, sky, key);
    #endif
  }
  vec3 light = arriving(normal, sky, key);
  if (thin > 0.5) light += throughLeaf(normal, uv);
  #if defined(SHADED) && !defined(DARK)
  light += 0.03 * paperEdge();
  #endif
  light = min(light, vec3(ceiling));
  vec2 fromLight = (vPlace.xy - vec2(-0.35 * size.x, 0.65 * size.y)) / (1.5 * size);
  light *= 1.0 - pool * smoothstep(0.1, 1.0, length(fromLight));
  vec3 colour = ink * light;
  #ifdef DARK
  colour += thin * glint(normal);
  #ifdef SHADED
  colour += 0.06 * paperEdge();
  #endif
  #endif
  gl_FragColor = vec4(colour, 1.0);
  #include <colorspace_fragment>
  gl_FragColor.rgb = dithered(gl_FragColor.rgb);
}
`;

/** How much nearer in depth a leaf counts than the one it lies on, metres. */
const leadOverOne = 0.0004;

/** Which side of a sheet a material is for. */
export interface PaperSide {
  /** The side that faces up where the sheet lies on the right. */
  readonly recto: boolean;
  /** Whether light shines through: a leaf in flight, not a page on its pile. */
  readonly thin: boolean;
  /** Whether the mesh's normals are this side's own; the leaf's are its recto's. */
  readonly ownNormals: boolean;
  /** Whether its edge at the spine is torn. */
  readonly torn: boolean;
}

/** A printed sheet's material, by its two pictures. */
export class PaperMaterial extends ShaderMaterial {
  /** @param pixel the size of a CSS pixel on the book, metres: shadows of paper on paper are no finer */
  constructor(
    side: PaperSide,
    shape: BookShape,
    paper: Texture,
    pixel: { readonly value: number },
  ) {
    const { kind, width, height, quarterTurned, shadows } = shape;
    const { paper: bare, isDark } = lookOf(shape);
    super({
      defines: {
        ...(quarterTurned ? { QUARTER_TURNED: "" } : {}),
        ...(side.torn ? { TORN: "" } : {}),
        ...(isDark ? { DARK: "" } : {}),
      },
      vertexShader,
      fragmentShader,
      side: side.recto ? FrontSide : BackSide,
      uniforms: {
        ...inkUniforms(paper),
        pictureBehind: { value: paper },
        beneath: { value: paper },
        lit: { value: side.recto || side.ownNormals ? 1 : -1 },
        mirrored: { value: side.recto ? 0 : 1 },
        thin: { value: side.thin ? 1 : 0 },
        ahead: { value: [0, 0] },
        thick: { value: 0 },
        ceiling: { value: kind === "scan" ? 1 : 1.03 },
        pool: { value: kind === "scan" ? 0 : 0.024 },
        shadows: { value: shadows },
        ...paperUniforms(),
        pixel,
        size: { value: [width, height] },
        bare: { value: new Color(bare) },
        opened: { value: -1 },
      },
    });
  }

  /** How far the sheet is torn across, metres; null if it is not. */
  set opened(metres: number | null) {
    // Shaders have no infinity.
    this.uniforms.opened.value = Math.min(metres ?? -1, 1e3);
  }

  /** The picture on this side. */
  set picture(texture: Texture) {
    this.uniforms.picture.value = texture;
  }

  /**
   * Makes the leaf visible over those under it, also where all are bent and
   * their triangles cross.
   *
   * @param left,right the number under it when it lies on that side
   */
  lieOver(left: number, right: number): void {
    this.uniforms.ahead.value = [leadOverOne * left, leadOverOne * right];
  }

  /** Shades it by paper that lies on it, or close over it: by the first of it, where there is very much. */
  lay(papers: readonly Paper[]): void {
    layPapers(this.uniforms, papers);
    if (papers.length > 0) this.shade();
  }

  /** Compiles in what paper that lies on it shades; without that frames take less time. */
  shade(): void {
    if ("SHADED" in this.defines) return;
    this.defines.SHADED = "";
    this.needsUpdate = true;
  }

  /** The picture of the page visible beside this one where its leaf is trimmed. */
  set beneath(texture: Texture) {
    this.uniforms.beneath.value = texture;
  }

  /** Thickness of the sheet, metres, so that its two sides stand apart; 0 for paper. */
  set thickness(metres: number) {
    this.uniforms.thick.value = metres;
  }

  /** The picture on the sheet's other side. */
  set pictureBehind(texture: Texture) {
    this.uniforms.pictureBehind.value = texture;
  }
}
