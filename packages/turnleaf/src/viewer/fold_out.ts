/**
 * The open fold-out, or the one that opens or closes: its flap is a sheet in the engine, hinged on
 * the page, that pointers and commands turn. There is at most one. A fold-out that is shut is one
 * bitmap on its page.
 */

import type { Turning } from "../book/turning.ts";
import type { BookEngine, FlapSheet } from "../engine/book_engine.ts";
import { Side } from "../engine/phases.ts";
import type { Ray, Surface, Vec3 } from "../engine/shapes.ts";
import type { OpenFoldOut, PageBitmaps } from "../pages/page_bitmaps.ts";
import { foldAt, isFoldOut, panelsOf } from "../pages/page_place.ts";
import { type Hit, pickSurface } from "../picking/pick.ts";
import { handAt, onPlane } from "../picking/reach.ts";
import type { BookShape } from "../stage/book_pose.ts";
import type { Place } from "../stage/book_stage.ts";
import { tableHeight } from "../stage/case_sizes.ts";
import type { Dragged, FoldOutSheets, LooseHit } from "./drag.ts";
import { mostSheetTicks } from "./frame_timing.ts";

/** Minimum distance from its fold at which a flap is held, as a fraction of its width. */
const nearestHeld = 0.3;

/** Movement in CSS pixels up to which a press on an open flap is a tap. */
const tapSize = 8;

/** What fold-outs need of a bound book. */
export interface FoldOutBook {
  readonly engine: BookEngine;
  readonly shape: BookShape;
  readonly turning: Pick<Turning, "moving">;
}

/** The dependencies and callbacks of fold-outs. */
export interface FoldOutHooks {
  /** Whether fold-outs can lie open at all. */
  readonly unfolds: boolean;
  /** Width of a leaf, device pixels. */
  readonly width: () => number;
  /** The book as it is bound now. */
  readonly bound: () => FoldOutBook;
  /**
   * Has the book bound by an engine whose fold-outs open, and a lifted corner fall back. Resolves
   * once that is tried.
   */
  readonly ready: () => Promise<void>;
  /** Returns the line of sight through a place on the canvas. */
  readonly rayAt: (x: number, y: number) => Ray;
  /** Called when the faces show other bitmaps than before. */
  readonly changed: () => void;
  /** Called when something moves. */
  readonly moved: () => void;
}

/** A fold-out whose flap is a sheet. */
interface Flap {
  readonly page: number;
  readonly side: Side;
  readonly parts: OpenFoldOut;
  readonly sheet: FlapSheet;
  /** Whether it is to lie open. */
  isToOpen: boolean;
}

/** The pointer that holds the flap. */
interface PointerGrab {
  readonly u: number;
  at: Place;
}

/** Unfolds and folds in a fold-out. */
export class FoldOut implements FoldOutSheets {
  readonly #pictures: PageBitmaps;
  readonly #hooks: FoldOutHooks;
  #flap: Flap | null = null;
  #grab: PointerGrab | null = null;
  #drawing: AbortController | null = null;
  /** Number of flaps that are being made. */
  #making = 0;
  #waiting: ((done: boolean) => void)[] = [];

  constructor(pictures: PageBitmaps, hooks: FoldOutHooks) {
    this.#pictures = pictures;
    this.#hooks = hooks;
  }

  /** The page (from 1) that lies open or opens; null if none does. */
  get page(): number | null {
    return this.#flap?.isToOpen ? this.#flap.page : null;
  }

  get isVisible(): boolean {
    return this.#flap !== null;
  }

  /** Whether a flap is about to be visible. */
  get isMaking(): boolean {
    return this.#making > 0;
  }

  /**
   * The bitmaps on the flap, and the side of the book that it belongs to; null
   * if no flap is visible.
   */
  get parts(): (OpenFoldOut & { readonly side: Side }) | null {
    return this.#flap && { ...this.#flap.parts, side: this.#flap.side };
  }

  /** The flap as it is drawn; null if there is none. */
  get surface(): Surface | null {
    return this.#flap?.sheet.surface ?? null;
  }

