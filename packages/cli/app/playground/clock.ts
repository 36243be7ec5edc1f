/** Lets the leaves' time pass while something moves, and asks for no frame while nothing does. */

/** A frame after a longer pause lets no more time pass than this, seconds. */
const longestFrame = 0.25;

/** What part of what is known of the pace is kept from one frame to the next. */
const memory = 0.9;

/** Drives frames. */
export class Clock {
  readonly #frame: (seconds: number) => { passed: number; isStill: boolean };
  #asked = 0;
  #last: number | null = null;
  #real = 0;
  #passed = 0;

  /** @param frame lets seconds of real time pass; answers how many passed for the leaves, and whether they lie still */
  constructor(frame: (seconds: number) => { passed: number; isStill: boolean }) {
    this.#frame = frame;
  }

  /** Asks for frames until the leaves lie still. */
  start(): void {
    if (this.#asked === 0) this.#asked = requestAnimationFrame((now) => this.#go(now));
  }

  /** Asks for no more. */
  stop(): void {
    cancelAnimationFrame(this.#asked);
    this.#rest();
  }

  /** How many times slower than the real time the leaves' time passes; NaN before any passed. */
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
