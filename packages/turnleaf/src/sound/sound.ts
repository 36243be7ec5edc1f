/**
 * The sound of a book. Its audio context is created at the first motion after
 * the reader's first gesture, as browsers require, and is suspended while the
 * book is at rest: then no audio thread runs.
 */

import type { Stock, StockFigures } from "../engine/shapes.ts";
import type { BookPose } from "../stage/book_pose.ts";
import { MotionMeter } from "./motion.ts";
import { PaperSound } from "./paper_sound.ts";

/** The sound of one book; `close` ends it. */
export class Sound {
  readonly #meter = new MotionMeter();
  #context: AudioContext | null = null;
  #paperSound: PaperSound | null = null;
  #closed = false;
  /** Work done in tearing since the previous frame, J. */
  #work = 0;

  /** Call it when work was done in tearing a leaf, J. */
  tear(work: number): void {
    this.#work += work;
  }

  /**
   * Handles a frame of a book.
   *
   * @param seconds since the previous frame
   * @param moving whether another is to come
   */
  follow(pose: BookPose, seconds: number, moving: boolean, stock: Stock | StockFigures): void {
    // Screens faster than the engine draw a frame twice.
    if (this.#closed || (moving && seconds === 0)) return;
    const motion = this.#meter.measure(pose, seconds, this.#work);
    this.#work = 0;
    if (!moving) {
      this.#paperSound?.rest(this.#context?.currentTime ?? 0, () => {
        this.#context?.suspend().catch(() => {});
      });
      return;
    }
    if (this.#context === null) {
      if (navigator.userActivation?.hasBeenActive === false) return;
      this.#context = new AudioContext({ latencyHint: "interactive" });
      this.#paperSound = new PaperSound(this.#context);
    }
    if (this.#context.state === "suspended") void this.#context.resume().catch(() => {});
    if (this.#paperSound) {
      this.#paperSound.stock = stock;
      this.#paperSound.move(motion, this.#context.currentTime);
    }
  }

  /** Stops the sound for good. */
  close(): void {
    this.#closed = true;
    this.#context?.close().catch(() => {});
    this.#context = this.#paperSound = null;
  }
}
