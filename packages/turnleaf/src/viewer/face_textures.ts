/**
 * Shows the best bitmap of its page on every face of the drawn book, requests
 * the pages wanted next, and finds those that are seen larger than their
 * bitmaps.
 */

import {
  type Face,
  faceNames,
  faceOf,
  facesBetween,
  facesOfLeaf,
  isBoardFace,
  pagesWanted,
} from "../book/faces.ts";
import { type Binding, leftPage, pagesAt, rightPage, spineOf } from "../book/spreads.ts";
import type { Turning } from "../book/turning.ts";
import { Side } from "../engine/phases.ts";
import type { PageBitmaps } from "../pages/page_bitmaps.ts";
import { isTrimmed } from "../pages/page_place.ts";
import type { PagePicture } from "../sources/page_source.ts";
import type { BookShape } from "../stage/book_pose.ts";
import type { BookStage } from "../stage/book_stage.ts";
import type { CameraMotion } from "./camera_motion.ts";
import type { FoldOut } from "./fold_out.ts";

/**
 * Maximum of leaves in flight whose pages are drawn as sharp as those at rest:
 * many pass by too fast to be read.
 */
const mostSharpFlights = 2;

/** Widths of bitmaps of whole pages, device pixels. */
export interface BitmapWidths {
  /** Of a page of paper. */
  readonly page: number;
  /** Of one on a board. */
  readonly board: number;
}

/** Maximum of them. */
const widest = 2048;

/**
 * Returns the widths at which pages look sharp when the whole book is shown: just the pixels of the
 * screen where their texels lie on these, else more, in steps, so that a small change of
 * size redraws nothing.
 */
export function bitmapWidths(
  { width, height, quarterTurned, alone }: BookShape,
  stage: BookStage,
  viewing: CameraMotion,
): BitmapWidths {
  const [u, v] = quarterTurned
    ? [0.6 * width * (alone || 1), height]
    : [width * (alone || 1), 0.4 * height];
  // The pages of a turn are those of the rest after it.
  return viewing.lookAtRest(() => {
    const spine = stage.project(quarterTurned ? [u, 0, 0] : [0, v, 0]);
    const edge = stage.project([u, v, 0]);
    const onScreen = Math.hypot(edge.x - spine.x, edge.y - spine.y) * stage.restingRatio;
    const board = Math.min(Math.ceil((onScreen * 1.2) / 256) * 256, widest);
    const texels = stage.pageTexels;
    return { board, page: texels > 0 && texels <= widest ? texels : board };
  });
}

/** A page that lies open, and the face that shows it. */
export interface OpenPage {
  readonly face: Face;
  /** From 1. */
  readonly page: number;
  /** Width of its bitmap in device pixels; infinite if the source has no sharper one. */
  readonly width: number;
}

/** Brings a book's bitmaps onto its stage. */
export class FaceTextures {
  readonly #binding: Binding;
  readonly #stage: BookStage;
  readonly #turning: Turning;
  readonly #pictures: PageBitmaps;
  readonly #cloth: string;
  /** The bitmaps on the stage, in the order in which they were brought there. */
  #shown: readonly (PagePicture | null)[] = [];

  /** @param cloth CSS colour of the boards */
  constructor(
    binding: Binding,
    stage: BookStage,
    turning: Turning,
    pictures: PageBitmaps,
    cloth: string,
  ) {
    this.#binding = binding;
    this.#stage = stage;
    this.#turning = turning;
    this.#pictures = pictures;
    this.#cloth = cloth;
  }

