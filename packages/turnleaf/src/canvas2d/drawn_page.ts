/** The page of a leaf in flight, drawn once where it would lie on the canvas, and copied from there. */

import type { PagePicture } from "../sources/page_source.ts";
import { pageBox } from "./canvas_layout.ts";
import { type Brush, drawPage } from "./draw_book.ts";
import { KeptDrawing } from "./kept_drawing.ts";

/** A page in the light of its side. Where it lies flat, it is pixel for pixel what is drawn at rest. */
export class DrawnPage {
  readonly #drawing: KeptDrawing;
  /** From its pixels to the space of the brush. */
  #toBook = new DOMMatrix();
  #hasInk = false;

  constructor(document: Document) {
    this.#drawing = new KeptDrawing(document);
  }

  /** Whether it shows a picture, and not bare paper. */
  get hasInk(): boolean {
    return this.#hasInk;
  }

  /**
   * Shows a page that would lie on a side. It has no more pixels than the canvas, also where a zoom
   * makes the page larger than that.
   *
   * @param version a number that changes when the content of a picture does
   * @param density its pixels across one of the canvas
   */
  show(
    brush: Brush,
    sign: 1 | -1,
    picture: PagePicture | null,
    version: number,
    density: number,
  ): void {
    const { pen, toCanvas, shape } = brush;
    this.#hasInk = picture !== null;
    const [left, top, right, bottom] = pageBox(shape, sign);
    const a = toCanvas.transformPoint({ x: left, y: top });
    const b = toCanvas.transformPoint({ x: right, y: bottom });
    const [x, y] = [Math.floor(Math.min(a.x, b.x)), Math.floor(Math.min(a.y, b.y))];
    const width = Math.max(1, Math.ceil(Math.max(a.x, b.x)) - x);
    const height = Math.max(1, Math.ceil(Math.max(a.y, b.y)) - y);
    const most = pen.canvas.width * pen.canvas.height;
    const scale = Math.min(density, Math.sqrt(most / (width * height)));
    const toPixels = new DOMMatrix().scale(scale).translate(-x, -y).multiply(toCanvas);
    this.#toBook = toPixels.inverse();
    const shows = [shape, sign, picture, version, ...matrixOf(toPixels)];
    const size = [width, height].map((length) => Math.ceil(length * scale));
    this.#drawing.update(size[0], size[1], shows, (pen) => {
      pen.setTransform(toPixels);
      drawPage({ ...brush, pen }, sign, picture);
    });
  }

  /** Copies it to where it lies, in the brush's space as its pen has transformed it. */
  draw({ pen }: Brush): void {
    pen.save();
    pen.transform(...matrixOf(this.#toBook));
    pen.drawImage(this.#drawing.canvas, 0, 0);
    pen.restore();
  }

  /** Frees its pixels. */
  free(): void {
    this.#drawing.free();
  }
}

function matrixOf({ a, b, c, d, e, f }: DOMMatrix) {
  return [a, b, c, d, e, f] as const;
}
