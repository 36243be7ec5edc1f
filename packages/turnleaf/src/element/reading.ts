/** The open book as text: laid over its pages, searched, told as contents. */

import { pagesAt } from "../book/spreads.ts";
import type { OutlineEntry, PageSource } from "../sources/page_source.ts";
import { PageTexts } from "../text/page_texts.ts";
import type { PageView } from "../text/page_view.ts";
import { type SearchHit, searchBook } from "../text/searching.ts";
import { TextLayer } from "../text/text_layer.ts";
import type { Viewer } from "../viewer.ts";
import { elementTexts, fill } from "../words/languages.ts";

/** What an open book has to read. */
export class Reading {
  readonly #source: PageSource;
  readonly #texts: PageTexts;
  readonly #layer: TextLayer;
  readonly #ended = new AbortController();

  /**
   * @param canvas what the text is laid over; it is read out only where there is none
   * @param goTo turns to a page (from 1)
   * @param language tag of the language that the element speaks
   */
  constructor(
    source: PageSource,
    viewer: Viewer,
    canvas: HTMLCanvasElement,
    goTo: (page: number) => void,
    language: () => string,
  ) {
    this.#source = source;
    this.#texts = new PageTexts(source);
    const view: PageView = {
      get openPages() {
        return pagesAt(viewer.binding, viewer.turning.spread);
      },
      placeOf: (page, size) => viewer.placeOf(page, size),
      project: viewer.project.bind(viewer),
      onView: viewer.onView.bind(viewer),
    };
    this.#layer = new TextLayer(view, {
      source,
      name: (page) => fill(elementTexts(language()).pageNamed, { label: source.label(page - 1) }),
      goTo,
      redraw: (page) => viewer.redraw(page),
      onText: (isText) => {
        canvas.ariaHidden = isText ? "true" : null;
      },
    });
    canvas.after(this.#layer.element);
  }

  /** As the element's own. */
  search(query: string, signal?: AbortSignal): Promise<readonly SearchHit[]> {
    const ended = this.#ended.signal;
    const either = signal ? AbortSignal.any([signal, ended]) : ended;
    return searchBook(this.#texts, this.#source.pageCount, query, either);
  }

  /** Marks a hit and every other place of its query wherever they come in sight; null takes the marks away. */
  mark(hit: SearchHit | null): void {
    this.#layer.mark(hit);
  }

  /** The book has other pages than before: all that was read of them is read anew. */
  changed(): void {
    this.#texts.clear();
    this.#layer.reload();
  }

  /** As the element's own. */
  async outline(): Promise<readonly OutlineEntry[]> {
    return (await this.#source.outline?.(this.#ended.signal)) ?? [];
  }

  /** Takes the layer away and ends every search. */
  destroy(): void {
    this.#ended.abort();
    this.#layer.destroy();
  }
}
