/** Sharpness where pages are seen larger than their pictures are: what sees to it is loaded when one first is. */

import type { Face } from "../book/faces.ts";
import { loaded } from "../sources/loaded.ts";
import { isCoarse, type OpenPage, type SharpnessTools } from "./coarseness.ts";
import type { DetailPictures } from "./detail_pictures.ts";

/** The sharper parts of the pages that lie open. */
export class Sharpness {
  readonly #tools: SharpnessTools;
  #details: DetailPictures | null = null;
  #isLoading = false;
  #isAsked = false;

  constructor(tools: SharpnessTools) {
    this.#tools = tools;
  }

  /** Whether nothing in sight waits to become sharper. */
  get settled(): boolean {
    return !this.#isLoading && (this.#details?.settled ?? true);
  }

  /** Looks at the pages that lie open, at rest on a canvas of so many CSS pixels, and draws what is missing. */
  look(open: readonly OpenPage[], width: number, height: number): void {
    if (this.#details) this.#details.look(open, width, height);
    else if (!this.#isAsked && open.some((page) => isCoarse(this.#tools.stage, page))) this.#load();
  }

  /** Takes away what belongs to other pages than those that are seen on the faces. */
  keep(pages: Partial<Record<Face, number | null>>): void {
    this.#details?.keep(pages);
  }

  /** Takes away what is shown of a page (from 1): it looks otherwise now. */
  redraw(page: number): void {
    this.#details?.redraw(page);
  }

  /** Stops drawing; what is shown stays. */
  pause(): void {
    this.#details?.pause();
  }

  /** Takes everything away. */
  close(): void {
    this.#details?.keep({});
  }

  #load(): void {
    this.#isAsked = this.#isLoading = true;
    const { arrived, failed } = this.#tools;
    loaded(import("./detail_pictures.ts"))
      .then(({ DetailPictures }) => {
        this.#details = new DetailPictures(this.#tools);
      }, failed)
      .finally(() => {
        this.#isLoading = false;
        arrived();
      });
  }
}
