/** What of a leaf stands between a resting page and the light. */

import type { Surface } from "../engine/shapes.ts";
import { LeafSection } from "./leaf_section.ts";
import { shadowSlopes } from "./light.ts";
import type { Overhead } from "./page_mesh.ts";
import { pageRows } from "./page_mesh.ts";
import { obstacleStride, type PileShape } from "./pile_shape.ts";

/**
 * Room for what stands over a page.
 *
 * @param height of the page, metres
 * @param board where the tip of a board over it is kept; empty where there is none
 */
export function overheadOf(height: number, board: Float32Array): Overhead {
  const section = (): LeafSection => new LeafSection(pageRows, height);
  return { sky: section(), keys: shadowSlopes.map(section), board };
}

/**
 * Cuts what stands over a side's page: the leaf nearest to it, or nothing.
 *
 * @param stride every how many of the leaf's columns are looked at; divides their number less 1
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
