/** On a small screen a tap on the middle of a page hides the bars, and shows them again. */

import { pageTap } from "../element/page_tap.ts";

/**
 * Follows the taps until the signal aborts.
 *
 * @param frame gets the class `bare` while the bars are hidden
 * @param isNarrow returns whether the bars take the place of the book
 */
export function watchTaps(
  frame: HTMLElement,
  stage: HTMLElement,
  isNarrow: () => boolean,
  signal: AbortSignal,
): void {
  const show = (): void => frame.classList.remove("bare");
  stage.addEventListener(
    pageTap,
    () => {
      if (isNarrow()) frame.classList.toggle("bare");
      else show();
    },
    { signal },
  );
  // Readers who use the keyboard need them.
  frame.addEventListener("keydown", show, { signal });
  signal.addEventListener("abort", show);
}
