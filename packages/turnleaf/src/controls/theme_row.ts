/** The choice of a theme, and of what dark ones do with pages that are drawn already. */

import { pageThemes } from "../themes.ts";
import type { ControlledBook } from "./book.ts";
import { make } from "./make.ts";
import type { Wording } from "./wording.ts";

const themes = ["auto", ...pageThemes] as const;
const darkPages = ["invert", "dim"] as const;

/** Two rows of buttons, each one of several: by themselves radio buttons, in a menu items of it. */
export class ThemeRow {
  readonly element: HTMLElement = make("div", { class: "themes" });
  readonly #book: ControlledBook;
  readonly #refreshers: (() => void)[] = [];

  /** @param role of each button */
  constructor(book: ControlledBook, { texts }: Wording, role: "radio" | "menuitemradio") {
    this.#book = book;
    const names = {
      auto: texts.themeAuto,
      light: texts.themeLight,
      sepia: texts.sepia,
      grey: texts.grey,
      night: texts.night,
    };
    const group = role === "radio" ? "radiogroup" : "group";
    const row = make("div", { role: group, class: "swatches", "aria-label": texts.theme });
    const known = (): string =>
      themes.find((name) => name === book.getAttribute("theme")) ?? "auto";
    for (const theme of themes) {
      const swatch = make("i", { class: `swatch ${theme}` });
      this.#add(row, role, [swatch, make("span", {}, names[theme])], "theme", theme, known);
    }
    const label = make("span", { class: "label" }, texts.darkPages);
    const pages = make("div", { role: group, class: "dark-pages", "aria-label": texts.darkPages });
    pages.append(label);
    for (const how of darkPages) {
      const text = make("span", {}, how === "invert" ? texts.inverted : texts.dimmed);
      this.#add(pages, role, [text], "dark-pages", how, () => book.darkPagesNow);
    }
    this.#refreshers.push(() => {
      pages.hidden = book.darkPagesNow === "";
    });
    this.element.append(row, pages);
  }

  refresh(): void {
    for (const refresh of this.#refreshers) refresh();
  }

  #add(
    row: HTMLElement,
    role: string,
    shown: readonly Node[],
    attribute: string,
    value: string,
    chosen: () => string,
  ): void {
    const item = make("button", {
      type: "button",
      role,
      ...(role === "radio" ? {} : { tabindex: -1 }),
    });
    item.append(...shown);
    item.addEventListener("click", () => {
      this.#book.setAttribute(attribute, value);
      this.refresh();
    });
    row.append(item);
    this.#refreshers.push(() => {
      item.ariaChecked = String(chosen() === value);
    });
  }
}
