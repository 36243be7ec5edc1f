/**
 * Sheets that were torn out: pointers carry them, they fall, and they lie on the table beside the
 * book. One that is let go over the book is put aside, so that its pages stay readable. Two pointers
 * that pull one apart, or a command, tear it across: each piece is a sheet then.
 */

import type { TornSheet, UV } from "../engine/book_engine.ts";
import { columnAt, type Ray, type Surface, surfaceBounds, type Vec3 } from "../engine/shapes.ts";
import { type Hit, pickSurface } from "../picking/pick.ts";
import { onPlane } from "../picking/reach.ts";
import type { PagePicture } from "../sources/page_source.ts";
import type { BookShape } from "../stage/book_pose.ts";
import { tableHeight } from "../stage/case_sizes.ts";
import type { Dragged, LooseHit } from "./drag.ts";
import type { Rebinder } from "./rebinder.ts";
import { holdsBeside, isOnParted, type PageSize, pathBetween, type TearPath } from "./tear_path.ts";

/** Sheets that are kept at most: the one torn out first is taken away for the next. */
const mostSheets = 8;

/** Height over the table at which a pointer carries a sheet, as a fraction of its width. */
const carried = 0.4;

/**
 * Seconds in which a sheet is put aside, and how far beside the pages it then lies, in page widths:
 * more than contact keeps it away from their block.
 */
const asideSeconds = 0.6;
const apart = 0.2;

/** How far beyond their distance on the paper two pointers pull a sheet apart before it tears, in page widths. */
const taut = 0.05;

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

/** What a sheet shows. */
export interface SheetPictures {
  readonly recto: PagePicture | null;
  readonly verso: PagePicture | null;
}

/** A grab of a sheet by a pointer. */
interface Hold {
  /** The place that it holds. */
  readonly place: UV;
  /** Where it pulls; null before it was moved. */
  at: Vec3 | null;
  /** What it holds: a piece, once the sheet is torn through. */
  sheet: LooseSheet;
}

/** How a sheet is being torn across. */
interface Tear {
  readonly path: TearPath;
  /** What a command does; null if pointers tear it. */
  readonly command: TearMotion | null;
}

/** The motion of a command that tears a sheet across. */
interface TearMotion {
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

/** One loose sheet, or a piece of one. */
interface LooseSheet {
  /** The leaf's, which its pieces have in common. */
  readonly id: number;
  readonly sheet: TornSheet;
  readonly pictures: SheetPictures;
  /** The pointers that hold it, by the number of their grab. */
  holds: [Hold | null, Hold | null];
  /** How it is put aside; null if it is not. */
  aside: AsideMotion | null;
  /** How it is being torn across; null if it is not. */
  tear: Tear | null;
  /** Whether it is pressed into a ball, or falls after that. */
  isCrumpling: boolean;
}

/** The motion by which the viewer puts a sheet aside. */
interface AsideMotion {
  /** Where each of its grabs goes. */
  readonly ways: readonly { readonly from: Vec3; readonly to: Vec3 }[];
  /** How far it goes to a side on its way, metres: pieces that turn back would lie over each other. */
  readonly around: readonly [x: number, y: number];
  /** Fraction of its way that is done. */
  part: number;
}

/** The dependencies of loose sheets. */
export interface LooseSheetHooks {
  /** Called when something moves. */
  readonly moved: () => void;
  /** Returns the line of sight through a place on the canvas. */
  readonly rayAt: (x: number, y: number) => Ray;
  /** Returns whether a point of book space is seen on the canvas. */
  readonly isSeen: (point: Vec3) => boolean;
  /** Called with the work done in crumpling sheets, J. */
  readonly heard: (work: number) => void;
  /** Gives back a picture that is shown no more. */
  readonly drop: (picture: PagePicture) => void;
}

/** The loose sheets of one viewer, in the order in which they were torn out. */
export class LooseSheetPile {
  readonly #rebinder: Rebinder;
  readonly #hooks: LooseSheetHooks;
  #sheets: LooseSheet[] = [];

