/** Whether what is held has come to rest in the hand. */

import type { Surface } from "../engine/shapes.ts";

/** Motion in a frame that nobody sees, metres: a sixtieth of a pixel. */
const unseen = 5e-6;

/**
 * In so many frames without a stir that motion doubles: the thinnest paper
 * trembles in a hand for as long as one looks, and no battery pays for that.
 */
const doubling = 30;

/** Frames in a row without more than that. */
const frames = 8;

/** Looks at leaves from frame to frame. */
export class Stillness {
  #before: Float32Array[] = [];
  #count = 0;
  /** Frames since the last stir. */
  #passed = 0;

  /** Whether leaves have not moved for some frames, this one included. */
  check(leaves: readonly Pick<Surface, "positions">[]): boolean {
    const least = unseen * 2 ** (this.#passed++ / doubling);
    const moved =
      leaves.length !== this.#before.length ||
      leaves.some(({ positions }, k) => hasMoved(positions, this.#before[k], least));
    if (moved) this.#before = leaves.map(({ positions }) => positions.slice());
    this.#count = moved ? 0 : this.#count + 1;
    return this.#count >= frames;
  }

  /** Begins anew: something changed. */
  stir(): void {
    this.#count = this.#passed = 0;
  }
}

function hasMoved(now: Float32Array, before: Float32Array, least: number): boolean {
  if (now.length !== before.length) return true;
  for (let k = 0; k < now.length; k++) if (Math.abs(now[k] - before[k]) > least) return true;
  return false;
}
