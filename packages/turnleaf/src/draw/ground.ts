/** The table: nothing but the book's soft shadow over whatever the canvas lies on. */

import { Mesh, NoBlending, PlaneGeometry, ShaderMaterial } from "three";

const vertexShader = /* glsl */ `
varying vec2 vPlace;
void main() {
  vPlace = position.xy;
  gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
}
`;

/** The shadow of a box whose edge is softened by a Gaussian, thrice. */
const fragmentShader = /* glsl */ `
uniform vec4 box;
uniform vec4 tall;
varying vec2 vPlace;

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
  float lit = (1.0 - 0.55 * soft(box, vec2(0.0003, -0.0004), 0.0016))
            * (1.0 - 0.40 * soft(tall, vec2(0.0028, -0.0030), 0.0055))
            * (1.0 - 0.34 * soft(tall, vec2(0.0090, -0.0090), 0.0170));
  float shade = 1.0 - lit;
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
  readonly #tall = [0, 0, 0, 0];

  /** @param z of the table, metres */
  constructor(z: number, size: number) {
    const material = new ShaderMaterial({
      vertexShader,
      fragmentShader,
      uniforms: { box: { value: this.#box }, tall: { value: this.#tall } },
      depthWrite: false,
      blending: NoBlending,
    });
    this.mesh = new Mesh(new PlaneGeometry(size, size), material);
    this.mesh.position.z = z;
    this.mesh.frustumCulled = false;
    // Before the book, which is drawn over it.
    this.mesh.renderOrder = -1;
  }

  /** The book covers x0 to x1, y0 to y1 where it lies on the table, metres. */
  shadow(x0: number, y0: number, x1: number, y1: number): void {
    const all = [x0, y0, x1, y1];
    for (let k = 0; k < 4; k++) this.#box[k] = this.#tall[k] = all[k];
  }

  dispose(): void {
    this.mesh.geometry.dispose();
    this.mesh.material.dispose();
  }
}
