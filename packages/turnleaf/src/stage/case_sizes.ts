/** The dimensions of a case, shared by all stages. */

import type { BookShape } from "./book_pose.ts";

/** Lengths of a case, metres. */
export const caseSizes = {
  /** Thickness of a board. */
  board: 0.0026,
  /** How far boards extend beyond the pages at head, foot and fore-edge. */
  rim: 0.0032,
  bevel: 0.0006,
  corner: 0.0012,
  /** Length of the cloth hinge between a board and the spine. */
  joint: 0.006,
  /** Depth of the boards' inner faces under the lowest leaf, so that the two never coincide. */
  sink: 0.0002,
} as const;

/** Returns the height of the table that a book lies on, metres: below its boards, if it has any. */
export function tableHeight({ cover }: Pick<BookShape, "cover">): number {
  return cover === "hard" ? -caseSizes.board - caseSizes.sink : 0;
}
