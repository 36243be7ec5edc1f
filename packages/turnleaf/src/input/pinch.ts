/** A pinch: two fingers that zoom and move what lies under them. */

import type { Place } from "../stage/book_stage.ts";
import type { Viewer } from "../viewer/viewer.ts";

type Finger = [id: number, at: Place];

/** One pinch, from its second finger down to the first up. */
export class Pinch {
  readonly #viewer: Viewer;
  readonly #fingers: Map<number, Place>;
  /** Zoom per pixel between the fingers. */
  readonly #rate: number;

  constructor(viewer: Viewer, first: Finger, second: Finger) {
    this.#viewer = viewer;
    this.#fingers = new Map([first, second]);
    this.#rate = viewer.zoomLevel / Math.max(this.#apart, 1);
  }

  /** Moves a pointer. Returns whether it is one of the two. */
  move(id: number, at: Place): boolean {
    if (!this.#fingers.has(id)) return false;
    const before = this.#middle;
    this.#fingers.set(id, at);
    this.#viewer.zoom(this.#rate * this.#apart, before, this.#middle, 0);
    return true;
  }

  /** Releases a pointer. Returns the remaining finger, or null if it was none of the two. */
  pointerUp(id: number): Finger | null {
    if (!this.#fingers.delete(id)) return null;
    return [...this.#fingers][0];
  }

  get #apart(): number {
    const [a, b] = this.#fingers.values();
    return Math.hypot(a.x - b.x, a.y - b.y);
  }

  get #middle(): Place {
    const [a, b] = this.#fingers.values();
    return { x: (a.x + b.x) / 2, y: (a.y + b.y) / 2 };
  }
}
