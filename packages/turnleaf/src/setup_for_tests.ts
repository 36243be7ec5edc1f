/** Before and after every test in a browser: one in which WebGL complains fails. */

import { afterEach, beforeAll, expect } from "vitest";
import { commands } from "vitest/browser";

declare module "vitest/browser" {
  interface BrowserCommands {
    webglComplaints(): Promise<string[]>;
  }
}

/** Waits until the graphics process has done, and told of, all that was asked of it. */
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
