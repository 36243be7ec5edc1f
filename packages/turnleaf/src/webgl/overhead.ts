/** The part of a leaf between a resting page and the light. */

import type { Surface } from "../engine/shapes.ts";
import { LeafSection } from "./leaf_section.ts";
import { shadowSlopes } from "./light.ts";
import type { Overhead } from "./page_mesh.ts";
import { pageRows } from "./page_mesh.ts";
import { obstacleStride, type PileShape } from "./pile_shape.ts";

/**
 * Creates the buffers for what stands over a page.
 *
 * @param height of the page, metres
 * @param board receives the tip of a board over it; empty if there is none
 */
export function overheadOf(height: number, board: Float32Array): Overhead {
  const section = (): LeafSection => new LeafSection(pageRows, height);
  return { sky: section(), keys: shadowSlopes.map(section), board };
}

/**
 * Cuts the leaf nearest to a side's page, or clears the section.
 *
 * @param stride tests every so many of the leaf's columns; divides their number
 * less 1
 */
export function castOver(
  over: Overhead,
  pile: PileShape,
  leaf: Surface | undefined,
  stride: number = obstacleStride,
): void {
  if (leaf === undefined) {
    over.sky.clear();
    for (const key of over.keys) key.clear();
    return;
  }
  over.sky.cut(leaf, pile.sign, 0, 0, stride);
  for (let k = 0; k < over.keys.length; k++) {
    over.keys[k].cut(leaf, pile.sign, shadowSlopes[k], pile.top, stride);
  }
}
