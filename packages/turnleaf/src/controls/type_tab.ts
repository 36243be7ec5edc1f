/** The tab in which the reader chooses how flowing text is set. */

import type { ControlledBook } from "./book.ts";
import { make } from "./make.ts";
import type { PanelTab } from "./panel.ts";
import { ThemeRow } from "./theme_row.ts";
import type { Wording } from "./wording.ts";

/** One choice a row; each is an attribute of the element. */
export class TypeTab implements PanelTab {
  readonly element: HTMLElement = make("div", { class: "view" });
  readonly #book: ControlledBook;
  readonly #themes: ThemeRow;
  readonly #selects = new Map<string, HTMLSelectElement>();

  constructor(book: ControlledBook, wording: Wording) {
    const { texts, number } = wording;
    this.#book = book;
    const own: readonly [string, string] = ["", texts.asInBook];
    const sizes = [0.7, 0.8, 0.9, 1, 1.1, 1.25, 1.5, 1.75, 2, 2.5];
    const lines = [1.2, 1.4, 1.6, 1.8, 2];
    this.#add("font-size", texts.typeSize, [
      ...sizes.map(
        (size) => [size === 1 ? "" : String(size), `${number(Math.round(100 * size))} %`] as const,
      ),
    ]);
    this.#add("font", texts.typeface, [
      own,
      ["serif", texts.serif],
      ["sans-serif", texts.sansSerif],
    ]);
    this.#add("line-height", texts.lineHeight, [
      own,
      ...lines.map((line) => [String(line), number(line)] as const),
    ]);
    this.#add("margins", texts.margins, [
      ["0.5", texts.narrow],
      ["", texts.usual],
      ["1.5", texts.wide],
    ]);
    this.#themes = new ThemeRow(book, wording, "radio");
    this.element.append(this.#themes.element);
  }

  show(): void {
    this.refresh();
  }

  hide(): void {}

  refresh(): void {
    this.#themes.refresh();
    for (const [name, select] of this.#selects) select.value = this.#book.getAttribute(name) ?? "";
  }

  focus(): void {
    this.element.querySelector("select")?.focus();
  }

  #add(name: string, label: string, options: readonly (readonly [string, string])[]): void {
    const select = make("select", { class: "choose" });
    for (const [value, text] of options) select.append(make("option", { value }, text));
    select.addEventListener("change", () => {
      if (select.value === "") this.#book.removeAttribute(name);
      else this.#book.setAttribute(name, select.value);
    });
    this.#selects.set(name, select);
    this.element.append(make("label", { class: "choice" }, label, select));
  }
}