  constructor(rebinder: Rebinder, hooks: LooseSheetHooks) {
    this.#rebinder = rebinder;
    this.#hooks = hooks;
  }

  /** What is drawn of them. */
  get surfaces(): readonly Surface[] {
    return this.#sheets.map(({ sheet }) => sheet.surface);
  }

  /** What each of them shows. */
  get pictures(): readonly SheetPictures[] {
    return this.#sheets.map(({ pictures }) => pictures);
  }

  /**
   * Adds a sheet that is off.
   *
   * @param id by which `remove` knows it
   */
  add(id: number, sheet: TornSheet, pictures: SheetPictures): void {
    this.#sheets.push(loose(id, sheet, pictures));
    while (this.#sheets.length > mostSheets) this.remove(this.#sheets[0].id);
  }

  /** Takes a sheet away, with all of its pieces. */
  remove(id: number): void {
    for (const one of this.#sheets.filter((sheet) => sheet.id === id)) this.#discard(one);
  }

  /** Takes all of them away. */
  clear(): void {
    for (const one of [...this.#sheets]) this.#discard(one);
  }

  /** Takes a sheet or a piece away. */
  #discard(gone: LooseSheet): void {
    this.#sheets = this.#sheets.filter((sheet) => sheet !== gone);
    gone.sheet.destroy();
    const isLast = this.#sheets.every(({ id }) => id !== gone.id);
    for (const picture of [gone.pictures.recto, gone.pictures.verso]) {
      if (picture && isLast) this.#hooks.drop(picture);
    }
    this.#hooks.moved();
  }

  /** Steps what moves by whole ticks, at most `moveTicks`. Returns whether anything goes on moving. */
  step(ticks: number): boolean {
    const { tearing, tick } = this.#rebinder.bound.engine;
    for (const one of [...this.#sheets]) {
      if (one.sheet.isAsleep || ticks === 0) continue;
      this.#move(one, ticks * tick);
      tearing?.step(one.sheet, ticks);
      const work = one.sheet.takeWork();
      if (work > 0) this.#hooks.heard(work);
      if (one.tear && !one.sheet.holdsAcross) this.#part(one, one.tear);
      if (one.isCrumpling && one.sheet.isAsleep) this.#crumpled(one);
    }
    return this.#sheets.some(({ sheet }) => !sheet.isAsleep);
  }

  /** Returns the nearest of them on a line of sight, or null. */
  pick(ray: Ray): (Hit & { readonly on: LooseHit }) | null {
    const { columns } = this.#rebinder.bound.engine;
    let best: (Hit & { readonly on: LooseHit }) | null = null;
    for (const one of this.#sheets) {
      const hit = pickSurface(ray, one.sheet.surface, columns);
      if (hit === null || (best && best.distance <= hit.distance)) continue;
      const place = [hit.u, hit.v] as const;
      best = { ...hit, on: { isLoose: true, grab: () => this.#grab(one, place) } };
    }
    return best;
  }

  /** Grabs a sheet at (u, v). Returns what moves it with a pointer. */
  grab(id: number, u: number, v: number): Dragged {
    const one = this.#sheets.find((sheet) => sheet.id === id);
    return one ? this.#grab(one, [u, v]) : noDrag;
  }

  /** Crumples the sheet that was torn out last and is not crumpled. Returns whether there is one. */
  crumple(): boolean {
    return this.#crumple(this.#sheets.findLast(isWhole));
  }

  /**
   * Tears the sheet across that was torn out last and is neither crumpled nor torn, from (u, v) to
   * (u, v) on its page, each on an edge. Returns whether there is one that can be torn so.
   */
  tearAcross(path: (isRectoUp: boolean) => TearPath): boolean {
    const one = this.#sheets.findLast(isWhole);
    return one !== undefined && this.#tearByCommand(one, path(facesUp(one.sheet.surface)));
  }

  /** Puts a sheet aside that is held over the book. */
  putAside(id: number): void {
    const one = this.#sheets.find((sheet) => sheet.id === id);
    if (one) this.#letGo(one, null);
  }

  #grab(one: LooseSheet, place: UV): Dragged {
    const grab = one.holds.indexOf(null);
    const isBall = one.sheet.isCrumpled;
    if (grab < 0 || one.tear?.command || (isBall && grab > 0)) return noDrag;
    const hold: Hold = { place, at: null, sheet: one };
    one.aside = null;
    one.isCrumpling = false;
    one.holds[grab] = hold;
    one.sheet.grab(...place, grab as 0 | 1);
    return {
      canFlick: false,
      move: (x, y) => {
        hold.at = onPlane(this.#hooks.rayAt(x, y), this.#carried);
        this.#pull(hold);
        this.#hooks.moved();
      },
      release: () => this.#release(hold),
      doubleTap: () => {
        this.#crumple(hold.sheet);
      },
    };
  }

  /** Pulls a sheet to where its pointers are; two that pull it taut begin to tear it. */
  #pull(hold: Hold): void {
    const one = hold.sheet;
    if (!this.#sheets.includes(one) || hold.at === null) return;
    const grab = one.holds.indexOf(hold);
    if (grab < 0) return;
    one.sheet.pull(hold.at, grab as 0 | 1);
    const [first, second] = one.holds;
    if (!first?.at || !second?.at || one.tear) return;
    const size = this.#size;
    const [a, b] = [first.place, second.place];
    const flat = Math.hypot((a[0] - b[0]) * size.width, (a[1] - b[1]) * size.height);
    if (distance(first.at, second.at) < flat + taut * size.width) return;
    const path = pathBetween(a, b, size);
    if (path === null || !one.sheet.tearAcross(...path)) return;
    one.tear = { path, command: null };
    this.#holdAnew(one);
  }

  /** A pointer lets go of what it holds. */
  #release(hold: Hold): void {
    const one = hold.sheet;
    const grab = one.holds.indexOf(hold);
    if (!this.#sheets.includes(one) || grab < 0) return;
    one.holds[grab] = null;
    if (one.holds.every((other) => other === null)) this.#letGo(one, hold.at);
    else this.#holdAnew(one);
  }

  /** Has the pointers of a sheet hold it, and nothing else. */
  #holdAnew({ sheet, holds }: LooseSheet): void {
    sheet.release();
    for (const grab of [0, 1] as const) {
      const hold = holds[grab];
      if (hold === null) continue;
      sheet.grab(...hold.place, grab);
      if (hold.at) sheet.pull(hold.at, grab);
    }
  }

  #crumple(one: LooseSheet | undefined): boolean {
    if (!one?.sheet.crumple()) return false;
    one.aside = null;
    one.isCrumpling = true;
    one.holds = [null, null];
    this.#hooks.moved();
    return true;
  }

  /** A ball lies where it fell: over the pages it is put aside. */
  #crumpled(one: LooseSheet): void {
    one.isCrumpling = false;
    if (this.#isOverBook(one)) this.#letGo(one, null);
  }

  #tearByCommand(one: LooseSheet, path: TearPath): boolean {
    if (!one.sheet.tearAcross(...path)) return false;
    const size = this.#size;
    const places = holdsBeside(path, size);
    const { surface } = one.sheet;
    const [a, b] = places.map((place) => pointAt(surface, place)) as [Vec3, Vec3];
    const long = Math.hypot(b[0] - a[0], b[1] - a[1]) || 1;
    one.aside = null;
    one.holds = [null, null];
    one.tear = {
      path,
      command: {
        places,
        starts: [a, b],
        apart: [(b[0] - a[0]) / long, (b[1] - a[1]) / long, 0],
        // What the engine draws is overwritten by the next step.
        lay: { ...surface, positions: surface.positions.slice() },
        since: 0,
      },
    };
    for (const grab of [0, 1] as const) one.sheet.grab(...places[grab], grab);
    this.#hooks.moved();
    return true;
  }

  /** Moves what a command tears on. */
  #moveTear({ sheet }: LooseSheet, motion: TearMotion, seconds: number): void {
    motion.since += seconds;
    const { width } = this.#rebinder.bound.shape;
    const raised = tearRaised * width * Math.min(motion.since / tearRaising, 1);
    const away = tearSpeed * width * Math.max(motion.since - tearRaising, 0);
    for (const grab of [0, 1] as const) {
      const sign = grab === 0 ? -1 : 1;
      const [x, y, z] = motion.starts[grab].map(
        (at, axis) => at + sign * away * motion.apart[axis],
      );
      sheet.pull([x, y, z + raised + sign * Math.min(away, tearAskew * width)], grab);
    }
    if (motion.since > longestTear) sheet.cut();
  }

  /** A sheet is torn through: each piece goes on by itself, held by what held it. */
  #part(one: LooseSheet, { path, command }: Tear): void {
    const parted = one.sheet.part();
    one.tear = null;
    if (parted === null) return;
    const size = this.#size;
    const other = loose(one.id, parted, one.pictures);
    this.#sheets.splice(this.#sheets.indexOf(one) + 1, 0, other);
    const holds = one.holds.filter((hold) => hold !== null);
    const pieces = [one, other] as const;
    for (const [k, piece] of pieces.entries()) {
      const own = holds.filter(({ place }) => isOnParted(place, path, size) === (k === 1));
      for (const hold of own) hold.sheet = piece;
      piece.holds = [own[0] ?? null, own[1] ?? null];
      this.#holdAnew(piece);
      // The second hold is on the left of the way in which it is torn.
      const isSecond = command && isOnParted(command.places[1], path, size) === (k === 1);
      if (command) this.#layDown(piece, command, isSecond === true);
      else if (own.length === 0) this.#letGo(piece, null);
    }
    while (this.#sheets.length > mostSheets) this.remove(this.#sheets[0].id);
    // Both show their pictures, each by its place in the list.
    this.#hooks.moved();
  }

  /** Lays a piece that a command has torn off down where it lay, but for a gap beside the other. */
  #layDown(piece: LooseSheet, { apart, lay }: TearMotion, isSecond: boolean): void {
    const way = (isSecond ? 1 : -1) * this.#size.width;
    const by = piecesApart * way;
    const { surface } = piece.sheet;
    piece.aside = {
      ways: laidBetween.map((part, grab) => {
        const place = placeOnPage(surface, [part, 0.5]);
        piece.sheet.grab(...place, grab as 0 | 1);
        const [x, y, z] = pointAt(lay, place);
        return { from: pointAt(surface, place), to: [x + by * apart[0], y + by * apart[1], z] };
      }),
      around: [piecesAround * way * apart[0], piecesAround * way * apart[1]],
      part: 0,
    };
  }

  #isOverBook({ sheet }: LooseSheet): boolean {
    const { width, height } = this.#rebinder.bound.shape;
    const { low, high } = surfaceBounds(sheet.surface);
    return low[0] < width && high[0] > -width && low[1] < height && high[1] > 0;
  }

