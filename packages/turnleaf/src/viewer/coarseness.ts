/** Finds pages that are seen larger than their bitmaps. */

import type { Face } from "../book/faces.ts";
import type { PageBitmaps } from "../pages/page_bitmaps.ts";
import type { PageSource } from "../sources/page_source.ts";
import type { BookStage } from "../stage/book_stage.ts";

/** A page that lies open, and the face that shows it. */
export interface OpenPage {
  readonly face: Face;
  /** From 1. */
  readonly page: number;
  /** Width of its bitmap in device pixels; infinite if the source has no sharper one. */
  readonly width: number;
}

/** What draws and shows sharper parts of pages. */
export interface SharpnessParts {
  readonly source: PageSource;
  readonly stage: BookStage;
  /** A leaf's width over its height. */
  readonly aspect: number;
  /** Gives the place of a page on its leaf. */
  readonly pictures: Pick<PageBitmaps, "placeOf">;
  /** Called when something has arrived and a frame should be drawn. */
  readonly arrived: () => void;
  /** Called if the code that draws sharper parts cannot be loaded: pages keep their bitmaps. */
  readonly failed: (error: unknown) => void;
}

/** Returns the canvas pixels across a whole leaf at the size it has at a point of a face. */
export function acrossAt(stage: BookStage, face: Face, x: number, y: number): number {
  const [from, to] = [x - 0.01, x + 0.01].map((x) => stage.projectOn(face, x, y));
  return (Math.hypot(to.x - from.x, to.y - from.y) / 0.02) * stage.restingRatio;
}

/**
 * Returns whether a page is seen larger than its bitmap. Before the bitmap
 * arrives, the page's place on its leaf is unknown.
 */
export function isCoarse(stage: BookStage, { face, width }: OpenPage): boolean {
  return width > 0 && acrossAt(stage, face, 0.5, 0.5) > width;
}
