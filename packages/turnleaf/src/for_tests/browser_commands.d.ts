/** What the driver of the browser does for tests that run in it. */

import "vitest/browser";

declare module "vitest/browser" {
  interface BrowserCommands {
    webglComplaints(): Promise<string[]>;
    requestsElsewhere(): Promise<string[]>;
  }
}
