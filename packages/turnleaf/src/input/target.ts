/** The target of pointers, wheel and keys. */

import type { Viewer } from "../viewer/viewer.ts";

/** An open book, and the callbacks of the element around it. */
export interface InputTarget {
  readonly viewer: Viewer;
  /** Turns one leaf forward (1) or back (-1), with motion or without, as the reader prefers. */
  readonly turn: (by: 1 | -1) => void;
  /** Returns whether the reader prefers reduced motion. */
  readonly calm: () => boolean;
}
