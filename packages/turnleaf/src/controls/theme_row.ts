/** The choice of a theme, and of what dark ones do with pages that are drawn already. */

import { darkPages, themes } from "../attributes.ts";
import type { ControlledBook } from "./book.ts";
import { radios } from "./choices.ts";
import { make } from "./make.ts";
import type { Wording } from "./wording.ts";

/** Two rows of buttons, each one of several: by themselves radio buttons, in a menu items of it. */
export class ThemeRow {
  readonly element: HTMLElement = make("div", { class: "themes" });
  readonly #book: ControlledBook;
  readonly #role: "radio" | "menuitemradio";
  readonly #refreshers: (() => void)[] = [];

  /** @param role of each button */
  constructor(book: ControlledBook, { texts }: Wording, role: "radio" | "menuitemradio") {
    this.#book = book;
    this.#role = role;
    const names = {
      auto: texts.themeAuto,
      light: texts.themeLight,
      sepia: texts.sepia,
      grey: texts.grey,
      night: texts.night,
    };
    const ways = { invert: texts.inverted, dim: texts.dimmed };
    const said = (): string => book.getAttribute("theme") ?? "";
    const known = (): string => themes.find((name) => name === said()) ?? "auto";
    const row = this.#group(texts.theme, "swatches", "theme", themes, known, (theme) => [
      make("i", { class: `swatch ${theme}` }),
      make("span", {}, names[theme]),
    ]);
    const done = (): string => book.darkPagesNow;
    const pages = this.#group(
      texts.darkPages,
      "dark-pages",
      "dark-pages",
      darkPages.filter((how) => how !== ""),
      done,
      (how) => [make("span", {}, ways[how])],
    );
    pages.prepend(make("span", { class: "label" }, texts.darkPages));
    this.#refreshers.push(() => {
      pages.hidden = done() === "";
    });
    this.element.append(row, pages);
  }

  refresh(): void {
    for (const refresh of this.#refreshers) refresh();
  }

  /** Makes a group of buttons, each of which gives an attribute one of its values. */
  #group<V extends string>(
    label: string,
    name: string,
    attribute: string,
    values: readonly V[],
    chosen: () => string,
    shown: (value: V) => readonly Node[],
  ): HTMLElement {
    const isAlone = this.#role === "radio";
    const role = isAlone ? "radiogroup" : "group";
    const group = make("div", { role, class: name, "aria-label": label });
    const buttons = values.map((value) => {
      const button = make("button", { type: "button", role: this.#role, tabindex: -1 });
      button.append(...shown(value));
      button.addEventListener("click", () => {
        this.#book.setAttribute(attribute, value);
        this.refresh();
      });
      return button;
    });
    group.append(...buttons);
    const check = isAlone
      ? radios(group, buttons)
      : (at: number) => {
          for (const [k, button] of buttons.entries()) button.ariaChecked = String(k === at);
        };
    this.#refreshers.push(() => check((values as readonly string[]).indexOf(chosen())));
    return group;
  }
}
