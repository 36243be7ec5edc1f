/**
 * Fades out the area beyond the spine of a page that stands alone, instead of
 * cutting it off at the canvas's edge.
 */

import {
  CustomBlending,
  Mesh,
  type PerspectiveCamera,
  PlaneGeometry,
  ShaderMaterial,
  SrcAlphaFactor,
  Vector2,
  Vector3,
  ZeroFactor,
} from "three";
import type { BookShape } from "../stage/book_pose.ts";
import { fadeBeyondSpine as fade } from "../stage/zoom.ts";

const vertexShader = /* glsl */ `
varying vec2 vPlace;
void main() {
  vPlace = position.xy;
  gl_Position = vec4(position.xy, 0.0, 1.0);
}
`;

const fragmentShader = /* glsl */ `
uniform vec2 from;
uniform vec2 way;
uniform float amount;
varying vec2 vPlace;
void main() {
  float faded = smoothstep(0.0, 1.0, dot(vPlace - from, way) / dot(way, way));
  gl_FragColor = vec4(0.0, 0.0, 0.0, 1.0 - amount * faded);
}
`;

/** A quad over the whole picture, drawn last, that clears what is under it. */
export class BeyondSpine {
  readonly mesh: Mesh<PlaneGeometry, ShaderMaterial>;
  readonly #from = new Vector2();
  readonly #way = new Vector2();

  constructor() {
    const material = new ShaderMaterial({
      vertexShader,
      fragmentShader,
      uniforms: {
        from: { value: this.#from },
        way: { value: this.#way },
        amount: { value: 0 },
      },
      depthTest: false,
      depthWrite: false,
      transparent: true,
      blending: CustomBlending,
      blendSrc: ZeroFactor,
      blendDst: SrcAlphaFactor,
    });
    this.mesh = new Mesh(new PlaneGeometry(2, 2), material);
    this.mesh.frustumCulled = false;
    this.mesh.renderOrder = 1000;
    this.mesh.visible = false;
  }

  /**
   * Follows the camera.
   *
   * @param closed how far the book is closed, 0 to 1: then all of it is shown
   */
  aim(
    { width, height, thickness, alone }: BookShape,
    closed: number,
    camera: PerspectiveCamera,
  ): void {
    const amount = alone === 0 ? 0 : 1 - closed;
    this.mesh.visible = amount > 0;
    if (amount === 0) return;
    const seen = (fraction: number): Vector3 =>
      new Vector3(-alone * fraction * width, height / 2, thickness / 2).project(camera);
    const [from, to] = [seen(fade.from), seen(fade.to)];
    this.#from.set(from.x, from.y);
    this.#way.set(to.x - from.x, to.y - from.y);
    this.mesh.material.uniforms.amount.value = amount;
  }

  dispose(): void {
    this.mesh.geometry.dispose();
    this.mesh.material.dispose();
  }
}
