/**
 * Books whose frames in motion are drawn when a test looks at them: software draws pixel by pixel, and of
 * the frames of a turn a test reads few. What a frame shows is what it would have shown when it was due.
 */

import type { DrawOptions } from "../stage/book_stage.ts";
import { WebGLStage } from "../webgl/webgl_stage.ts";
import { hookContexts } from "./webgl_contexts.ts";

/**
 * Of the frames that nothing looks at one in so many is drawn all the same, so that a complaint of WebGL
 * about leaves in the air is heard.
 */
const between = 30;

/** The pixels of a book at rest, as it is shown to readers. */
const sharp = Object.getOwnPropertyDescriptor(
  WebGLStage.prototype,
  "restingDots",
) as PropertyDescriptor;

const due = new Map<WebGLStage, DrawOptions | undefined>();
const { draw, destroy } = WebGLStage.prototype;
/** Canvases that a stage draws on. What draws on others may ask for their sizes at any time. */
const canvases = new WeakSet<object>();

/** Draws what is due on every stage. */
export function drawNow(): void {
  for (const [stage, options] of due) {
    due.delete(stage);
    draw.call(stage, options);
  }
}

/** Has the stages of a file draw each frame at once again. */
export function drawAtOnce(): void {
  WebGLStage.prototype.draw = draw;
}

/** Has the stages of a file draw a book at rest with as many pixels as readers see, for tests of those. */
export function drawSharply(): void {
  Object.defineProperty(WebGLStage.prototype, "restingDots", sharp);
}

/** Has the stages of a file draw a book at rest with the screen's pixels, and no more of them. */
export function drawPlainly(): void {
  Object.defineProperty(WebGLStage.prototype, "restingDots", {
    get(this: WebGLStage): number {
      return Math.min(sharp.get?.call(this), 1);
    },
    configurable: true,
  });
}

/** Has the stages of a file draw their frames in motion once something reads their canvas. */
export function drawWhenSeen(): void {
  let count = 0;
  WebGLStage.prototype.draw = function (options) {
    due.set(this, options);
    // A book at rest is drawn, as a command may move the engine's memory, of which it is drawn.
    if (options?.resting || count++ % between === 0) drawNow();
  };
  WebGLStage.prototype.destroy = function (keepCanvas) {
    due.delete(this);
    return destroy.call(this, keepCanvas);
  };
  hookContexts((canvas, options, next) => {
    canvases.add(canvas);
    return next(options);
  });
  // A frame may give its canvas another size.
  for (const side of ["width", "height"]) {
    const property = Object.getOwnPropertyDescriptor(HTMLCanvasElement.prototype, side);
    Object.defineProperty(HTMLCanvasElement.prototype, side, {
      ...property,
      get(this: HTMLCanvasElement) {
        if (canvases.has(this)) drawNow();
        return property?.get?.call(this);
      },
    });
  }
  for (const { prototype } of [CanvasRenderingContext2D, OffscreenCanvasRenderingContext2D]) {
    const { drawImage } = prototype;
    prototype.drawImage = function (
      this: CanvasRenderingContext2D,
      ...image: [object, ...number[]]
    ) {
      if (canvases.has(image[0])) drawNow();
      Reflect.apply(drawImage, this, image);
    };
  }
}
