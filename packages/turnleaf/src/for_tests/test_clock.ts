/**
 * The viewer's clock under a test's control: frames come when the test asks for them,
 * a sixtieth of a second after each other, however busy the machine is.
 */

import { vi } from "vitest";

/** Time between two frames, milliseconds. */
const frameTime = 1000 / 60;

/**
 * Most frames that `until` draws: a minute of the book's time. Longer than any
 * motion of a test.
 */
const mostFrames = 3600;

/**
 * Takes the window's animation frames over, and the times of its events, which
 * are those of this clock from then on. `vi.restoreAllMocks` gives them back.
 */
export class TestClock {
  /** The current time, milliseconds. */
  now: number = performance.now();
  readonly #requests = new Map<number, FrameRequestCallback>();
  #count = 0;

  constructor() {
    vi.spyOn(window, "requestAnimationFrame").mockImplementation((call) => {
      this.#requests.set(++this.#count, call);
      return this.#count;
    });
    vi.spyOn(window, "cancelAnimationFrame").mockImplementation((request) => {
      this.#requests.delete(request);
    });
    vi.spyOn(Event.prototype, "timeStamp", "get").mockImplementation(() => this.now);
  }

  /** Whether a frame has been requested. */
  get isAsked(): boolean {
    return this.#requests.size > 0;
  }

  /** Draws some frames at once, and calls `look` after each of them. */
  frames(count: number, look: () => void = () => undefined): void {
    for (let k = 0; k < count; k++) {
      this.now += frameTime;
      const requests = [...this.#requests.values()];
      this.#requests.clear();
      for (const call of requests) call(this.now);
      look();
    }
  }

  /**
   * Draws frames until a condition holds, with a task of the browser between
   * them: pictures and promises arrive as they would. While no frame is asked
   * for, no time passes.
   */
  async until(condition: () => boolean): Promise<void> {
    for (let drawn = 0; !condition(); ) {
      if (drawn > mostFrames) throw new Error(`Not within ${mostFrames} frames: ${condition}`);
      if (this.isAsked) {
        this.frames(1);
        drawn++;
      }
      await new Promise((resolve) => setTimeout(resolve));
    }
  }
}
