/** Before and after every browser test: a WebGL error makes it fail. */

import { afterEach, beforeAll, expect } from "vitest";
import { commands } from "vitest/browser";

declare module "vitest/browser" {
  interface BrowserCommands {
    webglComplaints(): Promise<string[]>;
    requestsElsewhere(): Promise<string[]>;
  }
}

/** Waits until the graphics process has done everything requested and reported its errors. */
function finishDrawing(): void {
  const context = document.createElement("canvas").getContext("webgl2");
  context?.readPixels(0, 0, 1, 1, context.RGBA, context.UNSIGNED_BYTE, new Uint8Array(4));
  context?.getExtension("WEBGL_lose_context")?.loseContext();
}

beforeAll(async () => {
  await commands.webglComplaints();
});

afterEach(async () => {
  finishDrawing();
  expect(await commands.webglComplaints()).toEqual([]);
});
