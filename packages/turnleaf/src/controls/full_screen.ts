/** In full screen the bars make room for the book, and come back when they are looked for. */

/** Milliseconds that the bars stay after the last movement. */
const sight = 2500;

/**
 * Follows the pointer while an element fills the screen. No timer runs once the bars are away.
 * @param frame what is marked: `full` in full screen, `awake` while the bars are in sight
 * @param changed hears that full screen began or ended
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
    // Browsers tell of a move too when what lies under a still pointer changes, as it does when the bars go.
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
