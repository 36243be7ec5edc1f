/** Gives every face of the drawn book the best picture of its page, and asks for the pages wanted next. */

import {
  type Face,
  faceNames,
  facesBetween,
  facesOfLeaf,
  isBoardFace,
  pagesWanted,
} from "../book/faces.ts";
import type { Binding } from "../book/spreads.ts";
import type { Turning } from "../book/turning.ts";
import type { BookStage } from "../draw/stage.ts";
import type { PagePictures } from "../pages/page_pictures.ts";

/** Leaves in flight whose pages are drawn as sharp as those at rest: many pass by too fast to be read. */
const mostSharpFlights = 2;

/** The spreads left and right of all that is in flight. */
export function spreadsBetween({ flights, spread }: Turning): [low: number, high: number] {
  return [flights[0]?.low ?? spread, flights.at(-1)?.high ?? spread];
}

/** Brings a book's pictures onto its stage. */
export class Picturing {
  readonly #binding: Binding;
  readonly #stage: BookStage;
  readonly #turning: Turning;
  readonly #pictures: PagePictures;

  constructor(binding: Binding, stage: BookStage, turning: Turning, pictures: PagePictures) {
    this.#binding = binding;
    this.#stage = stage;
    this.#turning = turning;
    this.#pictures = pictures;
  }

  /** Asks for the pages in sight and those that may come next, `width` device pixels wide. */
  want(width: number): void {
    const { flights, spread, destination } = this.#turning;
    const wanted = pagesWanted(this.#binding, spread, flights, destination);
    this.#pictures.want(wanted, width, flights.length > mostSharpFlights);
  }

  /** Shows on every face what there is. */
  show(): void {
    const pages = facesBetween(this.#binding, ...spreadsBetween(this.#turning));
    for (const face of faceNames) this.#stage.setFace(face, this.#pictureOf(face, pages[face]));
    for (const [index, flight] of this.#turning.flights.entries()) {
      if (flight.part !== "leaf") continue;
      const { recto, verso } = facesOfLeaf(this.#binding, flight);
      this.#stage.setLeaf(index, "recto", this.#pictureOfPaper(recto));
      this.#stage.setLeaf(index, "verso", this.#pictureOfPaper(verso));
    }
  }

  #pictureOf(face: Face, page: number | null) {
    // A board seen by its edge alone is plain cloth rather than a page to come.
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
