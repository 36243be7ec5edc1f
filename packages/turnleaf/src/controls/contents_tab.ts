/** The tab of the book's table of contents. */

import type { BookDetail, OutlineEntry } from "../sources/page_source.ts";
import type { ControlledBook } from "./book.ts";
import { make } from "./make.ts";
import type { PanelTab } from "./panel.ts";
import { namePage, type Wording } from "./wording.ts";

/** Maximum of lines shown, and of their depth. */
const mostLines = 3000;
const deepest = 8;

/** The contents of the book. Loaded when first shown, and again for another book. */
export class ContentsTab implements PanelTab {
  readonly element: HTMLElement = make("div", { class: "view" });
  readonly #book: ControlledBook;
  readonly #wording: Wording;
  readonly #picked: () => void;
  #lines: { readonly page: number; readonly button: HTMLButtonElement }[] = [];
  /** The request, pending or done; null before the first. */
  #asked: object | null = null;
  /** The warnings that are listed, as text. */
  #shownWarnings = "[]";

  /** @param picked called when the reader went to an entry */
  constructor(book: ControlledBook, wording: Wording, picked: () => void) {
    this.#book = book;
    this.#wording = wording;
    this.#picked = picked;
  }

  show(): void {
    if (this.#asked === null) void this.#ask();
    else this.refresh();
  }

  hide(): void {}

  async #ask(): Promise<void> {
    const asked = {};
    this.#asked = asked;
    const { wait, noContents } = this.#wording.texts;
    if (this.#lines.length === 0) this.#tell(wait);
    let sentence = noContents;
    let entries: readonly OutlineEntry[] = [];
    try {
      entries = await this.#book.outline();
    } catch (error) {
      if (error instanceof Error) sentence = this.#wording.sentence(error);
    }
    // Another book may be open by now.
    if (this.#asked !== asked) return;
    const { details } = this.#book;
    if (entries.length === 0) {
      this.#tell(sentence);
      this.element.append(...detailList(details));
      this.#listWarnings();
      return;
    }
    const { scrollTop } = this.element;
    const focused = activeIn(this.element);
    const line = this.#lines.findIndex(({ button }) => button === focused);
    this.#lines = [];
    this.element.replaceChildren(this.#list(entries, 1), ...detailList(details));
    this.element.scrollTop = scrollTop;
    this.refresh();
    if (line >= 0) this.#lines[line]?.button.focus();
    else if (this.element === focused) this.focus();
  }

  #tell(sentence: string): void {
    this.element.replaceChildren(make("p", { class: "remark" }, sentence));
  }

  /** Clears the contents of a book that was closed. */
  forget(): void {
    this.#asked = null;
    this.#lines = [];
    this.#shownWarnings = "[]";
    this.element.replaceChildren();
  }

  /** Asks for the contents again, whose lines lead to other pages now; the list stays until they are there. */
  renew(): void {
    if (this.#asked !== null) void this.#ask();
  }

  refresh(): void {
    if (this.#asked === null) {
      this.show();
      return;
    }
    this.#listWarnings();
    const current = this.#current();
    for (const { button } of this.#lines) button.removeAttribute("aria-current");
    current?.setAttribute("aria-current", "true");
    if (current) this.#reveal(current);
  }

  /** Lists what cannot be shown of the book below all else, folded up until the reader asks. */
  #listWarnings(): void {
    const { warnings } = this.#book;
    const shown = JSON.stringify(warnings);
    if (shown === this.#shownWarnings) return;
    this.#shownWarnings = shown;
    const before = this.element.querySelector(".warnings");
    before?.remove();
    if (warnings.length === 0) return;
    const { plural, texts } = this.#wording;
    const items = warnings.map(({ message, page }) => {
      const line = make("span", { dir: "auto" }, message);
      return make("li", {}, line, ...(page === undefined ? [] : [" ", this.#pageLink(page)]));
    });
    const open = before?.hasAttribute("open") ?? false;
    const title = make("summary", {}, plural(texts.notShown, warnings.length));
    this.element.append(
      make("details", { class: "details warnings", open }, title, make("ul", {}, ...items)),
    );
  }

  /** Returns a button that turns to a page. */
  #pageLink(page: number): HTMLElement {
    const button = make("button", { type: "button" }, namePage(this.#wording, this.#book, page));
    button.addEventListener("click", () => {
      void this.#book.turnTo(page);
      this.#picked();
    });
    return button;
  }

  /** Scrolls the list until a line is in sight; `scrollIntoView` would scroll the web page too. */
  #reveal(line: HTMLElement): void {
    const [list, { offsetTop: top, offsetHeight }] = [this.element, line];
    const bottom = top + offsetHeight;
    if (top < list.scrollTop) list.scrollTop = top;
    else if (bottom > list.scrollTop + list.clientHeight)
      list.scrollTop = bottom - list.clientHeight;
  }

  focus(): void {
    const to = this.#current() ?? this.#lines[0]?.button;
    if (to) to.focus();
    else {
      this.element.tabIndex = -1;
      this.element.focus();
    }
  }

  /** Returns the last entry that begins before the visible pages end. */
  #current(): HTMLButtonElement | null {
    const { page, spread } = this.#book;
    const seen = Math.max(page, spread.left ?? 0, spread.right ?? 0);
    let best: { page: number; button: HTMLButtonElement } | null = null;
    for (const line of this.#lines) {
      if (line.page <= seen && line.page >= (best?.page ?? 1)) best = line;
    }
    return best?.button ?? null;
  }

  #list(entries: readonly OutlineEntry[], depth: number): HTMLElement {
    const list = make("ul", { class: "contents" });
    for (const entry of entries) {
      if (this.#lines.length >= mostLines) break;
      const item = make("li", {}, this.#line(entry));
      if (entry.children.length > 0 && depth < deepest) {
        item.append(this.#list(entry.children, depth + 1));
      }
      list.append(item);
    }
    return list;
  }

  #line({ title, page, top = 0, href }: OutlineEntry): HTMLElement {
    if (page === null) {
      // Only addresses of the web and of mail are followed.
      if (!href || !/^(https?|mailto):/i.test(href)) return make("span", { class: "line" }, title);
      return make(
        "a",
        { class: "line", href, target: "_blank", rel: "noopener noreferrer" },
        title,
      );
    }
    const button = make(
      "button",
      { type: "button", class: "line" },
      make("span", { dir: "auto" }, title),
      make("span", { class: "label" }, this.#book.label(page)),
    );
    button.addEventListener("click", () => {
      void this.#book.turnTo(page, { top, jump: true });
      this.#picked();
    });
    this.#lines.push({ page, button });
    return button;
  }
}

/** Returns what the book's owner wants to be shown of it, as a list; nothing if there is nothing. */
function detailList(details: readonly BookDetail[]): HTMLElement[] {
  if (details.length === 0) return [];
  const list = make("ul", { class: "details" });
  for (const { label, value, href, direction = "auto" } of details) {
    const isWeb = href && /^https?:/i.test(href);
    const link = { href: href ?? "", target: "_blank", rel: "noopener noreferrer" };
    const text = isWeb ? make("a", link, value) : value;
    list.append(
      make("li", { dir: direction }, ...(label ? [make("b", {}, label), " "] : []), text),
    );
  }
  return [list];
}

/** Returns the focused element in the shadow tree of an element. */
function activeIn(element: Element): Element | null {
  const root = element.getRootNode();
  return root instanceof ShadowRoot ? root.activeElement : null;
}
