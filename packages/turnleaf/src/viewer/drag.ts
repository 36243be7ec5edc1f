/**
 * The way of a drag, from a place on the canvas to the engine's commands, in
 * the order in which it happens: what lies under the pointer, which leaf it
 * takes, where it holds it, and where the leaf goes when it is released.
 * `Input` makes drags of pointer events; `Turning` gives their commands to the
 * engine, and says which flight a grab holds.
 */

import type { DogEar } from "../book/dog_ears.ts";
import { type Binding, leftPage, rightPage } from "../book/spreads.ts";
import type { Flight, Turning } from "../book/turning.ts";
import type { BookEngine } from "../engine/book_engine.ts";
import { maxGrabs, Side } from "../engine/phases.ts";
import { pileHeight, type Ray, type Vec3 } from "../engine/shapes.ts";
import { type Hit, pickPile, pickSurface } from "../picking/pick.ts";
import { handAt } from "../picking/reach.ts";
import type { BookShape } from "../stage/book_pose.ts";
import type { BookStage, Place } from "../stage/book_stage.ts";
import type { CornerPeek } from "./corner_peek.ts";
import type { CornerPress } from "./corner_press.ts";

/** What a pointer can grab. */
export interface DragHit extends Hit {
  /** The flight there, the side whose uppermost leaf it is, or a loose sheet. */
  readonly on: Flight | Side | LooseHit;
}

/** What a pointer that is down moves. */
export interface Dragged {
  /** Whether a flick of it turns a leaf. */
  readonly canFlick: boolean;
  /** Moves the pointer to a place on the canvas, CSS pixels. */
  move(x: number, y: number): void;
  /** Releases it. */
  release(): void;
  /** Handles a double tap on it, after its release. */
  doubleTap?(): void;
}

/** A sheet that was torn out or is the flap of a fold-out, where a pointer can grab it. */
export interface LooseHit {
  readonly isLoose: true;
  /** Grabs it. */
  grab(): Dragged;
}

/** Finds sheets that were torn out, or the flap of a fold-out. */
export interface LooseSheets {
  /** Returns the nearest of them on a line of sight, or null. */
  pick(ray: Ray): (Hit & { readonly on: LooseHit }) | null;
}

/** The flap of the fold-out that is open, opens or closes, and those that are shut. */
export interface FoldOutSheets extends LooseSheets {
  /** Whether one is open, opens or closes. */
  readonly isVisible: boolean;
  /**
   * Grabs the flap that lies shut at (u, v) of a page (from 1) on a side. Returns what moves it
   * with a pointer; null if no flap lies there.
   */
  take(page: number, side: Side, u: number, v: number): Dragged | null;
  /** Folds in the open fold-out. Resolves once it is folded in. */
  foldIn(): Promise<void>;
}

/**
 * What a pointer can do besides grabbing leaves and boards. It outlives every binding; each part is
 * set once what does it is loaded.
 */
export interface DragTargets {
  /** The fold-outs, where they can be opened. */
  foldOut: FoldOutSheets | null;
  /** The sheets that were torn out, once one may be. */
  loose: LooseSheets | null;
  /** Returns the corner at which a leaf is held, once corners may be folded by hand. */
  cornerAt: typeof CornerPress.at | null;
}

/** A place on a leaf that is bound in the book. */
export interface LeafHit extends Hit {
  readonly on: Flight | Side;
}

/** Returns whether a hit is on a leaf of the book, not on a loose sheet. */
export function isOnLeaf(hit: DragHit): hit is LeafHit {
  return typeof hit.on === "number" || !("isLoose" in hit.on);
}

/** What drags need of a bound book. */
export interface DragContext {
  readonly engine: BookEngine;
  readonly stage: BookStage;
  readonly binding: Binding;
  readonly turning: Turning;
  readonly peek: CornerPeek;
  readonly shape: Pick<BookShape, "width" | "height" | "alone" | "quarterTurned">;
  readonly targets: Readonly<DragTargets>;
  /** Called when something moves. */
  readonly moved: () => void;
}

/** Maximum of drags at once: the last grab lifts corners. */
export const maxDrags: number = maxGrabs - 1;

/** How much nearer than a page behind it a leaf in flight counts, metres: it is preferred. */
const preference = 0.001;

/**
 * Minimum distance from the spine at which a leaf is held, as a fraction of its
 * width: closer, it could not be turned.
 */
const nearestHeld = 0.3;

/**
 * Up to this u a leaf counts as held far from its edge; and how far beyond the
 * spine it is then carried over, as a fraction of its width.
 */
