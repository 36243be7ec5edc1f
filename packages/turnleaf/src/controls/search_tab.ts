/** The tab that searches the book. */

import { typographyAttributes } from "../element/typography.ts";
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
  readonly #status: HTMLElement = make("p", { role: "status", class: "remark" });
  readonly #results: HTMLElement = make("ul", { class: "rows" });
  #search: AbortController | null = null;
  #hits: Hit[] = [];
  /** The rows that are listed, and how many may be. */
  #rows: { readonly hit: Hit; readonly where: HTMLElement }[] = [];
  #most = atOnce;
  readonly #more: HTMLElement = make("li");
  /** Whether the panel is about to close as the reader went to a hit. */
  #isPicking = false;
  /** Ends what waits for the reader to turn on from a hit. */
  #left = new AbortController();
  /** What was searched for, and how the text was set then. */
  #query = "";
  #typography = "";

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
      const isListed = this.#rows.length > 0 && this.#query === this.#field.value.trim();
      if (isListed) this.#pickNext();
      else void this.#find();
    });
    // The clear button in the field empties it.
    this.#field.addEventListener("input", () => {
      if (this.#field.value === "") this.forget();
    });
    this.element.append(form, this.#status, this.#results);
  }

  show(): void {}

  /**
   * The marks disappear with the panel, or, where that closes over a hit, as the reader turns on; the list
   * stays for the next time.
   */
  hide(): void {
    if (this.#isPicking) return;
    this.#unmark();
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
    this.#rows = [];
    this.#most = atOnce;
    this.#status.textContent = "";
    this.#results.replaceChildren();
    this.#unmark();
  }

  /** Says on which pages the hits are now; text that was set anew is searched again. */
  renew(): void {
    if (this.#search && this.#typography !== typographyOf(this.#book)) void this.#find();
    for (const { hit, where } of this.#rows) {
      where.textContent = namePage(this.#wording, this.#book, hit.page);
    }
  }

  async #find(): Promise<void> {
    const query = this.#field.value.trim();
    this.forget();
    if (query === "") return;
    const search = new AbortController();
    this.#search = search;
    this.#query = query;
    this.#typography = typographyOf(this.#book);
    const { texts } = this.#wording;
    const { signal } = search;
    this.#status.textContent = texts.searching;
    const onHits = (hits: readonly Hit[]): void => {
      if (signal.aborted) return;
      this.#hits.push(...hits);
      this.#status.textContent = `${this.#count} – ${texts.searching}`;
      this.#list();
    };
    try {
      const hits = await this.#book.search(query, { signal, onHits });
      if (signal.aborted) return;
      // Those on pages of other files among them come last until here.
      const isInOrder = hits.every((hit, k) => hit === this.#hits[k]);
      this.#hits = [...hits];
      if (!isInOrder) this.#clear();
      this.#list();
      const nothing = this.#book.mayHaveText ? texts.nothingFound : texts.noText;
      this.#status.textContent = hits.length === 0 ? nothing : this.#count;
    } catch (error) {
      if (signal.aborted) return;
      this.#status.textContent =
        error instanceof Error ? this.#wording.sentence(error) : texts.nothingFound;
    }
  }

  /** Goes to the hit after the one that was gone to last, or to the first. */
  #pickNext(): void {
    const rows = [...this.#results.querySelectorAll<HTMLElement>(".hit")];
    const next = rows[rows.findIndex((row) => row.ariaCurrent === "true") + 1] ?? rows[0];
    next?.scrollIntoView({ block: "nearest" });
    next?.click();
  }

  get #count(): string {
    return this.#wording.plural(this.#wording.texts.found, this.#hits.length);
  }

  #clear(): void {
    this.#rows = [];
    this.#results.replaceChildren();
  }

  /** Lists the hits that are not listed yet, as many as may be, and a button for the others. */
  #list(): void {
    const { texts, number } = this.#wording;
    for (const hit of this.#hits.slice(this.#rows.length, this.#most)) {
      const { row, where } = this.#row(hit);
      this.#rows.push({ hit, where });
      this.#results.append(make("li", {}, row));
    }
    const left = this.#hits.length - this.#rows.length;
    if (left === 0) {
      this.#more.remove();
      return;
    }
    const name = `${texts.more} (${fill("{n}", { n: number(left) })})`;
    const shown = this.#more.querySelector("button");
    if (shown) shown.textContent = name;
    else {
      const more = make("button", { type: "button", class: "line" }, name);
      more.addEventListener("click", () => {
        const first = this.#rows.length;
        this.#most += atOnce;
        this.#list();
        this.#results.querySelectorAll<HTMLElement>(".hit")[first]?.focus();
      });
      this.#more.append(more);
    }
    this.#results.append(this.#more);
  }

  #row(hit: Hit): { readonly row: HTMLElement; readonly where: HTMLElement } {
    const words = make("span", { dir: "auto" }, hit.before, make("mark", {}, hit.text), hit.after);
    const where = make("span", { class: "label" }, namePage(this.#wording, this.#book, hit.page));
    const row = make("button", { type: "button", class: "line hit" }, where, words);
    row.addEventListener("click", () => {
      for (const other of this.#results.querySelectorAll("[aria-current]")) {
        other.removeAttribute("aria-current");
      }
      row.setAttribute("aria-current", "true");
      this.#isPicking = true;
      this.#picked();
      this.#isPicking = false;
      void this.#show(hit);
    });
    return { row, where };
  }

  /** Goes to a hit and marks it: while the panel is open, or until the reader turns on. */
  async #show(hit: Hit): Promise<void> {
    this.#left.abort();
    this.#left = new AbortController();
    const { signal } = this.#left;
    await this.#book.showHit(hit);
    if (signal.aborted) return;
    const turned = (): void => {
      if (!this.element.checkVisibility()) this.#unmark();
    };
    this.#book.addEventListener("turnstart", turned, { signal });
  }

  #unmark(): void {
    this.#left.abort();
    void this.#book.showHit(null);
  }
}

/** Returns what says how flowing text is set. */
function typographyOf(book: HTMLElement): string {
  return typographyAttributes.map((name) => book.getAttribute(name)).join();
}
