/** The graphics context is lost: for a while, or for good. */

import { afterEach, expect, test, vi } from "vitest";
import type { TurnleafBook } from "../element.ts";
import { clock } from "../for_tests/clock.ts";
import { book, happens, scans, settled } from "../for_tests/element_books.ts";

afterEach(() => {
  vi.useRealTimers();
  vi.restoreAllMocks();
  document.body.replaceChildren();
});

const canvasOf = (element: TurnleafBook) =>
  element.shadowRoot?.querySelector("[part=canvas]") as HTMLCanvasElement;

const card = (canvas: HTMLCanvasElement) =>
  canvas.getContext("webgl2")?.getExtension("WEBGL_lose_context");

/**
 * Copies an element's canvas, scaled down, after every frame. Returns a
 * function that returns its last picture.
 */
function photographer(element: TurnleafBook) {
  const copy = document.createElement("canvas");
  [copy.width, copy.height] = [60, 44];
  const pen = copy.getContext("2d", { willReadFrequently: true }) as CanvasRenderingContext2D;
  const real = globalThis.requestAnimationFrame;
  globalThis.requestAnimationFrame = (call) =>
    real((now) => {
      call(now);
      // Frames requested by others leave the canvas empty.
      const canvas = canvasOf(element);
      const before = pen.getImageData(0, 0, 60, 44);
      pen.clearRect(0, 0, 60, 44);
      if (canvas) pen.drawImage(canvas, 0, 0, 60, 44);
      if (!pen.getImageData(0, 0, 60, 44).data.some((value) => value > 0))
        pen.putImageData(before, 0, 0);
    });
  return {
    last: () => pen.getImageData(0, 0, 60, 44).data,
    stop: () => {
      globalThis.requestAnimationFrame = real;
    },
  };
}

test("the pictures of its pages come back too", async () => {
  const element = book(scans(12), { page: "4" });
  const camera = photographer(element);
  try {
    await happens(element, "load");
    await settled(element);
    const before = camera.last();
    expect(before.some((value) => value > 0)).toBe(true);
    const canvas = canvasOf(element);
    const extension = card(canvas);
    const lost = new Promise((done) => canvas.addEventListener("webglcontextlost", done));
    extension?.loseContext();
    await lost;
    // Not before every listener has heard of the loss.
    await clock.task();
    const restored = new Promise((done) => canvas.addEventListener("webglcontextrestored", done));
    extension?.restoreContext();
    await restored;
    await settled(element);
    const after = camera.last();
    const apart = after.reduce((sum, value, k) => sum + Math.abs(value - before[k]), 0);
    expect(apart / after.length).toBeLessThan(0.5);
  } finally {
    camera.stop();
  }
});

test("where the processor draws, books have one sample a pixel, from the first on", async () => {
  for (let k = 0; k < 2; k++) {
    const element = book(scans(4));
    await settled(element);
    const gl = canvasOf(element).getContext("webgl2") as WebGL2RenderingContext;
    const info = gl.getExtension("WEBGL_debug_renderer_info");
    const renderer = String(info && gl.getParameter(info.UNMASKED_RENDERER_WEBGL));
    const isSoftware = /swiftshader/i.test(renderer);
    expect(gl.getContextAttributes()?.antialias, renderer).toBe(!isSoftware);
    element.remove();
  }
});