const farFromEdge = 0.65;
const beyondSpine = 0.12;

/**
 * Distance from the spine at which a leaf counts as carried over if nothing
 * beyond the spine is visible, as a fraction of its width.
 */
const nearSpine = 0.35;

/**
 * From this u on a page that stands alone is itself pulled away from its spine where leaves may be
 * torn out: closer to the spine such a pull brings the previous page back.
 */
const outerEdge = 0.8;

/** The drags on one bound book. */
export class Drags {
  readonly #book: DragContext;
  /** By the number of their grab. */
  readonly #drags = new Map<number, Drag>();
  #pressed: Drag | null = null;
  #closed = false;

  constructor(book: DragContext) {
    this.#book = book;
  }

  /** Returns what a pointer at a place on the canvas (CSS pixels) can grab, or null. */
  pick(x: number, y: number): DragHit | null {
    if (this.#closed) return null;
    const { engine, stage, turning, peek, targets } = this.#book;
    const ray = stage.rayAt(x, y);
    let best: DragHit | null = this.#pickPage(ray);
    const { leaves } = turning;
    for (const flight of turning.flights) {
      // A board in flight can be grabbed anywhere, wherever its page is seen.
      if (flight.part !== "leaf") return best && { ...best, on: flight };
      const hit = pickSurface(ray, engine.surface(leaves.indexOf(flight)), engine.columns);
      if (hit && (best === null || hit.distance < best.distance + preference)) {
        best = { ...hit, on: flight };
      }
    }
    for (const sheets of [targets.foldOut, targets.loose]) {
      const sheet = sheets?.pick(ray) ?? null;
      if (sheet && (best === null || sheet.distance < best.distance + preference)) best = sheet;
    }
    if (best && !isOnLeaf(best)) return best;
    // Beside a lifted corner a pointer grabs that leaf, not the one under it.
    return best && peek.flight && best.on === peek.side ? { ...best, on: peek.flight } : best;
  }

  #pickPage(ray: Ray): DragHit | null {
    const { engine, turning, shape } = this.#book;
    let best: DragHit | null = null;
    for (const side of [Side.right, Side.left]) {
      if (!turning.hasLeaf(side)) continue;
      const sign = side === Side.right ? 1 : -1;
      const hit = pickPile(ray, engine.pile(side), sign, engine.columns, shape.height);
      if (hit && (best === null || hit.distance < best.distance)) best = { ...hit, on: side };
    }
    return best;
  }

  /** The drags of leaves that lie on a side or fly, in no order. */
  get all(): Iterable<Drag> {
    return this.#drags.values();
  }

  /** Returns whether a hit is on a leaf in flight or a loose sheet, rather than on one with only its corner lifted. */
  isFlying({ on }: DragHit): boolean {
    return typeof on !== "number" && on !== this.#book.peek.flight;
  }

  /**
   * Grabs what `pick` found, in flight or at rest. Returns the drag, or null if
   * that cannot be picked up or a listener took the book away: where a fold-out is open it is
   * folded in first.
   *
   * @param pull how far the pointer has moved since, CSS pixels
   */
  grab(found: DragHit, pull: Place = { x: 0, y: 0 }): Dragged | null {
    const number = this.#freeGrab;
    if (this.#closed || number === undefined) return null;
    const { turning, peek, targets } = this.#book;
    const flap = this.#takeFlap(found, pull);
    if (flap) return flap;
    const hit = this.#pulled(found, pull);
    if (!isOnLeaf(hit)) {
      peek.end();
      return (hit.on as LooseHit).grab();
    }
    if (targets.foldOut?.isVisible) {
      void targets.foldOut.foldIn();
      return null;
    }
    const { on, u, v } = hit;
    const side = typeof on === "number" ? on : on === peek.flight ? peek.side : null;
    const flight = typeof on === "number" ? turning.pickUp(on) : on;
    if (flight === null) {
      peek.end();
      return null;
    }
    const held = [Math.min(Math.max(u, nearestHeld), 1), Math.min(Math.max(v, 0), 1)] as const;
    const corner = this.#cornerOf(flight, side, ...held);
    const drag = new Drag(this.#book, number, held, corner, () => this.#drags.delete(number));
    turning.grab(flight, number, ...held);
    this.#drags.set(number, drag);
    // The lifted corner falls back, unless it is of this leaf, which is turned from now on.
    peek.end();
    peek.becomeTurn(flight);
    return this.#closed ? null : drag;
  }

  /** Grabs the shut flap of a fold-out that is pulled away from the spine; null for anything else. */
  #takeFlap({ on, u, v }: DragHit, { x, y }: Place): Dragged | null {
    const { binding, turning, peek, shape, targets } = this.#book;
    const isLifted = peek.flight !== null && on === peek.flight;
    const side = isLifted ? peek.side : on;
    if (typeof side !== "number" || (turning.moving && !isLifted) || shape.quarterTurned)
      return null;
    const outward = side === Side.right ? x : -x;
    const page = (side === Side.right ? rightPage : leftPage)(binding, turning.spread);
    if (page === null || outward <= Math.abs(y) || targets.foldOut?.isVisible) return null;
    const flap = targets.foldOut?.take(page, side, u, v) ?? null;
    if (flap) peek.end();
    return flap;
  }

  get #freeGrab(): number | undefined {
    return Array.from({ length: maxDrags }, (_, k) => k).find((k) => !this.#drags.has(k));
  }

  /**
   * Returns what a pull from a hit moves. If a page stands alone, a pull away
   * from its spine, from the page or from beside the spine, brings the previous
   * page back; where there is none, or at the outer edge, it pulls at the page itself if leaves
   * may be torn out.
   */
  #pulled(hit: DragHit, { x, y }: Place): DragHit {
    const { shape, turning, targets } = this.#book;
    const { alone, quarterTurned } = shape;
    const isOutward = (quarterTurned ? y : x) * alone > 0;
    if (!isOutward || typeof hit.on !== "number") return hit;
    const on = alone === 1 ? Side.left : Side.right;
    const isAtEdge = hit.on !== on && hit.u >= outerEdge;
    if (targets.loose && (isAtEdge || !turning.hasLeaf(on))) return hit;
    return { ...hit, on, u: 1 };
  }

