/**
 * Waiting for a state of a page: checked with each of its frames, or brought about by a clock that
 * only the test moves. Nothing here waits for a time.
 */

import type { Page } from "playwright-core";
import type { TurnleafBook } from "turnleaf";
import { expect } from "vitest";

/** Milliseconds after which a state that has not come is reported: before the test's own timeout. */
const patience = 50_000;

/**
 * Waits until a function that runs in the page returns a value, compared as JSON. Fails with the last
 * value otherwise.
 */
export async function comesTo<T, A = undefined>(
  page: Page,
  look: (arg: A) => T,
  expected: NoInfer<T>,
  arg?: A,
): Promise<void> {
  const call = `(${look})(${JSON.stringify(arg)})`;
  const wanted = JSON.stringify(JSON.stringify(expected));
  try {
    // A function, as a page's policy may forbid texts that are evaluated in later frames.
    const holds = new Function(`return JSON.stringify(${call}) === ${wanted}`) as () => boolean;
    await page.waitForFunction(holds, null, { timeout: patience });
  } catch (error) {
    expect(await page.evaluate(call), String(error)).toEqual(expected);
    throw error;
  }
}

/** Evaluates a function on the page's book. */
export const askBook = <T, A = undefined>(
  page: Page,
  look: (book: TurnleafBook, arg: A) => T,
  arg?: A,
): Promise<Awaited<T>> =>
  page.locator("turnleaf-book").evaluate(look as never, arg as never) as never;

/** Waits until a function of the page's book returns a value, compared as JSON. */
export const bookComesTo = <T>(
  page: Page,
  look: (book: TurnleafBook) => T,
  expected: NoInfer<T>,
): Promise<void> =>
  comesTo(
    page,
    `() => { const book = document.querySelector("turnleaf-book"); return book && (${look})(book); }` as never,
    expected,
  );

/** Waits until the page's book is at rest and sharp, with no page to load. */
export const bookSettles = (page: Page): Promise<void> =>
  bookComesTo(page, (book) => book.settled, true);

/** Waits until the text of the first element that a selector finds is this, or matches it. */
export async function textComesTo(
  page: Page,
  selector: string,
  text: string | RegExp,
): Promise<void> {
  await page.waitForFunction(
    ([selector, text, pattern]) => {
      const shown = document.querySelector(selector)?.textContent ?? "";
      return pattern === null ? shown === text : new RegExp(pattern).test(shown);
    },
    typeof text === "string"
      ? ([selector, text, null] as const)
      : ([selector, "", text.source] as const),
    { timeout: patience },
  );
}

/** Waits for as many frames of the page. */
export const passFrames = (page: Page, count: number): Promise<void> =>
  page.evaluate(async (count) => {
    for (let k = 0; k < count; k++) await new Promise(requestAnimationFrame);
  }, count);

/** Stops the clock of a page that is still empty: its time passes only by {@link passTime}. */
export async function stopClock(page: Page): Promise<void> {
  await page.clock.install({ time: 0 });
  await page.clock.pauseAt(1000);
}

/** Stops the running clock of a page that has one of `page.clock.install`. */
export const pauseClock = async (page: Page): Promise<void> =>
  page.clock.pauseAt(await page.evaluate(() => Date.now() + 1000));

/** Lets time pass on a stopped clock, as a page with so slow frames has it: every timer fires at most once. */
export async function passTime(page: Page, frames: number, frameTime: number): Promise<void> {
  for (let k = 0; k < frames; k++) await page.clock.fastForward(frameTime);
}

/** Lets a stopped clock run, frame by frame, until a condition holds. */
export async function passTimeUntil(
  page: Page,
  condition: () => Promise<boolean>,
  frameTime = 50,
): Promise<void> {
  for (let frame = 0; !(await condition()); frame++) {
    expect(frame, "frames until it holds").toBeLessThan(2000);
    await page.clock.fastForward(frameTime);
  }
}
