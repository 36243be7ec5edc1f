/**
 * A 3D book: simulated paper, drawn by the graphics card. Loaded when a book
 * opens where both are available.
 */

import { WasmBook } from "./engine/wasm_book.ts";
import type { Backend } from "./viewer/viewer.ts";
import { WebGLStage } from "./webgl/webgl_stage.ts";

/** Paper that the engine, of compiled code, bends and three.js draws. */
export function webglBackend(code: Promise<WebAssembly.Module>): Backend {
  return {
    engine: (size) => WasmBook.create(size, code),
    stage: (canvas, shape) => new WebGLStage(canvas, shape),
    creasable: async (size) =>
      (await import("./engine/creasable_book.ts")).CreasableBook.creasable(size),
    folds: () => import("./viewer/folds.ts"),
    tearing: () => import("./viewer/tearing.ts"),
    models: () => import("./leaf_models/leaf_models.ts"),
  };
}
