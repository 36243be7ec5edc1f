/** A book on the flat: leaves that are peeled, drawn with a 2D canvas. Loaded where a book in space cannot be had. */

import { Canvas2DStage } from "./canvas2d/canvas2d_stage.ts";
import { PeeledBook } from "./canvas2d/peeled_book.ts";
import type { Backend } from "./viewer/viewer.ts";

/** Needs neither WebGL nor WebAssembly. */
export const canvas2dBackend: Backend = {
  engine: async (size) => new PeeledBook(size),
  stage: (canvas, shape) => new Canvas2DStage(canvas, shape),
};
