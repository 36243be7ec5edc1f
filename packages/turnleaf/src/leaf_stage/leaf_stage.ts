/**
 * Draws one leaf over two resting pages, lit as the viewer lights a book: for
 * pages that show a leaf of `turnleaf/models` or a recorded turn. Draws when
 * `draw` is called, and requests no animation frame.
 *
 * Metres, as in `turnleaf/models`: x across the spine, y along it to the head,
 * z up from the pages.
 */

import type { Texture } from "three";
import type { Ray, Vec3 } from "../engine/shapes.ts";
import type { PaperMesh } from "../paper_mesh.ts";
import { pickSurface } from "../picking/pick.ts";
import { handAt } from "../picking/reach.ts";
import type { PagePicture } from "../sources/page_source.ts";
import { LeafScene } from "../webgl/leaf_scene.ts";

export type { PagePicture, Ray, Vec3 };

/** The size of a leaf, metres. */
export interface LeafSize {
  /** From the spine to the fore-edge. */
  readonly width: number;
  /** From the foot to the head. */
  readonly height: number;
}

/** Points of a leaf in evenly spaced columns and rows, or moved onto its creases. */
export interface ShownLeaf {
  /** Points along a row, from the spine. */
  readonly columns: number;
  /** Rows, from the foot. */
  readonly rows: number;
  /** x, y, z of each point, row by row, metres. */
  readonly positions: Float32Array;
  /** Unit normal of each, up where the leaf lies on the right. */
  readonly normals: Float32Array;
  /** How the points lie on the flat paper if the leaf is creased. */
  readonly creased?: PaperMesh | undefined;
}

/** A place on a leaf: u from 0 at the spine to 1 at the fore-edge, v from 0 at the foot to 1 at the head. */
export interface LeafPlace {
  readonly u: number;
  readonly v: number;
}

/** Pictures of the leaf's two sides, and of the page that rests on either side. Null is blank. */
export type LeafPictures = Readonly<
  Record<"recto" | "verso" | "left" | "right", PagePicture | null>
>;

/** The part of a three.js `Scene` that is used, so that no types of three.js are needed. */
export interface SceneOfThree {
  readonly isScene: boolean;
  add(...objects: object[]): unknown;
  remove(...objects: object[]): unknown;
}

/** A `Texture` of three.js, likewise. */
export interface TextureOfThree {
  readonly isTexture: boolean;
}

/** One leaf on one canvas. */
export class LeafStage {
  private readonly size: LeafSize;
  // A function: a Proxy that wraps what it returns, as Vue's does, does not reach three.js's objects.
  private readonly leafScene: () => LeafScene;
  private leaf: ShownLeaf | null = null;
  /** u of each of the leaf's columns. */
  private u = new Float32Array(0);
  private width = 1;
  private height = 1;

  /**
   * @param onRestored called when the graphics context was restored after a
   * loss, and a frame should be drawn
   *
   * @throws Error if the browser has no WebGL 2
   */
  constructor(canvas: HTMLCanvasElement, size: LeafSize, onRestored?: () => void) {
    this.size = size;
    const scene = new LeafScene(canvas, size, onRestored);
    this.leafScene = () => scene;
  }

  /**
   * The scene that is drawn. Objects added to it are drawn too; the caller who adds an
   * object disposes of it.
   */
  get scene(): SceneOfThree {
    return this.leafScene().scene;
  }

  /** Fits the canvas to `width` by `height` CSS pixels, each `pixelRatio` device pixels. */
  resize(width: number, height: number, pixelRatio: number): void {
    this.width = Math.max(1, width);
    this.height = Math.max(1, height);
    this.leafScene().resize(this.width, this.height, pixelRatio);
  }

  /** Sets the pictures of the leaf and the pages from the next frame on. */
  print(pictures: LeafPictures): void {
    this.leafScene().print(pictures);
  }

  /**
   * Shows textures on the leaf's recto and verso in place of its pictures; null
   * shows those again.
   */
  cover(textures: Readonly<Record<"recto" | "verso", TextureOfThree>> | null): void {
    this.leafScene().cover(textures as Readonly<Record<"recto" | "verso", Texture>> | null);
  }

  /**
   * Sets where the leaf is from the next frame on. Its arrays are read in every
   * frame until then.
   */
  show(leaf: ShownLeaf): void {
    if (this.u.length !== leaf.columns) {
      this.u = Float32Array.from({ length: leaf.columns }, (_, k) => k / (leaf.columns - 1));
    }
    this.leaf = leaf;
    this.leafScene().show(leaf);
  }

  /** Draws one frame immediately. */
  draw(): void {
    this.leafScene().draw();
  }

  /**
   * Returns the place on the leaf at a position of the canvas, CSS pixels from
   * its upper left corner, or null beside the leaf.
   */
  pick(x: number, y: number): LeafPlace | null {
    if (!this.leaf) return null;
    return pickSurface(this.ray(x, y), { ...this.leaf, version: 0 }, this.u);
  }

  /**
   * Returns the position in space, on an arch, of a pointer at a position of
   * the canvas that carries a point of the leaf `reach` metres from the spine.
   */
  handAt(x: number, y: number, reach: number): Vec3 {
    return handAt(this.ray(x, y), Math.max(reach, 0.01 * this.size.width), () => 0);
  }

  /** Frees all memory of the graphics card. The canvas cannot be drawn on again. */
  destroy(): void {
    this.leafScene().destroy();
  }

  private ray(x: number, y: number): Ray {
    return this.leafScene().rayAt((2 * x) / this.width - 1, 1 - (2 * y) / this.height);
  }
}
