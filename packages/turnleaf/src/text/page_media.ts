/** The sounds and films of an open page: a button over each plays it where it is printed. */

import type { PageMedium } from "../sources/page_source.ts";

/**
 * Returns a page's sounds and films as buttons, in their order. One that is pressed loads its
 * recording, and a player with controls takes its place.
 *
 * @csspart medium A sound or a film on a page: the button that plays it, then its player.
 * @param ended its abort frees the recordings
 * @param played called when one is asked for or heard, with true, and when it is no longer, with false
 */
export function makeMedia(
  media: readonly PageMedium[],
  ended: AbortSignal,
  played: (medium: PageMedium, isPlayed: boolean) => void,
): HTMLElement[] {
  return media.map((medium) => {
    const element = document.createElement("div");
    const button = document.createElement("button");
    element.className = "medium";
    element.setAttribute("part", "medium");
    button.type = "button";
    button.textContent = "▶";
    button.title = medium.title;
    button.setAttribute("aria-label", medium.title);
    element.append(button);
    // Its keys are not commands to the book.
    element.addEventListener("keydown", (event) => event.stopPropagation());
    button.addEventListener("click", () => {
      button.disabled = true;
      const report = (isPlayed: boolean): void => {
        if (!ended.aborted) played(medium, isPlayed);
      };
      report(true);
      play(medium, element, ended, report).catch((error: Error) => {
        if (ended.aborted) return;
        element.replaceChildren(error.message);
        report(false);
      });
    });
    return element;
  });
}

/** Puts a player in place of what is in an element, and plays. Rejects with an error whose message is a sentence. */
async function play(
  medium: PageMedium,
  element: HTMLElement,
  ended: AbortSignal,
  report: (isPlayed: boolean) => void,
): Promise<void> {
  const file = await medium.load();
  ended.throwIfAborted();
  const player = document.createElement(medium.kind);
  const address = URL.createObjectURL(file);
  const free = (): void => {
    player.removeAttribute("src");
    URL.revokeObjectURL(address);
  };
  ended.addEventListener("abort", free, { once: true });
  player.addEventListener("play", () => report(true));
  player.addEventListener("pause", () => report(false));
  player.controls = true;
  player.setAttribute("aria-label", medium.title);
  player.src = address;
  element.replaceChildren(player);
  player.focus({ preventScroll: true });
  // Pressed again, interrupted as its place was laid anew, or not allowed without another press: the
  // controls are there. That it cannot be played may be known only after that.
  player.play().catch(() => report(!player.paused));
  await new Promise<never>((_, reject) => {
    const fail = (): void => {
      free();
      const sentence = `${medium.title} cannot be played; update the browser, or allow blob: in media-src of this page's Content-Security-Policy.`;
      reject(new Error(sentence, { cause: player.error }));
    };
    player.addEventListener("error", fail, { once: true, signal: ended });
  });
}
