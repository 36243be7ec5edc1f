/** What a stage draws: a book's fixed shape, and where its parts are in one frame. */

import type { Pile, Surface } from "../engine/shapes.ts";
import type { PageTheme } from "../themes.ts";

/** The constant shape of a bound book. Lengths in metres. */
export interface BookShape {
  /** Page width across the spine. */
  readonly width: number;
  /** Page height along the spine. */
  readonly height: number;
  /** Thickness of all leaves together. */
  readonly thickness: number;
  readonly leaves: number;
  /** Boards in cloth, or nothing but leaves. */
  readonly cover: "hard" | "none";
  /** Whether it is a set of sheets that are folded once and stapled. The default is false. */
  readonly isStapled?: boolean;
  /** How far its boards extend beyond the pages at head, foot and fore-edge; 0 without boards. */
  readonly rim: number;
  /** Whether the spine lies across the screen and the right side below it. */
  readonly quarterTurned: boolean;
  /** The side whose pages alone are read, 1 right or -1 left; 0 if both are. */
  readonly alone: 1 | 0 | -1;
  /** The colours of paper, edges and boards. The default is `light`. */
  readonly theme?: PageTheme;
  /** CSS colour of the boards and the spine, by day. */
  readonly cloth: string;
  /** Strength of the shadows of leaves on pages and on each other, 0 to 1. */
  readonly shadows: number;
  /** Whether it is seen from right above, and closed where it lies when it is open; otherwise from where a reader sits. */
  readonly fromAbove: boolean;
  /** How far the eye of a reader leans back from right above the open book, degrees: 0 to 12. */
  readonly tilt: number;
  /** Fraction of its place that stays free at each edge of the book: 0 to 0.25. */
  readonly margin: number;
  /** Scans are never drawn brighter than they are. */
  readonly kind: "typeset" | "scan";
}

/**
 * Where the parts of the book are. For book space see `engine/shapes.ts`; z = 0
 * is the boards' inner face.
 */
export interface BookPose {
  /** Resting pages on the left; null if there are none. */
  readonly left: Pile | null;
  /** Resting pages on the right; null if there are none. */
  readonly right: Pile | null;
  /**
   * The leaves in flight, from left to right. A recto faces up where its leaf
   * lies on the right.
   */
  readonly leaves: readonly Surface[];
  /** Those of them that lie creased on the pages. */
  readonly lying?: readonly Surface[];
  /** Whether they lie folded on the pages and are lit as these, rather than between them. */
  readonly folded?: boolean;
  /** The flap of an open fold-out, if there is one. */
  readonly flap?: Surface | null;
  /** Sheets that are torn out and lie on or beside the book, or are carried over it. */
  readonly loose?: readonly Surface[];
  /**
   * An object of the stage's own kind (three.js's `Object3D`) shown over the
   * book until it is removed by its owner.
   */
  readonly above?: object;
  /**
   * Half the difference in thickness of the right and the left pile, metres:
   * the offset of the gutter from the spine's middle.
   */
  readonly lean: number;
  /** Radians: pi lies open on the left, 0 is closed over the right pile. */
  readonly frontBoard: number;
  /** Radians: 0 lies open on the right, pi is closed over the left pile. */
  readonly backBoard: number;
}
