/** The target of pointers, wheel and keys. */

import type { ElementPlane } from "../element_plane.ts";
import type { Place } from "../stage/book_stage.ts";
import type { Viewer } from "../viewer/viewer.ts";

/** A kind of gesture by pointer or wheel that can be switched off. */
export type Gesture = "drag" | "click" | "corner" | "wheel" | "zoom";

/** Where a column of text begins and ends, as fractions of a page's width. */
export interface Column {
  readonly from: number;
  readonly to: number;
}

/** An open book, and the callbacks of the element around it. */
export interface InputTarget {
  readonly viewer: Viewer;
  /** How the stage is seen in the window. */
  readonly plane: ElementPlane;
  /**
   * Turns one leaf forward (1) or back (-1), with motion or without, as the reader prefers. `isTap`
   * says that a key or button was pressed once, and is not held. Resolves, once the book is at rest, to whether it lies there.
   */
  readonly turn: (by: 1 | -1, isTap?: boolean) => Promise<boolean>;
  /**
   * Returns where the column of text at a place of an open page begins and ends, as fractions of the page's
   * width; null if it has one column, or its text is not known.
   */
  readonly columnAt: (page: number, at: Place) => Column | null;
  /** Returns the columns of an open page's text in the order of reading; none if it has one, or its text is not known. */
  readonly columnsOf: (page: number) => readonly Column[];
  /**
   * Selects the word at a place of the window, CSS pixels. Returns what extends the selection by whole words
   * to another place; null if there is no text at the first, or none may be copied.
   */
  readonly selectWord: (at: Place) => ((x: number, y: number) => void) | null;
  /** A finger has tapped on the middle of a page. */
  readonly tapped: () => void;
  /** Announces to screen readers the zoom level to which a key leads. */
  readonly announceZoom: () => void;
  /** Returns whether the reader prefers reduced motion. */
  readonly calm: () => boolean;
  /** Returns whether a gesture acts on the book. */
  readonly allows: (gesture: Gesture) => boolean;
  /** Returns the minimum length of a flick that turns, CSS pixels. */
  readonly swipeDistance: () => number;
}
