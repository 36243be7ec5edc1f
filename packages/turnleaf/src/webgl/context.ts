/**
 * A canvas's WebGL 2 context: creation, release, loss and restoration. Free of
 * three.js, which is loaded after it.
 */

import { drawsInSoftware } from "./software_gl.ts";

/** Timeout for the restoration of a lost context while the page is visible, milliseconds. */
const patience = 4000;

/** Whether contexts draw several samples of a pixel: until one is known to draw in software. */
let antialias = true;

/** Returns the context, or null if there is none. */
export function openContext(canvas: HTMLCanvasElement): WebGL2RenderingContext | null {
  return canvas.getContext("webgl2", {
    alpha: true,
    antialias,
    depth: true,
    stencil: false,
    premultipliedAlpha: true,
  });
}

/**
 * Returns whether a canvas's context can be drawn on: not where it is lost, nor where it would draw
 * several samples of each pixel in software, which takes a large part of a frame's time. Contexts that are
 * opened later are such that can. At rest a book is drawn with more pixels than the screen has, so
 * that its edges are smooth either way.
 */
export function isUsable(context: WebGL2RenderingContext): boolean {
  if (context.isContextLost()) return false;
  if (!drawsInSoftware(context)) return true;
  antialias = false;
  return context.getContextAttributes()?.antialias !== true;
}

/** Frees all memory of a canvas on the graphics card now, rather than when it is collected. */
export function giveUpContext(canvas: HTMLCanvasElement): void {
  openContext(canvas)?.getExtension("WEBGL_lose_context")?.loseContext();
}

/** Events of a context. */
export interface ContextEvents {
  /** It was lost, with everything on the graphics card. */
  lost(): void;
  /** It was restored: everything is to be drawn again. */
  restored(): void;
  /** It was not restored in time. */
  lostForGood(): void;
}

/** Waits for the restoration of a lost context. */
export class ContextWatch {
  readonly #events: ContextEvents;
  readonly #ended = new AbortController();
  #timer: ReturnType<typeof setTimeout> | undefined;
  #isLost = false;

  constructor(canvas: HTMLCanvasElement, events: ContextEvents) {
    this.#events = events;
    const { signal } = this.#ended;
    canvas.addEventListener("webglcontextlost", (event) => this.#lost(event), { signal });
    canvas.addEventListener("webglcontextrestored", () => this.#restored(), { signal });
  }

  /** Whether there is no context now, so that nothing drawn is visible. */
  get isLost(): boolean {
    return this.#isLost;
  }

  /** Ends the watch. */
  destroy(): void {
    this.#ended.abort();
    clearTimeout(this.#timer);
  }

  #lost(event: Event): void {
    // Otherwise it would never be restored.
    event.preventDefault();
    this.#isLost = true;
    this.#events.lost();
    this.#wait();
  }

  #restored(): void {
    this.#isLost = false;
    clearTimeout(this.#timer);
    this.#events.restored();
  }

  #wait(): void {
    clearTimeout(this.#timer);
    // A hidden page may be without its context for as long as it is hidden.
    if (document.hidden) {
      const { signal } = this.#ended;
      const seen = (): void => {
        if (this.#isLost) this.#wait();
      };
      document.addEventListener("visibilitychange", seen, { once: true, signal });
    } else this.#timer = setTimeout(() => this.#late(), patience);
  }

  #late(): void {
    if (document.hidden) this.#wait();
    else this.#events.lostForGood();
  }
}
