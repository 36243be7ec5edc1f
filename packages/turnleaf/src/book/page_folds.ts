/** Straight folds across pages. */

import type { Edge } from "./spreads.ts";

/** A place on a page. */
export interface PagePlace {
  /** How far from its left edge, as a fraction of its width. */
  readonly x: number;
  /** How far from its upper edge, as a fraction of its height. */
  readonly y: number;
}

/** A straight fold across a page, from edge to edge. */
export interface PageFold {
  /** From 1. */
  readonly page: number;
  /** A place on its line, on which the fold goes on to the edges of the page. */
  readonly from: PagePlace;
  /** Another place on its line. */
  readonly to: PagePlace;
  /**
   * Angle at which it rests, degrees: 0 is flat, above it the page is folded toward the reader
   * who looks at it, below it away, -180 to 180 folded shut.
   */
  readonly angle: number;
}

/**
 * Returns whether the line of a fold meets the spine, which lies at an edge of the page: a bound
 * page cannot be folded there.
 */
export function meetsSpine({ from, to }: PageFold, spine: Edge): boolean {
  const isUpright = spine === "left" || spine === "right";
  const at = spine === "left" || spine === "top" ? 0 : 1;
  const place = ({ x, y }: PagePlace) => (isUpright ? [x - at, y] : [y - at, x]);
  const [[a, start], [b, end]] = [place(from), place(to)];
  if (a === b) return a === 0;
  const along = start + (a / (a - b)) * (end - start);
  return along >= 0 && along <= 1;
}
