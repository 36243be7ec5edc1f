/** The text of an open book, laid over its pages and searched: loaded after the book is shown. */

import { pagesAt } from "../book/spreads.ts";
import type { PageList } from "../sources/page_list.ts";
import { PageTexts } from "../text/page_texts.ts";
import type { PageView } from "../text/page_view.ts";
import { type SearchHit, searchBook } from "../text/searching.ts";
import { textStyle } from "../text/text.css.ts";
import { TextLayer, type TextLayerOptions } from "../text/text_layer.ts";
import type { Viewer } from "../viewer/viewer.ts";
import { elementTexts, fill, pageNamed } from "../words/languages.ts";
import type { RollView } from "./roll_view.ts";
import { addStyle } from "./shadow_tree.ts";

/** What the text layer needs of the open book. */
export interface TextTarget {
  readonly source: PageList;
  readonly viewer: Viewer;
  /** In a shadow tree; read out only if there is no text. */
  readonly canvas: HTMLCanvasElement;
  /** The pages that are scrolled; null if all are turned. */
  readonly roll: RollView | null;
  /** Turns to a page (from 1), and to a place so far down it, as `top` of `LinkTarget`. */
  readonly goTo: (page: number, top?: number) => void;
  /** Returns the tag of the element's language. */
  readonly language: () => string;
}

/** The text of one open book. */
export class BookTextOverlay {
  readonly #source: PageList;
  readonly #texts = new PageTexts();
  /** Over the book, and over the pages that are scrolled, if any are. */
  readonly #layers: readonly TextLayer[];
  readonly #roll: RollView | null;

  /** @param ended its abort removes the text */
  constructor({ source, viewer, canvas, roll, goTo, language }: TextTarget, ended: AbortSignal) {
    this.#source = source;
    const view: PageView = {
      get openPages() {
        return pagesAt(viewer.binding, viewer.turning.spread);
      },
      placeOf: (page, size) => viewer.placeOf(page, size),
      project: (...place) => (roll?.isShown ? null : viewer.project(...place)),
      onView: viewer.onViewChange.bind(viewer),
    };
    const options: TextLayerOptions = {
      source,
      name: (page) => pageNamed(language(), source.label(page - 1)),
      goTo: (page, top) => goTo(page, top ?? 0),
      leaving: (address) => {
        const texts = elementTexts(language());
        // Languages may have been added before these texts were.
        return {
          question: fill(texts.leaving ?? "{address}", { address }),
          follow: texts.leave ?? address,
        };
      },
      redraw: (page) => {
        viewer.redraw(page);
        roll?.redraw(page);
      },
      onText: (isText) => {
        canvas.ariaHidden = isText ? "true" : null;
      },
    };
    const removeStyle = addStyle(canvas.getRootNode() as ShadowRoot, textStyle);
    const over = new TextLayer(view, options);
    canvas.after(over.element);
    const layers = [over];
    if (roll) {
      const along = new TextLayer(roll, options);
      roll.content.append(along.element);
      layers.push(along);
    }
    this.#layers = layers;
    this.#roll = roll;
    // Beside the text of a web page a click ends its selection; on a canvas browsers leave it as it is.
    const deselect = (): void => getSelection()?.removeAllRanges();
    canvas.addEventListener("click", deselect, { signal: ended });
    ended.addEventListener("abort", () => {
      for (const layer of layers) layer.destroy();
      removeStyle();
    });
  }

  /** As the element's own. */
  search(
    query: string,
    signal: AbortSignal,
    found?: (hits: readonly SearchHit[]) => void,
  ): Promise<readonly SearchHit[]> {
    return searchBook(this.#source.textPages(signal), this.#texts, query, signal, found);
  }

  /** As of `PageTexts`. */
  get mayHaveText(): boolean {
    return this.#texts.mayHaveText;
  }

  /**
   * Marks a hit and every other place of its query when they become visible;
   * null removes the marks.
   */
  mark(hit: SearchHit | null): void {
    if (hit) this.#roll?.reveal(hit.page);
    for (const layer of this.#layers) layer.mark(hit);
  }

  /** Returns the column of text at a place of an open page, as `TextLayer` does. */
  columnAt(...place: Parameters<TextLayer["columnAt"]>): ReturnType<TextLayer["columnAt"]> {
    return this.#layers[0]?.columnAt(...place) ?? null;
  }

  /** As `TextLayer` has it. */
  columnsOf(page: number): ReturnType<TextLayer["columnsOf"]> {
    return this.#layers[0]?.columnsOf(page) ?? [];
  }

  /** As `TextLayer` has it, of the text over the book. */
  selectWord(...place: Parameters<TextLayer["selectWord"]>): ReturnType<TextLayer["selectWord"]> {
    return this.#layers[0]?.selectWord(...place) ?? null;
  }

  /** Reads the pages again after a change of the book. */
  changed(): void {
    for (const layer of this.#layers) layer.reload();
  }
}
