/** A finger of the browser's own, led by its interface for tools. */

import { frame, toolSession, type WindowPlace } from "./real_mouse.ts";

/** Sends one event of a finger; one that ends is nowhere. */
export async function finger(
  type: "touchStart" | "touchMove" | "touchEnd",
  at?: WindowPlace,
): Promise<void> {
  const { x: left, y: top, scale } = frame();
  const touchPoints = at ? [{ x: left + at.x * scale, y: top + at.y * scale }] : [];
  await toolSession().send("Input.dispatchTouchEvent", { type, touchPoints });
}

/** Moves a finger that is down from one place to another in small steps. */
export async function moveFinger(from: WindowPlace, to: WindowPlace): Promise<void> {
  for (let k = 1; k <= 8; k++) {
    const [x, y] = [from.x + ((to.x - from.x) * k) / 8, from.y + ((to.y - from.y) * k) / 8];
    await finger("touchMove", { x, y });
  }
}
