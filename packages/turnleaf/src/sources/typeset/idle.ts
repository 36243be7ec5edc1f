/**
 * Resolves when the browser has nothing else to do for this page, and after
 * some milliseconds in any case. Where it does not say when that is, it is a
 * task later.
 */
export function idle(longest: number): Promise<void> {
  return new Promise((resolve) => {
    if ("requestIdleCallback" in globalThis) {
      requestIdleCallback(() => resolve(), { timeout: longest });
    } else setTimeout(resolve);
  });
}
