/** A canvas's WebGL 2 context: asked for, given up, lost and come back. Free of three.js, which is loaded after it. */

/** How long a lost context is waited for while the page is in sight, milliseconds. */
const patience = 4000;

/** The context; null where there is none to be had. */
export function openContext(canvas: HTMLCanvasElement): WebGL2RenderingContext | null {
  return canvas.getContext("webgl2", {
    alpha: true,
    antialias: true,
    depth: true,
    stencil: false,
    premultipliedAlpha: true,
  });
}

/** Frees all that a canvas has on the graphics card, now rather than when it is collected. */
export function giveUpContext(canvas: HTMLCanvasElement): void {
  openContext(canvas)?.getExtension("WEBGL_lose_context")?.loseContext();
}

/** What is told of a context. */
export interface ContextEvents {
  /** It is lost, with everything that was on the card. */
  lost(): void;
  /** It is back: everything is to be drawn again. */
  restored(): void;
  /** It did not come back in time. */
  gone(): void;
}

/** Waits for a context when it is lost. */
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

  /** Whether there is no context now: nothing that is drawn is seen. */
  get isLost(): boolean {
    return this.#isLost;
  }

  /** Ends the watch. */
  destroy(): void {
    this.#ended.abort();
    clearTimeout(this.#timer);
  }

  #lost(event: Event): void {
    // Or it would never come back.
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
    // A page out of sight may be without its card for as long as that lasts.
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
    else this.#events.gone();
  }
}
