/** The row at the foot of the book: one page back and forward, the slider, the page field. */

import { fill, isName } from "../words/languages.ts";
import type { ControlledBook } from "./book.ts";
import { iconButton } from "./buttons.ts";
import { findPage } from "./find_page.ts";
import { make } from "./make.ts";
import type { Wording } from "./wording.ts";

/**
 * Shows where the book lies open, and turns it elsewhere.
 *
 * @csspart pages The row beneath the book.
 * @csspart slider The slider over the book's pages.
 * @csspart field The field that shows and accepts the page.
 */
export class PagesBar {
  readonly element: HTMLElement;
  readonly #book: ControlledBook;
  readonly #wording: Wording;
  readonly #slider: HTMLInputElement;
  readonly #bubble: HTMLElement = make("span", { class: "bubble", "aria-hidden": "true" });
  readonly #field: HTMLInputElement;
  readonly #count: HTMLElement = make("span", { class: "count", dir: "auto" });
  readonly #status: HTMLElement = make("span", { role: "status", class: "unseen" });
  readonly #previous: HTMLButtonElement;
  readonly #next: HTMLButtonElement;
  readonly #back: HTMLButtonElement = make("button", {
    type: "button",
    class: "return",
    hidden: true,
  });
  /** Whether the reader drags the slider: it then shows the target, not the book's place. */
  #sliding = false;

  constructor(book: ControlledBook, wording: Wording) {
    this.#book = book;
    this.#wording = wording;
    const { texts } = wording;
    this.#previous = iconButton("previous", texts.previous);
    this.#next = iconButton("next", texts.next);
    this.#previous.addEventListener("click", () => this.#turn(this.#previous));
    this.#next.addEventListener("click", () => this.#turn(this.#next));
    this.#slider = make("input", {
      type: "range",
      min: 1,
      part: "slider",
      "aria-label": texts.page,
    });
    this.#field = make("input", {
      class: "entry",
      part: "field",
      "aria-label": texts.page,
      autocomplete: "off",
      spellcheck: "false",
      enterkeyhint: "go",
    });
    const form = make("form", { class: "place" }, this.#field, this.#count);
    this.element = make(
      "div",
      { role: "group", part: "pages", class: "ui pages", "aria-label": texts.pages },
      this.#previous,
      make("div", { class: "track" }, this.#slider, this.#bubble),
      this.#next,
      form,
      this.#status,
      this.#back,
    );
    this.#listen(form);
    this.refresh();
  }

  /** Shows which page lies open. */
  refresh(): void {
    const { page, pageCount, direction } = this.#book;
    this.element.dir = direction;
    this.element.hidden = pageCount === 0;
    this.#slider.max = String(Math.max(pageCount, 1));
    if (!this.#sliding) this.#slide(page);
    this.#field.removeAttribute("aria-invalid");
    const label = this.#book.label(page);
    if ((this.element.getRootNode() as ShadowRoot).activeElement !== this.#field) {
      this.#field.value = label;
    }
    const { texts, number } = this.#wording;
    const values = { page: number(page), n: this.#wording.count(this.#book) };
    this.#count.textContent = fill(label === String(page) ? texts.of : texts.pageOf, values);
    const { jumpedFrom } = this.#book;
    this.#back.hidden = jumpedFrom === null;
    const before = this.#book.label(jumpedFrom ?? 1);
    const back = isName(before) ? texts.backToNamed : texts.backTo;
    this.#back.textContent = fill(back, { label: before });
    this.#previous.ariaDisabled = String(!this.#book.canTurn(-1));
    this.#next.ariaDisabled = String(!this.#book.canTurn(1));
  }

  #listen(form: HTMLFormElement): void {
    const slider = this.#slider;
    slider.addEventListener("input", () => {
      this.#sliding = true;
      const page = Number(slider.value);
      this.#slide(page);
      void this.#book.turnTo(page, { jump: true });
    });
    slider.addEventListener("change", () => {
      this.#sliding = false;
    });
    const held = (is: boolean) => () => this.element.classList.toggle("held", is);
    slider.addEventListener("pointerdown", held(true));
    for (const end of ["pointerup", "pointercancel", "blur"]) {
      slider.addEventListener(end, held(false));
    }
    // It is read on by keys; who moves the slider by keys keeps it.
    slider.addEventListener("pointerup", () => this.#book.focus({ preventScroll: true }));
    this.#back.addEventListener("click", () => {
      this.#book.focus({ preventScroll: true });
      this.#book.jumpBack();
    });
    const field = this.#field;
    field.addEventListener("focus", () => field.select());
    field.addEventListener("input", () => field.removeAttribute("aria-invalid"));
    field.addEventListener("blur", () => this.refresh());
    field.addEventListener("keydown", (event) => {
      if (event.key !== "Escape") return;
      event.preventDefault();
      this.#book.focus({ preventScroll: true });
    });
    form.addEventListener("submit", (event) => {
      event.preventDefault();
      this.#go();
    });
  }

  #turn(button: HTMLButtonElement): void {
    if (button.ariaDisabled === "true") return;
    void this.#book.press(button === this.#next ? 1 : -1, true);
  }

  #go(): void {
    const page = findPage(this.#book, this.#field.value);
    if (page === null) {
      this.#field.setAttribute("aria-invalid", "true");
      const label = this.#field.value.slice(0, 40);
      this.#status.textContent = fill(this.#wording.texts.noSuchPage, { label });
      this.#field.select();
      return;
    }
    this.#status.textContent = "";
    this.#book.focus({ preventScroll: true });
    void this.#book.turnTo(page, { jump: true });
  }

  /** Sets the slider at a page and says so. */
  #slide(page: number): void {
    const { texts, number, count } = this.#wording;
    const { pageCount } = this.#book;
    const label = this.#book.label(page);
    this.#slider.value = String(page);
    this.#slider.setAttribute(
      "aria-valuetext",
      fill(texts.place, { label, page: number(page), n: count(this.#book) }),
    );
    this.#bubble.textContent = label;
    const fraction = pageCount > 1 ? (page - 1) / (pageCount - 1) : 0;
    this.element.style.setProperty("--fraction", fraction.toFixed(4));
  }
}
