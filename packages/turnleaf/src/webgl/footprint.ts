/** The shadow on the table of everything that stands on it or hangs over it. */

import { type Surface, surfaceBounds } from "../engine/shapes.ts";
import type { BookPose, BookShape } from "../stage/book_pose.ts";
import { caseSizes } from "../stage/case_sizes.ts";
import type { CaseShape } from "./case_shape.ts";
import type { Ground } from "./ground.ts";
import type { PileShape } from "./pile_shape.ts";

/** Draws the shadow of a book in boards. */
export function shadowOfCase(
  ground: Ground,
  book: BookShape,
  shape: CaseShape,
  left: PileShape,
  right: PileShape,
): void {
  const { rim, joint, board } = caseSizes;
  const reach = book.width + rim - joint;
  const boards = [
    { hinge: shape.frontHinge, angle: shape.frontAngle },
    { hinge: shape.backHinge, angle: shape.backAngle },
  ];
  let [x0, x1] = [Math.min(shape.c[0], shape.d[0]), Math.max(shape.c[0], shape.d[0])];
  let [over0, over1, high] = [0, 0, 0];
  for (const { hinge, angle } of boards) {
    const lift = reach * Math.sin(angle);
    const span = reach * Math.cos(angle);
    // Under a raised board only the pile stands on the table; the board throws a softer shadow.
    const down = Math.max(0, 1 - lift / 0.03) ** 2;
    x0 = Math.min(x0, hinge[0] + span * down);
    x1 = Math.max(x1, hinge[0] + span * down);
    if (lift / 2 > high) {
      high = lift / 2;
      over0 = Math.min(hinge[0], hinge[0] + span);
      over1 = Math.max(hinge[0], hinge[0] + span);
    }
  }
  const [y0, y1] = [-rim, book.height + rim];
  ground.shadow(x0 - 0.001, y0, x1 + 0.001, y1, Math.max(left.top, right.top) + board);
  ground.raise(over0, y0, over1, y1, high);
}

/** Draws the shadow of leaves without boards. */
export function shadowOfLeaves(
  ground: Ground,
  book: BookShape,
  leaves: BookPose["leaves"],
  left: PileShape,
  right: PileShape,
): void {
  let [x0, x1] = [0, 0];
  for (const pile of [left, right]) {
    for (let k = 0; pile.present && k < pile.curves.length; k += 2 * pile.columns) {
      const end = pile.curves[k + 2 * pile.columns - 2];
      x0 = Math.min(x0, end);
      x1 = Math.max(x1, end);
    }
  }
  for (const { positions, columns, rows } of leaves) {
    for (let row = 0; row < rows; row += 4) {
      const at = 3 * (row * columns + columns - 1);
      // A leaf high above the table throws no shadow of its own.
      const low = Math.exp(-Math.max(0, positions[at + 2]) / 0.03);
      x0 = Math.min(x0, positions[at] * low);
      x1 = Math.max(x1, positions[at] * low);
    }
  }
  ground.shadow(x0, 0, x1, book.height, Math.max(left.top, right.top));
}

/** Draws the shadow of a fold-out's flap beside the book; nothing for null. */
export function shadowOfFlap(ground: Ground, book: BookShape, flap: Surface | null): void {
  if (flap === null) {
    ground.raise(0, 0, 0, 0, 0);
    return;
  }
  const { positions, columns } = flap;
  const { low, high } = surfaceBounds(flap);
  const lift = (positions[2] + positions[3 * columns - 1]) / 2;
  ground.raise(low[0], 0, high[0], book.height, lift);
}

/** Draws the shadow of a loose sheet over the table, whose height is given in metres. */
export function shadowOfSheet(ground: Ground, sheet: Surface, table: number): void {
  const { positions } = sheet;
  const { low, high } = surfaceBounds(sheet);
  let sum = 0;
  for (let at = 2; at < positions.length; at += 3) sum += positions[at];
  ground.raise(low[0], low[1], high[0], high[1], (3 * sum) / positions.length - table);
}
