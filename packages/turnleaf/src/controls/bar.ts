/** The toolbar at the head of the book. */

import { type Action, type ActionName, type Tab, tabs } from "./actions.ts";
import type { ControlledBook } from "./book.ts";
import { actionButton, iconButton } from "./buttons.ts";
import { make, roving } from "./make.ts";
import { Menu } from "./menu.ts";
import type { Wording } from "./wording.ts";

/** Tabs that have a button if there is little space, and actions that have one if there is much. */
const narrowTabs: readonly Tab[] = ["contents", "search", "type"];
const inBar: readonly ActionName[] = [
  "readAloud",
  "zoomOut",
  "zoomIn",
  "layout",
  "bookmark",
  "fullscreen",
];

/**
 * Buttons in a row, one of them in the order of tabs; arrows go from one to the next.
 * @csspart toolbar The row above the book.
 * @csspart title The book's title in it.
 */
export class Bar {
  readonly element: HTMLElement;
  readonly menu: Menu;
  readonly #book: ControlledBook;
  readonly #title: HTMLElement = make("span", { part: "title", class: "title", dir: "auto" });
  readonly #tabButtons = new Map<Tab, HTMLButtonElement>();
  readonly #refreshers: (() => void)[] = [];

  /** @param toggle opens a tab of the panel, or closes it */
  constructor(
    book: ControlledBook,
    wording: Wording,
    actions: Readonly<Record<ActionName, Action>>,
    toggle: (tab: Tab, opener: HTMLElement) => void,
  ) {
    this.#book = book;
    const start = make("div", { class: "group" });
    for (const tab of tabs) {
      const button = iconButton(tab, wording.texts[tab], { "aria-expanded": "false" });
      if (!narrowTabs.includes(tab)) button.classList.add("wide");
      button.addEventListener("click", () => toggle(tab, button));
      this.#tabButtons.set(tab, button);
      start.append(button);
    }
    const end = make("div", { class: "group end" });
    for (const name of inBar) {
      const { button, refresh } = actionButton(actions[name]);
      if (name !== "bookmark" && name !== "readAloud") button.classList.add("wide");
      this.#refreshers.push(refresh);
      end.append(button);
    }
    const more = iconButton("more", wording.texts.more);
    end.append(more);
    this.menu = new Menu(book, wording, actions, more);
    this.element = make("div", {
      role: "toolbar",
      part: "toolbar",
      class: "ui bar",
      "aria-label": wording.texts.toolbar,
    });
    this.element.append(start, this.#title, end, this.menu.element);
    roving(this.element, () => this.#buttons());
    this.refresh();
  }

  refresh(): void {
    this.#title.dir = this.#book.titleDirection;
    this.#title.textContent = this.#book.bookTitle;
    for (const refresh of this.#refreshers) refresh();
    this.menu.refresh();
    const type = this.#tabButtons.get("type");
    if (type) type.hidden = !this.#book.canTypeset;
    const all = [...this.element.querySelectorAll<HTMLElement>(".group button")];
    if (all.every(({ tabIndex }) => tabIndex === 0)) for (const button of all) button.tabIndex = -1;
    // The button that Tab reaches must be a visible one.
    const buttons = this.#buttons();
    if (buttons[0] && !buttons.some(({ tabIndex }) => tabIndex === 0)) buttons[0].tabIndex = 0;
  }

  /** Shows which tab of the panel is open. */
  showTab(open: Tab | null): void {
    for (const [tab, button] of this.#tabButtons) {
      button.setAttribute("aria-expanded", String(tab === open));
    }
  }

  /** Returns the button of a tab; if it is hidden, the first one. */
  buttonOf(tab: Tab): HTMLElement | undefined {
    const button = this.#tabButtons.get(tab);
    return button?.offsetParent ? button : this.#buttons()[0];
  }

  #buttons(): HTMLElement[] {
    const all = this.element.querySelectorAll<HTMLElement>(".group button");
    return [...all].filter((button) => button.offsetParent !== null);
  }
}
