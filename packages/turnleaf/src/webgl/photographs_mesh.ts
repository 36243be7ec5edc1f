/** Photographs of the open book, laid over its pages. */

import {
  BufferAttribute,
  BufferGeometry,
  CustomBlending,
  Group,
  LinearFilter,
  Mesh,
  OneFactor,
  OneMinusSrcAlphaFactor,
  ShaderMaterial,
  Texture,
} from "three";

const vertexShader = /* glsl */ `
varying vec2 vUv;
void main() {
  vUv = uv;
  gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
}
`;

/** Unlit, as it was taken; where it is transparent the book is visible. */
const fragmentShader = /* glsl */ `
uniform sampler2D picture;
varying vec2 vUv;
void main() {
  gl_FragColor = texture2D(picture, vUv);
}
`;

/** Drawn after everything else. */
const last = 100;

/** Where the open pages lie, metres. */
export interface OpenPages {
  /** Width and height of one. */
  readonly width: number;
  readonly height: number;
  /** How high the fore-edges of both lie. */
  readonly left: number;
  readonly right: number;
}

/**
 * A picture over both pages, from fore-edge to fore-edge, and over their head
 * and foot as far as it is higher.
 */
export type PhotographQuad = Mesh<BufferGeometry, ShaderMaterial>;

/** Photographs over one book, any number at once, the last uppermost. */
export class PhotographsMesh {
  readonly group: Group = new Group();
  readonly #ratio: number | null;
  readonly #textures: readonly Texture[];
  readonly #quads: PhotographQuad[] = [];

  /**
   * @param pictures of the open book from above, its spine upright in the
   * middle
   *
   * @param ratio width over height of a page in them, stretched to the book's;
   * null if it is the book's
   */
  constructor(pictures: readonly ImageBitmap[], ratio: number | null) {
    this.#ratio = ratio;
    this.#textures = pictures.map((picture) => {
      const texture = new Texture(picture);
      texture.flipY = false;
      texture.generateMipmaps = false;
      texture.minFilter = texture.magFilter = LinearFilter;
      texture.needsUpdate = true;
      return texture;
    });
    this.group.userData.textures = this.#textures;
  }

  /** Shows pictures by number, from 0, over the pages. */
  show(numbers: readonly number[], pages: OpenPages): void {
    while (this.#quads.length < numbers.length) this.#add();
    for (const [k, quad] of this.#quads.entries()) {
      quad.visible = k < numbers.length;
      if (!quad.visible) continue;
      const texture = this.#textures[numbers[k]];
      const { width, height } = texture.image as ImageBitmap;
      quad.material.uniforms.picture.value = texture;
      const ratio = this.#ratio ?? pages.width / pages.height;
      const over = pages.height * ((height / width) * ratio - 0.5);
      const [low, high] = [-over, pages.height + over];
      const { left, right } = pages;
      const place = quad.geometry.getAttribute("position") as BufferAttribute;
      place.setXYZ(0, -pages.width, high, left);
      place.setXYZ(1, pages.width, high, right);
      place.setXYZ(2, -pages.width, low, left);
      place.setXYZ(3, pages.width, low, right);
      place.needsUpdate = true;
    }
  }

  dispose(): void {
    for (const texture of this.#textures) texture.dispose();
    for (const { geometry, material } of this.#quads) {
      geometry.dispose();
      material.dispose();
    }
    this.group.removeFromParent();
  }

  #add(): void {
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(new Float32Array(12), 3));
    geometry.setAttribute("uv", new BufferAttribute(new Float32Array([0, 0, 1, 0, 0, 1, 1, 1]), 2));
    geometry.setIndex([0, 2, 1, 1, 2, 3]);
    // A bitmap's colours are already multiplied by its alpha.
    const material = new ShaderMaterial({
      vertexShader,
      fragmentShader,
      uniforms: { picture: { value: null } },
      transparent: true,
      depthTest: false,
      depthWrite: false,
      blending: CustomBlending,
      blendSrc: OneFactor,
      blendDst: OneMinusSrcAlphaFactor,
    });
    const quad = new Mesh(geometry, material);
    quad.frustumCulled = false;
    quad.renderOrder = last + this.#quads.length;
    this.#quads.push(quad);
    this.group.add(quad);
  }
}
