/** The material of everything that is not a sheet: leaf edges, cloth, boards, headbands. */

import { type Color, DoubleSide, FrontSide, ShaderMaterial, type Texture } from "three";
import { inkChunk, inkUniforms } from "./ink.ts";
import { lightChunk, pictureChunk } from "./shading.ts";

const vertexShader = /* glsl */ `
attribute vec2 open;
attribute vec2 grainAt;
varying vec3 vNormal;
varying vec2 vUv;
varying vec2 vGrainAt;
varying vec2 vOpen;
varying vec3 vPlace;
void main() {
  vPlace = (modelMatrix * vec4(position, 1.0)).xyz;
  vNormal = mat3(modelMatrix) * normal;
  vUv = uv;
  vGrainAt = grainAt;
  vOpen = open;
  gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
}
`;

const fragmentShader = /* glsl */ `
uniform vec3 base;
uniform sampler2D grain;
uniform float grainDepth;
uniform float pictured;
uniform vec4 panel;
uniform float paperiness;
varying vec3 vNormal;
varying vec2 vUv;
varying vec2 vGrainAt;
varying vec2 vOpen;
varying vec3 vPlace;
${lightChunk}
${pictureChunk}
${inkChunk}

void main() {
  vec3 normal = normalize(gl_FrontFacing ? vNormal : -vNormal);
  float thread = 1.0 + grainDepth * (texture2D(grain, vGrainAt).r * 2.0 - 1.0);
  vec3 colour = base * thread;

  float fraction = 0.0;
  if (pictured > 0.0) {
    vec2 at = (vUv - panel.xy) / (panel.zw - panel.xy);
    vec2 soft = fwidth(vUv) / (panel.zw - panel.xy) + 1e-5;
    vec2 within = smoothstep(-soft, soft, at) * smoothstep(-soft, soft, 1.0 - at);
    vec4 print = printed(onPicture(at));
    // A panel that covers the whole face goes round its bevel too.
    fraction = print.a * pictured * (panel.y <= 0.0 ? 1.0 : within.x * within.y);
    colour = mix(colour, print.rgb, fraction);
  }

  vec3 sky = vec3(vOpen.x * (0.5 + 0.5 * normal.z));
  sky = mix(sky, amongPaper(sky.x), max(paperiness, fraction));
  vec3 light = arriving(normal, sky, vOpen.y);
  // The light falls off away from the lamp, and cloth, unlike a picture, shows it.
  light *= 1.0 - 0.09 * (1.0 - fraction) * (1.0 - paperiness) * smoothstep(-0.2, 0.3, dot(vPlace.xy, vec2(0.75, -0.66)));
  gl_FragColor = vec4(colour * min(light, vec3(1.03)), 1.0);
  #include <colorspace_fragment>
  gl_FragColor.rgb = dithered(gl_FragColor.rgb);
}
`;

/** The look of a solid surface. */
export interface SolidLook {
  readonly base: Color;
  readonly grain: Texture;
  /** How much the grain darkens and brightens. */
  readonly grainDepth: number;
  /** How much light neighbouring paper reflects in, 0 to 1. */
  readonly paperiness: number;
  /** If true, it is visible from both sides. */
  readonly twoSided?: boolean;
  /** Whether the book lies with its spine across the screen, and pictures with it. */
  readonly quarterTurned: boolean;
}

/** A solid surface's material, with a picture on a panel of it if there is one. */
export class SolidMaterial extends ShaderMaterial {
  /** Bound if there is no picture. */
  readonly #grain: Texture;

  constructor(look: SolidLook) {
    super({
      vertexShader,
      fragmentShader,
      defines: look.quarterTurned ? { QUARTER_TURNED: "" } : {},
      side: look.twoSided ? DoubleSide : FrontSide,
      uniforms: {
        base: { value: look.base },
        grain: { value: look.grain },
        grainDepth: { value: look.grainDepth },
        paperiness: { value: look.paperiness },
        ...inkUniforms(look.grain),
        pictured: { value: 0 },
        panel: { value: [0, 0, 1, 1] },
      },
    });
    this.#grain = look.grain;
  }

  /** Shows a picture, or the plain surface for null. */
  setPicture(texture: Texture | null): void {
    this.uniforms.pictured.value = texture ? 1 : 0;
    // A texture that stayed bound would be uploaded again after its picture was freed.
    this.uniforms.picture.value = texture ?? this.#grain;
  }

  /** The part of the face, left, top, right, bottom from 0 to 1, that the picture covers. */
  get panel(): readonly [number, number, number, number] {
    return this.uniforms.panel.value;
  }

  set panel(panel: readonly [number, number, number, number]) {
    this.uniforms.panel.value = panel;
  }
}
