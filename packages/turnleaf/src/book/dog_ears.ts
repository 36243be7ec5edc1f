/** Corners of pages that are folded over. */

/** The corners of a page that can be folded: those of its edge away from the spine. */
export type Corner = "head" | "foot";

/** A corner of a page that is folded over onto it. */
export interface DogEar {
  /** From 1. */
  readonly page: number;
  /** At the head of the page or at its foot; where its spine is above or below, on the right or on the left. */
  readonly corner: Corner;
  /** How far from the corner its fold meets the page's edges: a fraction of the page's width, 0.05 to 0.5. */
  readonly size: number;
}

/** Angle at which paper rests that was folded and pressed by a finger, degrees: 20 open. */
export const foldedDegrees = 160;

/** The same, radians. */
export const foldedRest: number = (foldedDegrees / 180) * Math.PI;

/** The sizes of dog-ears: least, most and default. */
export const dogEarSizes = [0.05, 0.5, 0.2] as const;

/** Returns a size that a dog-ear can have, nearest to a number; the default if it is none. */
export function dogEarSize(size: unknown): number {
  const [least, most, usual] = dogEarSizes;
  const isNumber = typeof size === "number" && Number.isFinite(size);
  return isNumber ? Math.min(Math.max(size, least), most) : usual;
}
