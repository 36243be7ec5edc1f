/** Before every file of browser tests: the clock is the tests' own, and nothing is drawn. */

import { afterAll, afterEach, vi } from "vitest";
import { clock, installClock } from "./clock.ts";
import { drawNothing } from "./undrawn.ts";
import { countWork } from "./work.ts";

installClock();
// Not before a book needs it: most files open none, and its code takes time to load.
drawNothing(() => void leaveLightOut());
countWork();
afterEach(() => clock.run());
// The next file may run in the same page: it finds nothing mocked, no book, and no frame of one that was not closed.
afterAll(() => {
  vi.restoreAllMocks();
  vi.unstubAllGlobals();
  for (const left of document.querySelectorAll("iframe, turnleaf-book")) left.remove();
  document.body.removeAttribute("style");
});

/** Has books compute no light, which takes as long as all else of a frame, and which nothing shows. */
async function leaveLightOut(): Promise<void> {
  const { DrawnBook } = await import("../webgl/drawn_book.ts");
  DrawnBook.prototype.light = () => undefined;
}
