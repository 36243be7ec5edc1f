/** A book that is heard and felt, where the element asks for it: attributes `sound` and `vibrate`. */

import type { Stock, StockFigures } from "../engine/shapes.ts";
import type { Sound } from "../sound/sound.ts";
import { loaded } from "../sources/loaded.ts";
import type { ViewerOptions } from "../viewer/viewer.ts";

/** How long a phone stirs when a leaf is taken and when it lies, milliseconds. */
const taken = 8;
const laid = 14;

/** The sound and the stirring of the book in an element. */
export class SoundAndHaptics {
  readonly #element: HTMLElement;
  readonly #stock: () => Stock | StockFigures;
  readonly #failed: (error: unknown) => void;
  #sound: Sound | null = null;
  #asked = false;

  /**
   * @param stock what the leaves are made of now
   * @param failed told that what makes sound cannot be loaded
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

  /** A frame of the book. What makes sound is loaded with the first that moves. */
  readonly follow: NonNullable<ViewerOptions["onMotion"]> = (pose, seconds, moving) => {
    if (!this.#element.hasAttribute("sound")) return;
    this.#sound?.follow(pose, seconds, moving, this.#stock());
    if (this.#asked || !moving) return;
    this.#asked = true;
    loaded(import("../sound/sound.ts")).then(({ Sound }) => {
      if (this.#asked) this.#sound = new Sound();
    }, this.#failed);
  };

  /** A leaf was taken up. */
  take(): void {
    this.#stir(taken);
  }

  /** The book lies still. */
  lie(): void {
    this.#stir(laid);
  }

  /** Silence: the book is closed, or is not to be heard any more. */
  close(): void {
    this.#asked = false;
    this.#sound?.close();
    this.#sound = null;
  }

  #stir(milliseconds: number): void {
    if (!this.#element.hasAttribute("vibrate") || !navigator.userActivation?.hasBeenActive) return;
    navigator.vibrate?.(milliseconds);
  }
}
