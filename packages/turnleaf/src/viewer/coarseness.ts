/** Pages that are seen larger than their pictures are. */

import type { Face } from "../book/faces.ts";
import type { PageBitmaps } from "../pages/page_bitmaps.ts";
import type { PageSource } from "../sources/page_source.ts";
import type { BookStage } from "../stage/book_stage.ts";

/** A page that lies open, on the face where it is seen. */
export interface OpenPage {
  readonly face: Face;
  /** From 1. */
  readonly page: number;
  /** Width of its picture in device pixels; infinite where the source has no sharper one. */
  readonly width: number;
}

/** What sharper parts are made of and shown on. */
export interface SharpnessTools {
  readonly source: PageSource;
  readonly stage: BookStage;
  /** A leaf's width over its height. */
  readonly aspect: number;
  /** Knows where on its leaf a page lies. */
  readonly pictures: Pick<PageBitmaps, "placeOf">;
  /** Something came, and a frame should be drawn. */
  readonly arrived: () => void;
  /** What draws sharper parts cannot be loaded: pages stay as their pictures are. */
  readonly failed: (error: unknown) => void;
}

/** Canvas pixels across a whole leaf, as large as it is seen at a place of a face. */
export function acrossAt(stage: BookStage, face: Face, x: number, y: number): number {
  const [from, to] = [x - 0.01, x + 0.01].map((x) => stage.projectOn(face, x, y));
  return (Math.hypot(to.x - from.x, to.y - from.y) / 0.02) * stage.restingRatio;
}

/** Whether a page is seen larger than its picture is. Where that is to come, nobody knows yet how the page lies on its leaf. */
export function isCoarse(stage: BookStage, { face, width }: OpenPage): boolean {
  return width > 0 && acrossAt(stage, face, 0.5, 0.5) > width;
}
