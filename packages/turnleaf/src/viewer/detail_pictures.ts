/**
 * Sharpens pages that are seen larger than their bitmaps: the part in sight is
 * drawn again at the screen's resolution and laid over the bitmap.
 */

import { type Face, isBoardFace } from "../book/faces.ts";
import type { PageBitmaps } from "../pages/page_bitmaps.ts";
import { closePicture } from "../pages/page_pool.ts";
import type { PageBox, PagePicture, PageSize, PageSource } from "../sources/page_source.ts";
import type { BookStage } from "../stage/book_stage.ts";
import type { Bindable } from "./bound_book.ts";
import { isCoarse, type OpenPage, texelsAt } from "./face_textures.ts";

/** What draws and shows sharper parts of pages. */
export interface SharpnessParts {
  readonly source: PageSource;
  readonly stage: BookStage;
  /** Has a leaf's width over its height, as it was measured last. */
  readonly book: Pick<Bindable, "aspect">;
  /** Gives the place of a page on its leaf. */
  readonly pictures: Pick<PageBitmaps, "placeOf">;
  /** Called when something has arrived and a frame should be drawn. */
  readonly arrived: () => void;
  /** Called if the code that draws sharper parts cannot be loaded: pages keep their bitmaps. */
  readonly failed: (error: unknown) => void;
}

/** The part of a page in sight, as fractions of its leaf, and its apparent size. */
interface VisiblePart {
  readonly box: PageBox;
  /** Texels of it that are seen across the whole leaf. */
  readonly across: number;
  /** Whether each of these is a pixel of the screen. */
  readonly isOnGrid: boolean;
}

/** A part of a page that is drawn or being drawn. */
interface Detail extends VisiblePart {
  readonly page: number;
  /** Texels across the whole leaf. */
  readonly texels: number;
  /** Null while it is being drawn, and if it cannot be. */
  picture: PagePicture | null;
  readonly drawing: AbortController;
}

/**
 * Texels per canvas pixel where they are interpolated: that blurs a page, and less
 * so if they are finer.
 */
const finer = 1.25;

/** Maximum of pixels of one detail, and along one side of it. */
const mostPixels = 8e6;
const mostAlong = 4096;

/**
 * How far a detail reaches beyond the part in sight, as a fraction of that
 * part, so that a little panning stays within it.
 */
const beyond = 0.2;

/** Strips of a page in each direction that are tested for being in sight. */
const strips = 40;

/** The details of the open pages. */
export class DetailPictures {
  readonly #source: PageSource;
  readonly #stage: BookStage;
  readonly #book: Pick<Bindable, "aspect">;
  readonly #pictures: Pick<PageBitmaps, "placeOf">;
  readonly #arrived: () => void;
  readonly #shown = new Map<Face, Detail>();
  readonly #coming = new Map<Face, Detail>();

  constructor({ source, stage, book, pictures, arrived }: SharpnessParts) {
    this.#pictures = pictures;
    this.#source = source;
    this.#stage = stage;
    this.#book = book;
    this.#arrived = arrived;
  }

  /** Whether every page in sight is sharp. */
  get settled(): boolean {
    return this.#coming.size === 0;
  }

