/**
 * Pages that are elements, drawn by the browser itself while they turn, so that what moves on
 * them goes on moving: HTML-in-canvas, where the browser has it (see docs/html-pages.md). An
 * element can be drawn only onto a canvas that contains it, so its slot lies in one until the
 * book lies still. Moved by `moveBefore`, the element keeps its focus, scrolling, animations
 * and frames.
 */

import type { PageBox } from "../sources/page_source.ts";
import type { DrawnPage, LiveBitmaps, Viewer } from "../viewer/viewer.ts";
import { addStyle } from "./shadow_tree.ts";

/** Pages drawn so at once, at most: twice the four of one turn; of more, in a riffle, nothing is read. */
const mostDrawn = 8;

/** A canvas that draws what it contains, and its context: no type library has them yet. */
type LiveCanvas = HTMLCanvasElement & { onpaint: (() => void) | null };
type LivePen = CanvasRenderingContext2D & {
  drawElementImage(element: Element, x: number, y: number, width: number, height: number): void;
};

/** The elements of a book's pages while they turn. */
export class LiveDrawings implements LiveBitmaps {
  readonly #viewer: Viewer;
  readonly #boxOf: (page: number) => HTMLElement | undefined;
  readonly #layer: HTMLElement = document.createElement("div");
  readonly #removeStyle: () => void;
  readonly #pages = new Map<number, LivePage>();

  /**
   * @param stage contains the book's canvas
   *
   * @param boxOf returns the place of a page (from 1), which contains its slot; undefined if the
   * page is no element
   */
  constructor(
    stage: HTMLElement,
    viewer: Viewer,
    boxOf: (page: number) => HTMLElement | undefined,
  ) {
    this.#viewer = viewer;
    this.#boxOf = boxOf;
    this.#layer.className = "drawings";
    this.#removeStyle = addStyle(stage.getRootNode() as ShadowRoot, style);
    stage.append(this.#layer);
  }

  /** Draws the pages that are in sight from now on, as they change. */
  begin(): void {
    this.#viewer.setLiveBitmaps(this);
  }

  /** Puts every element back where it lies at rest. */
  end(): void {
    const pages = [...this.#pages.values()];
    this.#pages.clear();
    for (const page of pages) page.putBack();
    this.#viewer.setLiveBitmaps(null);
    for (const { canvas } of pages) this.#viewer.forgetCanvas(canvas);
  }

  /** Ends it for good. */
  destroy(): void {
    this.end();
    this.#layer.remove();
    this.#removeStyle();
  }

  bitmapOf(page: number, drawn: DrawnPage): HTMLCanvasElement | null {
    return (this.#pages.get(page) ?? this.#take(page))?.bitmap(drawn) ?? null;
  }

  #take(page: number): LivePage | null {
    const box = this.#boxOf(page);
    if (!box || this.#pages.size === mostDrawn) return null;
    const taken = new LivePage(box, this.#layer, (canvas) => this.#viewer.canvasChanged(canvas));
    this.#pages.set(page, taken);
    return taken;
  }
}

/** One element, inside the canvas on which it is drawn. */
class LivePage {
  readonly canvas: LiveCanvas = document.createElement("canvas") as LiveCanvas;
  readonly #box: HTMLElement;
  readonly #slot: Element | null;
  /** What is drawn: the element on white, as its picture at rest is. */
  readonly #sheet: HTMLElement = document.createElement("div");
  #place: PageBox | null = null;
  #hasChanged = false;

  /** @param changed called when the element looks otherwise than before, once it is drawn so if it is shown */
  constructor(box: HTMLElement, layer: HTMLElement, changed: (canvas: HTMLCanvasElement) => void) {
    this.#box = box;
    this.#slot = box.firstElementChild;
    // The attribute's name of before 2026-09, and what took its place.
    this.canvas.setAttribute("layoutsubtree", "");
    this.canvas.setAttribute("content", "drawable");
    this.#sheet.setAttribute("drawable", "");
    this.#sheet.inert = box.inert;
    this.canvas.append(this.#sheet);
    layer.append(this.canvas);
    if (this.#slot) this.#sheet.moveBefore(this.#slot, null);
    let isFirst = true;
    this.canvas.onpaint = () => {
      // The first comes of the move: what does not change is as it was drawn before.
      if (!isFirst) this.#hasChanged = true;
      isFirst = false;
      this.#draw();
      if (this.#hasChanged || this.#place) changed(this.canvas);
    };
  }

  /** Returns the canvas, once the element looks otherwise than it was drawn. */
  bitmap({ picture, place, isOutdated }: DrawnPage): HTMLCanvasElement | null {
    if (!this.#hasChanged && !isOutdated && this.#place === null) return null;
    if (this.#place === null) {
      this.#place = place;
      [this.canvas.width, this.canvas.height] = [picture.width, picture.height];
      // The leaf around the page; and the page, where the browser has nothing painted of it.
      this.#pen.drawImage(picture, 0, 0);
      this.#draw();
    }
    return this.canvas;
  }

  /** Puts the element back into its box. */
  putBack(): void {
    this.canvas.onpaint = null;
    if (this.#slot) this.#box.moveBefore(this.#slot, null);
    this.canvas.remove();
  }

  get #pen(): LivePen {
    return this.canvas.getContext("2d") as LivePen;
  }

  #draw(): void {
    if (this.#place === null) return;
    const { width, height } = this.canvas;
    const { x, y, width: across, height: along } = this.#place;
    try {
      this.#pen.drawElementImage(
        this.#sheet,
        x * width,
        y * height,
        across * width,
        along * height,
      );
    } catch {
      // It is not painted now, as where it is hidden: its last picture stays.
    }
  }
}

/**
 * What is painted is drawn, and what is transparent, hidden or out of sight is not painted: the
 * elements lie in the middle of the stage, too small to be seen.
 */
const style: string = /* css */ `
.drawings { position: absolute; left: 50%; top: 50%; transform: scale(1e-5); pointer-events: none; }
.drawings > canvas { position: absolute; left: 0; top: 0; }
.drawings > canvas > div { position: relative; width: max-content; background: #fff; }
`;
