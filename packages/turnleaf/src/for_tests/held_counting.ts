/** Counting of the pages of flowing text, held for tests: it goes on when the browser is idle. */

import { onTestFinished } from "vitest";

const real = globalThis.requestIdleCallback;
let held: IdleRequestCallback[] = [];

/** Has no further chapter counted, until `countOn` or the end of the test. */
export function holdCounting(): void {
  onTestFinished(() => {
    globalThis.requestIdleCallback = real;
    held = [];
  });
  globalThis.requestIdleCallback = (call) => held.push(call);
}

/** Has so many more chapters counted, one after the other, or all if no number is given. Those that are held go on. */
export function countOn(chapters: number = Number.POSITIVE_INFINITY): void {
  let left = chapters;
  const due = held;
  held = [];
  globalThis.requestIdleCallback = (call, options) => {
    if (left <= 0) return held.push(call);
    left -= 1;
    return real(call, options);
  };
  for (const call of due) globalThis.requestIdleCallback(call);
}
