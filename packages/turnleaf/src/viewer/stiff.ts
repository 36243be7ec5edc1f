/**
 * Leaves that are stiffer than the paper between them: board, which stays flat,
 * and card, which bends half as much. The engine moves them as paper; here its
 * surfaces are straightened before they are drawn.
 */

import type { Binding } from "../book/spreads.ts";
import type { Flight } from "../book/turning.ts";
import { columnPlace, type Pile, type Surface } from "../engine/shapes.ts";

/** Stiffness of card, from 0 for paper to 1 for a board. */
const cardStiffness = 0.5;

/** Thickness of a leaf of board and of card, metres. */
const boardThickness = 0.0016;
const cardThickness = 0.0004;

/** Leaves of paper that together are as thick as a leaf of board. */
export const paperPerBoard: number = boardThickness / 0.0004;

/**
 * Fractions of a turn between which the paper under a leaf takes its shape from
 * the leaf, or gives it up.
 */
const pressed = [0.1, 0.45] as const;

/** Straightens the leaves of one binding. */
export class Stiffening {
  readonly #binding: Binding;
  readonly #width: number;
  /**
   * Straightened surfaces by their originals: the same result for the same leaf
   * keeps a frame free.
   */
  #leaves = new WeakMap<Surface, Surface>();

  /** @param width of a leaf, metres */
  constructor(binding: Binding, width: number) {
    this.#binding = binding;
    this.#width = width;
  }

  /** Returns a leaf in flight, straightened by its stiffness. */
  leaf(surface: Surface, flight: Flight): Surface {
    const fraction = this.#of(flight.low);
    if (fraction === 0) return surface;
    let leaf = this.#leaves.get(surface);
    if (leaf === undefined) {
      const thickness = fraction === 1 ? boardThickness : cardThickness;
      leaf = { ...straightened(surface, fraction, this.#width), thickness };
      this.#leaves.set(surface, leaf);
    }
    return leaf;
  }

  /**
   * Returns the left and right pile, each straightened by the leaf on it;
   * `leaves` are those in flight between.
   */
  piles(
    left: Pile,
    right: Pile,
    spread: number,
    flights: readonly Flight[],
    leaves: readonly Surface[],
  ): [left: Pile, right: Pile] {
    let [onLeft, onRight] = [this.#of(spread - 1), this.#of(spread)];
    const [first, last] = [flights[0], flights.at(-1)];
    if (first?.part === "leaf" && last) {
      const back = 1 - turned(leaves[0]);
      onLeft = mix(this.#of(first.low), this.#of(first.low - 1), back);
      onRight = mix(
        this.#of(last.high - 1),
        this.#of(last.high),
        turned(leaves[leaves.length - 1]),
      );
    }
    const straight = (pile: Pile, fraction: number, sign: 1 | -1): Pile =>
      fraction === 0 ? pile : straightenedPile(pile, fraction, sign * this.#width);
    return [straight(left, onLeft, -1), straight(right, onRight, 1)];
  }

  /** Returns the stiffness of leaf `k`, 0 to 1. */
  #of(k: number): number {
    const { hardLeaves, softCover, leaves } = this.#binding;
    if (hardLeaves.has(k)) return 1;
    return softCover && (k === 0 || k === leaves - 1) ? cardStiffness : 0;
  }
}

/** Returns how far a leaf has turned, from 0 on the right to 1 on the left. */
function turned({ positions, columns, rows }: Surface): number {
  const edge = 3 * ((rows >> 1) * columns + columns - 1);
  return Math.atan2(Math.max(positions[edge + 2], 0), positions[edge]) / Math.PI;
}

function mix(from: number, to: number, fraction: number): number {
  const t = Math.min(Math.max((fraction - pressed[0]) / (pressed[1] - pressed[0]), 0), 1);
  return from + (to - from) * t * t * (3 - 2 * t);
}

/** Mixes a leaf's own shape with the plane through its root and the middle of its fore-edge. */
function straightened(surface: Surface, fraction: number, width: number): Surface {
  const { columns, rows } = surface;
  const positions = surface.positions.slice();
  const normals = surface.normals.slice();
  const root = 3 * (rows >> 1) * columns;
  const edge = root + 3 * (columns - 1);
  const [dx, dz] = [positions[edge] - positions[root], positions[edge + 2] - positions[root + 2]];
  const length = Math.hypot(dx, dz) || 1;
  const [cos, sin] = [dx / length, dz / length];
  const foot = positions[1];
  const height = positions[3 * columns * (rows - 1) + 1] - foot;
  for (let row = 0; row < rows; row++) {
    const from = 3 * row * columns;
    const [x0, z0] = [positions[from], positions[from + 2]];
    for (let column = 0; column < columns; column++) {
      const at = from + 3 * column;
      const out = width * columnPlace(column, columns);
      const flat = [x0 + out * cos, foot + (height * row) / (rows - 1), z0 + out * sin];
      const normal = [-sin, 0, cos];
      for (let k = 0; k < 3; k++) {
        positions[at + k] += (flat[k] - positions[at + k]) * fraction;
        normals[at + k] += (normal[k] - normals[at + k]) * fraction;
      }
    }
  }
  return { ...surface, positions, normals };
}

/**
 * Mixes a pile's own shape with straight leaves from the gutter to the height
 * of their fore-edges.
 */
function straightenedPile(pile: Pile, fraction: number, reach: number): Pile {
  const { columns, layers } = pile;
  const curves = pile.curves.slice();
  for (let layer = 0; layer < layers; layer++) {
    const from = 2 * columns * layer;
    const [x0, z0, z1] = [curves[from], curves[from + 1], curves[from + 2 * columns - 1]];
    for (let column = 0; column < columns; column++) {
      const at = from + 2 * column;
      const u = columnPlace(column, columns);
      curves[at] += (x0 + reach * u - curves[at]) * fraction;
      curves[at + 1] += (z0 + (z1 - z0) * u - curves[at + 1]) * fraction;
    }
  }
  return { ...pile, curves };
}
