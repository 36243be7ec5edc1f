/** Advances the leaves' time while something moves, and requests no frame at rest. */

/** Maximum time of one frame, seconds, after a longer pause. */
const longestFrame = 0.25;

/** Weight of the previous pace in its moving average. */
const memory = 0.9;

/** Drives frames. */
export class Clock {
  readonly #frame: (seconds: number) => { passed: number; isStill: boolean };
  #asked = 0;
  #last: number | null = null;
  #real = 0;
  #passed = 0;

  /**
   * @param frame advances by seconds of real time; returns how many passed for
   * the leaves, and whether they are at rest
   */
  constructor(frame: (seconds: number) => { passed: number; isStill: boolean }) {
    this.#frame = frame;
  }

  /** Requests frames until the leaves are at rest. */
  start(): void {
    if (this.#asked === 0) this.#asked = requestAnimationFrame((now) => this.#go(now));
  }

  /** Stops requesting frames. */
  stop(): void {
    cancelAnimationFrame(this.#asked);
    this.#rest();
  }

  /** How many times slower than real time the leaves' time passes; NaN before any passed. */
  get slowness(): number {
    return this.#real / this.#passed;
  }

  #go(now: number): void {
    this.#asked = requestAnimationFrame((next) => this.#go(next));
    const real = this.#last === null ? 1 / 60 : Math.max(0, (now - this.#last) / 1000);
    this.#last = now;
    const { passed, isStill } = this.#frame(Math.min(real, longestFrame));
    this.#real = memory * this.#real + real;
    this.#passed = memory * this.#passed + passed;
    if (isStill) this.stop();
  }

  #rest(): void {
    this.#asked = 0;
    this.#last = null;
    this.#real = 0;
    this.#passed = 0;
  }
}
