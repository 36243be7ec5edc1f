/**
 * The flap of a fold-out: the part of a wide page beyond its fold, from lying
 * on the page to lying beside the book.
 */

import { columnPlace, type Pile, type Surface } from "../engine/shapes.ts";

/** Where a flap is. */
export interface FlapPlace {
  /** 1 on the page on the right, -1 on the left. */
  readonly sign: 1 | -1;
  /** 0 folded in, 1 lying open. */
  readonly open: number;
  /**
   * Position of the fold, as a fraction of the page from the spine, and the
   * width of the flap, likewise.
   */
  readonly fold: number;
  readonly fraction: number;
}

/** As fine as a leaf in flight, which is drawn in its place. */
const rows = 25;

/** Height of a folded flap over its page, metres. */
const clear = 0.0006;

/** The last part of its way down in which a flap takes the page's shape. */
const settling = 0.3;

/**
 * Returns the flap as a sheet: a row runs from the fold outward.
 *
 * @param pile that the page lies on
 * @param width,height of the book's page, metres
 * @param version of the sheet
 */
export function flapSurface(
  { sign, open, fold, fraction }: FlapPlace,
  pile: Pile,
  width: number,
  height: number,
  version: number,
): Surface {
  const { columns } = pile;
  const positions = new Float32Array(3 * columns * rows);
  const normals = new Float32Array(positions.length);
  const eased = open * open * (3 - 2 * open);
  // From the page's own side over the top to the far side, seen as on the right.
  const angle = Math.PI * (1 - eased);
  const lying = Math.max(0, 1 - eased / settling) ** 2;
  const [hingeX, hingeZ] = placeOn(pile, fold);
  const line = new Float32Array(2 * columns);
  for (let column = 0; column < columns; column++) {
    const out = fraction * columnPlace(column, columns);
    const x = hingeX + sign * width * out * Math.cos(angle);
    const z = hingeZ + clear + width * out * Math.sin(angle);
    const [pageX, pageZ] = placeOn(pile, Math.max(fold - out, 0));
    line[2 * column] = x + (pageX - x) * lying;
    line[2 * column + 1] = z + (pageZ + clear - z) * lying;
  }
  for (let column = 0; column < columns; column++) {
    const [from, to] = [2 * Math.max(column - 1, 0), 2 * Math.min(column + 1, columns - 1)];
    const [dx, dz] = [line[to] - line[from], line[to + 1] - line[from + 1]];
    const length = Math.hypot(dx, dz) || 1;
    for (let row = 0; row < rows; row++) {
      const at = 3 * (row * columns + column);
      positions.set([line[2 * column], (height * row) / (rows - 1), line[2 * column + 1]], at);
      normals.set([-dz / length, 0, dx / length], at);
    }
  }
  return { columns, rows, positions, normals, version };
}

/** Returns x and z of a pile's uppermost page at u, metres. */
function placeOn({ curves, columns }: Pile, u: number): [x: number, z: number] {
  let k = 0;
  while (k + 2 < columns && columnPlace(k + 1, columns) < u) k++;
  const [from, to] = [columnPlace(k, columns), columnPlace(k + 1, columns)];
  const t = (u - from) / (to - from);
  const at = (axis: number): number =>
    curves[2 * k + axis] + (curves[2 * k + 2 + axis] - curves[2 * k + axis]) * t;
  return [at(0), at(1)];
}
