/** What the browser prints, for tests that run in it. */

/**
 * Commands of the browser tests.
 * @type {Record<string, (context: import("vitest/node").BrowserCommandContext, markup: string) => Promise<string>>}
 */
export const printingCommands = {
  /** Returns markup as the PDF that the browser prints of it, as base64. */
  async printedPdf({ page }, markup) {
    const printed = await page.context().newPage();
    try {
      await printed.setContent(markup);
      return (await printed.pdf({ tagged: true, outline: true })).toString("base64");
    } finally {
      await printed.close();
    }
  },
};
