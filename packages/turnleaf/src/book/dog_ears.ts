/** Corners of pages that are folded over, as creases of the leaves. */

import type { Crease } from "../engine/shapes.ts";
import { type Binding, isBoard, leafOf, paperOnLeft, rightPage } from "./spreads.ts";

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

/** A corner as a leaf has it: folded over, or opened again, which leaves a line. */
export interface CornerFold extends DogEar {
  readonly isOpened?: boolean;
}

/** Angle at which a folded corner rests, radians: 20 degrees open, as paper pressed by a finger. */
export const foldedRest: number = (160 / 180) * Math.PI;

/** Angle at which one rests that was opened again: smoothed by a finger, as far from flat as it was from folded over. */
export const openedRest: number = Math.PI - foldedRest;

/** The sizes of dog-ears: least, most and default. */
export const dogEarSizes = [0.05, 0.5, 0.2] as const;

/** Returns a size that a dog-ear can have, nearest to a number; the default if it is none. */
export function dogEarSize(size: unknown): number {
  const [least, most, usual] = dogEarSizes;
  const isNumber = typeof size === "number" && Number.isFinite(size);
  return isNumber ? Math.min(Math.max(size, least), most) : usual;
}

/**
 * Returns the creases of dog-ears, by their leaves of paper, counted from 0 at the front. A
 * page that is not of paper, or not of this book, has none, and a corner has one: the last.
 *
 * @param shape a page's width and height, in one unit
 */
export function creasesOfDogEars(
  ears: readonly CornerFold[],
  binding: Binding,
  { width, height }: { readonly width: number; readonly height: number },
): Map<number, Crease[]> {
  const creases = new Map<number, Map<Corner, Crease>>();
  for (const { page, corner, size, isOpened } of ears) {
    const leaf = leafOf(binding, page);
    if (isBoard(binding, leaf)) continue;
    const paper = paperOnLeft(binding, leaf);
    const corners = creases.get(paper) ?? new Map<Corner, Crease>();
    const up = Math.min((size * width) / height, 0.5);
    const rest = isOpened ? openedRest : foldedRest;
    corners.set(corner, {
      through: corner === "foot" ? [1 - size, 0, 1, up] : [1 - size, 1, 1, 1 - up],
      rest: rightPage(binding, leaf) === page ? rest : -rest,
    });
    creases.set(paper, corners);
  }
  return new Map([...creases].map(([leaf, corners]) => [leaf, [...corners.values()]]));
}