  /**
   * Examines the open pages, at rest, and draws what is missing.
   *
   * @param canvas its size, CSS pixels
   */
  look(open: readonly OpenPage[], canvas: PageSize): void {
    this.keep(Object.fromEntries(open.map(({ face, page }) => [face, page])));
    for (const seen of open) {
      const { face, page } = seen;
      const box = isCoarse(this.#stage, seen) ? this.#boxInSight(face, canvas) : null;
      if (box === null) this.#drop(face);
      else {
        const across = texelsAt(this.#stage, face, ...middleOf(box));
        const isOnGrid = !isBoardFace(face) && this.#stage.pageTexels > 0;
        this.#want(face, page, { box, across, isOnGrid });
      }
    }
  }

  /** Removes details of pages other than those on the faces. */
  keep(pages: Partial<Record<Face, number | null>>): void {
    for (const details of [this.#shown, this.#coming]) {
      for (const [face, { page }] of details) if (pages[face] !== page) this.#drop(face);
    }
  }

  /** Removes the detail of a page (from 1) whose content has changed. */
  redraw(page: number): void {
    for (const details of [this.#shown, this.#coming]) {
      for (const [face, detail] of details) if (detail.page === page) this.#drop(face);
    }
  }

  /** Stops drawing; visible details stay. */
  pause(): void {
    for (const face of [...this.#coming.keys()]) this.#abort(face);
  }

  #want(face: Face, page: number, sighted: VisiblePart): void {
    for (const details of [this.#shown, this.#coming]) {
      const detail = details.get(face);
      if (detail && serves(detail, sighted)) return;
    }
    this.#abort(face);
    const drawing = new AbortController();
    const { across, isOnGrid } = sighted;
    const reach = reaching(sighted, this.#book.aspect);
    const detail: Detail = { page, across, isOnGrid, ...reach, picture: null, drawing };
    this.#coming.set(face, detail);
    void this.#draw(face, detail);
  }

  async #draw(face: Face, detail: Detail): Promise<void> {
    const { page, box, texels, drawing } = detail;
    const { signal } = drawing;
    try {
      const size = await this.#source.size(page - 1, signal);
      const { width, height } = size;
      const place = this.#pictures.placeOf(page, size);
      const dots = texels * place.width;
      const region = onDots(within(box, place), dots, (dots * height) / width);
      // Slightly more than whole pixels, so that rounding does not drop one.
      const pixels = region.width * dots + 0.01;
      const picture = await this.#source.draw(page - 1, pixels, signal, region);
      if (signal.aborted) closePicture(picture);
      signal.throwIfAborted();
      detail.picture = picture;
      this.#stage.setDetail(face, { picture, box: onLeaf(region, place) });
    } catch {
      // The page's bitmap stays; its own drawing reports the error.
      if (signal.aborted) return;
    }
    this.#coming.delete(face);
    const before = this.#shown.get(face);
    this.#shown.set(face, detail);
    if (before) this.#free(before);
    this.#arrived();
  }

  #abort(face: Face): void {
    this.#coming.get(face)?.drawing.abort(new DOMException("Not in sight.", "AbortError"));
    this.#coming.delete(face);
  }

  #drop(face: Face): void {
    this.#abort(face);
    const detail = this.#shown.get(face);
    if (detail === undefined) return;
    this.#shown.delete(face);
    this.#stage.setDetail(face, null);
    this.#free(detail);
  }

  #free({ picture }: Detail): void {
    if (picture === null) return;
    this.#stage.forget(picture);
    closePicture(picture);
  }

  /** Returns the part of a face that is visible on the canvas, or null. */
  #boxInSight(face: Face, { width, height }: PageSize): PageBox | null {
    const at = Array.from({ length: strips + 1 }, (_, row) =>
      Array.from({ length: strips + 1 }, (_, column) =>
        this.#stage.projectOn(face, column / strips, row / strips),
      ),
    );
    let [left, top, right, bottom] = [strips, strips, 0, 0];
    for (let row = 0; row < strips; row++) {
      for (let column = 0; column < strips; column++) {
        const corners = [0, 1].flatMap((k) => [at[row + k][column], at[row + k][column + 1]]);
        const [xs, ys] = [corners.map(({ x }) => x), corners.map(({ y }) => y)];
        if (Math.max(...xs) < 0 || Math.min(...xs) > width) continue;
        if (Math.max(...ys) < 0 || Math.min(...ys) > height) continue;
        [left, right] = [Math.min(left, column), Math.max(right, column + 1)];
        [top, bottom] = [Math.min(top, row), Math.max(bottom, row + 1)];
      }
    }
    if (right === 0) return null;
    return boxOf(left / strips, top / strips, right / strips, bottom / strips);
  }
}

/** Returns whether a detail covers the part in sight at about its apparent size. */
function serves(detail: VisiblePart, { box, across, isOnGrid }: VisiblePart): boolean {
  const slack = 1e-6;
  if (isOnGrid && detail.across !== across) return false;
  return (
    detail.box.x <= box.x + slack &&
    detail.box.y <= box.y + slack &&
    detail.box.x + detail.box.width >= box.x + box.width - slack &&
    detail.box.y + detail.box.height >= box.y + box.height - slack &&
    detail.across > 0.98 * across &&
    detail.across < 1.6 * across
  );
}

/** Returns the part to draw for a part in sight: somewhat more of the page, within memory. */
function reaching(
  { box, across, isOnGrid }: VisiblePart,
  aspect: number,
): Pick<Detail, "box" | "texels"> {
  const texels = isOnGrid ? across : across * finer;
  const pixels = ({ width, height }: PageBox): number => texels ** 2 * width * (height / aspect);
  let best = box;
  for (const fraction of [beyond, beyond / 2, 0]) {
    const [dx, dy] = [fraction * box.width, fraction * box.height];
    best = boxOf(
      Math.max(box.x - dx, 0),
      Math.max(box.y - dy, 0),
      Math.min(box.x + box.width + dx, 1),
      Math.min(box.y + box.height + dy, 1),
    );
    if (pixels(best) <= mostPixels) break;
  }
  const longest = Math.max(best.width, best.height / aspect) * texels;
  const fit = Math.min(Math.sqrt(mostPixels / pixels(best)), mostAlong / longest, 1);
  return { box: best, texels: texels * fit };
}

/** Converts a box of the leaf to a box of the page that covers `place` of it. */
function within(box: PageBox, place: PageBox): PageBox {
  const x = (value: number): number => clamped((value - place.x) / place.width);
  const y = (value: number): number => clamped((value - place.y) / place.height);
  return boxOf(x(box.x), y(box.y), x(box.x + box.width), y(box.y + box.height));
}

/**
 * Grows a box of a page to whole pixels of the given resolution, so that a
 * picture of it is neither stretched nor shifted.
 */
function onDots(box: PageBox, across: number, down: number): PageBox {
  const [left, top] = [Math.floor(box.x * across), Math.floor(box.y * down)];
  const right = Math.max(Math.ceil((box.x + box.width) * across), left + 1);
  const bottom = Math.max(Math.ceil((box.y + box.height) * down), top + 1);
  return boxOf(left / across, top / down, right / across, bottom / down);
}

/** The inverse of `within`. */
function onLeaf(region: PageBox, place: PageBox): PageBox {
  return {
    x: place.x + region.x * place.width,
    y: place.y + region.y * place.height,
    width: region.width * place.width,
    height: region.height * place.height,
  };
}

function boxOf(left: number, top: number, right: number, bottom: number): PageBox {
  return { x: left, y: top, width: right - left, height: bottom - top };
}

function middleOf(box: PageBox): [number, number] {
  return [box.x + box.width / 2, box.y + box.height / 2];
}

function clamped(fraction: number): number {
  return Math.min(Math.max(fraction, 0), 1);
}
