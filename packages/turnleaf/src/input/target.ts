/** What pointers, wheel and keys act on. */

import type { Viewer } from "../viewer/viewer.ts";

/** An open book, and what of the element it lies in is asked beside it. */
export interface InputTarget {
  readonly viewer: Viewer;
  /** A reader turns one leaf on (1) or back (-1), with motion or without, as the reader likes it. */
  readonly turn: (by: 1 | -1) => void;
  /** Whether the reader asked for less motion. */
  readonly calm: () => boolean;
}
