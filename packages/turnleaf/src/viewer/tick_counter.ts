/** Converts the screen's frames to the engine's ticks. */

/** Maximum time of one frame, in seconds; after a pause the turn goes on where it was. */
const longestFrame = 0.1;

/** Counts the whole ticks from frame to frame while something moves. */
export class TickCounter {
  readonly #tick: number;
  #lastTime: number | null = null;
  #remainder = 0;

  /** @param tick length of a tick in seconds */
  constructor(tick: number) {
    this.#tick = tick;
  }

  /**
   * Returns the whole ticks since the last frame, 0 or more: none in the first
   * frame of a movement, nor for a frame whose time is not a number or not
   * later than the last one's.
   *
   * @param now time of the animation frame in milliseconds
   */
  count(now: number): number {
    if (!Number.isFinite(now)) return 0;
    const since = this.#lastTime === null ? 0 : (now - this.#lastTime) / 1000;
    const seconds = Math.min(Math.max(since, 0), longestFrame);
    this.#lastTime = now;
    this.#remainder += seconds / this.#tick;
    const ticks = Math.floor(this.#remainder);
    this.#remainder -= ticks;
    return ticks;
  }

  /** Ends the movement: the next frame is the first of another. */
  stop(): void {
    this.#lastTime = null;
    this.#remainder = 0;
  }
}
