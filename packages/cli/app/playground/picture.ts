/** One of the two pictures: a leaf on its canvas, with its overlay. */

import type { Scene } from "three";
import { type LeafPictures, LeafStage } from "turnleaf/leaf-stage";
import { Overlay } from "./overlay.ts";
import type { AnyLeaf } from "./replay_leaf.ts";
import type { Settings } from "./settings.ts";
import { StrainColours } from "./strain.ts";
import { leafSize, type Variant } from "./variants.ts";

/** Maximum of device pixels per CSS pixel: more makes no visible difference. */
const mostRatio = 2;

/** A leaf's picture. */
export class Picture {
  readonly canvas: HTMLCanvasElement;
  readonly stage: LeafStage;
  readonly #overlay: Overlay;
  readonly #strain = new StrainColours();
  #isCovered = false;

  /**
   * @param redraw shows the leaf again after the graphics context was restored
   *
   * @throws Error if the browser has no WebGL 2
   */
  constructor(canvas: HTMLCanvasElement, pages: LeafPictures, redraw: () => void) {
    this.canvas = canvas;
    this.stage = new LeafStage(canvas, leafSize, redraw);
    this.stage.print(pages);
    this.#overlay = new Overlay(this.stage.scene as Scene);
  }

  /** Follows the canvas's box. */
  resize(): void {
    const { clientWidth, clientHeight } = this.canvas;
    this.stage.resize(clientWidth, clientHeight, Math.min(devicePixelRatio, mostRatio));
  }

  /** Draws a leaf as it is now. */
  draw(variant: Variant, leaf: AnyLeaf, settings: Settings): void {
    leaf.update();
    const surface = leaf.surface();
    this.stage.show(surface);
    if (settings.strain) {
      const areNew = this.#strain.paint(surface);
      if (areNew || !this.#isCovered) this.stage.cover(this.#strain);
    } else if (this.#isCovered) this.stage.cover(null);
    this.#isCovered = settings.strain;
    this.#overlay.show(variant, leaf.nodes(), surface, settings);
    this.stage.draw();
  }
}