  /**
   * Opens the fold-out of a page on a side. Resolves, once it lies open, to
   * whether it does.
   */
  async unfold(page: number, side: Side): Promise<boolean> {
    const flap = await this.#make(page, side);
    if (flap === null) return false;
    flap.sheet.turn(true);
    this.#hooks.moved();
    return await new Promise((resolve) => this.#waiting.push(resolve));
  }

  async foldIn(): Promise<void> {
    this.#drawing?.abort();
    const flap = this.#flap;
    if (flap === null) return;
    this.#grab = null;
    // What waits for it to shut goes on waiting: two commands would else wake each other for ever.
    if (flap.isToOpen) {
      this.#tell(false);
      flap.sheet.turn(false);
    }
    flap.isToOpen = false;
    this.#hooks.moved();
    await new Promise((resolve) => this.#waiting.push(resolve));
  }

  pick(ray: Ray): (Hit & { readonly on: LooseHit }) | null {
    const flap = this.#flap;
    const hit = flap && pickSurface(ray, flap.sheet.surface, this.#hooks.bound().engine.columns);
    if (!hit) return null;
    return { ...hit, on: { isLoose: true, grab: () => this.#carry(hit.u, hit.v, flap) } };
  }

  take(page: number, side: Side, u: number, v: number): Dragged | null {
    const place = this.#pictures.placeOfDrawn(page);
    if (!this.#hooks.unfolds || !isFoldOut(place)) return null;
    const { panels, across } = panelsOf(place);
    const out = (foldAt - u) / across;
    if (out < 0 || out > 1) return null;
    // Folded more than once, it is drawn out by its edge.
    return this.#carry(panels === 1 ? out : 1, v, this.#make(page, side));
  }

  /** Advances the motion by whole ticks. Returns whether anything moves. */
  step(ticks: number): boolean {
    const flap = this.#flap;
    if (flap === null) return false;
    const { sheet } = flap;
    // Where the book is seen may have changed.
    this.#follow();
    if (!sheet.isAsleep) sheet.step(Math.min(ticks, mostSheetTicks));
    if (!sheet.isAsleep) return true;
    if (this.#grab) return false;
    // Let go near the middle it may have fallen to the other side.
    flap.isToOpen = sheet.angle < Math.PI / 2;
    if (flap.isToOpen) this.#tell(true);
    else this.close();
    return false;
  }

  /** Removes everything at once. */
  close(): void {
    this.#drawing?.abort();
    const flap = this.#flap;
    if (flap === null) return;
    this.#flap = this.#grab = null;
    flap.sheet.destroy();
    this.#pictures.foldIn();
    this.#hooks.changed();
    this.#tell(false);
  }

  /** Returns whether a page (from 1) is a fold-out that can be opened: known once it has been drawn. */
  unfolds(page: number): boolean {
    return this.#hooks.unfolds && isFoldOut(this.#pictures.placeOfDrawn(page));
  }

  /** Draws the fold-out of a page on a side and makes its flap, shut. Resolves to null if it cannot be. */
  async #make(page: number, side: Side): Promise<Flap | null> {
    if (!this.unfolds(page)) return null;
    this.#making++;
    try {
      return await this.#makeFlap(page, side);
    } finally {
      this.#making--;
    }
  }

  async #makeFlap(page: number, side: Side): Promise<Flap | null> {
    const { ready, bound, width, changed } = this.#hooks;
    await ready();
    this.close();
    if (bound().turning.moving || !bound().engine.flap) return null;
    const drawing = new AbortController();
    this.#drawing = drawing;
    const parts = await this.#pictures.unfold(page, width(), drawing.signal).catch(() => null);
    if (parts === null) return null;
    const { engine, shape } = bound();
    const { panels } = panelsOf(parts.place);
    const around = { table: tableHeight(shape), rim: shape.rim };
    const place = { side, fold: foldAt, width: parts.place.width - foldAt, panels, ...around };
    const sheet = drawing.signal.aborted ? null : engine.flap?.(place);
    if (!sheet) {
      this.#pictures.foldIn();
      return null;
    }
    this.#flap = { page, side, parts, sheet, isToOpen: true };
    changed();
    return this.#flap;
  }

  /** Grabs the flap at (u, v), once it is made. Returns what moves it with a pointer. */
  #carry(u: number, v: number, flap: Flap | Promise<Flap | null>): Dragged {
    let from: Place | null = null;
    let at: Place = { x: 0, y: 0 };
    let isTap = !(flap instanceof Promise);
    let isOver = false;
    let held: Flap | null = null;
    let grabbed: PointerGrab | null = null;
    const grab = (made: Flap | null) => {
      if (made === null || made !== this.#flap) return;
      held = made;
      grabbed = { u: Math.max(u, nearestHeld), at };
      if (isOver) this.#letGo(made, grabbed);
      else {
        this.#grab = grabbed;
        made.sheet.grab(grabbed.u, v);
        if (from) {
          // It came after the pointer had begun to move, whose whole way it follows.
          made.sheet.pull(this.#placeOf(made, { u: grabbed.u, at: from }));
          this.#follow();
        }
      }
      this.#hooks.moved();
    };
    if (flap instanceof Promise) void flap.then(grab);
    else grab(flap);
    return {
      canFlick: false,
      move: (x, y) => {
        at = { x, y };
        from ??= at;
        if (Math.hypot(x - from.x, y - from.y) > tapSize) isTap = false;
        if (grabbed) grabbed.at = at;
        this.#follow();
        this.#hooks.moved();
      },
      release: () => {
        isOver = true;
        if (grabbed === null || this.#grab !== grabbed || held === null) return;
        this.#grab = null;
        if (isTap) {
          // The grab ended its way in.
          if (!held.isToOpen) held.sheet.turn(false);
          return void this.foldIn();
        }
        this.#letGo(held, grabbed);
        this.#hooks.moved();
      },
    };
  }

  /**
   * Lets go of a flap: it lies open if the pointer was beyond its fold. Paper that lags behind the pointer,
   * or was not there yet, is turned there.
   */
  #letGo(flap: Flap, grab: PointerGrab): void {
    const { sheet, parts, side } = flap;
    const { panels } = panelsOf(parts.place);
    const width = ((parts.place.width - foldAt) * this.#hooks.bound().shape.width) / panels;
    const [x] = this.#placeOf(flap, grab);
    const outward = (x - sheet.surface.positions[0]) * (side === Side.right ? 1 : -1);
    // Shut, panels lie in pairs upon each other, and the end of an odd number of them over the page.
    flap.isToOpen = outward > Math.floor(panels / 2) * width;
    const isOutward = sheet.angle < Math.PI / 2;
    if (flap.isToOpen === isOutward) sheet.release();
    else sheet.turn(flap.isToOpen);
  }

  /** Pulls the held flap to where its pointer is. */
  #follow(): void {
    if (this.#flap && this.#grab) this.#flap.sheet.pull(this.#placeOf(this.#flap, this.#grab));
  }

  /**
   * Returns where a pointer is in space: on an arch over the fold, or on the table beyond; level
   * with the fold for a flap that is folded more than once, whose edge goes there by no arch.
   */
  #placeOf({ side, parts, sheet }: Flap, { u, at }: PointerGrab): Vec3 {
    const { shape } = this.#hooks.bound();
    const { origin, direction } = this.#hooks.rayAt(at.x, at.y);
    const [x, , z] = sheet.surface.positions;
    if (panelsOf(parts.place).panels > 1) return onPlane({ origin, direction }, z);
    const reach = u * (parts.place.width - foldAt) * shape.width;
    const outward = side === Side.right ? 1 : -1;
    const over = { origin: [origin[0] - x, origin[1], origin[2] - z] as const, direction };
    const place = handAt(over, reach, (x) => (x * outward > 0 ? tableHeight(shape) - z : 0));
    return [place[0] + x, place[1], place[2] + z];
  }

  #tell(done: boolean): void {
    for (const resolve of this.#waiting.splice(0)) resolve(done);
  }
}