  get #carried(): number {
    const { shape } = this.#rebinder.bound;
    return tableHeight(shape) + shape.thickness + carried * shape.width;
  }

  get #size(): PageSize {
    return this.#rebinder.bound.shape;
  }

  /**
   * Lets a sheet fall: where it hangs, or beside the book if that is over the book.
   *
   * @param at where a pointer held it; null if none did
   */
  #letGo(one: LooseSheet, at: Vec3 | null): void {
    const { shape } = this.#rebinder.bound;
    const middle = middleOf(one.sheet.surface);
    one.holds = [null, null];
    one.sheet.release();
    if (!this.#isOverBook(one)) {
      // What was thrown out of sight is gone.
      if (at && !this.#hooks.isSeen(at) && !this.#hooks.isSeen(middle)) this.#discard(one);
    } else {
      const to = asideOf(shape, at ?? middle);
      one.sheet.grab(...middlePlace(one.sheet.surface));
      one.aside = { ways: [{ from: middle, to }], around: [0, 0], part: 0 };
    }
    this.#hooks.moved();
  }

  /** Moves a sheet on that is put aside or torn by a command. */
  #move(one: LooseSheet, seconds: number): void {
    if (one.tear?.command) this.#moveTear(one, one.tear.command, seconds);
    const { aside } = one;
    if (aside === null) return;
    aside.part = Math.min(aside.part + seconds / asideSeconds, 1);
    const eased = aside.part * aside.part * (3 - 2 * aside.part);
    // Level until it is past the book, then down.
    const sunk = aside.part ** 4;
    const beside = 4 * aside.part * (1 - aside.part);
    for (const [grab, { from, to }] of aside.ways.entries()) {
      const at = (axis: number, part: number) => from[axis] + part * (to[axis] - from[axis]);
      const [x, y] = aside.around.map((way, axis) => at(axis, eased) + beside * way);
      one.sheet.pull([x, y, at(2, sunk)], grab as 0 | 1);
    }
    if (aside.part < 1) return;
    one.aside = null;
    one.sheet.release();
  }
}

