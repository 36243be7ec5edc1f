/** The sound and the vibration of a book, by the attributes `sound` and `vibrate`. */

import type { Stock, StockFigures } from "../engine/shapes.ts";
import type { Sound } from "../sound/sound.ts";
import { loadPart } from "../sources/load_part.ts";
import type { ViewerOptions } from "../viewer/viewer.ts";

/** Duration of the vibration when a leaf is grabbed and when it lands, milliseconds. */
const taken = 8;
const laid = 14;

/** The sound and the vibration of the book in an element. */
export class SoundAndHaptics {
  readonly #element: HTMLElement;
  readonly #stock: () => Stock | StockFigures;
  readonly #failed: (error: unknown) => void;
  #sound: Sound | null = null;
  #asked = false;

  /**
   * @param stock returns the paper of the leaves
   *
   * @param failed called if the code that makes sound cannot be loaded
   */
  constructor(
    element: HTMLElement,
    stock: () => Stock | StockFigures,
    failed: (error: unknown) => void,
  ) {
    this.#element = element;
    this.#stock = stock;
    this.#failed = failed;
  }

  /**
   * Handles a frame of the book. The code that makes sound is loaded with the
   * first moving frame.
   */
  readonly follow: NonNullable<ViewerOptions["onMotion"]> = (pose, seconds, moving) => {
    if (!this.#element.hasAttribute("sound")) return;
    this.#sound?.follow(pose, seconds, moving, this.#stock());
    if (this.#asked || !moving) return;
    this.#asked = true;
    loadPart(import("../sound/sound.ts")).then(({ Sound }) => {
      if (this.#asked) this.#sound = new Sound();
    }, this.#failed);
  };

  /** Call it when a leaf was picked up. */
  take(): void {
    this.#vibrate(taken);
  }

  /** Call it when work was done in tearing a leaf, J. */
  tear(work: number): void {
    if (this.#element.hasAttribute("sound")) this.#sound?.tear(work);
    this.#vibrate(taken);
  }

  /** Call it when the book is at rest. */
  lie(): void {
    this.#vibrate(laid);
  }

  /** Stops the sound: the book is closed, or the attribute was removed. */
  close(): void {
    this.#asked = false;
    this.#sound?.close();
    this.#sound = null;
  }

  #vibrate(milliseconds: number): void {
    if (!this.#element.hasAttribute("vibrate") || !navigator.userActivation?.hasBeenActive) return;
    navigator.vibrate?.(milliseconds);
  }
}
