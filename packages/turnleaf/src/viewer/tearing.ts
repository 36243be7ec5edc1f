/**
 * Tears leaves out of the book: one that a pointer or a command pulls away from
 * the spine beyond its reach is drawn as a sheet that the spine holds row by row. Once it is off,
 * its pages are no longer the book's, and it is a loose sheet. Loaded when a book may be torn.
 */

import { placeOnLeaf } from "../book/creases.ts";
import { facesOfLeaf } from "../book/faces.ts";
import { sideBefore } from "../book/leaf_order.ts";
import type { PagePlace } from "../book/page_folds.ts";
import {
  type Binding,
  isCover,
  leafOf,
  pagesAt,
  paperLeaves,
  paperOnLeft,
} from "../book/spreads.ts";
import type { Flight } from "../book/turning.ts";
import type { BoundRows, TornSheet } from "../engine/book_engine.ts";
import { maxGrabs, Side } from "../engine/phases.ts";
import { pileHeight, type Surface, type TearLine, type Vec3 } from "../engine/shapes.ts";
import type { PageBitmaps } from "../pages/page_bitmaps.ts";
import { onPlane } from "../picking/reach.ts";
import type { BookPose } from "../stage/book_pose.ts";
import type { BookStage } from "../stage/book_stage.ts";
import { tableHeight } from "../stage/case_sizes.ts";
import type { Zoom } from "../stage/zoom.ts";
import type { BookExtent } from "./book_extent.ts";
import type { Drag } from "./drag.ts";
import { stepSheets } from "./frame_timing.ts";
import { LooseSheetPile } from "./loose_sheets.ts";
import type { Rebinder } from "./rebinder.ts";
import { seenTable } from "./table_places.ts";
import type { TearOwner } from "./viewer_options.ts";

/** How far a leaf is pulled beyond its reach before it is drawn as one that tears, in page widths. */
const taut = 0.05;

/** How high a leaf that tears is pulled, as a part of how far it is pulled. */
const rising = 0.5;

/** Seconds in which a leaf that was let go while it was being torn is drawn as bound again. */
const mended = 0.25;

/** A leaf torn out by command: where it is held, and the speed of its pull, page widths a second. */
const commandHold = [0.95, 0.9] as const;
const commandGrab = maxGrabs - 1;
const commandSpeed = 0.6;

/** Seconds after which a command cuts what its pull has not torn. */
const longestPull = 2;

/** What tearing needs of the viewer. */
export interface TearView {
  /** Something moves: a frame should show it. */
  readonly moved: () => void;
  /** Lays the book open at a spread, where its place is from then on. */
  readonly lay: (spread: number) => void;
  /**
   * Takes the pages (from 1) of a leaf that is off out of the book, and binds it without them.
   * Returns the number of its sheet; null if they cannot be taken out.
   */
  readonly takeOut: (pages: readonly number[]) => number | null;
  /** How large the book is shown. */
  readonly extent: Pick<BookExtent, "canvas" | "contains">;
  /** Calls `look` with the camera as it is when it shows the whole book and nothing else. */
  readonly lookAtRest: <T>(look: () => T) => T;
  /** Sets what is shown at zoom level 1, in so many seconds. */
  readonly showWhole: (whole: Zoom, seconds: number) => void;
}

/** What it needs of the viewer, and of the owner of the book's pages. */
export interface TearHooks extends TearView, Pick<TearOwner, "mayTear" | "heard"> {
  /** Returns how the leaves are bound; null if none may be torn out now. */
  readonly line: () => TearLine | null;
}

/** A leaf that is being torn. */
interface Tear {
  readonly flight: Flight;
  readonly sheet: TornSheet;
  readonly pages: readonly number[];
  /** The pointer that pulls it; null if the viewer does, by a command. */
  readonly drag: Drag | null;
  /** Whether the owner has been asked, as the first row gave way. */
  isAsked: boolean;
  /** How far a command has pulled it, metres. */
  away: number;
  /** Seconds since it was let go; null while it is held. */
  since: number | null;
  /** Called once it is off, or bound again. */
  readonly done: (isOff: boolean) => void;
}

/** Tears leaves out of one viewer's book. */
export class Tearing {
  readonly #rebinder: Rebinder;
  readonly #bitmaps: PageBitmaps;
  readonly #loose: LooseSheetPile;
  readonly #hooks: TearHooks;
  #tear: Tear | null = null;
  /** The pages whose leaf may not be torn by the pointer that holds it: their owner said so. */
  #declined: Drag | null = null;
  /** What binds leaves that were let go half torn, by their first page; until pages move. */
  readonly #begun = new Map<number, BoundRows>();
  #drawn: { readonly surface: Surface; readonly sheet: Surface; readonly part: number } | null =
    null;

