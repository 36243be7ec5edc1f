/** Pages of a book that are elements of the web page. */

import { loadPart } from "../sources/load_part.ts";
import type { PageList } from "../sources/page_list.ts";
import type { NewIndex, PageSource } from "../sources/page_source.ts";
import type { Viewer } from "../viewer/viewer.ts";
import { languageOf, pageNamed } from "../words/languages.ts";
import type { LivePages } from "./live_pages.ts";

/** Turns the open book to a page (from 1), and to a place so far down it, as `top` of `LinkTarget`. */
export type GoTo = (page: number, top?: number) => void;

/** Pages of a book that are elements: the code that lays them out is loaded when there is one. */
export class BookElements {
  readonly #element: HTMLElement;
  readonly #stage: HTMLElement;
  readonly #source: PageList;
  readonly #goTo: GoTo;
  #live: LivePages | null = null;
  #isEnded = false;
  #viewer: Viewer | null = null;

  constructor(element: HTMLElement, stage: HTMLElement, source: PageList, goTo: GoTo) {
    this.#element = element;
    this.#stage = stage;
    this.#source = source;
    this.#goTo = goTo;
  }

  /** Lays out the pages of a source that are elements: the book's own, or one to be added. */
  async adopt(source: PageSource): Promise<void> {
    if (!hasElements(source)) return;
    const { LivePages } = await loadPart(import("./live_pages.ts"));
    if (this.#isEnded) return;
    this.#live ??= this.#lay(LivePages);
    this.#live.adopt(source, source === this.#source);
  }

  /** Makes a change of the pages, and follows it. */
  after(change: () => NewIndex): NewIndex {
    const moved = change();
    this.refresh();
    return moved;
  }

  /** Lays out the elements that are pages now, and no others. */
  refresh(): void {
    this.#live?.adopt(this.#source);
  }

  /** Shows them over the pages of a viewer. */
  follow(viewer: Viewer): void {
    this.#viewer = viewer;
    this.#live?.follow(viewer, this.#source);
  }

  /** Removes their places. */
  destroy(): void {
    this.#isEnded = true;
    this.#live?.destroy();
  }

  #lay(Live: typeof LivePages): LivePages {
    const source = this.#source;
    const live = new Live(this.#element, this.#stage, {
      name: (page) => pageNamed(languageOf(this.#element), source.label(page - 1)),
      pageOf: (element) => {
        for (let index = 0; index < source.pageCount; index++) {
          if (source.element(index) === element) return index + 1;
        }
        return 0;
      },
      goTo: this.#goTo,
    });
    if (this.#viewer) live.follow(this.#viewer, source);
    return live;
  }
}

/** Returns whether pages of a source are elements. */
export function hasElements(source: PageSource): boolean {
  for (let index = 0; index < source.pageCount; index++) if (source.element?.(index)) return true;
  return false;
}
