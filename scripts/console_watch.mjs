/**
 * What the browser itself writes on the console, for tests that run in it. A
 * page cannot hear the warnings of WebGL; the driver of the browser can.
 */

/** Complaints by the page they were written on. */
const complaints = new WeakMap();

/** Warnings and errors by the page they were written on, those of its workers too. */
const messages = new WeakMap();

/** Beside a word that WebGL complains in: its own, the driver's, or three.js's. */
const isOfWebgl = /WebGL|\bGL_|texSubImage|texStorage|THREE\./;

/**
 * What no drawing is at fault for: a context that was given up, as every
 * removed book's is, and a test that reads pixels back.
 */
const isHarmless = /CONTEXT_LOST_WEBGL|Context (Lost|Restored)|GPU stall due to ReadPixels/;

/**
 * Whether WebGL complains in a text of the console. Chromium tells of it by warnings, which others write too.
 * @param {string} text
 */
export function isWebglComplaint(text) {
  return isOfWebgl.test(text) && !isHarmless.test(text);
}

/**
 * Commands of the browser tests.
 * @type {Record<string, (context: import("vitest/node").BrowserCommandContext) => Promise<string[]>>}
 */
export const consoleCommands = {
  /** Returns what WebGL complained of since the last call; the first call begins to listen. */
  async webglComplaints({ page }) {
    const before = complaints.get(page);
    const since = [];
    complaints.set(page, since);
    if (before === undefined) {
      page.on("console", (message) => {
        const text = message.text();
        if (isWebglComplaint(text)) complaints.get(page)?.push(text);
      });
    }
    return before ?? [];
  },

  /**
   * Returns the warnings and errors on the console since the last call, and what was left uncaught in the
   * page and its workers; the first call begins to listen.
   */
  async consoleMessages({ page }) {
    // What was said before this was asked is heard before the browser responds.
    await page.evaluate(() => null);
    const before = messages.get(page);
    messages.set(page, []);
    if (before === undefined) {
      page.on("console", (message) => {
        if (/^(warning|error)$/.test(message.type())) messages.get(page)?.push(message.text());
      });
      page.on("pageerror", (error) => messages.get(page)?.push(String(error)));
    }
    return before ?? [];
  },
};
