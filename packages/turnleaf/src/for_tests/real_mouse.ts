/** The browser's own mouse, led by its interface for tools: it hits, selects and focuses as a reader's does. */

import { cdp } from "vitest/browser";

/** The part of the browser's interface for tools that is used here. */
export interface ToolSession {
  send(method: string, parameters?: object): Promise<unknown>;
}

/** Returns the session of the test's page. */
export const toolSession = (): ToolSession => cdp() as unknown as ToolSession;

/** A place in this document's window, CSS pixels. */
export interface WindowPlace {
  readonly x: number;
  readonly y: number;
}

/** Returns where this document lies on the outermost page, which the tools use. */
export function frame(): WindowPlace & { readonly scale: number } {
  const box = frameElement?.getBoundingClientRect();
  return { x: box?.left ?? 0, y: box?.top ?? 0, scale: box ? box.width / innerWidth : 1 };
}

/** Sends one event. */
export async function mouse(
  type: "mouseMoved" | "mousePressed" | "mouseReleased",
  { x, y }: WindowPlace,
  buttons: 0 | 1 = 0,
): Promise<void> {
  const { x: left, y: top, scale } = frame();
  await toolSession().send("Input.dispatchMouseEvent", {
    type,
    x: left + x * scale,
    y: top + y * scale,
    button: type === "mouseMoved" && buttons === 0 ? "none" : "left",
    buttons,
    clickCount: 1,
  });
}

/** Moves to a place, presses and releases. */
export async function clickMouse(at: WindowPlace): Promise<void> {
  await mouse("mouseMoved", at);
  await mouse("mousePressed", at, 1);
  await mouse("mouseReleased", at);
}

/** Presses at a place, moves to another in small steps, and releases. */
export async function dragMouse(from: WindowPlace, to: WindowPlace): Promise<void> {
  await mouse("mouseMoved", from);
  await mouse("mousePressed", from, 1);
  for (let k = 1; k <= 8; k++) {
    const [x, y] = [from.x + ((to.x - from.x) * k) / 8, from.y + ((to.y - from.y) * k) / 8];
    await mouse("mouseMoved", { x, y }, 1);
  }
  await mouse("mouseReleased", to);
}
