/**
 * What the browser requests from other hosts than the tests' own, for tests that run in it. A page
 * learns neither of the requests of its frames nor of those of images within images; the driver of
 * the browser does.
 */

/** Requests by the page that made them. */
const requests = new WeakMap();

/**
 * Commands of the browser tests.
 * @type {Record<string, (context: import("vitest/node").BrowserCommandContext) => Promise<string[]>>}
 */
export const requestCommands = {
  /** Returns the addresses on other hosts that were requested since the last call; the first call begins to listen. */
  async requestsElsewhere({ page }) {
    const before = requests.get(page);
    requests.set(page, []);
    if (before === undefined) {
      const own = new URL(page.url()).host;
      const note = (request) => {
        const { protocol, host } = new URL(request.url());
        if (/^(https?|wss?):$/.test(protocol) && host !== own)
          requests.get(page)?.push(request.url());
      };
      page.on("requestfinished", note);
      page.on("requestfailed", (request) => {
        // What the policy of the page or of a frame forbids never leaves the browser.
        if (request.failure()?.errorText !== "csp") note(request);
      });
    }
    return before ?? [];
  },
};
