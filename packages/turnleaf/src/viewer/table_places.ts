/** Where loose sheets are put beside the book, and from where both are seen. Pure arithmetic. */

import type { Vec3 } from "../engine/shapes.ts";
import type { PageSize } from "../sources/page_source.ts";
import type { BookShape } from "../stage/book_pose.ts";
import type { Place } from "../stage/book_stage.ts";
import { tableHeight } from "../stage/case_sizes.ts";
import { wholeBook, type Zoom } from "../stage/zoom.ts";

/** A rectangle on the table, in book space, metres. */
export interface TableArea {
  readonly low: readonly [x: number, y: number];
  readonly high: readonly [x: number, y: number];
}

/** How far beside the book a sheet is put, in page widths: more than contact keeps it away from its block. */
const apart = 0.2;

/** How much of a sheet stays in sight while the book is read, in page widths: enough to take it by. */
const inReach = apart / 2;

/** What stays free around what is wholly in sight, as a fraction of what is seen, if as much does around the book. */
const free = 0.02;

/** The level of a view that differs from that of the whole book by its middle alone. */
const besideWhole = 1 - 1e-5;

const axes = [0, 1] as const;

/**
 * Returns what is seen of the table where a view shows the whole book.
 *
 * @param seen where points of book space are on the canvas, while the book lies open
 * @param canvas its size, CSS pixels
 */
export function seenTable(
  shape: BookShape,
  seen: (point: Vec3) => Place,
  canvas: PageSize,
): TableArea {
  const table = tableHeight(shape);
  const { width, height } = shape;
  const [at, across, along] = [
    seen([0, 0, table]),
    seen([width, 0, table]),
    seen([0, height, table]),
  ];
  const [a, b] = [(across.x - at.x) / width, (along.x - at.x) / height];
  const [c, d] = [(across.y - at.y) / width, (along.y - at.y) / height];
  const corners = [0, canvas.width].flatMap((x) =>
    [0, canvas.height].map((y) => {
      const [right, down] = [x - at.x, y - at.y];
      const by = a * d - b * c;
      return [(d * right - b * down) / by, (a * down - c * right) / by] as const;
    }),
  );
  return areaAround(corners.map((corner) => ({ low: corner, high: corner })));
}

/** Returns where the book lies on the table; of one whose pages are read one by one, that page alone. */
export function bookOnTable({ width, height, thickness, rim, alone }: BookShape): TableArea {
  // The boards of an open book lie apart by half of its thickness on either side.
  const reach = width + rim + (alone === 0 ? thickness / 2 : 0);
  return {
    low: [alone === 1 ? 0 : -reach, -rim],
    high: [alone === -1 ? 0 : reach, height + rim],
  };
}

/**
 * Returns where something is put aside: beside the book where it is seen, with what lies there
 * already, from the least distance; of such places the one nearest to where it was.
 *
 * @param size its extent along the spine's normal and the spine, metres
 * @param others where others lie
 * @param at where it was held, or its middle
 * @param seen what is seen of the table where a view shows the whole book
 */
export function placeAside(
  shape: BookShape,
  size: readonly [x: number, y: number],
  others: readonly TableArea[],
  at: readonly number[],
  seen: TableArea,
): TableArea {
  const { width, height, alone } = shape;
  const book = bookOnTable(shape);
  // What lies beyond the spine of a page that stands alone is not seen.
  const sideways = [-1, 1].filter((sign) => sign * alone >= 0);
  const side = alone || (at[0] < 0 ? -1 : 1);
  const beyond = (sign: number, axis: 0 | 1) =>
    (sign < 0 ? book.low : book.high)[axis] + sign * (apart * width + size[axis] / 2);
  const middles = [
    ...sideways.map((sign) => [beyond(sign, 0), height / 2] as const),
    ...[-1, 1].map((sign) => [(side * width) / 2, beyond(sign, 1)] as const),
  ];
  let [best, highest, least] = [areaOf(middles[0], size), 0, Infinity];
  for (const middle of middles) {
    const area = areaOf(middle, size);
    const { level } = viewWith(shape, [...others, area], seen);
    const away = Math.hypot(middle[0] - at[0], middle[1] - at[1]);
    if (level < highest || (level === highest && away >= least)) continue;
    [best, highest, least] = [area, level, away];
  }
  return best;
}

/**
 * Returns the view nearest to that of the whole book that shows with it what lies on the table.
 *
 * @param seen what is seen of the table where a view shows the whole book
 */
export function viewWith(shape: BookShape, areas: readonly TableArea[], seen: TableArea): Zoom {
  const sides = axes.map((axis) => seen.high[axis] - seen.low[axis]);
  const edge = Math.min(free, shape.margin);
  const all = areaAround([bookOnTable(shape), ...areas]);
  const [low, high] = [
    axes.map((axis) => all.low[axis] - edge * sides[axis]),
    axes.map((axis) => all.high[axis] + edge * sides[axis]),
  ];
  const isSeen = axes.every((axis) => low[axis] >= seen.low[axis] && high[axis] <= seen.high[axis]);
  if (isSeen) return wholeBook;
  const levels = axes.map((axis) => sides[axis] / (high[axis] - low[axis]));
  const level = Math.min(...levels, besideWhole);
  const [x, y] = axes.map((axis) => {
    const half = sides[axis] / level / 2;
    return within((seen.low[axis] + seen.high[axis]) / 2, high[axis] - half, low[axis] + half);
  });
  return { level, x, y };
}

/** Returns what of an area stays in sight while the book is read: what is nearest to the book. */
export function reachOf(shape: BookShape, { low, high }: TableArea): TableArea {
  const book = [0, shape.height / 2];
  const sides = axes.map((axis) => Math.min(inReach * shape.width, high[axis] - low[axis]));
  const [x, y] = axes.map((axis) =>
    within(book[axis], low[axis] + sides[axis] / 2, high[axis] - sides[axis] / 2),
  );
  return areaOf([x, y], [sides[0], sides[1]]);
}

function areaOf(
  [x, y]: readonly [number, number],
  [wide, high]: readonly [number, number],
): TableArea {
  return { low: [x - wide / 2, y - high / 2], high: [x + wide / 2, y + high / 2] };
}

function areaAround(areas: readonly TableArea[]): TableArea {
  const [x, y] = axes.map((axis) => [
    Math.min(...areas.map(({ low }) => low[axis])),
    Math.max(...areas.map(({ high }) => high[axis])),
  ]);
  return { low: [x[0], y[0]], high: [x[1], y[1]] };
}

function within(value: number, low: number, high: number): number {
  return Math.min(Math.max(value, low), high);
}