/** What moves nothing. */
const noDrag: Dragged = { canFlick: false, move: () => {}, release: () => {} };

function loose(id: number, sheet: TornSheet, pictures: SheetPictures): LooseSheet {
  const free = { holds: [null, null] as LooseSheet["holds"], aside: null, tear: null };
  return { id, sheet, pictures, ...free, isCrumpling: false };
}

/** Returns whether a sheet is neither crumpled nor torn across. */
function isWhole({ sheet }: LooseSheet): boolean {
  return sheet.surface.creased === undefined;
}

/**
 * Returns where the middle of a sheet lies that is put aside: on the screen left or right of the
 * book, on the side of a place.
 */
function asideOf(shape: BookShape, [x, y]: Vec3): Vec3 {
  const { width, height, rim, quarterTurned } = shape;
  const [table, beyond] = [tableHeight(shape), rim + apart * width];
  if (!quarterTurned) return [(x < 0 ? -1 : 1) * (1.5 * width + beyond), height / 2, table];
  return [
    (Math.sign(x) * width) / 2,
    height / 2 + (y < height / 2 ? -1 : 1) * (height + beyond),
    table,
  ];
}

/** Returns u and v on the page of a place on a surface, in parts of its rows and columns if these are even. */
function placeOnPage({ creased, columns, rows }: Surface, [u, v]: UV): UV {
  if (!creased) return [u, v];
  const point = Math.round(v * (rows - 1)) * columns + Math.round(u * (columns - 1));
  return [creased.places[2 * point], creased.places[2 * point + 1]];
}

