/** The tab of the reader's bookmarks. */

import type { ControlledBook } from "./book.ts";
import { iconButton } from "./buttons.ts";
import { make } from "./make.ts";
import type { View } from "./panel.ts";
import { namePage, type Say } from "./say.ts";

/** Bookmarked pages in the book's order, each with a button to go there and one to remove it. */
export class Bookmarks implements View {
  readonly element: HTMLElement = make("div", { class: "view" });
  readonly #book: ControlledBook;
  readonly #say: Say;
  readonly #picked: () => void;

  /** @param picked called when the reader went to a page */
  constructor(book: ControlledBook, say: Say, picked: () => void) {
    this.#book = book;
    this.#say = say;
    this.#picked = picked;
  }

  show(): void {
    this.refresh();
  }

  hide(): void {}

  refresh(): void {
    const { texts } = this.#say;
    const { bookmarks, page } = this.#book;
    if (bookmarks.length === 0) {
      const add = make("button", { type: "button", class: "plain" }, texts.addBookmark);
      add.addEventListener("click", () => {
        this.#book.toggleBookmark();
        this.focus();
      });
      this.element.replaceChildren(make("p", { class: "note" }, texts.noBookmarks), add);
      return;
    }
    const list = make("ul", { class: "rows" });
    for (const marked of bookmarks) {
      const name = namePage(this.#say, this.#book, marked);
      const there = make("button", { type: "button", class: "line" }, name);
      if (marked === page) there.setAttribute("aria-current", "true");
      there.addEventListener("click", () => {
        void this.#book.goTo(marked);
        this.#picked();
      });
      const remove = iconButton("close", `${texts.removeBookmark}: ${name}`);
      remove.addEventListener("click", () => {
        this.#book.toggleBookmark(marked);
        this.focus();
      });
      list.append(make("li", { class: "row" }, there, remove));
    }
    this.element.replaceChildren(list);
  }

  focus(): void {
    const current = this.element.querySelector<HTMLElement>("[aria-current]");
    (current ?? this.element.querySelector<HTMLElement>("button"))?.focus();
  }
}
