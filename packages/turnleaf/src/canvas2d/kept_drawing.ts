/** Drawings on canvases of their own, kept from frame to frame until what they show changes. */

/** One such drawing. */
export class KeptDrawing {
  readonly canvas: HTMLCanvasElement;
  readonly #pen: CanvasRenderingContext2D;
  #shown: readonly unknown[] = [];

  /** @throws Error if the browser gives no further canvas */
  constructor(document: Document) {
    this.canvas = document.createElement("canvas");
    const pen = this.canvas.getContext("2d");
    if (!pen) throw new Error("This book needs a canvas, which this browser does not offer.");
    this.#pen = pen;
  }

  /**
   * Draws it, unless it shows the same already.
   *
   * @param width,height pixels, whole numbers
   * @param shows all that the drawing depends on, compared by identity
   * @param draw draws on an empty canvas
   */
  update(
    width: number,
    height: number,
    shows: readonly unknown[],
    draw: (pen: CanvasRenderingContext2D) => void,
  ): void {
    const all = [width, height, ...shows];
    if (all.length === this.#shown.length && all.every((one, k) => one === this.#shown[k])) return;
    this.#shown = all;
    // Setting a size clears the canvas and resets the pen.
    this.canvas.width = width;
    this.canvas.height = height;
    draw(this.#pen);
  }

  /** Frees its pixels. */
  free(): void {
    this.#shown = [];
    this.canvas.width = this.canvas.height = 0;
  }
}
