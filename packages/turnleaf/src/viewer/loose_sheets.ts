/**
 * Sheets that were torn out: pointers carry them, they fall, and they lie on the table beside the
 * book. One that is let go over the book is put aside, so that its pages stay readable.
 */

import type { TornSheet } from "../engine/book_engine.ts";
import { columnAt, type Ray, type Surface, surfaceBounds, type Vec3 } from "../engine/shapes.ts";
import { type Hit, pickSurface } from "../picking/pick.ts";
import { onPlane } from "../picking/reach.ts";
import type { PagePicture } from "../sources/page_source.ts";
import type { BookShape } from "../stage/book_pose.ts";
import { tableHeight } from "../stage/case_sizes.ts";
import type { Dragged, LooseHit } from "./drag.ts";
import { mostSheetTicks } from "./frame_timing.ts";
import type { Rebinder } from "./rebinder.ts";

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

/** What a sheet shows. */
export interface SheetPictures {
  readonly recto: PagePicture | null;
  readonly verso: PagePicture | null;
}

/** One loose sheet. */
interface LooseSheet {
  readonly id: number;
  readonly sheet: TornSheet;
  readonly pictures: SheetPictures;
  /** How it is put aside; null if it is not. */
  aside: AsideMotion | null;
  /** Whether it is pressed into a ball, or falls after that. */
  isCrumpling: boolean;
}

/** The motion by which the viewer puts a sheet aside. */
interface AsideMotion {
  readonly from: Vec3;
  readonly to: Vec3;
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
    this.#sheets.push({ id, sheet, pictures, aside: null, isCrumpling: false });
    while (this.#sheets.length > mostSheets) this.remove(this.#sheets[0].id);
  }

  /** Takes a sheet away. */
  remove(id: number): void {
    const gone = this.#sheets.find((sheet) => sheet.id === id);
    if (gone === undefined) return;
    this.#sheets = this.#sheets.filter((sheet) => sheet !== gone);
    gone.sheet.destroy();
    for (const picture of [gone.pictures.recto, gone.pictures.verso]) {
      if (picture) this.#hooks.drop(picture);
    }
    this.#hooks.moved();
  }

  /** Takes all of them away. */
  clear(): void {
    for (const { id } of [...this.#sheets]) this.remove(id);
  }

  /** Steps what moves by whole ticks. Returns whether anything goes on moving. */
  step(ticks: number): boolean {
    const { tearing, tick } = this.#rebinder.bound.engine;
    const bounded = Math.min(ticks, mostSheetTicks);
    for (const one of this.#sheets) {
      if (one.sheet.isAsleep || ticks === 0) continue;
      this.#move(one, bounded * tick);
      tearing?.step(one.sheet, bounded);
      const work = one.sheet.takeWork();
      if (work > 0) this.#hooks.heard(work);
      if (one.isCrumpling && one.sheet.isAsleep) this.#crumpled(one);
    }
    return this.#sheets.some(({ sheet }) => !sheet.isAsleep);
  }

  /** Returns the nearest of them on a line of sight, or null. */
  pick(ray: Ray): (Hit & { readonly on: LooseHit }) | null {
    const { columns } = this.#rebinder.bound.engine;
    let best: (Hit & { readonly on: LooseHit }) | null = null;
    for (const { id, sheet } of this.#sheets) {
      const hit = pickSurface(ray, sheet.surface, columns);
      if (hit === null || (best && best.distance <= hit.distance)) continue;
      best = { ...hit, on: { isLoose: true, grab: () => this.grab(id, hit.u, hit.v) } };
    }
    return best;
  }

  /** Grabs a sheet at (u, v). Returns what moves it with a pointer. */
  grab(id: number, u: number, v: number): Dragged {
    const held = () => this.#sheets.find((sheet) => sheet.id === id);
    const one = held();
    if (one) {
      one.aside = null;
      one.isCrumpling = false;
      one.sheet.grab(u, v);
    }
    let at: Vec3 = [0, 0, 0];
    return {
      canFlick: false,
      move: (x, y) => {
        at = onPlane(this.#hooks.rayAt(x, y), this.#carried);
        held()?.sheet.pull(at);
        this.#hooks.moved();
      },
      release: () => {
        const one = held();
        if (one) this.#letGo(one, at);
      },
      doubleTap: () => {
        this.#crumple(held());
      },
    };
  }

  /** Crumples the sheet that was torn out last and is not crumpled. Returns whether there is one. */
  crumple(): boolean {
    return this.#crumple(this.#sheets.findLast(({ sheet }) => !sheet.isCrumpled));
  }

  #crumple(one: LooseSheet | undefined): boolean {
    if (!one?.sheet.crumple()) return false;
    one.aside = null;
    one.isCrumpling = true;
    this.#hooks.moved();
    return true;
  }

  /** A ball lies where it fell: over the pages it is put aside. */
  #crumpled(one: LooseSheet): void {
    one.isCrumpling = false;
    if (this.#isOverBook(one)) this.#letGo(one, null);
  }

  #isOverBook({ sheet }: LooseSheet): boolean {
    const { width, height } = this.#rebinder.bound.shape;
    const { low, high } = surfaceBounds(sheet.surface);
    return low[0] < width && high[0] > -width && low[1] < height && high[1] > 0;
  }

  /** Puts a sheet aside that is held over the book. */
  putAside(id: number): void {
    const one = this.#sheets.find((sheet) => sheet.id === id);
    if (one) this.#letGo(one, null);
  }

  get #carried(): number {
    const { shape } = this.#rebinder.bound;
    return tableHeight(shape) + shape.thickness + carried * shape.width;
  }

  /**
   * Lets a sheet fall: where it hangs, or beside the book if that is over the book.
   *
   * @param at where a pointer held it; null if none did
   */
  #letGo(one: LooseSheet, at: Vec3 | null): void {
    const { shape } = this.#rebinder.bound;
    const middle = middleOf(one.sheet.surface);
    if (!this.#isOverBook(one)) {
      one.sheet.release();
      // What was thrown out of sight is gone.
      if (at && !this.#hooks.isSeen(at) && !this.#hooks.isSeen(middle)) this.remove(one.id);
    } else {
      const to = asideOf(shape, at ?? middle);
      one.sheet.grab(0.5, 0.5);
      one.aside = { from: middle, to, part: 0 };
    }
    this.#hooks.moved();
  }

  /** Moves a sheet on that is put aside. */
  #move(one: LooseSheet, seconds: number): void {
    const { aside } = one;
    if (aside === null) return;
    aside.part = Math.min(aside.part + seconds / asideSeconds, 1);
    const eased = aside.part * aside.part * (3 - 2 * aside.part);
    const [x, y] = [0, 1].map(
      (axis) => aside.from[axis] + eased * (aside.to[axis] - aside.from[axis]),
    );
    // Level until it is past the book, then down.
    const sunk = aside.part ** 4;
    one.sheet.pull([x, y, aside.from[2] + sunk * (aside.to[2] - aside.from[2])]);
    if (aside.part < 1) return;
    one.aside = null;
    one.sheet.release();
  }
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

/** Returns the middle of a surface. */
function middleOf({ positions, columns, rows, creased }: Surface): Vec3 {
  const column = creased ? columns >> 1 : Math.round(columnAt(0.5, columns));
  const at = 3 * ((rows >> 1) * columns + column);
  return [positions[at], positions[at + 1], positions[at + 2]];
}
