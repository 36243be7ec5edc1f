/**
 * Sheets that were torn out: pointers carry them, they fall, and they lie on the table beside the
 * book. One that is let go over the book is put aside, so that its pages stay readable. Two pointers
 * that pull one apart, or a command, tear it across: each piece is a sheet then. The camera steps back
 * so far that they are seen whole until the reader goes on, and within reach from then on.
 */

import type { TornSheet, UV } from "../engine/book_engine.ts";
import { type Ray, type Surface, surfaceBounds, type Vec3 } from "../engine/shapes.ts";
import { type Hit, pickSurface } from "../picking/pick.ts";
import { onPlane } from "../picking/reach.ts";
import type { PagePicture } from "../sources/page_source.ts";
import { tableHeight } from "../stage/case_sizes.ts";
import { wholeBook, type Zoom } from "../stage/zoom.ts";
import type { Dragged, LooseHit } from "./drag.ts";
import type { Rebinder } from "./rebinder.ts";
import {
  type AsideMotion,
  asideSeconds,
  beginTear,
  layDown,
  moveAside,
  moveTear,
  putAside,
  type TearMotion,
} from "./sheet_motions.ts";
import { facesUp, middleOf, partOfPage, pointAt } from "./sheet_places.ts";
import { placeAside, reachOf, type TableArea, viewWith } from "./table_places.ts";
import { isOnParted, type PageSize, pathBetween, type TearPath } from "./tear_path.ts";

/** Sheets that are kept at most: the one torn out first is taken away for the next. */
const mostSheets = 8;

/** Height over the table at which a pointer carries a sheet, as a fraction of its width. */
const carried = 0.4;

/** How far beyond their distance on the paper two pointers pull a sheet apart before it tears, in page widths. */
const taut = 0.05;

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
  /** Where it was put aside, or will be; null if it was moved since. */
  area: TableArea | null;
  /** How it is being torn across; null if it is not. */
  tear: Tear | null;
  /** Whether it is pressed into a ball, or falls after that. */
  isCrumpling: boolean;
}

/** The dependencies of loose sheets. */
export interface LooseSheetHooks {
  /** Called when something moves. */
  readonly moved: () => void;
  /** Returns the line of sight through a place on the canvas. */
  readonly rayAt: (x: number, y: number) => Ray;
  /** Returns whether a point of book space is seen on the canvas. */
  readonly isSeen: (point: Vec3) => boolean;
  /** Returns what is seen of the table where a view shows the whole book. */
  readonly seenTable: () => TableArea;
  /** Sets what is shown at zoom level 1, in so many seconds. */
  readonly showWhole: (whole: Zoom, seconds: number) => void;
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
  /** Whether they are looked at, and are seen whole; else the book is, and they are within reach. */
  #isLookedAt = false;
  /** Whether tearing and crumpling have been rehearsed. */
  #isRehearsed = false;

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
    this.#isLookedAt = true;
    while (this.#sheets.length > mostSheets) this.remove(this.#sheets[0].id);
  }

  /** Takes a sheet away, with all of its pieces. */
  remove(id: number): void {
    for (const one of this.#sheets.filter((sheet) => sheet.id === id)) this.#discard(one);
  }

  /** Takes all of them away. */
  clear(): void {
    for (const one of this.#sheets) this.#free(one);
  }

  /** Takes a sheet or a piece away; what lay upon it falls. */
  #discard(gone: LooseSheet): void {
    const { tearing } = this.#rebinder.bound.engine;
    tearing?.wakeUpon(
      gone.sheet,
      this.#sheets.map(({ sheet }) => sheet),
    );
    this.#free(gone);
  }

  #free(gone: LooseSheet): void {
    this.#sheets = this.#sheets.filter((sheet) => sheet !== gone);
    gone.sheet.destroy();
    const isLast = this.#sheets.every(({ id }) => id !== gone.id);
    for (const picture of [gone.pictures.recto, gone.pictures.verso]) {
      if (picture && isLast) this.#hooks.drop(picture);
    }
    this.look();
    this.#hooks.moved();
  }

  /** Call it when the reader goes on with the book: they are only within reach from then on. */
  readOn(): void {
    this.#isLookedAt = false;
    this.look();
  }

