/** In full screen the bars hide, and come back when the pointer moves. */

/** Milliseconds for which the bars stay after the last movement. */
export const sight = 2500;

/**
 * Follows the pointer while an element fills the screen. No timer runs once the
 * bars are hidden.
 *
 * @param frame gets the class `full` in full screen, and `awake` while the bars
 * are visible
 * @param changed called when full screen began or ended
 */
export function watchFullScreen(
  book: HTMLElement,
  frame: HTMLElement,
  changed: () => void,
  signal: AbortSignal,
): void {
  let timer = 0;
  const sleep = (): void => {
    clearTimeout(timer);
    frame.classList.remove("awake");
  };
  const wake = (): void => {
    if (!frame.classList.contains("full")) return;
    clearTimeout(timer);
    frame.classList.add("awake");
    timer = window.setTimeout(sleep, sight);
  };
  const follow = (): void => {
    const isFull = book.ownerDocument.fullscreenElement === book;
    frame.classList.toggle("full", isFull);
    if (isFull) wake();
    else sleep();
    changed();
  };
  const moved = ({ movementX, movementY }: PointerEvent): void => {
    // Browsers also send a move when the content under a still pointer changes,
    // as it does when the bars hide.
    if (movementX !== 0 || movementY !== 0) wake();
  };
  book.addEventListener("pointermove", moved, { passive: true, signal });
  book.addEventListener("pointerdown", wake, { passive: true, signal });
  book.ownerDocument.addEventListener("fullscreenchange", follow, { signal });
  signal.addEventListener("abort", () => {
    sleep();
    frame.classList.remove("full");
  });
}
