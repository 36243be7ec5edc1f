/** The table: nothing but the book's soft shadow over the background of the canvas. */

import { Mesh, NoBlending, PlaneGeometry, ShaderMaterial, Vector2 } from "three";
import type { Paper } from "../engine/shapes.ts";
import { layPapers, papersChunk, paperUniforms } from "./papers.ts";
import { lightChunk } from "./shading.ts";

const vertexShader = /* glsl */ `
varying vec2 vPlace;
void main() {
  vPlace = position.xy;
  gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
}
`;

/** The shadow of a box whose edge is softened by a Gaussian, cubed. */
const fragmentShader = /* glsl */ `
uniform vec4 box;
uniform float high;
uniform vec4 raised;
uniform float raisedHigh;
uniform vec2 canvas;
varying vec2 vPlace;
#ifdef SHADED
uniform float table;
${lightChunk}
${papersChunk}
#endif

// Abramowitz and Stegun 7.1.27, absolute error below 5e-4.
vec2 erf(vec2 x) {
  vec2 a = abs(x);
  vec2 t = 1.0 + a * (0.278393 + a * (0.230389 + a * (0.000972 + a * 0.078108)));
  t *= t;
  return sign(x) * (1.0 - 1.0 / (t * t));
}

float soft(vec4 box, vec2 shift, float sigma) {
  vec2 low = erf((vPlace - box.xy - shift) / (1.41421 * sigma));
  vec2 high = erf((vPlace - box.zw - shift) / (1.41421 * sigma));
  vec2 within = 0.5 * (low - high);
  return within.x * within.y;
}

void main() {
  // The higher the book, the farther and softer its shadow falls, away from the key light.
  vec2 away = vec2(0.575, -0.5) * high;
  float lit = (1.0 - 0.55 * soft(box, vec2(0.0003, -0.0004), 0.0016))
            * (1.0 - 0.46 * soft(box, 0.40 * away, 0.0030 + 0.20 * high))
            * (1.0 - 0.40 * soft(box, 0.85 * away, 0.0100 + 0.75 * high));
  vec2 under = vec2(0.575, -0.5) * raisedHigh;
  lit *= 1.0 - 0.26 * smoothstep(0.0, 0.02, raisedHigh)
             * soft(raised, under, 0.004 + 0.35 * raisedHigh);
  #ifdef SHADED
  vec3 sky = vec3(1.0);
  float key = 1.0;
  shadeByPapers(vec3(vPlace, table), 0.0, 1.0, sky, key);
  // Of light, and what is drawn is blended as sRGB has it.
  lit *= pow(dot(KEY * key + SKY * sky, vec3(1.0)) / dot(KEY + SKY, vec3(1.0)), 1.0 / 2.2);
  #endif
  // Where the canvas ends there is no shadow left to be cut off.
  vec2 fromEdge = min(gl_FragCoord.xy, canvas - gl_FragCoord.xy) / min(canvas.x, canvas.y);
  float shade = (1.0 - lit) * smoothstep(0.0, 0.06, min(fromEdge.x, fromEdge.y));
  float noise = fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715))));
  shade = clamp(shade + (noise - 0.5) / 255.0, 0.0, 1.0);
  if (shade < 0.002) discard;
  gl_FragColor = vec4(vec3(0.115, 0.085, 0.06) * shade, shade);
}
`;

/** The table's quad. Draws premultiplied colour, in the canvas's own colour space. */
export class Ground {
  readonly mesh: Mesh<PlaneGeometry, ShaderMaterial>;
  readonly #box = [0, 0, 0, 0];
  readonly #raised = [0, 0, 0, 0];
  readonly #canvas = new Vector2(1, 1);

  /**
   * @param z of the table, metres
   * @param pixel the size of a CSS pixel there, metres
   */
  constructor(z: number, size: number, pixel: { readonly value: number }) {
    const material = new ShaderMaterial({
      defines: {},
      vertexShader,
      fragmentShader,
      uniforms: {
        box: { value: this.#box },
        high: { value: 0 },
        raised: { value: this.#raised },
        raisedHigh: { value: 0 },
        canvas: { value: this.#canvas },
        table: { value: z },
        ...paperUniforms(),
        pixel,
      },
      depthWrite: false,
      blending: NoBlending,
    });
    this.mesh = new Mesh(new PlaneGeometry(size, size), material);
    this.mesh.position.z = z;
    this.mesh.frustumCulled = false;
    this.mesh.onBeforeRender = (renderer) => void renderer.getDrawingBufferSize(this.#canvas);
    // Drawn before the book.
    this.mesh.renderOrder = -1;
  }

  /**
   * Sets the shadow of the book, which covers x0 to x1, y0 to y1 and stands
   * `high` above the table, metres.
   */
  shadow(x0: number, y0: number, x1: number, y1: number, high: number): void {
    this.#box[0] = x0;
    this.#box[1] = y0;
    this.#box[2] = x1;
    this.#box[3] = y1;
    this.mesh.material.uniforms.high.value = high;
  }

  /**
   * Sets the shadow of a board or leaf over x0 to x1, y0 to y1, raised `high`
   * above the table at its middle, metres.
   */
  raise(x0: number, y0: number, x1: number, y1: number, high: number): void {
    this.#raised[0] = x0;
    this.#raised[1] = y0;
    this.#raised[2] = x1;
    this.#raised[3] = y1;
    this.mesh.material.uniforms.raisedHigh.value = high;
  }

  /** Shades it by paper that lies on it. */
  lay(papers: readonly Paper[]): void {
    layPapers(this.mesh.material.uniforms, papers);
    if (papers.length > 0) this.shade();
  }

  /** Compiles in what paper that lies on it shades; without that frames take less time. */
  shade(): void {
    const { material } = this.mesh;
    if ("SHADED" in material.defines) return;
    material.defines.SHADED = "";
    material.needsUpdate = true;
  }

  dispose(): void {
    this.mesh.geometry.dispose();
    this.mesh.material.dispose();
  }
}
