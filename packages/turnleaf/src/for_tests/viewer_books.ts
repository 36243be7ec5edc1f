/** Viewers of small books, for tests in a browser. */

import { openViewer } from "../open_viewer.ts";
import type { PageSource } from "../sources/page_source.ts";
import type { Viewer, ViewerOptions } from "../viewer/viewer.ts";
import { clock } from "./clock.ts";

/** Size of their canvases, CSS pixels. */
export const width = 400;
export const height = 300;

/** A book on a canvas in the document. */
export interface ViewedBook {
  readonly canvas: HTMLCanvasElement;
  readonly viewer: Viewer;
}

let canvas = document.createElement("canvas");
/** Whether the book that was on the canvas has left it to the next one. */
let isSpare = false;

/** Closes a book, and leaves its canvas to the next one, with what is compiled. */
export function close({ viewer }: ViewedBook): void {
  isSpare = viewer.destroy(true);
}

/** Opens a book on a canvas in the document. Resolves once it rests. */
export async function opened(
  source: PageSource,
  options: Partial<ViewerOptions>,
): Promise<ViewedBook> {
  const fresh = (): HTMLCanvasElement => {
    if (isSpare) {
      isSpare = false;
      return canvas;
    }
    canvas.remove();
    canvas = document.createElement("canvas");
    canvas.style.cssText = `width: ${width}px; height: ${height}px; background: white`;
    document.body.append(canvas);
    return canvas;
  };
  const nothing = () => {};
  const viewer = await openViewer(
    fresh,
    source,
    {
      cover: "none",
      cloth: "#6a2a26",
      paper: () => ({}),
      page: () => 1,
      turnSeconds: () => 0.1,
      onStart: nothing,
      onRest: nothing,
      onZoom: nothing,
      onFailure: nothing,
      ...options,
    },
    new AbortController().signal,
  );
  viewer.resize(width, height, 1);
  await settledViewer(viewer);
  return { canvas, viewer };
}

/** Waits until nothing moves and all is sharp. */
export const settledViewer = (viewer: Viewer): Promise<void> => clock.until(() => viewer.settled);

/**
 * Returns the brightness of the canvas's own pixels in rows, from places in
 * CSS pixels to the right, 0 to 255: all of one frame.
 */
export async function brightness(
  { canvas, viewer }: ViewedBook,
  places: readonly { readonly x: number; readonly y: number }[],
  count = 1,
): Promise<number[][]> {
  const copy = document.createElement("canvas");
  [copy.width, copy.height] = [count, places.length];
  const pen = copy.getContext("2d") as CanvasRenderingContext2D;
  // Within a frame: afterwards a WebGL canvas may be empty.
  viewer.invalidate();
  await new Promise((resolve) => requestAnimationFrame(resolve));
  const scale = canvas.width / width;
  for (const [row, place] of places.entries()) {
    const [x, y] = [Math.round(place.x * scale), Math.round(place.y * scale)];
    pen.drawImage(canvas, x, y, count, 1, 0, row, count, 1);
  }
  const { data } = pen.getImageData(0, 0, count, places.length);
  return places.map((_, row) =>
    Array.from({ length: count }, (_, k) => data[4 * (row * count + k)]),
  );
}
