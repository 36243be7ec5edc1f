/** The side panel: tabs of contents, thumbnails, search, bookmarks and type. */

import { type Tab, tabs } from "./actions.ts";
import { iconButton } from "./buttons.ts";
import { icon, make, roving } from "./make.ts";
import type { Wording } from "./wording.ts";

/** The content of a tab. */
export interface PanelTab {
  readonly element: HTMLElement;
  /** Called when it becomes visible. */
  show(): void;
  /** Called when it is hidden. */
  hide(): void;
  /** Called when the book lies open elsewhere, or its bookmarks have changed. */
  refresh(): void;
  /** Moves the focus to where the reader goes on. */
  focus(): void;
}

/**
 * One tab at a time, beside the book; on a narrow element, over it.
 * @csspart panel The contents, thumbnails, search, bookmarks and type.
 */
export class Panel {
  readonly element: HTMLElement;
  readonly #views: Readonly<Record<Tab, PanelTab>>;
  readonly #tabButtons = new Map<Tab, HTMLButtonElement>();
  readonly #body: HTMLElement;
  /** Names the tab if the row of tabs is hidden: beside the toolbar's own buttons. */
  readonly #heading: HTMLElement = make("h2", { class: "wide" });
  readonly #wording: Wording;
  readonly #changed: (tab: Tab | null) => void;
  #open: Tab | null = null;

  /** @param changed called with the open tab */
  constructor(
    wording: Wording,
    views: Readonly<Record<Tab, PanelTab>>,
    close: () => void,
    changed: (tab: Tab | null) => void,
  ) {
    this.#views = views;
    this.#wording = wording;
    this.#changed = changed;
    const { texts } = wording;
    const row = make("div", { role: "tablist", class: "tabs narrow" });
    for (const tab of tabs) {
      const button = make("button", {
        type: "button",
        role: "tab",
        id: `tab-${tab}`,
        "aria-controls": "body",
        "aria-label": texts[tab],
        title: texts[tab],
        tabindex: -1,
      });
      button.append(icon(tab));
      button.addEventListener("click", () => this.open(tab));
      button.addEventListener("focus", () => this.open(tab));
      this.#tabButtons.set(tab, button);
      row.append(button);
    }
    const buttons = [...this.#tabButtons.values()];
    roving(row, () => buttons.filter(({ hidden }) => !hidden));
    const shut = iconButton("close", texts.close);
    shut.addEventListener("click", close);
    this.#body = make("div", { role: "tabpanel", id: "body", class: "body" });
    for (const tab of tabs) this.#body.append(views[tab].element);
    this.element = make("section", { part: "panel", class: "ui panel", hidden: true });
    this.element.append(make("div", { class: "head" }, row, this.#heading, shut), this.#body);
  }

  /** The open tab, or null. */
  get tab(): Tab | null {
    return this.#open;
  }

  /** Shows a tab. */
  open(tab: Tab): void {
    if (this.#open === tab) return;
    if (this.#open) this.#views[this.#open].hide();
    this.#open = tab;
    this.element.dataset.tab = tab;
    this.element.hidden = false;
    for (const [name, button] of this.#tabButtons) {
      button.ariaSelected = String(name === tab);
      button.tabIndex = name === tab ? 0 : -1;
      this.#views[name].element.hidden = name !== tab;
    }
    this.#heading.textContent = this.#wording.texts[tab];
    this.#body.setAttribute("aria-labelledby", `tab-${tab}`);
    this.element.setAttribute("aria-labelledby", `tab-${tab}`);
    this.#views[tab].show();
    this.#changed(tab);
  }

  /** Moves the focus to where the reader goes on in the open tab. */
  focus(): void {
    if (this.#open) this.#views[this.#open].focus();
  }

  /** Closes it. */
  close(): void {
    if (this.#open) this.#views[this.#open].hide();
    this.#open = null;
    this.element.hidden = true;
    this.#changed(null);
  }

  /** Hides a tab that the open book has no use for, or shows it again. */
  allow(tab: Tab, isAllowed: boolean): void {
    const button = this.#tabButtons.get(tab);
    if (button) button.hidden = !isAllowed;
    if (this.#open === tab && !isAllowed) this.close();
  }

  /** Updates it from the book. */
  refresh(): void {
    if (this.#open) this.#views[this.#open].refresh();
  }
}
