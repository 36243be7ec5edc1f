/** What a stage draws: a book's fixed shape, and where its parts are in one frame. */

import type { Pile, Surface } from "../engine/shapes.ts";

/** What of a book never changes while it is read. Lengths in metres. */
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
  /** How far its boards stand out beyond the pages at head, foot and fore-edge; 0 where there are none. */
  readonly rim: number;
  /** Whether the spine lies across the screen and the right side below it. */
  readonly rolled: boolean;
  /** The side whose pages alone are read, 1 right or -1 left; 0 where both are. */
  readonly alone: 1 | 0 | -1;
  /** CSS colour of the boards and the spine. */
  readonly cloth: string;
  /** Scans are never drawn brighter than they are. */
  readonly kind: "typeset" | "scan";
}

/** Where the parts of the book are. Book space: see `engine/shapes.ts`; z = 0 is the boards' inner face. */
export interface BookPose {
  /** Resting pages on the left; null where none lie. */
  readonly left: Pile | null;
  /** Resting pages on the right; null where none lie. */
  readonly right: Pile | null;
  /** The leaves in flight, from the left to the right. A recto faces up where its leaf lies on the right. */
  readonly leaves: readonly Surface[];
  /** Whether they lie folded on the pages, so that light falls on them as on these, rather than between them. */
  readonly folded?: boolean;
  /** The flap of a fold-out that lies open, where none is in flight. */
  readonly flap?: Surface | null;
  /** An object of the stage's own kind (three.js's `Object3D`) seen over the book from now on; who put it there takes it away. */
  readonly above?: object;
  /** Half of what the right block is thicker than the left, metres: so far the gutter is off the spine's middle. */
  readonly lean: number;
  /** Radians: pi lies open on the left, 0 is closed over the right block. */
  readonly frontBoard: number;
  /** Radians: 0 lies open on the right, pi is closed over the left block. */
  readonly backBoard: number;
}
