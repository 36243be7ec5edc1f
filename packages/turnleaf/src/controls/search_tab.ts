/** The tab that searches the book. */

import { fill } from "../words/languages.ts";
import type { ControlledBook, FoundPlace } from "./book.ts";
import { icon, make } from "./make.ts";
import type { PanelTab } from "./panel.ts";
import { namePage, type Wording } from "./wording.ts";

/** Results listed at first, and with every press of the button for more. */
const atOnce = 200;

/** A search field, the number of hits, and the hits with their context. */
export class SearchTab<Hit extends FoundPlace> implements PanelTab {
  readonly element: HTMLElement = make("div", { class: "view found" });
  readonly #book: ControlledBook<Hit>;
  readonly #wording: Wording;
  readonly #picked: () => void;
  readonly #field: HTMLInputElement;
  readonly #status: HTMLElement = make("p", { role: "status", class: "note" });
  readonly #results: HTMLElement = make("ul", { class: "rows" });
  #search: AbortController | null = null;
  #hits: readonly Hit[] = [];

  /** @param picked called when the reader went to a hit */
  constructor(book: ControlledBook<Hit>, wording: Wording, picked: () => void) {
    this.#book = book;
    this.#wording = wording;
    this.#picked = picked;
    this.#field = make("input", {
      type: "search",
      class: "query",
      "aria-label": wording.texts.searchHint,
      placeholder: wording.texts.searchHint,
      autocomplete: "off",
      spellcheck: "false",
      maxlength: 200,
      enterkeyhint: "search",
    });
    const form = make("form", { role: "search", class: "ask" }, icon("search"), this.#field);
    form.addEventListener("submit", (event) => {
      event.preventDefault();
      void this.#find();
    });
    // The clear button in the field empties it.
    this.#field.addEventListener("input", () => {
      if (this.#field.value === "") this.forget();
    });
    this.element.append(form, this.#status, this.#results);
  }

  show(): void {}

  /** The marks disappear with the panel; the list stays for the next time. */
  hide(): void {
    void this.#book.showHit(null);
    for (const row of this.#results.querySelectorAll("[aria-current]")) {
      row.removeAttribute("aria-current");
    }
  }

  refresh(): void {}

  focus(): void {
    this.#field.focus();
    this.#field.select();
  }

  /** Ends the search and clears its results. */
  forget(): void {
    this.#search?.abort();
    this.#search = null;
    this.#hits = [];
    this.#status.textContent = "";
    this.#results.replaceChildren();
    void this.#book.showHit(null);
  }

  async #find(): Promise<void> {
    const query = this.#field.value.trim();
    this.forget();
    if (query === "") return;
    const search = new AbortController();
    this.#search = search;
    const { texts } = this.#wording;
    this.#status.textContent = texts.searching;
    try {
      const hits = await this.#book.search(query, { signal: search.signal });
      if (search.signal.aborted) return;
      this.#hits = hits;
      this.#status.textContent =
        hits.length === 0 ? texts.nothingFound : this.#wording.plural(texts.found, hits.length);
      this.#list(0);
    } catch (error) {
      if (search.signal.aborted) return;
      this.#status.textContent =
        error instanceof Error ? this.#wording.sentence(error) : texts.nothingFound;
    }
  }

  /** Lists the hits from an index on. */
  #list(from: number): void {
    const { texts, number } = this.#wording;
    for (const hit of this.#hits.slice(from, from + atOnce)) {
      this.#results.append(make("li", {}, this.#row(hit)));
    }
    const left = this.#hits.length - from - atOnce;
    if (left <= 0) return;
    const more = make(
      "button",
      { type: "button", class: "line" },
      `${texts.more} (${fill("{n}", { n: number(left) })})`,
    );
    const item = make("li", {}, more);
    more.addEventListener("click", () => {
      item.remove();
      this.#list(from + atOnce);
      this.#results.querySelectorAll<HTMLElement>("button")[from + atOnce]?.focus();
    });
    this.#results.append(item);
  }

  #row(hit: Hit): HTMLElement {
    const words = make("span", { dir: "auto" }, hit.before, make("mark", {}, hit.text), hit.after);
    const where = make("span", { class: "label" }, namePage(this.#wording, this.#book, hit.page));
    const row = make("button", { type: "button", class: "line hit" }, where, words);
    row.addEventListener("click", () => {
      for (const other of this.#results.querySelectorAll("[aria-current]")) {
        other.removeAttribute("aria-current");
      }
      row.setAttribute("aria-current", "true");
      void this.#book.showHit(hit);
      this.#picked();
    });
    return row;
  }
}