  /**
   * @param rebinder of a book that is bound, or will be as soon as it rests, by an engine whose
   * leaves can be torn
   */
  constructor(rebinder: Rebinder, bitmaps: PageBitmaps, stage: BookStage, hooks: TearHooks) {
    this.#rebinder = rebinder;
    this.#bitmaps = bitmaps;
    this.#hooks = hooks;
    this.#loose = new LooseSheetPile(rebinder, {
      moved: hooks.moved,
      rayAt: (x, y) => stage.rayAt(x, y),
      isSeen: (point) => hooks.extent.contains(stage.project(point)),
      seenTable: () =>
        hooks.lookAtRest(() => {
          const { shape } = rebinder.bound;
          return seenTable(shape, (point) => stage.projectOpen(point), hooks.extent.canvas);
        }),
      showWhole: hooks.showWhole,
      heard: (work) => hooks.heard(work),
      drop: (picture) => bitmaps.drop(picture),
    });
    rebinder.targets.loose = this.#loose;
  }

  /** Call it when the book was bound anew: what was being torn is bound again. */
  bound(): void {
    this.#end(false);
    this.#begun.clear();
    this.#loose.look(0);
  }

  /** Call it when the canvas has another size. */
  resized(): void {
    this.#loose.look(0);
  }

  /** Call it when the reader goes on with the book: loose sheets are only within reach from then on. */
  readOn(): void {
    this.#loose.readOn();
  }

  /**
   * Tears the leaf of a page (from 1) out, which lies open. Resolves, once it is off, to whether it
   * is: false if the page does not lie open, its leaf cannot be torn out or its owner keeps it.
   *
   * @param isSeen whether it is seen to be torn, and lies beside the book then
   */
  async tearOut(page: number, isSeen: boolean): Promise<boolean> {
    const { binding, turning, engine } = this.#rebinder.bound;
    if (turning.moving || this.#tear || !engine.tearing) return false;
    const side = sideOf(binding, turning.spread, page);
    const flight = side !== null && turning.hasLeaf(side) ? this.#pickUp(side) : null;
    if (flight === null) return false;
    // Held, so that it does not lie down meanwhile.
    engine.grab(flight.id, commandGrab, ...commandHold);
    const isOff = await new Promise<boolean>((done) => {
      if (!this.#begin(flight, null, commandHold, done)) done(false);
      else if (!isSeen) this.#cut();
    });
    if (!isOff) this.#rebinder.bound.engine.release(flight.id, commandGrab);
    this.#hooks.moved();
    return isOff;
  }

  /** Advances by whole ticks. Returns whether anything goes on moving. */
  step(ticks: number): boolean {
    return stepSheets(ticks, (some) => {
      const isFalling = this.#loose.step(some);
      return this.#stepTear(some) || isFalling;
    });
  }

  /** Shows the pictures of the loose sheets. */
  show(stage: BookStage): void {
    for (const [k, { recto, verso }] of this.#loose.pictures.entries()) {
      stage.setLoose(k, "recto", recto);
      stage.setLoose(k, "verso", verso);
    }
  }

  /** The loose sheets that are neither crumpled nor torn across: one is flat, all are folded, or null. */
  get wholeSheet(): "flat" | "folded" | null {
    return this.#loose.whole;
  }

  /** Crumples the loose sheet that was torn out last and is not crumpled. Returns whether there is one. */
  crumple(): boolean {
    return this.#loose.crumple();
  }

  /**
   * Tears the loose sheet across that was torn out last and is neither crumpled, torn nor folded, from a
   * place on an edge of the page that it shows to another. Returns whether there is one that can
   * be torn so.
   */
  tearAcross(from: PagePlace, to: PagePlace): boolean {
    const { quarterTurned } = this.#rebinder.bound.binding;
    return this.#loose.tearAcross((isRecto) => [
      placeOnLeaf(from, quarterTurned, isRecto),
      placeOnLeaf(to, quarterTurned, isRecto),
    ]);
  }

  /** Takes a loose sheet away; `id` is what `takeOut` returned. */
  remove(id: number): void {
    this.#loose.remove(id);
  }

  #stepTear(ticks: number): boolean {
    if (!this.#tear) this.#look();
    const tear = this.#tear;
    if (tear === null || ticks === 0) return tear !== null;
    const { engine, turning } = this.#rebinder.bound;
    const seconds = ticks * engine.tick;
    if (!turning.flights.includes(tear.flight)) return this.#end(false);
    if (tear.since === null) this.#pull(tear, seconds);
    else tear.since += seconds;
    engine.tearing?.step(tear.sheet, ticks);
    const [from, to] = tear.sheet.bound;
    const work = tear.sheet.takeWork();
    if (work > 0 && !tear.isAsked) {
      tear.isAsked = true;
      if (!this.#hooks.mayTear(tear.pages)) {
        this.#declined = tear.drag;
        return this.#end(false);
      }
      // A listener may have closed the book.
      if (this.#tear !== tear) return false;
    }
    if (work > 0) this.#hooks.heard(work);
    if (from === to) return this.#finish(tear);
    if (tear.since !== null && tear.since >= mended) {
      // What gave way stays torn, and its owner has let it.
      if (tear.isAsked) this.#begun.set(tear.pages[0], [from, to]);
      return this.#end(false);
    }
    return tear.since !== null || !tear.sheet.isAsleep;
  }

  /** Returns what is drawn of a book whose parts are as `pose` says. */
  pose(pose: BookPose): BookPose {
    const loose = this.#loose.surfaces;
    const tear = this.#tear;
    if (tear === null) return loose.length > 0 ? { ...pose, loose } : pose;
    const index = this.#rebinder.bound.turning.leaves.indexOf(tear.flight);
    const leaves = pose.leaves.map((leaf, k) => (k === index ? this.#blend(tear, leaf) : leaf));
    return { ...pose, leaves, loose };
  }

  /** Frees what is being torn, and takes all loose sheets away. */
  close(): void {
    this.#end(false);
    this.#loose.clear();
  }

  /** Begins to tear a leaf that a pointer pulls beyond its reach. */
  #look(): void {
    const { drags, shape } = this.#rebinder.bound;
    for (const drag of drags.all) {
      if (drag === this.#declined || drag.pressing !== null) continue;
      const { flight } = drag;
      if (flight?.part !== "leaf" || flight.high - flight.low !== 1) continue;
      if (this.#stretch(drag, flight) < taut * shape.width) continue;
      this.#begin(flight, drag, [drag.u, drag.v], () => {});
      return;
    }
  }

  #begin(
    flight: Flight,
    drag: Drag | null,
    [u, v]: readonly [number, number],
    done: (isOff: boolean) => void,
  ): boolean {
    const { engine, binding, shape } = this.#rebinder.bound;
    const line = this.#hooks.line();
    const { recto, verso } = facesOfLeaf(binding, flight);
    const pages = [recto, verso].filter((page) => page !== null).sort((a, b) => a - b);
    if (line === null || pages.length === 0 || pages.length === binding.pageCount) return false;
    // Of what comes to lie outermost a cover would be made in its place.
    if (isCover(binding, leafOf(binding, pages[0]))) return false;
    // Boards are no book without a leaf between them.
    if (paperLeaves(binding) < 2) return false;
    const bound = this.#begun.get(pages[0]);
    const table = { table: tableHeight(shape), rim: shape.rim };
    const sheet = engine.tearing?.tear(flight.id, { line, bound, ...table });
    if (!sheet) return false;
    sheet.grab(u, v);
    const isAsked = bound !== undefined;
    this.#tear = { flight, sheet, pages, drag, isAsked, away: 0, since: null, done };
    return true;
  }

  /** Takes the leaf that is being torn out at once, if its owner lets it go. */
  #cut(): void {
    const tear = this.#tear;
    if (tear === null) return;
    if (!tear.isAsked && !this.#hooks.mayTear(tear.pages)) this.#end(false);
    else if (this.#tear === tear) this.#finish(tear, false);
  }

  /** Pulls the sheet to where its pointer is, or onward where a command tears it. */
  #pull(tear: Tear, seconds: number): void {
    const { shape } = this.#rebinder.bound;
    if (tear.drag === null) {
      tear.away += seconds * commandSpeed * shape.width;
      tear.sheet.pull(this.#pulledTo(tear));
      if (tear.away >= longestPull * commandSpeed * shape.width) tear.sheet.cut();
      return;
    }
    const stretch = this.#stretch(tear.drag, tear.flight);
    // Let go, or taken back before anything gave way: it turns again as any leaf does.
    if (tear.drag.flight !== tear.flight || (stretch <= 0 && !tear.isAsked)) {
      tear.sheet.release();
      tear.since = 0;
    } else if (stretch <= 0) tear.sheet.pull(tear.drag.place);
    else tear.sheet.pull(onPlane(tear.drag.ray, this.#floor(tear.flight) + rising * stretch));
  }

  /** Returns where a command pulls a leaf: outward and up. */
  #pulledTo({ flight, away }: Tear): Vec3 {
    const { width, height } = this.#rebinder.bound.shape;
    const sign = sideBefore(flight) === Side.right ? 1 : -1;
    const [u, v] = commandHold;
    const x = sign * (u * width + 0.7 * away);
    return [x, v * height + 0.3 * away, this.#floor(flight) + 0.65 * away];
  }

  /**
   * The leaf is off: its pages leave the book, and it is a loose sheet.
   *
   * @param isSeen whether the sheet is shown
   */
  #finish(tear: Tear, isSeen = true): boolean {
    const { binding } = this.#rebinder.bound;
    const { recto, verso } = facesOfLeaf(binding, tear.flight);
    const take = (page: number | null) => (page === null ? null : this.#bitmaps.take(page));
    this.#tear = null;
    // Without the leaf the book lies between the pages beside it, which may be elsewhere than where it last rested.
    this.#hooks.lay(tear.flight.low);
    const pictures = { recto: take(recto), verso: take(verso) };
    const id = this.#hooks.takeOut(tear.pages);
    if (id === null) {
      for (const picture of [pictures.recto, pictures.verso]) {
        if (picture) this.#bitmaps.drop(picture);
      }
      tear.sheet.destroy();
      tear.done(false);
      return false;
    }
    this.#loose.add(id, tear.sheet, pictures);
    if (!isSeen) this.#loose.remove(id);
    const [u, v] = tear.drag ? [tear.drag.u, tear.drag.v] : commandHold;
    if (tear.drag) tear.drag.carry(this.#loose.grab(id, u, v));
    else this.#loose.putAside(id);
    tear.done(true);
    return true;
  }

  /** Ends what is being torn: it is drawn as bound again. */
  #end(isOff: boolean): false {
    const tear = this.#tear;
    this.#tear = null;
    this.#drawn = null;
    tear?.sheet.destroy();
    tear?.done(isOff);
    return false;
  }

  /** Returns the sheet, or something between it and the leaf once it was let go. */
  #blend(tear: Tear, leaf: Surface): Surface {
    const { surface } = tear.sheet;
    const part = tear.since === null ? 1 : Math.max(1 - tear.since / mended, 0);
    if (part === 1) return surface;
    const known = this.#drawn;
    if (known?.sheet === surface && known.part === part) return known.surface;
    const mix = (a: Float32Array, b: Float32Array) => a.map((x, k) => x + part * (b[k] - x));
    const blended = {
      ...surface,
      positions: mix(leaf.positions, surface.positions),
      normals: mix(leaf.normals, surface.normals),
    };
    this.#drawn = { surface: blended, sheet: surface, part };
    return blended;
  }

  /** Picks up the uppermost leaf of paper on a side. */
  #pickUp(side: Side): Flight | null {
    const { turning } = this.#rebinder.bound;
    return this.#rebinder.bound.pickUpToFold(side) ? (turning.flights.at(0) ?? null) : null;
  }

  /** Height of the pages on the side where a leaf lay, metres. */
  #floor(flight: Flight): number {
    return pileHeight(this.#rebinder.bound.engine.pile(sideBefore(flight)));
  }

  /**
   * Returns how far a pointer is beyond where its leaf reaches, on the side where that lay: from
   * the spine, and from its ends, metres.
   */
  #stretch(drag: Drag, flight: Flight): number {
    const { width, height } = this.#rebinder.bound.shape;
    const sign = sideBefore(flight) === Side.right ? 1 : -1;
    const [x, y] = onPlane(drag.ray, this.#floor(flight));
    if (sign * x <= 0) return 0;
    const [u, v] = [drag.u * width, drag.v * height];
    const beyond = (end: number) => Math.hypot(x, y - end) - Math.hypot(u, v - end);
    return Math.max(sign * x - u, beyond(0), beyond(height));
  }
}

/** Returns the side on which a page lies open, on a leaf that may be torn out; null if it does not. */
function sideOf(binding: Binding, spread: number, page: number): Side | null {
  const at = leafOf(binding, page);
  if (!pagesAt(binding, spread).includes(page) || isCover(binding, at)) return null;
  const leaf = paperOnLeft(binding, at);
  const onLeft = paperOnLeft(binding, spread);
  if (leaf === onLeft) return Side.right;
  return leaf === onLeft - 1 ? Side.left : null;
}
