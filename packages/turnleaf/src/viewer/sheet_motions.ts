/** The motions in which the viewer itself moves loose sheets: put aside, torn across, laid down. */

import type { TornSheet, UV } from "../engine/book_engine.ts";
import type { Surface, Vec3 } from "../engine/shapes.ts";
import {
  facesUp,
  middleOf,
  middlePlace,
  partOfPage,
  placeOnPage,
  pointAt,
} from "./sheet_places.ts";
import type { TableArea } from "./table_places.ts";
import { holdsBeside, type PageSize, type TearPath } from "./tear_path.ts";

/** Seconds in which a sheet is put aside. */
export const asideSeconds = 0.6;

/**
 * A sheet torn across by command: how high it is raised for that, so that most of it stays where it
 * lies, and by how much more one side of it, as fractions of its width; seconds of that; the speed
 * at which either side is pulled, page widths a second; and seconds after which what has not torn
 * is cut.
 */
const tearRaised = 0.12;
const tearAskew = 0.08;
const tearRaising = 0.3;
const tearSpeed = 1;
const longestTear = 3;

/** How far a command lays either piece off where it lay on the page, and goes around the other, in page widths. */
const piecesApart = 0.06;
const piecesAround = 0.3;

/** Between which parts of its columns a piece is held that is laid down. */
const laidBetween = [0.2, 0.8] as const;

/** The motion of a command that tears a sheet across. */
export interface TearMotion {
  /** Where the sheet is held, to the right of its path and to the left, and where that was at first. */
  readonly places: readonly [UV, UV];
  readonly starts: readonly [Vec3, Vec3];
  /** The direction from the first to the second, level and of unit length. */
  readonly apart: Vec3;
  /** The sheet as it lay at first. */
  readonly lay: Surface;
  /** Seconds since it began. */
  since: number;
}

/** The motion by which the viewer puts a sheet aside. */
export interface AsideMotion {
  /** Where each of its grabs goes. */
  readonly ways: readonly { readonly from: Vec3; readonly to: Vec3 }[];
  /** How far it goes to a side on its way, metres: pieces that turn back would lie over each other. */
  readonly around: readonly [x: number, y: number];
  /** Fraction of its way that is done. */
  part: number;
}

/** Begins to tear a sheet along a path by command: takes hold of it, as it lies. */
export function beginTear(sheet: TornSheet, path: TearPath, size: PageSize): TearMotion {
  const places = holdsBeside(path, size);
  const { surface } = sheet;
  const [a, b] = places.map((place) => pointAt(surface, place)) as [Vec3, Vec3];
  const long = Math.hypot(b[0] - a[0], b[1] - a[1]) || 1;
  for (const grab of [0, 1] as const) sheet.grab(...places[grab], grab);
  return {
    places,
    starts: [a, b],
    apart: [(b[0] - a[0]) / long, (b[1] - a[1]) / long, 0],
    // What the engine draws is overwritten by the next step.
    lay: { ...surface, positions: surface.positions.slice() },
    since: 0,
  };
}

/** Moves what a command tears on by some seconds. */
export function moveTear(
  sheet: TornSheet,
  motion: TearMotion,
  { width }: PageSize,
  seconds: number,
): void {
  motion.since += seconds;
  const raised = tearRaised * width * Math.min(motion.since / tearRaising, 1);
  const away = tearSpeed * width * Math.max(motion.since - tearRaising, 0);
  for (const grab of [0, 1] as const) {
    const sign = grab === 0 ? -1 : 1;
    const [x, y, z] = motion.starts[grab].map((at, axis) => at + sign * away * motion.apart[axis]);
    sheet.pull([x, y, z + raised + sign * Math.min(away, tearAskew * width)], grab);
  }
  if (motion.since > longestTear) sheet.cut();
}

/** Lays a piece that a command has torn off down where it lay, but for a gap beside the other. */
export function layDown(
  sheet: TornSheet,
  { apart, lay }: TearMotion,
  isSecond: boolean,
  { width }: PageSize,
): AsideMotion {
  const way = (isSecond ? 1 : -1) * width;
  const by = piecesApart * way;
  const { surface } = sheet;
  return {
    ways: laidBetween.map((part, grab) => {
      const place = placeOnPage(surface, [part, 0.5]);
      sheet.grab(...place, grab as 0 | 1);
      const [x, y, z] = pointAt(lay, place);
      return { from: pointAt(surface, place), to: [x + by * apart[0], y + by * apart[1], z] };
    }),
    around: [piecesAround * way * apart[0], piecesAround * way * apart[1]],
    part: 0,
  };
}

/** Begins to put a sheet aside: straight, to a place on the table, at its height. */
export function putAside(
  sheet: TornSheet,
  area: TableArea,
  table: number,
  { width, height }: PageSize,
): AsideMotion {
  const { surface } = sheet;
  const [x, y] = [0, 1].map((axis) => (area.low[axis] + area.high[axis]) / 2);
  const [low, high] = partOfPage(surface);
  const [u, v] = [0, 1].map((axis) => (low[axis] + high[axis]) / 2);
  if (sheet.isCrumpled) {
    sheet.grab(...middlePlace(surface));
    return { ways: [{ from: middleOf(surface), to: [x, y, table] }], around: [0, 0], part: 0 };
  }
  // A page that shows its verso is seen from behind.
  const across = facesUp(surface) ? width : -width;
  const ways = laidBetween.map((part, grab) => {
    const place = placeOnPage(surface, [part, 0.5]);
    sheet.grab(...place, grab as 0 | 1);
    const to = [x + across * (place[0] - u), y + height * (place[1] - v), table] as const;
    return { from: pointAt(surface, place), to };
  });
  return { ways, around: [0, 0], part: 0 };
}

/** Moves a sheet on that is put aside or laid down by some seconds. Returns whether it goes on. */
export function moveAside(sheet: TornSheet, aside: AsideMotion, seconds: number): boolean {
  aside.part = Math.min(aside.part + seconds / asideSeconds, 1);
  const eased = aside.part * aside.part * (3 - 2 * aside.part);
  // Level until it is past the book, then down.
  const sunk = aside.part ** 4;
  const beside = 4 * aside.part * (1 - aside.part);
  for (const [grab, { from, to }] of aside.ways.entries()) {
    const at = (axis: number, part: number) => from[axis] + part * (to[axis] - from[axis]);
    const [x, y] = aside.around.map((way, axis) => at(axis, eased) + beside * way);
    sheet.pull([x, y, at(2, sunk)], grab as 0 | 1);
  }
  return aside.part < 1;
}
