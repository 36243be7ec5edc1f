/**
 * What the viewer needs of a stage, which draws a book. Two implement it:
 * `WebGLStage` (3D, by three.js) and `Canvas2DStage` (flat). A stage draws when
 * `draw` is called: it requests no animation frame and no timer.
 */

import type { Face } from "../book/faces.ts";
import type { Ray, Vec3 } from "../engine/shapes.ts";
import type { PageBox, PagePicture } from "../sources/page_source.ts";
import type { BookPose, BookShape } from "./book_pose.ts";
import type { Zoom } from "./zoom.ts";

/** A place on the canvas, CSS pixels from its upper left corner. */
export interface Place {
  readonly x: number;
  readonly y: number;
}

/** The uppermost page of a side. */
export type PageFace = "left" | "right";

/** A side of a leaf in flight. */
export type LeafSide = "recto" | "verso";

/**
 * A sharper bitmap of a part of a face's own; the part in fractions of that
 * from its upper left corner.
 */
export interface FaceDetail {
  readonly picture: PagePicture;
  readonly box: PageBox;
}

/** How a frame is drawn. */
export interface DrawOptions {
  /** If true, nothing moves: the frame has several pixels for each of the screen, where these are large. */
  readonly resting?: boolean;
  /** If true, the view does not move: the print of pages that lie is laid on the pixels of the screen. */
  readonly steady?: boolean;
  /** Of a frame that is not at rest: fraction of the screen's pixel ratio, 1 by default. */
  readonly pixels?: number;
}

/** Draws one book on one canvas. */
export interface BookStage {
  /**
   * Called when the graphics context was restored after a loss and a frame
   * should be drawn again.
   */
  onRestored: (() => void) | null;
  /**
   * Called when the context was lost and was not restored in time: this stage
   * shows nothing any more.
   */
  onContextLost: (() => void) | null;
  /** Whether fold-outs can lie open. */
  readonly unfolds: boolean;
  /** Whether the graphics context is currently lost, so that nothing is visible. */
  readonly isLost: boolean;
  /** Whether the processor draws, for which each pixel costs much. */
  readonly isSoftware: boolean;
  /** Canvas pixels for each CSS pixel in a frame at rest. */
  readonly restingRatio: number;
  /**
   * Width of a bitmap of a whole page each of whose texels is a pixel of the screen where it lies open;
   * 0 where pages are seen aslant, and bitmaps are filtered.
   */
  readonly pageTexels: number;
  /** A key of the projection: two equal keys mean the same projection. */
  readonly viewKey: string;
  /** The zoom level and the centre of the view. Setting it clamps it to the book, if its level is 1 or more. */
  zoom: Zoom;

  /**
   * Replaces the book by one of another shape, at first with nothing on its faces.
   *
   * @param expectsSheets whether leaves may come to be folded or torn out: what draws these is made
   * ready with the next frame
   */
  bind(shape: BookShape, expectsSheets?: boolean): void;
  /**
   * Fits the canvas to `cssWidth` by `cssHeight` CSS pixels.
   *
   * @param pixelRatio device pixels along a CSS pixel of the window
   * @param scale CSS pixels of the window along one of the canvas, by transformations around it; 1 by default
   */
  resize(cssWidth: number, cssHeight: number, pixelRatio: number, scale?: number): void;
  /**
   * Returns the zoom at `level` in which the point seen at `from` now is seen
   * at `to`, clamped to the book.
   */
  zoomed(level: number, from: Place, to: Place): Zoom;

  /** Sets what a face shows from the next frame on; null for a blank page, or plain cloth outside. */
  setFace(face: Face, picture: PagePicture | null): void;
  /** Sets what a side of the leaf in flight at `index`, counted from the left, shows; null is blank. */
  setLeaf(index: number, side: LeafSide, picture: PagePicture | null): void;
  /** Sets what a side of the loose sheet at `index` of a pose shows; null is blank. */
  setLoose(index: number, side: LeafSide, picture: PagePicture | null): void;
  /**
   * Sets what is visible beside the page on a side where its leaf is trimmed:
   * the page on its other side bounds it too, and the one beneath shows.
   */
  setUnder(side: PageFace, behind: PagePicture | null, beneath: PagePicture | null): void;
  /**
   * Lays a sharper bitmap over a part of a face's own from the next frame on;
   * null removes it. The caller keeps ownership and calls `forget` when closing
   * it.
   */
  setDetail(face: Face, detail: FaceDetail | null): void;
  /** Shows what has been drawn on a canvas, which is the bitmap of faces, from the next frame on. */
  refresh(canvas: HTMLCanvasElement): void;
  /** Frees the stage's resources for a bitmap. Faces that still show it go blank. */
  forget(picture: PagePicture): void;

  /**
   * Sets where the book's parts are from the next frame on. Parts that have not
   * moved cost nothing.
   *
   * @param roughly if true, light between leaves is computed only in every
   * other pose
   */
  pose(pose: BookPose, roughly?: boolean): void;
  /** Draws one frame immediately. */
  draw(options?: DrawOptions): void;

  /** Returns the line of sight through a place on the canvas, CSS pixels from its upper left corner. */
  rayAt(x: number, y: number): Ray;
  /** Returns where a point of book space is on the canvas, CSS pixels from its upper left corner. */
  project(point: Vec3): Place;
  /** Returns where it would be if the book lay open, which may be shut. */
  projectOpen(point: Vec3): Place;
  /**
   * Returns where a place on a face's bitmap, in fractions from its upper left
   * corner, is on the canvas, likewise.
   */
  projectOn(face: Face, x: number, y: number): Place;

  /**
   * Frees all resources, and what is on the canvas.
   *
   * @param keepCanvas whether another stage will draw on the canvas
   * @returns whether another can; if not, the canvas cannot be drawn on again
   */
  destroy(keepCanvas?: boolean): boolean;
}
