/** The speed of a pointer at its release. */

import type { Place } from "../stage/book_stage.ts";

/** Time before the release that counts, milliseconds. */
const recent = 90;

/** The last positions of one pointer. */
export class Flick {
  #places: (Place & { readonly time: number })[] = [];

  /** Records a position, CSS pixels, and its time, milliseconds. */
  move({ x, y }: Place, time: number): void {
    this.#places = this.#places.filter((place) => time - place.time <= recent);
    this.#places.push({ x, y, time });
  }

  /**
   * Returns the velocity at a time, CSS pixels per millisecond: zero if the
   * pointer had stopped before.
   */
  velocity(time: number): Place {
    const places = this.#places.filter((place) => time - place.time <= recent);
    const [first, last] = [places[0], places.at(-1)];
    if (first === undefined || last === undefined) return { x: 0, y: 0 };
    const passed = Math.max(time - first.time, 1);
    return { x: (last.x - first.x) / passed, y: (last.y - first.y) / passed };
  }
}
