/** Opens a book as well as this machine can show it. */

import { openContext } from "./draw/context.ts";
import type { PageSource } from "./sources/page_source.ts";
import { type Craft, Viewer, type ViewerOptions } from "./viewer.ts";

/** The shortest module there is: its magic number and version. */
const emptyModule = Uint8Array.of(0, 0x61, 0x73, 0x6d, 1, 0, 0, 0);

/** Whether there is WebAssembly, and the page's security policy lets it run. */
function mayRunEngine(): boolean {
  try {
    return new WebAssembly.Module(emptyModule) instanceof WebAssembly.Module;
  } catch {
    return false;
  }
}

/** What shows a book: in space with WebGL 2 and the engine; else on the flat, and then neither is loaded. */
async function craftFor(canvas: HTMLCanvasElement): Promise<Craft> {
  const isSolid = mayRunEngine() && openContext(canvas) !== null;
  return (await (isSolid ? import("./solid.ts") : import("./plain/plain.ts"))).craft;
}

/**
 * Opens a book on a canvas that nothing was drawn on before.
 * Rejects with a `BookError` where no page's size can be had.
 */
export async function openViewer(
  canvas: HTMLCanvasElement,
  source: PageSource,
  options: ViewerOptions,
  signal: AbortSignal,
): Promise<Viewer> {
  const craft = await craftFor(canvas);
  signal.throwIfAborted();
  return Viewer.open(canvas, source, options, craft, signal);
}
