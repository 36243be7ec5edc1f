/** Sharpens pages that are seen larger than their bitmaps: the code is loaded when one first is. */

import type { Face } from "../book/faces.ts";
import { loadPart } from "../sources/load_part.ts";
import type { PageSize } from "../sources/page_source.ts";
import type { DetailPictures, SharpnessParts } from "./detail_pictures.ts";
import { isCoarse, type OpenPage } from "./face_textures.ts";

/** The sharper parts of the open pages. */
export class Sharpness {
  readonly #tools: SharpnessParts;
  #details: DetailPictures | null = null;
  #isLoading = false;
  #isAsked = false;

  constructor(tools: SharpnessParts) {
    this.#tools = tools;
  }

  /** Whether every page in sight is sharp. */
  get settled(): boolean {
    return !this.#isLoading && (this.#details?.settled ?? true);
  }

  /**
   * Examines the open pages, at rest, and draws what is missing.
   *
   * @param canvas its size, CSS pixels
   */
  look(open: readonly OpenPage[], canvas: PageSize): void {
    if (this.#details) this.#details.look(open, canvas);
    else if (!this.#isAsked && open.some((page) => isCoarse(this.#tools.stage, page))) this.#load();
  }

  /** Removes details of pages other than those on the faces. */
  keep(pages: Partial<Record<Face, number | null>>): void {
    this.#details?.keep(pages);
  }

  /** Removes the detail of a page (from 1) whose content has changed. */
  redraw(page: number): void {
    this.#details?.redraw(page);
  }

  /** Stops drawing; visible details stay. */
  pause(): void {
    this.#details?.pause();
  }

  /** Removes everything. */
  close(): void {
    this.#details?.keep({});
  }

  #load(): void {
    this.#isAsked = this.#isLoading = true;
    const { arrived, failed } = this.#tools;
    loadPart(import("./detail_pictures.ts"))
      .then(({ DetailPictures }) => {
        this.#details = new DetailPictures(this.#tools);
      }, failed)
      .finally(() => {
        this.#isLoading = false;
        arrived();
      });
  }
}
