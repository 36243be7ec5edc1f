/** From the screen's frames to the engine's ticks. */

/** Longest time a frame may stand for, seconds; after a pause the turn goes on where it was. */
const longestFrame = 0.1;

/** Counts the whole ticks that pass from frame to frame while something moves. */
export class Ticks {
  readonly #tick: number;
  #lastTime = 0;
  #remainder = 0;

  /** @param tick length of a tick in seconds */
  constructor(tick: number) {
    this.#tick = tick;
  }

  /** Whole ticks since the last frame; none in the first of a movement. */
  pass(now: number): number {
    const seconds =
      this.#lastTime === 0 ? 0 : Math.min((now - this.#lastTime) / 1000, longestFrame);
    this.#lastTime = now;
    this.#remainder += seconds / this.#tick;
    const ticks = Math.floor(this.#remainder);
    this.#remainder -= ticks;
    return ticks;
  }

  /** The movement is over: the next frame is the first of another, which owes nothing to this one. */
  stop(): void {
    this.#lastTime = this.#remainder = 0;
  }
}
