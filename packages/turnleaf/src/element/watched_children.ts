/** The book that the children of an element are, one page each. */

import { pagesIn } from "../sources/html/child_pages.ts";
import { loadPart } from "../sources/load_part.ts";
import type { BookInput } from "../sources/open.ts";

/** Watches an element's children, which may be parsed or added after it. */
export class WatchedChildren {
  readonly #element: HTMLElement;
  readonly #changed: () => void;
  readonly #observer: MutationObserver;

  /** @param changed called when children came or went, and once all are parsed */
  constructor(element: HTMLElement, changed: () => void) {
    this.#element = element;
    this.#changed = changed;
    this.#observer = new MutationObserver(changed);
  }

  /** The book of the children that are pages; "" if there are none yet. */
  get input(): BookInput {
    const element = this.#element;
    if (this.#isParsed && pagesIn(element).length > 0) {
      return async () => {
        const { HtmlPages } = await loadPart(import("../sources/html/html_pages.ts"));
        return new HtmlPages(pagesIn(element), element);
      };
    }
    return "";
  }

  /** Watches from now on; call it when the element is in a document. */
  watch(): void {
    this.#observer.observe(this.#element, { childList: true });
    if (this.#isParsed) return;
    const { ownerDocument } = this.#element;
    ownerDocument.addEventListener("DOMContentLoaded", this.#changed, { once: true });
  }

  /** Ends that. */
  stop(): void {
    this.#observer.disconnect();
  }

  /** Whether all children are there: pages that are still being parsed would come one by one. */
  get #isParsed(): boolean {
    return this.#element.ownerDocument.readyState !== "loading";
  }
}
