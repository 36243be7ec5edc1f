/** Opens a book as well as this machine can show it. */

import { mayRunCode } from "./engine/machine_code.ts";
import { BookError, type PageSource } from "./sources/page_source.ts";
import { Viewer, type ViewerOptions } from "./viewer/viewer.ts";
import { giveUpContext, openContext } from "./webgl/context.ts";

/**
 * Opens a book: in space where there is WebGL 2 and the engine may run; else on
 * the flat, and then neither three.js nor the engine is loaded.
 * Rejects with a `BookError` where no page's size can be had.
 *
 * @param freshCanvas a canvas that nothing was drawn on, in place of the one before
 * @param isFlat whether the graphics card is not to be asked
 */
export async function openViewer(
  freshCanvas: () => HTMLCanvasElement,
  source: PageSource,
  options: ViewerOptions,
  signal: AbortSignal,
  isFlat = false,
): Promise<Viewer> {
  let canvas = freshCanvas();
  const mayRun = mayRunCode();
  if (!mayRun) warnOnce();
  if (!isFlat && mayRun && openContext(canvas)) {
    try {
      const { webglBackend } = await import("./webgl_backend.ts");
      signal.throwIfAborted();
      return await Viewer.open(canvas, source, options, webglBackend, signal);
    } catch (error) {
      giveUpContext(canvas);
      signal.throwIfAborted();
      // Without its pages there is no book; without its card there is a plainer one.
      if (error instanceof BookError) throw error;
      canvas = freshCanvas();
    }
  }
  const { canvas2dBackend } = await import("./canvas2d_backend.ts");
  signal.throwIfAborted();
  return Viewer.open(canvas, source, options, canvas2dBackend, signal);
}

let hasWarned = false;

/** Says on the console, once a page, why books are shown on the flat: nothing on the page does. */
function warnOnce(): void {
  if (hasWarned || !globalThis.WebAssembly) return;
  hasWarned = true;
  console.warn(
    "turnleaf-book: books are shown on the flat, as this page's Content-Security-Policy lacks 'wasm-unsafe-eval' in script-src.",
  );
}
