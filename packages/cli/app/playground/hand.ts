/**
 * Pointer and keys: a drag on either picture, or the arrow keys, hold both
 * leaves at the same place.
 */

import type { LeafPlace } from "turnleaf/leaf-stage";
import type { Picture } from "./picture.ts";
import { leafSize } from "./variants.ts";

/** The actions of a pointer. */
export interface HandActions {
  grab(place: LeafPlace): void;
  hold(x: number, y: number, z: number): void;
  release(): void;
}

/** Closer to the spine a leaf does not give way. */
const leastU = 0.08;

/** How far a key moves the grab, as a fraction of the width. */
const byKey = 0.06;

const ways: Readonly<Record<string, readonly [number, number]>> = {
  ArrowLeft: [-1, 0],
  ArrowRight: [1, 0],
  ArrowUp: [0, 1],
  ArrowDown: [0, -1],
};

/** Makes a picture draggable, and movable by keys while it has the focus. */
export function followHand(picture: Picture, actions: HandActions): void {
  const { canvas, stage } = picture;
  let reach = 0;
  let pointer: number | null = null;
  /** Where the keys hold the foot corner; null if they do not. */
  let corner: { x: number; y: number } | null = null;

  const end = (): void => {
    pointer = null;
    corner = null;
    canvas.classList.remove("held");
    actions.release();
  };
  const pull = (event: PointerEvent): void => {
    actions.hold(...stage.handAt(event.offsetX, event.offsetY, reach));
  };
  canvas.addEventListener("pointerdown", (event) => {
    if (pointer !== null || !event.isPrimary || event.button !== 0) return;
    const place = stage.pick(event.offsetX, event.offsetY);
    if (!place) return;
    const { u, v } = { u: Math.max(place.u, leastU), v: place.v };
    pointer = event.pointerId;
    corner = null;
    reach = u * leafSize.width;
    canvas.setPointerCapture(pointer);
    canvas.classList.add("held");
    actions.grab({ u, v });
    pull(event);
  });
  canvas.addEventListener("pointermove", (event) => {
    if (event.pointerId === pointer) pull(event);
  });
  for (const type of ["pointerup", "pointercancel"] as const) {
    canvas.addEventListener(type, (event) => {
      if (event.pointerId === pointer) end();
    });
  }
  canvas.addEventListener("keydown", (event) => {
    const way = ways[event.key];
    if (corner && (event.key === "Enter" || event.key === " " || event.key === "Escape")) end();
    else if (event.key === "Enter" || event.key === " ") {
      corner = { x: leafSize.width, y: 0 };
      canvas.classList.add("held");
      actions.grab({ u: 1, v: 0 });
    } else if (!(way && corner)) return;
    event.preventDefault();
    if (!corner) return;
    const step = byKey * leafSize.width;
    const [across, along] = way ?? [0, 0];
    const x = clamp(corner.x + across * step, -leafSize.width, leafSize.width);
    const y = clamp(corner.y + along * step, -0.3 * leafSize.height, 0.6 * leafSize.height);
    corner = { x, y };
    // The same arch that a drag follows.
    actions.hold(x, y, 0.62 * Math.sqrt(leafSize.width ** 2 - x ** 2));
  });
  canvas.addEventListener("blur", () => {
    if (corner) end();
  });
}

const clamp = (x: number, least: number, most: number): number =>
  Math.min(most, Math.max(least, x));
