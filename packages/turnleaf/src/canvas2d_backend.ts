/** A flat book: peeled leaves on a 2D canvas. Loaded where WebGL or WebAssembly is unavailable. */

import { Canvas2DStage } from "./canvas2d/canvas2d_stage.ts";
import { PeeledBook } from "./canvas2d/peeled_book.ts";
import type { Backend } from "./viewer/viewer.ts";

/** Needs neither WebGL nor WebAssembly. */
export const canvas2dBackend: Backend = {
  engine: async (size) => new PeeledBook(size),
  stage: (canvas, shape) => new Canvas2DStage(canvas, shape),
};
