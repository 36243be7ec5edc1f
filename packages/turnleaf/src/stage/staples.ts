/** The two staples through the fold of a thin set of sheets, as they are seen where it lies open in its middle. */

import { pileHeight } from "../engine/shapes.ts";
import type { BookPose, BookShape } from "./book_pose.ts";

/**
 * Where they are along the spine, as fractions of it, as where a stapled leaf tears; and in metres how long
 * each is, the gap between its two legs, which are bent toward each other, and the wire's thickness.
 */
export const staples = { places: [0.25, 0.75], length: 0.012, gap: 0.001, wire: 0.0006 } as const;

/** Colour of the wire. */
export const stapleColour = "#8b8f95";

/** Thickness of the thickest set that is folded and stapled, metres: inner sheets of a thicker one would stand out. */
export const thickestStapled = 0.004;

/** Returns whether leaves without boards are sheets that are folded and stapled: two of them or more. */
export function areStapled({
  cover,
  leaves,
  thickness,
}: Pick<BookShape, "cover" | "leaves" | "thickness">): boolean {
  return cover === "none" && leaves >= 4 && leaves % 2 === 0 && thickness <= thickestStapled;
}

/** Returns whether the fold in the middle lies open, or a leaf beside it is in the air. */
export function showsStaples(
  { isStapled, thickness, leaves }: BookShape,
  { left, right }: Pick<BookPose, "left" | "right">,
): boolean {
  const isHalf = (pile: BookPose["left"]): boolean =>
    pile !== null && Math.abs(pileHeight(pile) - thickness / 2) < thickness / (2 * leaves);
  return isStapled === true && (isHalf(left) || isHalf(right));
}

/** Returns the two legs of each staple, from and to in metres along the spine from its end. */
export function stapleLegs(height: number): readonly (readonly [from: number, to: number])[] {
  const { places, length, gap } = staples;
  return places.flatMap((place) => {
    const middle = place * height;
    return [
      [middle - length / 2, middle - gap / 2],
      [middle + gap / 2, middle + length / 2],
    ] as const;
  });
}
