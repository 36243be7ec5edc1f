/** How large a book is shown: the canvas, the place for which it is laid out, and where in these it lies open. */

import type { PageSize } from "../sources/page_source.ts";
import type { BookStage, Place } from "../stage/book_stage.ts";
import type { Bindable } from "./bound_book.ts";
import type { CameraMotion } from "./camera_motion.ts";
import type { Rebinder } from "./rebinder.ts";

/** What the extent of a book follows from. */
export interface ExtentParts {
  readonly book: Pick<Bindable, "source" | "leaf">;
  readonly stage: Pick<BookStage, "projectOpen" | "resize">;
  readonly camera: Pick<CameraMotion, "lookAtRest">;
  readonly rebinder: Pick<Rebinder, "bound" | "isAside">;
}

/** How large one book is shown, however it is bound. */
export class BookExtent {
  readonly #parts: ExtentParts;
  #canvas: PageSize = { width: 0, height: 0 };
  #room: PageSize = this.#canvas;
  /** All that `resize` was called with last. */
  #sizes = "";
  #pixelRatio = 1;
  #scale = 1;

  constructor(parts: ExtentParts) {
    this.#parts = parts;
  }

  /** The size of the canvas, CSS pixels. */
  get canvas(): PageSize {
    return this.#canvas;
  }

  /** The size of the place for which the book is laid out, CSS pixels. */
  get room(): PageSize {
    return this.#room;
  }

  /** Whether the canvas has no size yet, so that nothing is to be drawn. */
  get isEmpty(): boolean {
    return this.#canvas.width === 0;
  }

  /** Returns whether a place is on the canvas. */
  contains({ x, y }: Place): boolean {
    return x >= 0 && y >= 0 && x <= this.#canvas.width && y <= this.#canvas.height;
  }

  /** Fits the book to a canvas, as `Viewer.resize` describes. Returns whether anything is of another size. */
  resize(canvas: PageSize, pixelRatio: number, scale: number, room: PageSize): boolean {
    const sizes = [canvas.width, canvas.height, pixelRatio, scale, room.width, room.height].join();
    if (sizes === this.#sizes) return false;
    this.#sizes = sizes;
    this.#canvas = canvas;
    this.#room = room;
    this.#pixelRatio = pixelRatio;
    this.#scale = scale;
    this.#resizeStage(canvas);
    return true;
  }

  /** Width over height of a place that two pages fill. */
  get placeRatio(): number {
    const { width, height } = this.#usualLeaf;
    return this.#shape.quarterTurned ? width / (2 * height) : (2 * width) / height;
  }

  /** Width of that place in CSS pixels where a page is as large as its source says, whose unit counts as one. */
  get placeWidth(): number {
    const { width } = this.#usualLeaf;
    return this.#shape.quarterTurned ? width : 2 * width;
  }

  /**
   * Where the open book lies, or would: the rectangle around the places of its
   * two pages, or of the one that stands alone, CSS pixels on the canvas.
   */
  get bounds(): { readonly from: Place; readonly to: Place } {
    const { width, height, thickness, alone } = this.#shape;
    const [left, right] = [alone === 1 ? 0 : -width, alone === -1 ? 0 : width];
    const corners = [left, right].flatMap((x) =>
      [0, height].map((y) => this.#parts.stage.projectOpen([x, y, thickness / 2])),
    );
    const [xs, ys] = [corners.map(({ x }) => x), corners.map(({ y }) => y)];
    return {
      from: { x: Math.min(...xs), y: Math.min(...ys) },
      to: { x: Math.max(...xs), y: Math.max(...ys) },
    };
  }

  /**
   * How wide a page of the open book is shown, CSS pixels, where it is not zoomed and has its whole room; 0
   * before the book has a size, and while a page is shown by itself that others are not like.
   */
  get pageWidth(): number {
    if (this.isEmpty || this.#parts.rebinder.isAside) return 0;
    const { alone, quarterTurned } = this.#shape;
    return this.#widthIn(this.#room) / (alone !== 0 || quarterTurned ? 1 : 2);
  }

  /**
   * Returns how large the book would be shown if its room were narrower, as a fraction of its size in the
   * whole room.
   *
   * @param width by which it would be, CSS pixels
   */
  fractionBeside(width: number): number {
    const room = this.#room;
    if (this.isEmpty || width >= room.width) return 1;
    return this.#widthIn({ ...room, width: room.width - width }) / this.#widthIn(room);
  }

  /** Returns how wide the open book is shown in a place of some size where it is not zoomed, CSS pixels. */
  #widthIn(place: PageSize): number {
    // Within it, as a smaller stage would move what is zoomed.
    return this.#parts.camera.lookAtRest(() => {
      this.#resizeStage(place);
      const { from, to } = this.bounds;
      this.#resizeStage(this.#canvas);
      return to.x - from.x;
    });
  }

  #resizeStage({ width, height }: PageSize): void {
    this.#parts.stage.resize(width, height, this.#pixelRatio, this.#scale);
  }

  /** What a place is sized for does not follow from the place. */
  get #usualLeaf(): PageSize {
    const { source, leaf } = this.#parts.book;
    return source.usualLeaf ?? leaf;
  }

  get #shape() {
    return this.#parts.rebinder.bound.shape;
  }
}
