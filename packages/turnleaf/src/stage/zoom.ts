/**
 * Which part of the book's picture is shown, and how large. Zoom is optical:
 * the same picture magnified and shifted, except that the camera moves right
 * over the book as the level rises, so that the text stands upright. Pure
 * arithmetic.
 */

/** A zoom: 1 shows the whole book in the middle, less shows what lies beside it too. */
export interface Zoom {
  readonly level: number;
  /** The point of book space (metres, at the height of the pages) in the middle of the canvas. */
  readonly x: number;
  readonly y: number;
}

/** The view of the whole book, which has its middle by itself. */
export const wholeBook: Zoom = { level: 1, x: 0, y: 0 };

/** A place on the canvas, in fractions of its size from its upper left corner. */
export type CanvasFraction = readonly [x: number, y: number];

/** The picture of a whole book from a camera position. */
export interface Sight {
  /** Returns where a point of the plane of the pages is in the picture. */
  seen(x: number, y: number): CanvasFraction;
  /** Returns the point of that plane at a place of the picture. */
  point(at: CanvasFraction): CanvasFraction;
  /** The book's outline in it: left, top, right, bottom. */
  readonly book: readonly [number, number, number, number];
}

/**
 * Where the area beyond the spine of a page that stands alone begins to fade
 * and where it has vanished, as fractions of the page's width.
 */
export const fadeBeyondSpine = { from: 0.03, to: 0.3 };

/** The level from which on the book is seen from right over it. */
const overheadFrom = 1.6;

/** Margin around the book that may be panned into the canvas, as a fraction of it at zoom 1. */
const margin = 0.02;

/**
 * Returns how far over the book the camera is at a level: 0 from where a reader
 * sits, 1 from right over it.
 */
export function overheadAt(level: number): number {
  const t = within((level - 1) / (overheadFrom - 1), 0, 1);
  return t * t * (3 - 2 * t);
}

/** Interpolates between two zooms, 0 to 1: a point that both show in one place stays there. */
export function zoomBetween(from: Zoom, to: Zoom, fraction: number): Zoom {
  // Exactly there, without the rounding of the way: level 1 is the whole book.
  if (fraction === 1) return to;
  const level = from.level * (to.level / from.level) ** fraction;
  const isPan = Math.abs(to.level / from.level - 1) < 1e-6;
  const way = isPan ? fraction : (1 / level - 1 / from.level) / (1 / to.level - 1 / from.level);
  return { level, x: from.x + (to.x - from.x) * way, y: from.y + (to.y - from.y) * way };
}

/**
 * Clamps a zoom to the book as the book moves: nothing beyond the book is shown
 * while it fills the canvas, and the whole book is in its middle. A level below 1 is shown as it is.
 */
export class ZoomState {
  readonly #sightAt: (level: number) => Sight;
  #zoom: Zoom = wholeBook;

  /** @param sightAt returns the picture of the book at a level, before magnification */
  constructor(sightAt: (level: number) => Sight) {
    this.#sightAt = sightAt;
  }

  get zoom(): Zoom {
    return this.#zoom;
  }

  /**
   * Shows a zoom, clamped to the book. Returns the place in the picture of the
   * whole book that is in the middle.
   */
  show(zoom: Zoom): CanvasFraction {
    const sight = this.#sightAt(zoom.level);
    const middle = keptTo(sight, sight.seen(zoom.x, zoom.y), zoom.level);
    const [x, y] = sight.point(middle);
    this.#zoom = { level: zoom.level, x, y };
    return middle;
  }

  /**
   * Returns the zoom at `level` in which the point seen at `from` now is seen
   * at `to`, clamped to the book.
   */
  zoomed(level: number, from: CanvasFraction, to: CanvasFraction): Zoom {
    const now = this.#sightAt(this.#zoom.level);
    const middle = now.seen(this.#zoom.x, this.#zoom.y);
    const point = now.point(beside(middle, from, 1 / this.#zoom.level));
    const then = this.#sightAt(level);
    const wanted = beside(then.seen(...point), to, -1 / level);
    const [x, y] = then.point(keptTo(then, wanted, level));
    return { level, x, y };
  }
}

function beside([x, y]: CanvasFraction, at: CanvasFraction, scale: number): CanvasFraction {
  return [x + (at[0] - 0.5) * scale, y + (at[1] - 0.5) * scale];
}

function keptTo({ book }: Sight, [x, y]: CanvasFraction, level: number): CanvasFraction {
  // Farther away than the whole book is, what is beside it is looked at.
  if (level < 1) return [x, y];
  return [kept(x, 0.5 / level, book[0], book[2]), kept(y, 0.5 / level, book[1], book[3])];
}

/** A book that does not fill the canvas is centred; at level 1 all of it is shown. */
function kept(middle: number, half: number, from: number, to: number): number {
  const [low, high] = [from - margin + half, to + margin - half];
  const onBook = low > high ? (from + to) / 2 : within(middle, low, high);
  return within(onBook, half, 1 - half);
}

function within(value: number, low: number, high: number): number {
  return Math.min(Math.max(value, low), high);
}