  /** Requests the visible pages and those that may come next. */
  want({ page, board }: BitmapWidths): void {
    const { flights, drawn, spread, destination } = this.#turning;
    const wanted = pagesWanted(this.#binding, spread, drawn, destination);
    const widthOf = (number: number): number =>
      spineOf(this.#binding, number) === "board" ? board : page;
    this.#pictures.want(wanted, widthOf, flights.length > mostSharpFlights);
  }

  /** The page on each face. */
  get pages(): Record<Face, number | null> {
    return facesBetween(this.#binding, this.#turning.under);
  }

  /** The pages that lie open if nothing is in flight. */
  get open(): OpenPage[] {
    const { spread } = this.#turning;
    const { pages } = this;
    return pagesAt(this.#binding, spread).flatMap((page) => {
      const face = faceOf(this.#binding, spread, page);
      // A creased page that lies there is drawn by itself, over another.
      return face && pages[face] === page
        ? [{ face, page, width: this.#pictures.sharpness(page) }]
        : [];
    });
  }

  /**
   * Shows what is available on every face, and on the flap of an open fold-out.
   *
   * @param isStill whether pages that are elements lie over theirs
   * @returns whether any bitmap is another than before
   */
  show(flap: FoldOut["parts"], isStill: boolean): boolean {
    const { pages } = this;
    const before = this.#shown;
    const shown: (PagePicture | null)[] = [];
    const note = <T extends PagePicture | null>(picture: T): T => {
      shown.push(picture);
      return picture;
    };
    const { hardCover, reversed } = this.#binding;
    const front = hardCover ? (reversed ? "backOutside" : "frontOutside") : null;
    for (const face of faceNames) {
      const page = pages[face];
      if (page === null && face === front) {
        this.#stage.setFace(face, note(this.#pictures.stampOn(this.#cloth)));
        continue;
      }
      const under = isStill && page !== null ? this.#pictures.under(page) : null;
      this.#stage.setFace(face, note(under ?? this.#pictureOf(face, page)));
    }
    if (flap) {
      const isRight = flap.side === Side.right;
      const [front, back] = isRight ? [flap.flap, flap.back] : [flap.back, flap.flap];
      // The flap is drawn after those that lie folded.
      const index = this.#turning.leaves.length;
      this.#stage.setLeaf(index, "recto", note(front));
      this.#stage.setLeaf(index, "verso", note(back));
    }
    const { low, high } = this.#turning.under;
    for (const [side, page, behind, next] of [
      ["left", pages.left, rightPage(this.#binding, low - 1), low - 1],
      ["right", pages.right, leftPage(this.#binding, high + 1), high + 1],
    ] as const) {
      const under = this.#under(side, page, behind, next);
      this.#stage.setUnder(side, note(under.behind), note(under.beneath));
    }
    for (const [index, leaf] of this.#turning.leaves.entries()) {
      const { recto, verso } = facesOfLeaf(this.#binding, leaf);
      this.#stage.setLeaf(index, "recto", note(this.#pictureOfPaper(recto)));
      this.#stage.setLeaf(index, "verso", note(this.#pictureOfPaper(verso)));
    }
    this.#shown = shown;
    return shown.length !== before.length || shown.some((picture, k) => picture !== before[k]);
  }

  /**
   * Returns what is visible beside a page whose leaf is trimmed: the page on its
   * back, and the next that lies on its side.
   */
  #under(side: "left" | "right", page: number | null, behind: number | null, next: number) {
    const isCut = page !== null && isTrimmed(this.#pictures.placeOfDrawn(page));
    const under = side === "left" ? leftPage(this.#binding, next) : rightPage(this.#binding, next);
    const picture = (page: number | null) =>
      page === null || !isCut ? null : this.#pictures.getIfDrawn(page);
    return { behind: picture(behind), beneath: picture(under) };
  }

  #pictureOf(face: Face, page: number | null) {
    // A board seen edge-on is plain cloth rather than a page to come.
    if (page !== null) {
      return isBoardFace(face) ? this.#pictures.getIfDrawn(page) : this.#pictures.get(page);
    }
    return null;
  }

  #pictureOfPaper(page: number | null) {
    // A book with an odd number of pages ends in a bare verso.
    return page === null ? this.#pictures.bare : this.#pictures.get(page);
  }
}

/**
 * Returns the texels of a bitmap across a whole page that are seen on a face: a pixel of the screen
 * each where they lie on these, else one of the canvas at the size that the page has at a point.
 */
export function texelsAt(stage: BookStage, face: Face, x: number, y: number): number {
  const texels = isBoardFace(face) ? 0 : stage.pageTexels;
  if (texels > 0) return texels;
  const [from, to] = [x - 0.01, x + 0.01].map((x) => stage.projectOn(face, x, y));
  return (Math.hypot(to.x - from.x, to.y - from.y) / 0.02) * stage.restingRatio;
}

/**
 * Returns whether a page is seen larger than its bitmap. Before the bitmap
 * arrives, the page's place on its leaf is unknown.
 */
export function isCoarse(stage: BookStage, { face, width }: OpenPage): boolean {
  return width > 0 && texelsAt(stage, face, 0.5, 0.5) > width;
}
