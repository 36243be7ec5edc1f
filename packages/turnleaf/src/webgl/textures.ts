/** Pictures as textures: one for each picture object, however many faces show it. */

import {
  DataTexture,
  LinearFilter,
  LinearMipmapLinearFilter,
  RGBAFormat,
  SRGBColorSpace,
  Texture,
  type WebGLRenderer,
} from "three";
import type { PagePicture } from "../sources/page_source.ts";
import { drawsInSoftware } from "./software_gl.ts";

/** Maximum used, for pages seen at a low angle: more makes no visible difference on a page. */
const mostAnisotropy = 8;

/** Textures by picture. */
export class PictureTextures {
  /** What a face shows while it has no picture. */
  paper: Texture;
  /** Anisotropy of the textures, from 1 for none. */
  readonly anisotropy: number;
  readonly #renderer: WebGLRenderer;
  readonly #textures = new Map<PagePicture, Texture>();

  /** @param paper CSS colour of six digits of what a face shows while it has no picture */
  constructor(renderer: WebGLRenderer, paper: string) {
    this.#renderer = renderer;
    this.anisotropy = drawsInSoftware(renderer.getContext())
      ? 1
      : Math.min(mostAnisotropy, renderer.capabilities.getMaxAnisotropy());
    this.paper = plainTexture(paper);
  }

  /** Returns the picture's texture, uploaded to the GPU now rather than in the middle of a turn. */
  of(picture: PagePicture | null): Texture {
    if (picture === null) return this.paper;
    const known = this.#textures.get(picture);
    if (known) return known;
    const texture = new Texture(picture);
    texture.colorSpace = SRGBColorSpace;
    texture.flipY = false;
    texture.generateMipmaps = true;
    texture.minFilter = LinearMipmapLinearFilter;
    texture.magFilter = LinearFilter;
    texture.anisotropy = this.anisotropy;
    texture.needsUpdate = true;
    this.#textures.set(picture, texture);
    if (!this.#renderer.getContext().isContextLost()) this.#renderer.initTexture(texture);
    return texture;
  }

  /** Changes the colour of bare paper, for materials that are made from now on. Returns the texture of before, to be disposed of. */
  setPaper(colour: string): Texture {
    const before = this.paper;
    this.paper = plainTexture(colour);
    return before;
  }

  /** Has what was drawn on a canvas since then uploaded with the next frame. */
  refresh(canvas: HTMLCanvasElement): void {
    const texture = this.#textures.get(canvas);
    if (texture) texture.needsUpdate = true;
  }

  /**
   * Frees a picture's texture. No material may show it any more: three.js would
   * create it again.
   */
  forget(picture: PagePicture): void {
    const texture = this.#textures.get(picture);
    if (texture === undefined) return;
    texture.dispose();
    // The picture is about to be closed; a texture still in use is reported rather than uploaded.
    texture.image = null;
    this.#textures.delete(picture);
  }

  /** Removes every texture from the graphics card; one that is shown again is uploaded again. */
  drop(): void {
    for (const texture of this.#textures.values()) texture.dispose();
    this.paper.dispose();
  }

  dispose(): void {
    this.drop();
    this.#textures.clear();
  }
}

function plainTexture(colour: string): Texture {
  const number = Number.parseInt(colour.slice(1), 16);
  const pixel = new Uint8Array([number >> 16, (number >> 8) & 255, number & 255, 255]);
  const texture = new DataTexture(pixel, 1, 1, RGBAFormat);
  texture.colorSpace = SRGBColorSpace;
  texture.needsUpdate = true;
  return texture;
}
