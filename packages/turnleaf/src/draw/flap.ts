/** The flap of a fold-out: the part of a wide page beyond its fold, from lying on the page to lying beside the book. */

import { columnPlace, type Surface } from "../engine/shapes.ts";
import type { PileShape } from "./pile_shape.ts";

/** Where a flap is. */
export interface FlapPose {
  /** The side whose uppermost page it belongs to. */
  readonly side: "left" | "right";
  /** 0 folded in, 1 lying open. */
  readonly open: number;
  /** Where the fold is, share of the page from the spine, and how wide the flap is, likewise. */
  readonly fold: number;
  readonly width: number;
}

const columns = 17;
const rows = 9;

/** A folded flap lies this high over its page, metres. */
const clear = 0.0004;

/** Over this last part of its way down a flap takes the page's shape. */
const settling = 0.3;

let version = 0;

/**
 * The flap as a sheet: a row runs from the fold outward.
 *
 * @param width,height of the book's page, metres
 */
export function flapSurface(
  { side, open, fold, width: share }: FlapPose,
  pile: PileShape,
  width: number,
  height: number,
): Surface {
  const sign = side === "right" ? 1 : -1;
  const positions = new Float32Array(3 * columns * rows);
  const normals = new Float32Array(positions.length);
  const [hingeX, hingeZ] = pile.pointAt(fold);
  const eased = open * open * (3 - 2 * open);
  // From the page's own side over the top to the far side, seen as on the right.
  const angle = Math.PI * (1 - eased);
  const lying = Math.max(0, 1 - eased / settling) ** 2;
  const [cos, sin] = [Math.cos(angle), Math.sin(angle)];
  for (let column = 0; column < columns; column++) {
    const out = share * columnPlace(column, columns);
    let x = hingeX + sign * width * out * cos;
    let z = hingeZ + clear + width * out * sin;
    const [pageX, pageZ] = pile.pointAt(Math.max(fold - out, 0));
    x += (pageX - x) * lying;
    z += (pageZ + clear - z) * lying;
    for (let row = 0; row < rows; row++) {
      const at = 3 * (row * columns + column);
      positions.set([x, (height * row) / (rows - 1), z], at);
    }
  }
  for (let column = 0; column < columns; column++) {
    const [from, to] = [3 * Math.max(column - 1, 0), 3 * Math.min(column + 1, columns - 1)];
    const [dx, dz] = [positions[to] - positions[from], positions[to + 2] - positions[from + 2]];
    const length = Math.hypot(dx, dz) || 1;
    for (let row = 0; row < rows; row++) {
      normals.set([-dz / length, 0, dx / length], 3 * (row * columns + column));
    }
  }
  return { columns, rows, positions, normals, version: ++version };
}
