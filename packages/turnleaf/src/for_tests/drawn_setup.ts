/**
 * Before every file of tests that read pixels: the clock is the tests' own, and a WebGL error makes the
 * file fail.
 */

import { afterAll, afterEach, beforeAll, expect } from "vitest";
import { commands } from "vitest/browser";
import { clock, installClock } from "./clock.ts";
import { drawPlainly, drawWhenSeen } from "./drawn_when_seen.ts";
import { countWork } from "./work.ts";

/** Waits until the graphics process has done everything requested and reported its errors. */
function finishDrawing(): void {
  const context = document.createElement("canvas").getContext("webgl2");
  context?.readPixels(0, 0, 1, 1, context.RGBA, context.UNSIGNED_BYTE, new Uint8Array(4));
  context?.getExtension("WEBGL_lose_context")?.loseContext();
}

installClock();
countWork();
drawWhenSeen();
drawPlainly();

beforeAll(async () => {
  await commands.webglComplaints();
});

afterEach(() => clock.run());

afterAll(async () => {
  finishDrawing();
  expect(await commands.webglComplaints()).toEqual([]);
});
