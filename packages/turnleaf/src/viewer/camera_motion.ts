/** Moves the camera, zoom and pan, and reports the views at which it comes to rest. */

import type { BookStage, Place } from "../stage/book_stage.ts";
import { wholeBook, type Zoom, zoomBetween } from "../stage/zoom.ts";

/** Maximum zoom level. */
const mostZoom = 8;

/** The camera over one book. */
export class CameraMotion {
  readonly #stage: BookStage;
  /** The view at level 1: of the whole book, and of what lies beside it. */
  #whole: Zoom = wholeBook;
  #glide: { from: Zoom; to: Zoom; passed: number; seconds: number } | null = null;

  constructor(stage: BookStage) {
    this.#stage = stage;
  }

  /** The current zoom level, or the one the camera is moving to. */
  get level(): number {
    return Math.max(this.#target.level, 1);
  }

  /**
   * The current view, or the one the camera is moving to. Setting it shows the
   * view at once, clamped to the book.
   */
  get view(): Zoom {
    return this.level > 1 ? this.#target : wholeBook;
  }

  set view(view: Zoom) {
    this.#glide = null;
    this.#stage.zoom = view.level > 1 ? view : this.#home;
  }

  /**
   * Shows the book at a level (1 to 8) so that the point seen at `from` comes
   * to `to`, clamped to the book.
   *
   * @param seconds duration; 0 for at once
   */
  zoom(level: number, from: Place, to: Place, seconds: number): void {
    const shown = this.#stage.zoom;
    // A request during a motion starts from the end of that motion.
    if (this.#glide) this.#stage.zoom = this.#glide.to;
    const zoom = level > 1 ? this.#stage.zoomed(Math.min(level, mostZoom), from, to) : this.#home;
    this.#stage.zoom = shown;
    this.#go(zoom, seconds);
  }

  /**
   * Sets what is shown at level 1, from now on: the whole book, or from farther away what lies beside it
   * too. A camera that shows another part of the book stays.
   *
   * @param seconds duration; 0 for at once
   */
  showWhole(whole: Zoom, seconds: number): void {
    const { level, x, y } = this.#whole;
    if (level === whole.level && x === whole.x && y === whole.y) return;
    this.#whole = whole;
    if (this.level === 1) this.#go(this.#home, seconds);
  }

  #go(to: Zoom, seconds: number): void {
    const from = this.#stage.zoom;
    this.#glide = seconds > 0 ? { from, to, passed: 0, seconds } : null;
    if (seconds === 0) this.#stage.zoom = to;
  }

  /** What is shown at level 1, by its own middle. */
  get #home(): Zoom {
    const corner = { x: 0, y: 0 };
    return this.#whole.level < 1 ? this.#whole : this.#stage.zoomed(1, corner, corner);
  }

  get #target(): Zoom {
    return this.#glide?.to ?? this.#stage.zoom;
  }

  /** Calls `look` with the camera as it is when it shows the whole book and nothing else. */
  lookAtRest<T>(look: () => T): T {
    const { zoom } = this.#stage;
    this.#stage.zoom = wholeBook;
    const seen = look();
    this.#stage.zoom = zoom;
    return seen;
  }

  /** Advances the camera. Returns whether it still moves. */
  step(seconds: number): boolean {
    const glide = this.#glide;
    if (glide === null) return false;
    glide.passed += seconds;
    const t = Math.min(glide.passed / glide.seconds, 1);
    this.#stage.zoom = zoomBetween(glide.from, glide.to, 1 - (1 - t) ** 3);
    if (t === 1) this.#glide = null;
    return t < 1;
  }
}

/** Listeners to the view of one book. */
export class ViewHistory {
  readonly #listeners = new Set<(rests: boolean) => void>();
  /** The view that was last reported. */
  #last = "";

  /** Adds a listener, called with whether the book rests. Returns a function that removes it. */
  add(listener: (rests: boolean) => void): () => void {
    this.#listeners.add(listener);
    return () => this.#listeners.delete(listener);
  }

  /** Reports a view, once for each; "" stands for none, while the book moves. */
  update(view: string): void {
    if (view === this.#last) return;
    this.#last = view;
    for (const listener of this.#listeners) listener(view !== "");
  }

  /** Reports the next view, whatever it is. */
  forget(): void {
    this.#last = "";
  }
}