  /** Returns the corner of the page at which a leaf that lay on a side is held, if it is. */
  #cornerOf(flight: Flight, side: Side | null, u: number, v: number): HeldCorner | null {
    const { binding, shape, targets } = this.#book;
    if (side === null || flight.part !== "leaf") return null;
    const isRight = side === Side.right;
    const page = isRight ? rightPage(binding, flight.low) : leftPage(binding, flight.high);
    const press = targets.cornerAt?.(shape, side, u, v) ?? null;
    return press && page !== null ? { side, page, press } : null;
  }

  /**
   * Counts the time for which corners are held still over their pages. Returns the one that is
   * to be pressed now, which `letGo` ends; whether one is to be waited for, if none is.
   */
  step(seconds: number): DogEar | boolean {
    if (this.#pressed) return true;
    let isWaiting = false;
    for (const drag of this.#drags.values()) {
      const ear = drag.rest(seconds);
      isWaiting ||= ear === null;
      if (!ear) continue;
      this.#pressed = drag;
      return ear;
    }
    return isWaiting;
  }

  /** The drag whose corner is being pressed, until `letGo`. */
  get pressed(): Drag | null {
    return this.#pressed;
  }

  /** Releases the corner that was pressed. */
  letGo(): void {
    this.#pressed?.letGo();
    this.#pressed = null;
  }

  /** Carries held leaves along when the camera has moved. */
  follow(): void {
    for (const drag of this.#drags.values()) drag.follow();
  }

  /** Ends every drag: its pointer moves nothing any more. */
  close(): void {
    this.#closed = true;
    for (const drag of [...this.#drags.values()]) drag.end();
  }
}

/** A corner of a page that lay on a side before it was taken there. */
interface HeldCorner {
  readonly side: Side;
  readonly page: number;
  readonly press: CornerPress;
}

/** A leaf or board that one pointer holds, until it is released. */
export class Drag implements Dragged {
  /** u and v of the held point. */
  readonly u: number;
  readonly v: number;
  readonly #book: DragContext;
  readonly #grab: number;
  readonly #ended: () => void;
  readonly #corner: HeldCorner | null;
  #isOver = false;
  /** The sheet that it carries once its leaf has been torn out. */
  #sheet: Dragged | null = null;
  /** The corner that is being pressed: the pointer moves the leaf no more. */
  #ear: DogEar | null = null;
  /** The pointer's place on the canvas, CSS pixels. */
  #at: Place = { x: 0, y: 0 };
  /** Where the held point was pulled last, metres. */
  #place: Vec3 = [0, 0, 0];

  /**
   * @param corner the corner that it holds, which may be folded
   * @param ended called when it is over
   */
  constructor(
    book: DragContext,
    grab: number,
    [u, v]: readonly [number, number],
    corner: HeldCorner | null,
    ended: () => void,
  ) {
    this.u = u;
    this.v = v;
    this.#book = book;
    this.#grab = grab;
    this.#corner = corner;
    this.#ended = ended;
  }

  /** Moves the pointer to a place on the canvas, CSS pixels. */
  move(x: number, y: number): void {
    if (this.#sheet) this.#sheet.move(x, y);
    if (this.#isOver || this.#ear) return;
    this.#at = { x, y };
    this.#corner?.press.move(this.#at);
    this.follow();
    this.#book.moved();
  }

  get canFlick(): boolean {
    return this.#sheet === null;
  }

  /** The flight that it holds; undefined if it holds none any more. */
  get flight(): Flight | undefined {
    return this.#isOver ? undefined : this.#book.turning.heldBy(this.#grab);
  }

  /** The line of sight through the pointer. */
  get ray(): Ray {
    return this.#book.stage.rayAt(this.#at.x, this.#at.y);
  }

  /** Where the held point was pulled last, metres. */
  get place(): Vec3 {
    return this.#place;
  }

  /** Ends as a drag of its leaf, which has been torn out: the pointer carries the sheet from now on. */
  carry(sheet: Dragged): void {
    this.#sheet = sheet;
    this.end();
    sheet.move(this.#at.x, this.#at.y);
  }

  /** Pulls the held point to where the pointer is in space: on an arch over the spine. */
  follow(): void {
    if (this.#ear) return;
    const { engine, stage, turning, shape } = this.#book;
    const ray = stage.rayAt(this.#at.x, this.#at.y);
    this.#place = handAt(ray, this.u * shape.width, (x) => floorUnder(engine, x));
    turning.hold(this.#grab, ...this.#place);
  }

  /**
   * Counts the time that a held corner rests over its page. Returns the corner to press, which
   * the pointer moves no more from then on; null if it is to be waited for, undefined if there
   * is none.
   */
  rest(seconds: number): DogEar | null | undefined {
    const { stage, turning } = this.#book;
    if (!this.#corner || this.#isOver || !turning.holds(this.#grab)) return undefined;
    const { page, press } = this.#corner;
    const found = press.step(seconds, stage.rayAt(this.#at.x, this.#at.y), this.#floor);
    if (!found) return found;
    this.#ear = { page, ...found };
    return this.#ear;
  }

  /** The page (from 1) whose corner it presses; null if it presses none. */
  get pressing(): number | null {
    return this.#ear?.page ?? null;
  }

  /** Brings a corner that is pressed a part of its way from where it was drawn down to where it lies folded. */
  press(part: number): void {
    if (!this.#ear || !this.#corner) return;
    const to = this.#corner.press.folded(this.#ear.size, this.#floor);
    const [x, y, z] = this.#place.map((from, axis) => from + part * (to[axis] - from));
    this.#book.turning.hold(this.#grab, x, y, z);
  }

  /** Releases a corner that was pressed: the leaf falls back. */
  letGo(): void {
    const { turning, moved } = this.#book;
    turning.release(this.#grab);
    this.end();
    moved();
  }

  /** Height of the page that it lay on, metres. */
  get #floor(): number {
    const isRight = this.#corner?.side !== Side.left;
    return floorUnder(this.#book.engine, isRight ? 1 : -1);
  }

  /** Releases it: the leaf falls to the side that its swing takes it, or to where it was carried. */
  release(): void {
    this.#sheet?.release();
    if (this.#isOver || this.#ear) return;
    const { turning, moved } = this.#book;
    const way = turning.holds(this.#grab) ? this.#carried : 0;
    if (way !== 0) void turning.press(way);
    turning.release(this.#grab);
    this.end();
    moved();
  }

  /**
   * The side, 1 left or -1 right, to which the pointer has carried a leaf that
   * would fall back if released at rest: one held far from the edge, because
   * most of it still hangs over the other side; or one of a page that stands
   * alone, which a pointer on the screen can carry no farther than upright. 0
   * if the engine decides.
   */
  get #carried(): 1 | 0 | -1 {
    const { alone, width } = this.#book.shape;
    const fraction = this.#place[0] / width;
    if (alone) return fraction * alone < nearSpine ? alone : 0;
    if (this.u >= farFromEdge || Math.abs(fraction) < beyondSpine) return 0;
    return fraction < 0 ? 1 : -1;
  }

  /** Ends it without a release: the book is closed, or bound anew. */
  end(): void {
    this.#isOver = true;
    this.#ended();
  }
}

/**
 * Returns the height of the pages under x, metres: at the fore-edge, because a
 * leaf is held near its edge.
 */
function floorUnder(engine: BookEngine, x: number): number {
  return pileHeight(engine.pile(x >= 0 ? Side.right : Side.left));
}