  /**
   * Has the camera show them, as they lie or will.
   *
   * @param seconds duration; 0 for at once
   */
  look(seconds: number = asideSeconds): void {
    const { shape } = this.#rebinder.bound;
    if (this.#sheets.length === 0) {
      this.#hooks.showWhole(wholeBook, seconds);
      return;
    }
    // Under a pointer that carries a sheet the view stays as it is.
    const isHeld = this.#sheets.some(({ holds }) => holds.some((hold) => hold !== null));
    if (isHeld && seconds > 0) return;
    const areas = this.#sheets.map(areaOf);
    const shown = this.#isLookedAt ? areas : areas.map((area) => reachOf(shape, area));
    this.#hooks.showWhole(viewWith(shape, shown, this.#hooks.seenTable()), seconds);
  }

  /** One is moved from where it lies, or was being put: it is looked at, and the camera shows all of them whole. */
  #takeUp(one: LooseSheet): void {
    one.aside = null;
    one.area = null;
    this.#isLookedAt = true;
    this.look();
  }

  /** Steps what moves by whole ticks, at most two. Returns whether anything goes on moving. */
  step(ticks: number): boolean {
    const { tearing, tick } = this.#rebinder.bound.engine;
    const moving = ticks === 0 ? [] : this.#sheets.filter(({ sheet }) => !sheet.isAsleep);
    for (const one of moving) this.#move(one, ticks * tick);
    if (moving.length > 0) {
      tearing?.stepTogether(
        this.#sheets.map(({ sheet }) => sheet),
        ticks,
      );
    }
    for (const one of moving) {
      const work = one.sheet.takeWork();
      if (work > 0) this.#hooks.heard(work);
      if (one.tear && !one.sheet.holdsAcross) this.#part(one, one.tear);
      if (one.isCrumpling && one.sheet.isAsleep) this.#crumpled(one);
      else if (one.sheet.isAsleep) this.look();
    }
    const moves = this.#sheets.some(({ sheet }) => !sheet.isAsleep);
    if (!moves && this.whole !== null) this.#rehearse();
    return moves;
  }

  /** Has the engine tear and crumple once unseen, part by part while nothing else is to be done, before a reader does. */
  #rehearse(): void {
    const { tearing } = this.#rebinder.bound.engine;
    if (this.#isRehearsed || !tearing) return;
    this.#isRehearsed = true;
    const parts = tearing.rehearse();
    const next = (): void => {
      if (!parts.next().done) whenIdle(next);
    };
    whenIdle(next);
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

  /** Those that are neither crumpled nor torn across: one is flat, all are folded, or null for none. */
  get whole(): "flat" | "folded" | null {
    if (this.#sheets.some(isFlat)) return "flat";
    return this.#sheets.some(isWhole) ? "folded" : null;
  }

  /** Crumples the sheet that was torn out last and is not crumpled. Returns whether there is one. */
  crumple(): boolean {
    return this.#crumple(this.#sheets.findLast(isWhole));
  }

  /**
   * Tears the sheet across that was torn out last and is neither crumpled, torn nor folded, from (u, v) to
   * (u, v) on its page, each on an edge. Returns whether there is one that can be torn so.
   */
  tearAcross(path: (isRectoUp: boolean) => TearPath): boolean {
    const one = this.#sheets.findLast(isFlat);
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
    one.isCrumpling = false;
    this.#takeUp(one);
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
    if (path === null || !one.sheet.tearAcross(...path, true)) return;
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
    one.isCrumpling = true;
    one.holds = [null, null];
    this.#takeUp(one);
    this.#hooks.moved();
    return true;
  }

  /** A ball lies where it fell: over the pages, or where it is out of reach, it is put aside. */
  #crumpled(one: LooseSheet): void {
    one.isCrumpling = false;
    const { shape } = this.#rebinder.bound;
    const reach = viewWith(shape, [reachOf(shape, areaOf(one))], this.#hooks.seenTable());
    if (this.#isOverBook(one) || reach !== wholeBook)
      this.#putAside(one, middleOf(one.sheet.surface));
    this.look();
    this.#hooks.moved();
  }

  #tearByCommand(one: LooseSheet, path: TearPath): boolean {
    if (!one.sheet.tearAcross(...path)) return false;
    const command = beginTear(one.sheet, path, this.#size);
    one.holds = [null, null];
    one.tear = { path, command };
    this.#takeUp(one);
    this.#hooks.moved();
    return true;
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
      const own = holds.filter((hold) => pieceOf(hold, pieces) === piece);
      for (const hold of own) hold.sheet = piece;
      piece.holds = [own[0] ?? null, own[1] ?? null];
      this.#holdAnew(piece);
      // The second hold is on the left of the way in which it is torn.
      const isSecond = command && isOnParted(command.places[1], path, size) === (k === 1);
      if (command) piece.aside = layDown(piece.sheet, command, isSecond === true, size);
      else if (own.length === 0) this.#letGo(piece, null);
    }
    while (this.#sheets.length > mostSheets) this.remove(this.#sheets[0].id);
    // Both show their pictures, each by its place in the list.
    this.#hooks.moved();
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
    const middle = middleOf(one.sheet.surface);
    one.holds = [null, null];
    one.sheet.release();
    const isOver = this.#isOverBook(one);
    // What was thrown out of sight is gone.
    if (!isOver && at && !this.#hooks.isSeen(at) && !this.#hooks.isSeen(middle)) this.#discard(one);
    else if (isOver || this.#isFarOff(one, at ?? middle)) this.#putAside(one, at ?? middle);
    this.look();
    this.#hooks.moved();
  }

  /** Whether the camera had to step back farther for a sheet than if it lay beside the book. */
  #isFarOff(one: LooseSheet, at: Vec3): boolean {
    const { shape } = this.#rebinder.bound;
    const seen = this.#hooks.seenTable();
    const beside = placeAside(shape, sizeOf(one.sheet, shape), [], at, seen);
    return viewWith(shape, [areaOf(one)], seen).level < viewWith(shape, [beside], seen).level;
  }

  #putAside(one: LooseSheet, at: Vec3): void {
    const { shape } = this.#rebinder.bound;
    const others = this.#sheets.filter((other) => other !== one).map(areaOf);
    const size = sizeOf(one.sheet, shape);
    one.area = placeAside(shape, size, others, at, this.#hooks.seenTable());
    one.aside = putAside(one.sheet, one.area, tableHeight(shape), shape);
  }

  /** Moves a sheet on that is put aside or torn by a command. */
  #move(one: LooseSheet, seconds: number): void {
    if (one.tear?.command) moveTear(one.sheet, one.tear.command, this.#size, seconds);
    if (one.aside === null || moveAside(one.sheet, one.aside, seconds)) return;
    one.aside = null;
    one.sheet.release();
  }
}

/** Returns the piece that a pointer holds: the one that has the place nearest to where it pulls. */
function pieceOf({ place, at }: Hold, pieces: readonly LooseSheet[]): LooseSheet {
  const away = ({ sheet }: LooseSheet): number =>
    at ? distance(pointAt(sheet.surface, place), at) : 0;
  return pieces.reduce((best, piece) => (away(piece) < away(best) ? piece : best));
}

/** Calls a function once nothing else is to be done, or soon. */
function whenIdle(call: () => void): void {
  if ("requestIdleCallback" in globalThis) requestIdleCallback(call);
  else setTimeout(call);
}

/** What moves nothing. */
const noDrag: Dragged = { canFlick: false, move: () => {}, release: () => {} };

function loose(id: number, sheet: TornSheet, pictures: SheetPictures): LooseSheet {
  const free = { holds: [null, null] as LooseSheet["holds"], aside: null, area: null, tear: null };
  return { id, sheet, pictures, ...free, isCrumpling: false };
}

/** Returns how wide and high a sheet or a piece lies that is put aside: a ball is as it is seen. */
function sizeOf({ surface, isCrumpled }: TornSheet, page: PageSize): readonly [number, number] {
  if (!isCrumpled) {
    const [low, high] = partOfPage(surface);
    return [(high[0] - low[0]) * page.width, (high[1] - low[1]) * page.height];
  }
  const { low, high } = surfaceBounds(surface);
  return [high[0] - low[0], high[1] - low[1]];
}

/** Returns where a sheet lies, or will once it is put aside. */
function areaOf({ area, sheet }: LooseSheet): TableArea {
  return area ?? surfaceBounds(sheet.surface);
}

/** Returns whether a sheet is neither crumpled nor torn across. */
function isWhole({ sheet }: LooseSheet): boolean {
  return !sheet.isCrumpled && sheet.surface.creased?.tears === undefined;
}

/** Returns whether a sheet is whole, and was not folded when it was torn out. */
function isFlat({ sheet }: LooseSheet): boolean {
  return sheet.surface.creased === undefined;
}

function distance(a: Vec3, b: Vec3): number {
  return Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}
