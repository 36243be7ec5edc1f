/** The open fold-out, or the one that opens or closes. There is at most one. */

import type { Surface } from "../engine/shapes.ts";
import type { OpenFoldOut, PageBitmaps } from "../pages/page_bitmaps.ts";
import { foldAt } from "../pages/page_place.ts";
import { loadPart } from "../sources/load_part.ts";
import type { BookPose, BookShape } from "../stage/book_pose.ts";

/** Time in which a flap opens, seconds. */
const openTime = 0.6;

/** The dependencies and callbacks of fold-outs. */
export interface FoldOutHooks {
  /** Whether fold-outs can lie open at all. */
  readonly unfolds: boolean;
  /** Width of a leaf, device pixels. */
  readonly width: () => number;
  /** Called when the faces show other bitmaps than before. */
  readonly changed: () => void;
  /** Called if the code that bends a fold-out cannot be loaded. */
  readonly failed: (error: unknown) => void;
}

/** A fold-out and how far it is open. */
interface Flap {
  readonly page: number;
  readonly sign: 1 | -1;
  readonly parts: OpenFoldOut;
  readonly flapSurface: typeof import("./flap_surface.ts").flapSurface;
  open: number;
  to: 0 | 1;
}

/** Unfolds and folds in a fold-out. */
export class FoldOut {
  readonly #pictures: PageBitmaps;
  readonly #hooks: FoldOutHooks;
  #flap: Flap | null = null;
  #drawing: AbortController | null = null;
  #waiting: ((done: boolean) => void)[] = [];
  #surface: { open: number; surface: Surface } | null = null;
  #version = 0;

  constructor(pictures: PageBitmaps, hooks: FoldOutHooks) {
    this.#pictures = pictures;
    this.#hooks = hooks;
  }

  /** The page (from 1) that lies open or opens; null if none does. */
  get page(): number | null {
    return this.#flap?.to === 1 ? this.#flap.page : null;
  }

  /**
   * The bitmaps on the flap, and the side of the book that it belongs to; null
   * if no flap is visible.
   */
  get parts(): (OpenFoldOut & { readonly sign: 1 | -1 }) | null {
    return this.#flap && { ...this.#flap.parts, sign: this.#flap.sign };
  }

  /**
   * Opens the fold-out of a page on a side (1 right, -1 left). Resolves, once
   * it lies open, to whether it does.
   */
  async unfold(page: number, sign: 1 | -1): Promise<boolean> {
    if (!this.#hooks.unfolds) return false;
    this.close();
    const drawing = new AbortController();
    this.#drawing = drawing;
    const width = this.#hooks.width();
    const flap = await loadPart(import("./flap_surface.ts")).catch(this.#hooks.failed);
    if (!flap || drawing.signal.aborted) return false;
    const parts = await this.#pictures.unfold(page, width, drawing.signal).catch(() => null);
    if (drawing.signal.aborted || parts === null) {
      if (parts) this.#pictures.foldIn();
      return false;
    }
    const { flapSurface } = flap;
    this.#flap = { page, sign, parts, flapSurface, open: 0, to: 1 };
    this.#hooks.changed();
    return await new Promise((resolve) => this.#waiting.push(resolve));
  }

  /** Folds in the open fold-out. Resolves once it is folded in. */
  async foldIn(): Promise<void> {
    this.#drawing?.abort();
    if (this.#flap === null) return;
    this.#tell(false);
    this.#flap.to = 0;
    await new Promise((resolve) => this.#waiting.push(resolve));
  }

  /** Advances the motion. Returns whether anything moves. */
  step(seconds: number): boolean {
    const flap = this.#flap;
    if (flap === null || (flap.to === 1 && flap.open === 1)) return false;
    const way = seconds / openTime;
    flap.open = flap.to === 1 ? Math.min(flap.open + way, 1) : Math.max(flap.open - way, 0);
    if (flap.open !== flap.to) return true;
    if (flap.to === 0) this.close();
    else this.#tell(true);
    return false;
  }

  /** Returns the flap over the pages of a pose. */
  surface(pose: BookPose, { width, height }: BookShape): Surface | null {
    const flap = this.#flap;
    const pile = flap?.sign === 1 ? pose.right : pose.left;
    if (flap === null || pile === null) return null;
    const { sign, open } = flap;
    if (this.#surface?.open !== open) {
      const place = { sign, open, fold: foldAt, fraction: flap.parts.place.width - foldAt };
      this.#surface = {
        open,
        surface: flap.flapSurface(place, pile, width, height, ++this.#version),
      };
    }
    return this.#surface.surface;
  }

  /** Removes everything at once. */
  close(): void {
    this.#drawing?.abort();
    this.#surface = null;
    if (this.#flap === null) return;
    this.#flap = null;
    this.#pictures.foldIn();
    this.#hooks.changed();
    this.#tell(false);
  }

  #tell(done: boolean): void {
    for (const resolve of this.#waiting.splice(0)) resolve(done);
  }
}
