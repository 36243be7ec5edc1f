/** A corner that a pointer draws in over its page and holds still there is to be folded. */

import type { Corner, DogEar } from "../book/dog_ears.ts";
import { dogEarSizes, foldedRest } from "../book/dog_ears.ts";
import { Side } from "../engine/phases.ts";
import type { Ray, Vec3 } from "../engine/shapes.ts";
import { onPlane } from "../picking/reach.ts";
import type { BookShape } from "../stage/book_pose.ts";
import type { Place } from "../stage/book_stage.ts";

/** Time for which the pointer rests before the corner is pressed, seconds. */
const restSeconds = 0.6;

/** Time of a frame that counts at most, seconds: in a longer one the pointer's events wait too. */
const longestFrame = restSeconds / 6;

/** How far a resting pointer may move, CSS pixels: fingers tremble. */
const tremble = 3;

/** How far from the corner a leaf is held at most, along each edge, as a fraction of its width. */
const cornerZone = 0.25;

/**
 * Ratio of the two ways, along both edges, that the pointer has gone from the corner: at most
 * this, or its inverse. Beyond, it pulls the leaf across or along the spine.
 */
const mostSlanted = 3;

/** A corner of a leaf that one pointer holds. */
export class CornerPress {
  readonly #shape: Pick<BookShape, "width" | "height">;
  readonly #sign: 1 | -1;
  readonly #corner: Corner;
  /** How far from the corner it is held: across and along the spine, metres. */
  readonly #held: readonly [across: number, along: number];
  /** Where the pointer began to rest, and for how long it has, seconds. */
  #restsAt: Place = { x: Number.NaN, y: Number.NaN };
  #rested = 0;
  #hasMoved = true;

  private constructor(
    shape: Pick<BookShape, "width" | "height">,
    side: Side,
    corner: Corner,
    held: readonly [number, number],
  ) {
    this.#shape = shape;
    this.#sign = side === Side.right ? 1 : -1;
    this.#corner = corner;
    this.#held = held;
  }

  /** Returns the corner at which a leaf that lay on a side is held, or null if it is held elsewhere. */
  static at(
    shape: Pick<BookShape, "width" | "height">,
    side: Side,
    u: number,
    v: number,
  ): CornerPress | null {
    const { width, height } = shape;
    const corner = v > 0.5 ? "head" : "foot";
    const held = [(1 - u) * width, (corner === "head" ? 1 - v : v) * height] as const;
    const isNear = held.every((away) => away <= cornerZone * width);
    return isNear ? new CornerPress(shape, side, corner, held) : null;
  }

  /** Call it when the pointer is somewhere, CSS pixels: the time that it rests begins anew if it has moved. */
  move({ x, y }: Place): void {
    if (Math.hypot(x - this.#restsAt.x, y - this.#restsAt.y) <= tremble) return;
    this.#restsAt = { x, y };
    this.#hasMoved = true;
  }

  /**
   * Counts the time that the pointer rests over the page.
   *
   * @param ray line of sight through the pointer
   * @param floor height of the page, metres
   * @returns the corner that is to be pressed now; null if it is to be waited for, undefined if
   * the pointer is not where a corner is folded
   */
  step(seconds: number, ray: Ray, floor: number): Omit<DogEar, "page"> | null | undefined {
    const [x, y] = onPlane(ray, floor);
    const { width, height } = this.#shape;
    const across = width - this.#sign * x;
    const along = this.#corner === "head" ? height - y : y;
    const [p, q] = this.#held;
    const slant = (across - p) / (along - q);
    const isInward = across > p && along > q && slant <= mostSlanted && slant >= 1 / mostSlanted;
    // A fold at 45 degrees that meets the edges so far from the corner takes what lies p and q
    // from it to size - q and size - p.
    const size = (across + along + p + q) / 2 / width;
    const [least, most] = dogEarSizes;
    const isThere = isInward && size >= least && size <= most;
    // The time before a frame in which it has moved is not known to be rest.
    this.#rested = isThere && !this.#hasMoved ? this.#rested + Math.min(seconds, longestFrame) : 0;
    this.#hasMoved = false;
    if (!isThere) return undefined;
    return this.#rested >= restSeconds ? { corner: this.#corner, size } : null;
  }

  /** Returns where what is held lies when the corner is folded at a size, over a page at a height, metres. */
  folded(size: number, floor: number): Vec3 {
    const { width, height } = this.#shape;
    const d = size * width;
    const [p, q] = this.#held;
    const along = d - p;
    const y = this.#corner === "head" ? height - along : along;
    // It stands off the page by the angle that the fold stays open.
    const up = (Math.abs(d - p - q) / Math.SQRT2) * Math.sin(foldedRest);
    return [this.#sign * (width - (d - q)), y, floor + up];
  }
}
