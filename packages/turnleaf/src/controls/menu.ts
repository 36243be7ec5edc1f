/** The menu of everything without a place in the toolbar. */

import type { Action, ActionName } from "./actions.ts";
import type { ControlledBook } from "./book.ts";
import { icon, make, roving, setIcon } from "./make.ts";
import { ThemeRow } from "./theme_row.ts";
import type { Wording } from "./wording.ts";

/** The menu's order; those of the first line have a button of their own if there is space. */
const inBar: readonly ActionName[] = ["zoomIn", "zoomOut", "layout", "fullscreen"];
const always: readonly ActionName[] = [
  "play",
  "sound",
  "tilt",
  "shift",
  "foldOut",
  "tearOut",
  "crumple",
  "tearAcross",
  "putBack",
  "print",
  "download",
  "keys",
];

/**
 * A menu under its button.
 *
 * @csspart menu The menu that the last button of the toolbar opens.
 */
export class Menu {
  readonly element: HTMLElement;
  readonly #book: ControlledBook;
  readonly #opener: HTMLButtonElement;
  #isOpenedByKey = false;
  #refreshers: (() => void)[] = [];

  /** @param opener the button under which it opens */
  constructor(
    book: ControlledBook,
    wording: Wording,
    actions: Readonly<Record<ActionName, Action>>,
    opener: HTMLButtonElement,
  ) {
    this.#book = book;
    this.#opener = opener;
    this.element = make("div", {
      role: "menu",
      part: "menu",
      class: "menu",
      "aria-label": wording.texts.more,
      hidden: true,
    });
    for (const name of inBar) this.#add(actions[name], "narrow");
    for (const name of always) this.#add(actions[name], "");
    const themes = new ThemeRow(book, wording, "menuitemradio");
    this.element.append(themes.element);
    this.#refreshers.push(() => themes.refresh());
    opener.setAttribute("aria-haspopup", "menu");
    opener.setAttribute("aria-expanded", "false");
    opener.addEventListener("click", () => (this.element.hidden ? this.open() : this.close()));
    roving(this.element, () => this.#items(), true);
    this.element.addEventListener("keydown", (event) => {
      if (event.key !== "Escape" && event.key !== "Tab") return;
      if (event.key === "Escape") event.preventDefault();
      this.close();
    });
    this.element.addEventListener("focusout", ({ relatedTarget }) => {
      const to = relatedTarget as Node | null;
      if (to !== opener && !this.element.contains(to)) this.close(false);
    });
  }

  open(): void {
    this.#isOpenedByKey = this.#opener.matches(":focus-visible");
    this.refresh();
    this.element.hidden = false;
    this.#opener.setAttribute("aria-expanded", "true");
    const items = this.#items();
    for (const [index, item] of items.entries()) item.tabIndex = index === 0 ? 0 : -1;
    items[0]?.focus();
  }

  /** @param returns whether the focus goes back to the button, or to the book if a pointer pressed that */
  close(returns = true): void {
    if (this.element.hidden) return;
    this.element.hidden = true;
    this.#opener.setAttribute("aria-expanded", "false");
    if (returns) (this.#isOpenedByKey ? this.#opener : this.#book).focus({ preventScroll: true });
  }

  refresh(): void {
    for (const refresh of this.#refreshers) refresh();
  }

  #items(): HTMLElement[] {
    const items = this.element.querySelectorAll<HTMLElement>("[role^=menuitem]");
    return [...items].filter((item) => item.offsetParent !== null);
  }

  #add(action: Action, where: string): void {
    const text = make("span");
    const role = action.pressed ? "menuitemcheckbox" : "menuitem";
    const item = make("button", { type: "button", role, tabindex: -1, class: where });
    item.append(icon(action.icon()), text);
    item.addEventListener("click", () => {
      if (item.ariaDisabled === "true") return;
      this.close();
      action.run(this.#opener);
    });
    this.element.append(item);
    this.#refreshers.push(() => {
      setIcon(item, action.icon());
      text.textContent = action.label();
      if (action.pressed) item.ariaChecked = String(action.pressed());
      if (action.disabled) item.ariaDisabled = String(action.disabled());
      if (action.hidden) item.hidden = action.hidden();
    });
  }
}
