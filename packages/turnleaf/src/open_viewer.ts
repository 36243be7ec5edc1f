/** Opens a book as well as this machine can show it. */

import { openContext } from "./draw/context.ts";
import type { PageSource } from "./sources/page_source.ts";
import { Viewer, type ViewerOptions } from "./viewer.ts";

/**
 * Opens a book on a canvas that nothing was drawn on before. What draws it is loaded only now.
 * Rejects with a `BookError` where no page's size can be had, or
 * with an `Error` where WebGL 2 or WebAssembly is not to be had.
 */
export async function openViewer(
  canvas: HTMLCanvasElement,
  source: PageSource,
  options: ViewerOptions,
  signal: AbortSignal,
): Promise<Viewer> {
  if (!openContext(canvas)) {
    throw new Error(
      "This book needs WebGL 2, which this browser does not offer or has switched off.",
    );
  }
  const { craft } = await import("./solid.ts");
  return Viewer.open(canvas, source, options, craft, signal);
}