/** Returns where the point of a torn sheet is that lies next to a place on the page. */
function pointAt({ positions, creased }: Surface, [u, v]: UV): Vec3 {
  const places = creased?.places ?? [];
  let [best, least] = [0, Infinity];
  for (let point = 0; 2 * point < places.length; point++) {
    const away = Math.hypot(places[2 * point] - u, places[2 * point + 1] - v);
    if (away < least) [best, least] = [point, away];
  }
  return [positions[3 * best], positions[3 * best + 1], positions[3 * best + 2]];
}

/** Returns the place on its page of a sheet's middle. */
function middlePlace(surface: Surface): UV {
  return placeOnPage(surface, [0.5, 0.5]);
}

/** Returns whether a sheet shows its recto from above. */
function facesUp({ normals }: Surface): boolean {
  let sum = 0;
  for (let at = 2; at < normals.length; at += 3) sum += normals[at];
  return sum >= 0;
}

function distance(a: Vec3, b: Vec3): number {
  return Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

/** Returns the middle of a surface. */
function middleOf({ positions, columns, rows, creased }: Surface): Vec3 {
  const column = creased ? columns >> 1 : Math.round(columnAt(0.5, columns));
  const at = 3 * ((rows >> 1) * columns + column);
  return [positions[at], positions[at + 1], positions[at + 2]];
}
