/** Opens a book with the best backend that this machine supports. */

import { engineCode, mayRunCode } from "./engine/machine_code.ts";
import { BookError, type PageSource } from "./sources/page_source.ts";
import { type Backend, Viewer, type ViewerOptions } from "./viewer/viewer.ts";
import { giveUpContext, isUsable, openContext } from "./webgl/context.ts";

/** Loads what draws in 3D. */
let loadWebGL = (): Promise<typeof import("./webgl_backend.ts")> => import("./webgl_backend.ts");

/** Replaces what draws in 3D by the same code of another file, with three.js inside. */
export function drawWith(load: typeof loadWebGL): void {
  loadWebGL = load;
}

/**
 * Checks that a book has a page that can be shown. Rejects with a `BookError`
 * if no page's size can be read, or with the signal's reason.
 */
export async function checkPages(source: PageSource, signal: AbortSignal): Promise<void> {
  await Viewer.check(source, signal);
}

/** How a book is shown. */
export interface Showing {
  /** Whether to use the 2D canvas in any case. The default is false. */
  readonly isFlat?: boolean;
  /** Absolute address of the engine's file; "", the default, for the engine in the package. */
  readonly engineSrc?: string;
}

/**
 * Chooses what will draw a book, on the canvas that `openViewer` will get, and starts loading it:
 * while the book is read. What fails is reported where the book is opened.
 *
 * @param freshCanvas as of `openViewer`
 */
export function prepareViewer(freshCanvas: () => HTMLCanvasElement, showing: Showing): void {
  const { context } = contextFor(freshCanvas, showing);
  loadBackend(context !== null, showing).catch(() => {});
}

/**
 * Opens a book: in 3D if WebGL 2 and WebAssembly are available; otherwise on a
 * 2D canvas, and then neither three.js nor the engine is loaded. If its WebGL context is lost
 * while it opens, a new one is created, once. Any other failure in 3D is logged as a warning, and the
 * book is shown on a 2D canvas. Rejects with a `BookError` if no page's size can be read.
 *
 * @param freshCanvas returns a canvas in place of the previous one: at first one that nothing
 * was drawn on, or that of a book whose viewer was destroyed and left it; then a new one
 */
export async function openViewer(
  freshCanvas: () => HTMLCanvasElement,
  source: PageSource,
  options: ViewerOptions,
  signal: AbortSignal,
  showing: Showing = {},
): Promise<Viewer> {
  let place = contextFor(freshCanvas, showing);
  let hasLostContext = false;
  while (place.context !== null) {
    try {
      return await open(place.canvas, true);
    } catch (error) {
      const isLost = place.context.isContextLost();
      giveUpContext(place.canvas);
      signal.throwIfAborted();
      // Without its pages there is no book; without a graphics card there is a plainer one.
      if (error instanceof BookError) throw error;
      if (isLost && !hasLostContext) {
        // Nothing watches the context until three.js draws on it. Lost while the book was read or
        // its code was loaded, it makes three.js throw; a new context is created, once.
        hasLostContext = true;
        place = contextFor(freshCanvas, showing);
      } else {
        console.warn(
          "turnleaf-book: the book is shown on the flat, as it cannot be drawn in 3D:",
          error,
        );
        place = { canvas: freshCanvas(), context: null };
      }
    }
  }
  return await open(place.canvas, false);

  async function open(canvas: HTMLCanvasElement, isWebGL: boolean): Promise<Viewer> {
    const backend = await loadBackend(isWebGL, showing);
    signal.throwIfAborted();
    return await Viewer.open(canvas, source, options, backend, signal);
  }
}

/** Returns a canvas and its WebGL context; null for the context where the book is to be flat. */
function contextFor(
  freshCanvas: () => HTMLCanvasElement,
  { isFlat = false }: Showing,
): { canvas: HTMLCanvasElement; context: WebGL2RenderingContext | null } {
  const canvas = freshCanvas();
  const mayRun = mayRunCode();
  if (!mayRun) warnOnce();
  const context = isFlat || !mayRun ? null : openContext(canvas);
  if (context === null || isUsable(context)) return { canvas, context };
  giveUpContext(canvas);
  const other = freshCanvas();
  return { canvas: other, context: openContext(other) };
}

/** Loads what draws a book in 3D, its parts at the same time, or on the flat. */
async function loadBackend(isWebGL: boolean, { engineSrc = "" }: Showing): Promise<Backend> {
  if (!isWebGL) return (await import("./canvas2d_backend.ts")).canvas2dBackend;
  const [code, { webglBackend }] = [loadEngine(engineSrc), await loadWebGL()];
  return webglBackend(code);
}

/** Rejects with a `BookError` if the file at an address cannot be loaded. */
function loadEngine(engineSrc: string): Promise<WebAssembly.Module> {
  const code = engineCode(engineSrc).catch((error: unknown) => {
    if (engineSrc === "") throw error;
    throw new BookError(
      `The book cannot be shown, as the engine cannot be loaded; engine-src names ${engineSrc}: correct it, or allow it in connect-src of this page's Content-Security-Policy.`,
      { code: "partMissing" },
    );
  });
  // It is awaited later.
  code.catch(() => {});
  return code;
}

export { giveUpContext };

let hasWarned = false;

/**
 * Warns on the console, once per page, why books are shown on a 2D canvas:
 * nothing on the page says it.
 */
function warnOnce(): void {
  if (hasWarned || !globalThis.WebAssembly) return;
  hasWarned = true;
  console.warn(
    "turnleaf-book: books are shown on the flat, as this page's Content-Security-Policy lacks 'wasm-unsafe-eval' in script-src.",
  );
}
