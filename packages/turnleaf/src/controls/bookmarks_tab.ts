/** The tab of the reader's bookmarks. */

import type { ControlledBook } from "./book.ts";
import { iconButton } from "./buttons.ts";
import { make } from "./make.ts";
import type { PanelTab } from "./panel.ts";
import { namePage, type Wording } from "./wording.ts";

/** Bookmarked pages in the book's order, each with a button to go there and one to remove it. */
export class BookmarksTab implements PanelTab {
  readonly element: HTMLElement = make("div", { class: "view" });
  readonly #book: ControlledBook;
  readonly #wording: Wording;
  readonly #picked: () => void;
  /** The names of the pages that are listed, and the buttons that go there. */
  #names: readonly string[] = [];
  #buttons: readonly HTMLElement[] = [];

  /** @param picked called when the reader went to a page */
  constructor(book: ControlledBook, wording: Wording, picked: () => void) {
    this.#book = book;
    this.#wording = wording;
    this.#picked = picked;
  }

  show(): void {
    this.refresh();
  }

  hide(): void {}

  refresh(): void {
    const { bookmarks, page } = this.#book;
    const names = bookmarks.map((marked) => namePage(this.#wording, this.#book, marked));
    // Rows that stay keep the focus.
    if (names.length === 0 || names.join("\n") !== this.#names.join("\n")) this.#list(names);
    for (const [k, button] of this.#buttons.entries()) {
      if (bookmarks[k] === page) button.setAttribute("aria-current", "true");
      else button.removeAttribute("aria-current");
    }
  }

  #list(names: readonly string[]): void {
    const { texts } = this.#wording;
    const { bookmarks } = this.#book;
    this.#names = names;
    this.#buttons = [];
    if (bookmarks.length === 0) {
      const add = make("button", { type: "button", class: "plain" }, texts.addBookmark);
      add.addEventListener("click", () => {
        this.#book.toggleBookmark();
        this.focus();
      });
      this.element.replaceChildren(make("p", { class: "remark" }, texts.noBookmarks), add);
      return;
    }
    const list = make("ul", { class: "rows" });
    this.#buttons = bookmarks.map((marked, k) => {
      const name = names[k];
      const there = make("button", { type: "button", class: "line" }, name);
      there.addEventListener("click", () => {
        void this.#book.turnTo(marked, { jump: true });
        this.#picked();
      });
      const remove = iconButton("close", `${texts.removeBookmark}: ${name}`);
      remove.addEventListener("click", () => {
        this.#book.toggleBookmark(marked);
        this.focus();
      });
      list.append(make("li", { class: "row" }, there, remove));
      return there;
    });
    this.element.replaceChildren(list);
  }

  focus(): void {
    const current = this.element.querySelector<HTMLElement>("[aria-current]");
    (current ?? this.element.querySelector<HTMLElement>("button"))?.focus();
  }
}
