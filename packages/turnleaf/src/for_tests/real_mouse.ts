/** Real mouse events, by the browser's own interface for tools. */

import { cdp } from "vitest/browser";

/** The part of that interface that tests use. */
export interface Session {
  send(method: string, parameters?: object): Promise<unknown>;
}
/** Returns that interface. */
export const session = (): Session => cdp() as unknown as Session;

/** Returns where this document lies on the outermost page, which the tools use. */
export function frame(): { x: number; y: number; scale: number } {
  const box = frameElement?.getBoundingClientRect();
  return { x: box?.left ?? 0, y: box?.top ?? 0, scale: box ? box.width / innerWidth : 1 };
}

/** Sends a mouse event at a place of this document, CSS pixels. */
export async function mouse(type: string, x: number, y: number, buttons: number): Promise<void> {
  const { x: left, y: top, scale } = frame();
  await session().send("Input.dispatchMouseEvent", {
    type,
    x: left + x * scale,
    y: top + y * scale,
    button: type === "mouseMoved" && buttons === 0 ? "none" : "left",
    buttons,
    clickCount: 1,
  });
}

/** Presses and releases at a place of this document, CSS pixels. */
export async function clickMouse(x: number, y: number): Promise<void> {
  await mouse("mouseMoved", x, y, 0);
  await mouse("mousePressed", x, y, 1);
  await mouse("mouseReleased", x, y, 0);
}
