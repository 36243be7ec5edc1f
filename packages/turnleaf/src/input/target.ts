/** The target of pointers, wheel and keys. */

import type { ElementPlane } from "../element_plane.ts";
import type { Viewer } from "../viewer/viewer.ts";

/** A kind of gesture by pointer or wheel that can be switched off. */
export type Gesture = "drag" | "click" | "corner" | "wheel" | "zoom";

/** An open book, and the callbacks of the element around it. */
export interface InputTarget {
  readonly viewer: Viewer;
  /** How the stage is seen in the window. */
  readonly plane: ElementPlane;
  /** Turns one leaf forward (1) or back (-1), with motion or without, as the reader prefers. */
  readonly turn: (by: 1 | -1, isTap?: boolean) => void;
  /** Announces to screen readers the zoom level to which a key leads. */
  readonly announceZoom: () => void;
  /** Returns whether the reader prefers reduced motion. */
  readonly calm: () => boolean;
  /** Returns whether a gesture acts on the book. */
  readonly allows: (gesture: Gesture) => boolean;
  /** Returns the minimum length of a flick that turns, CSS pixels. */
  readonly swipeDistance: () => number;
}
