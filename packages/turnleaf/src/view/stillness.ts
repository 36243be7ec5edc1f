/** Whether what is held has come to rest in the hand. */

import type { Surface } from "../engine/shapes.ts";

/** Motion in a frame that nobody sees, metres: a hundredth of a pixel. */
const unseen = 5e-6;

/** Frames in a row without more than that. */
const frames = 8;

/** Looks at leaves from frame to frame. */
export class Stillness {
  #before: Float32Array[] = [];
  #count = 0;

  /** Whether leaves have not moved for some frames, this one included. */
  check(leaves: readonly Surface[]): boolean {
    const moved =
      leaves.length !== this.#before.length ||
      leaves.some(({ positions }, k) => hasMoved(positions, this.#before[k]));
    if (moved) this.#before = leaves.map(({ positions }) => positions.slice());
    this.#count = moved ? 0 : this.#count + 1;
    return this.#count >= frames;
  }

  /** Begins anew: something changed. */
  stir(): void {
    this.#count = 0;
  }
}

function hasMoved(now: Float32Array, before: Float32Array): boolean {
  if (now.length !== before.length) return true;
  for (let k = 0; k < now.length; k++) if (Math.abs(now[k] - before[k]) > unseen) return true;
  return false;
}
