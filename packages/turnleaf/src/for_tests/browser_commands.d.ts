/** What the driver of the browser does for tests that run in it. */

import "vitest/browser";

declare module "vitest/browser" {
  interface BrowserCommands {
    webglComplaints(): Promise<string[]>;
    consoleMessages(): Promise<string[]>;
    printedPdf(markup: string): Promise<string>;
    processUse(): Promise<{ seconds: number; bytes: number | null }>;
    requestsElsewhere(): Promise<string[]>;
  }
}
