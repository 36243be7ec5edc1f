/** The open fold-out, or the one that opens or closes. There is at most one. */

import { columnPlace, type Pile, type Surface } from "../engine/shapes.ts";
import type { OpenFoldOut, PageBitmaps } from "../pages/page_bitmaps.ts";
import { foldAt } from "../pages/page_place.ts";
import type { BookPose, BookShape } from "../stage/book_pose.ts";

/** Time in which a flap opens, seconds. */
const openTime = 0.6;

/** The dependencies and callbacks of fold-outs. */
export interface FoldOutHooks {
  /** Whether fold-outs can lie open at all. */
  readonly unfolds: boolean;
  /** Width of a leaf, device pixels. */
  readonly width: () => number;
  /** Called when the faces show other bitmaps than before. */
  readonly changed: () => void;
}

/** A fold-out and how far it is open. */
interface Flap {
  readonly page: number;
  readonly sign: 1 | -1;
  readonly parts: OpenFoldOut;
  open: number;
  to: 0 | 1;
}

/** Unfolds and folds in a fold-out. */
export class FoldOut {
  readonly #pictures: PageBitmaps;
  readonly #hooks: FoldOutHooks;
  #flap: Flap | null = null;
  #drawing: AbortController | null = null;
  #waiting: ((done: boolean) => void)[] = [];
  #surface: { open: number; surface: Surface } | null = null;
  #version = 0;

  constructor(pictures: PageBitmaps, hooks: FoldOutHooks) {
    this.#pictures = pictures;
    this.#hooks = hooks;
  }

  /** The page (from 1) that lies open or opens; null if none does. */
  get page(): number | null {
    return this.#flap?.to === 1 ? this.#flap.page : null;
  }

  /**
   * The bitmaps on the flap, and the side of the book that it belongs to; null
   * if no flap is visible.
   */
  get parts(): (OpenFoldOut & { readonly sign: 1 | -1 }) | null {
    return this.#flap && { ...this.#flap.parts, sign: this.#flap.sign };
  }

  /**
   * Opens the fold-out of a page on a side (1 right, -1 left). Resolves, once
   * it lies open, to whether it does.
   */
  async unfold(page: number, sign: 1 | -1): Promise<boolean> {
    if (!this.#hooks.unfolds) return false;
    this.close();
    const drawing = new AbortController();
    this.#drawing = drawing;
    const width = this.#hooks.width();
    const parts = await this.#pictures.unfold(page, width, drawing.signal).catch(() => null);
    if (drawing.signal.aborted || parts === null) {
      if (parts) this.#pictures.foldIn();
      return false;
    }
    this.#flap = { page, sign, parts, open: 0, to: 1 };
    this.#hooks.changed();
    return await new Promise((resolve) => this.#waiting.push(resolve));
  }

  /** Folds in the open fold-out. Resolves once it is folded in. */
  async foldIn(): Promise<void> {
    this.#drawing?.abort();
    if (this.#flap === null) return;
    this.#tell(false);
    this.#flap.to = 0;
    await new Promise((resolve) => this.#waiting.push(resolve));
  }

  /** Advances the motion. Returns whether anything moves. */
  step(seconds: number): boolean {
    const flap = this.#flap;
    if (flap === null || (flap.to === 1 && flap.open === 1)) return false;
    const way = seconds / openTime;
    flap.open = flap.to === 1 ? Math.min(flap.open + way, 1) : Math.max(flap.open - way, 0);
    if (flap.open !== flap.to) return true;
    if (flap.to === 0) this.close();
    else this.#tell(true);
    return false;
  }

  /** Returns the flap over the pages of a pose. */
  surface(pose: BookPose, { width, height }: BookShape): Surface | null {
    const flap = this.#flap;
    const pile = flap?.sign === 1 ? pose.right : pose.left;
    if (flap === null || pile === null) return null;
    const { sign, open } = flap;
    if (this.#surface?.open !== open) {
      const place = { sign, open, fold: foldAt, fraction: flap.parts.place.width - foldAt };
      this.#surface = {
        open,
        surface: flapSurface(place, pile, width, height, ++this.#version),
      };
    }
    return this.#surface.surface;
  }

  /** Removes everything at once. */
  close(): void {
    this.#drawing?.abort();
    this.#surface = null;
    if (this.#flap === null) return;
    this.#flap = null;
    this.#pictures.foldIn();
    this.#hooks.changed();
    this.#tell(false);
  }

  #tell(done: boolean): void {
    for (const resolve of this.#waiting.splice(0)) resolve(done);
  }
}

/** Where a flap is. */
interface FlapPlace {
  /** 1 on the page on the right, -1 on the left. */
  readonly sign: 1 | -1;
  /** 0 folded in, 1 lying open. */
  readonly open: number;
  /**
   * Position of the fold, as a fraction of the page from the spine, and the
   * width of the flap, likewise.
   */
  readonly fold: number;
  readonly fraction: number;
}

/** Rows of a flap: as fine as a leaf in flight, which is drawn in its place. */
const rows = 25;

/** Height of a folded flap over its page, metres. */
const clear = 0.0006;

/** The last part of its way down in which a flap takes the page's shape. */
const settling = 0.3;

/**
 * Returns the flap as a sheet: a row runs from the fold outward.
 *
 * @param pile that the page lies on
 * @param width,height of the book's page, metres
 * @param version of the sheet
 */
function flapSurface(
  { sign, open, fold, fraction }: FlapPlace,
  pile: Pile,
  width: number,
  height: number,
  version: number,
): Surface {
  const { columns } = pile;
  const positions = new Float32Array(3 * columns * rows);
  const normals = new Float32Array(positions.length);
  const eased = open * open * (3 - 2 * open);
  // From the page's own side over the top to the far side, seen as on the right.
  const angle = Math.PI * (1 - eased);
  const lying = Math.max(0, 1 - eased / settling) ** 2;
  const [hingeX, hingeZ] = placeOn(pile, fold);
  const line = new Float32Array(2 * columns);
  for (let column = 0; column < columns; column++) {
    const out = fraction * columnPlace(column, columns);
    const x = hingeX + sign * width * out * Math.cos(angle);
    const z = hingeZ + clear + width * out * Math.sin(angle);
    const [pageX, pageZ] = placeOn(pile, Math.max(fold - out, 0));
    line[2 * column] = x + (pageX - x) * lying;
    line[2 * column + 1] = z + (pageZ + clear - z) * lying;
  }
  for (let column = 0; column < columns; column++) {
    const [from, to] = [2 * Math.max(column - 1, 0), 2 * Math.min(column + 1, columns - 1)];
    const [dx, dz] = [line[to] - line[from], line[to + 1] - line[from + 1]];
    const length = Math.hypot(dx, dz) || 1;
    for (let row = 0; row < rows; row++) {
      const at = 3 * (row * columns + column);
      positions.set([line[2 * column], (height * row) / (rows - 1), line[2 * column + 1]], at);
      normals.set([-dz / length, 0, dx / length], at);
    }
  }
  return { columns, rows, positions, normals, version };
}

/** Returns x and z of a pile's uppermost page at u, metres. */
function placeOn({ curves, columns }: Pile, u: number): [x: number, z: number] {
  let k = 0;
  while (k + 2 < columns && columnPlace(k + 1, columns) < u) k++;
  const [from, to] = [columnPlace(k, columns), columnPlace(k + 1, columns)];
  const t = (u - from) / (to - from);
  const at = (axis: number): number =>
    curves[2 * k + axis] + (curves[2 * k + 2 + axis] - curves[2 * k + axis]) * t;
  return [at(0), at(1)];
}
