/** A finger's tap on the middle of a page hides the bars, and shows them again. */

import { pageTap } from "../element/page_tap.ts";
import type { ControlledBook } from "./book.ts";
import { sight } from "./full_screen.ts";

/**
 * Follows the taps until the signal aborts. Bars that lie over the book also hide a while after it has
 * opened, and as a page is turned by hand.
 *
 * @param frame gets the class `bare` while the bars are hidden
 * @returns a function that lets bars over the book be seen for a while, and then hides them
 */
export function watchTaps(
  book: HTMLElement & Pick<ControlledBook, "pageCount">,
  frame: HTMLElement,
  stage: HTMLElement,
  signal: AbortSignal,
): () => void {
  /** Whether the last press was on the book. */
  let isByHand = false;
  let timer = 0;
  const show = (): void => {
    clearTimeout(timer);
    frame.classList.remove("bare");
  };
  // In full screen they come and go by themselves.
  const isOver = (): boolean => !frame.classList.contains("full") && stage.offsetTop === 0;
  const hide = (): void => {
    if (isOver()) frame.classList.add("bare");
  };
  const opened = (): void => {
    show();
    timer = window.setTimeout(hide, sight);
  };
  book.addEventListener("load", opened, { signal });
  if (book.pageCount > 0) opened();
  stage.addEventListener(
    pageTap,
    () => {
      const isBare = frame.classList.contains("bare");
      show();
      // Beside an open panel they stay.
      if (!isBare && !frame.classList.contains("open")) frame.classList.add("bare");
    },
    { signal },
  );
  frame.addEventListener(
    "pointerdown",
    ({ target }) => {
      isByHand = stage.contains(target as Node);
      // Bars that are used stay.
      if (!isByHand) clearTimeout(timer);
    },
    { capture: true, passive: true, signal },
  );
  book.addEventListener(
    "turnstart",
    () => {
      if (isByHand) hide();
    },
    { signal },
  );
  // Readers who use the keyboard need them.
  frame.addEventListener(
    "keydown",
    () => {
      isByHand = false;
      show();
    },
    { signal },
  );
  signal.addEventListener("abort", show);
  return opened;
}
