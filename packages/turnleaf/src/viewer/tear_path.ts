/** Along which line a page is torn across, where two grabs hold it for that, and which piece is whose. */

import type { UV } from "../engine/book_engine.ts";

/** Width and height of a page, metres. */
export interface PageSize {
  readonly width: number;
  readonly height: number;
}

/** A line across a page, from where its tear begins. */
export type TearPath = readonly [from: UV, to: UV];

/** How far a command holds a page from where its tear begins, along the path and beside it, in page widths. */
const holdAlong = 0.14;
const holdBeside = 0.24;

type Metres = readonly [x: number, y: number];

const metres = ([u, v]: UV, { width, height }: PageSize): Metres => [u * width, v * height];

/** Returns the direction of a path, of unit length. */
function direction([from, to]: TearPath, size: PageSize): Metres {
  const [a, b] = [metres(from, size), metres(to, size)];
  const long = Math.hypot(b[0] - a[0], b[1] - a[1]);
  return [(b[0] - a[0]) / long, (b[1] - a[1]) / long];
}

/**
 * Returns the path along which two grabs tear a page that they pull apart: where paper between
 * them is pulled most, across the line between them in its middle. It begins at the edge that is
 * nearer. Null if they hold one place.
 */
export function pathBetween(a: UV, b: UV, size: PageSize): TearPath | null {
  const [[ax, ay], [bx, by]] = [metres(a, size), metres(b, size)];
  const apart = Math.hypot(bx - ax, by - ay);
  if (apart === 0) return null;
  const middle = [(ax + bx) / 2, (ay + by) / 2] as const;
  const along = [(ay - by) / apart, (bx - ax) / apart] as const;
  const ends = [-1, 1].map((sign) => {
    const reaches = [size.width, size.height].map((side, axis) => {
      const way = sign * along[axis];
      return way === 0 ? Infinity : ((way > 0 ? side : 0) - middle[axis]) / way;
    });
    return { sign, reach: Math.min(...reaches) };
  });
  ends.sort((one, other) => one.reach - other.reach);
  const [from, to] = ends.map(({ sign, reach }): UV => {
    const [x, y] = middle.map((at, axis) => at + sign * reach * along[axis]);
    return [x / size.width, y / size.height];
  });
  return [from, to];
}

/** Returns where a command holds a page to tear it: to the right of its path, and to the left. */
export function holdsBeside(path: TearPath, size: PageSize): readonly [UV, UV] {
  const [x, y] = metres(path[0], size);
  const [along, up] = direction(path, size);
  const [ahead, beside] = [holdAlong * size.width, holdBeside * size.width];
  const hold = (sign: 1 | -1): UV => {
    const place = [x + ahead * along - sign * beside * up, y + ahead * up + sign * beside * along];
    return [
      Math.min(Math.max(place[0] / size.width, 0), 1),
      Math.min(Math.max(place[1] / size.height, 0), 1),
    ];
  };
  return [hold(-1), hold(1)];
}

/**
 * Returns whether a place is on the piece that the engine parts: on the left of the path, which it
 * follows toward rising u, or toward rising v if it is steeper.
 */
export function isOnParted(place: UV, path: TearPath, size: PageSize): boolean {
  const [along, up] = direction(path, size);
  const [x, y] = metres(place, size);
  const [fromX, fromY] = metres(path[0], size);
  const isLeft = along * (y - fromY) - up * (x - fromX) > 0;
  const isBackward = Math.abs(up) > Math.abs(along) ? up < 0 : along < 0;
  return isLeft !== isBackward;
}
