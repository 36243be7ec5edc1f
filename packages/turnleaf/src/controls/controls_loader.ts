/** The reader's controls, loaded when they are first shown. */

import { loadPart } from "../sources/load_part.ts";
import { languageOf, loadLanguage } from "../words/languages.ts";
import type { ControlledBook, FoundPlace } from "./book.ts";

/** Shows and hides the controls of one element. */
export class ControlsLoader {
  #wanted = false;
  #remove: (() => void) | null = null;
  readonly #failed: (error: unknown) => void;

  /** @param failed called if they cannot be loaded; the next request loads them again */
  constructor(failed: (error: unknown) => void) {
    this.#failed = failed;
  }

  /**
   * Shows the controls around a stage, or removes them.
   *
   * @param frame holds the stage
   */
  set<Hit extends FoundPlace>(
    shown: boolean,
    book: ControlledBook<Hit>,
    frame: HTMLElement,
    stage: HTMLElement,
  ): void {
    if (this.#wanted === shown) return;
    this.#wanted = shown;
    if (shown) this.#load(book, frame, stage).catch(this.#failed);
    else {
      this.#remove?.();
      this.#remove = null;
    }
  }

  /** Asks the reader for the password of a protected file; null if they give none. */
  async askPassword(
    book: HTMLElement,
    isWrong: boolean,
    signal: AbortSignal,
  ): Promise<string | null> {
    const [{ askPassword }] = await Promise.all([
      loadPart(import("./controls.ts")),
      loadLanguage(languageOf(book)),
    ]);
    return await askPassword(book, isWrong, signal);
  }

  async #load<Hit extends FoundPlace>(
    book: ControlledBook<Hit>,
    frame: HTMLElement,
    stage: HTMLElement,
  ): Promise<void> {
    const [{ addControls }] = await Promise.all([
      loadPart(import("./controls.ts")),
      loadLanguage(languageOf(book)),
    ]);
    if (this.#wanted && this.#remove === null) this.#remove = addControls(book, frame, stage);
  }
}
