/** Detects whether a held leaf has come to rest. */

import type { Surface } from "../engine/shapes.ts";

/** Imperceptible motion in a frame, metres: a sixtieth of a pixel. */
const unseen = 5e-6;

/**
 * Frames without visible motion after which that threshold doubles: the
 * thinnest paper trembles for as long as it is held, and drawing that would
 * drain a battery.
 */
const doubling = 30;

/** Consecutive frames below the threshold that count as rest. */
const frames = 8;

/** Compares leaves from frame to frame. */
export class Stillness {
  #before: Float32Array[] = [];
  #count = 0;
  /** Frames since the last visible motion. */
  #passed = 0;

  /** Returns whether leaves have not moved for some frames, this one included. */
  check(leaves: readonly Pick<Surface, "positions">[]): boolean {
    const least = unseen * 2 ** (this.#passed++ / doubling);
    const moved =
      leaves.length !== this.#before.length ||
      leaves.some(({ positions }, k) => hasMoved(positions, this.#before[k], least));
    if (moved) this.#before = leaves.map(({ positions }) => positions.slice());
    this.#count = moved ? 0 : this.#count + 1;
    return this.#count >= frames;
  }

  /** Starts over: something changed. */
  reset(): void {
    this.#count = this.#passed = 0;
  }
}

function hasMoved(now: Float32Array, before: Float32Array, least: number): boolean {
  if (now.length !== before.length) return true;
  for (let k = 0; k < now.length; k++) if (Math.abs(now[k] - before[k]) > least) return true;
  return false;
}
