/** Where a reader came from by a jump, until he reads on. */

import { type NewIndex, placeOf } from "../sources/page_source.ts";

/** The last jump of one reader. */
export class Jumps {
  #from: number | null = null;
  /** Whether the book is on its way to where the reader jumped. */
  #isUnderWay = false;

  /** The page (from 1) from which the reader jumped to where the book lies open; null if he has read on. */
  get from(): number | null {
    return this.#isUnderWay ? null : this.#from;
  }

  /** Call it when the reader jumps: from a page (from 1), unless a jump is under way already. */
  begin(page: number): void {
    if (!this.#isUnderWay) this.#from = page;
    this.#isUnderWay = true;
  }

  /** Call it when the book has come to rest elsewhere. */
  rested(): void {
    if (!this.#isUnderWay) this.#from = null;
    this.#isUnderWay = false;
  }

  /** Call it when the pages have moved. */
  follow(moved: NewIndex): void {
    if (this.#from !== null) this.#from = placeOf(moved, this.#from - 1) + 1;
  }

  /** Forgets the jump, as of a book that is closed. */
  forget(): void {
    this.#from = null;
    this.#isUnderWay = false;
  }
}
