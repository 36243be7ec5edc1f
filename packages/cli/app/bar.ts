import type { TurnleafBook } from "turnleaf";
import { findPage } from "./pages.ts";

/** Milliseconds that the bar stays in sight after the last movement. */
const sight = 2500;

/**
 * The controls at the foot of the window. They come into sight when the
 * pointer moves, at a touch, or when the keyboard reaches them, and leave it by
 * themselves; at rest no timer runs.
 */
export class Bar {
  readonly #book: TurnleafBook;
  readonly #bar: HTMLElement = element("bar");
  readonly #page: HTMLInputElement = element("page");
  readonly #previous: HTMLButtonElement = element("previous");
  readonly #next: HTMLButtonElement = element("next");
  #sleep = 0;

  constructor(book: TurnleafBook) {
    this.#book = book;
    this.#previous.addEventListener("click", () => void book.previous());
    this.#next.addEventListener("click", () => void book.next());
    this.#page.addEventListener("focus", () => this.#page.select());
    this.#page.addEventListener("input", () => this.#page.removeAttribute("aria-invalid"));
    this.#page.addEventListener("blur", () => this.refresh());
    this.#page.addEventListener("keydown", (event) => {
      if (event.key === "Escape") this.#leave();
    });
    element("place").addEventListener("submit", (event) => {
      event.preventDefault();
      this.#go();
    });
    for (const type of ["pointermove", "pointerdown"]) {
      addEventListener(type, () => this.wake(), { passive: true });
    }
    prepareFullscreen();
  }

  /** Shows the controls of a book that is open. */
  show(): void {
    this.#bar.hidden = false;
    element("count").textContent = `/ ${this.#book.pageCount}`;
    this.refresh();
    this.wake();
  }

  /** Tells which page lies open. */
  refresh(): void {
    const { page, pageCount } = this.#book;
    this.#page.removeAttribute("aria-invalid");
    if (document.activeElement !== this.#page) this.#page.value = this.#book.label(page);
    this.#previous.disabled = page <= 1;
    this.#next.disabled = page >= pageCount;
  }

  wake(): void {
    this.#bar.classList.add("awake");
    clearTimeout(this.#sleep);
    this.#sleep = window.setTimeout(() => this.#bar.classList.remove("awake"), sight);
  }

  #go(): void {
    const page = findPage(this.#book, this.#page.value);
    if (page === null) {
      this.#page.setAttribute("aria-invalid", "true");
      this.#page.select();
      return;
    }
    this.#leave();
    void this.#book.goTo(page);
  }

  /** Gives the keyboard back to the book. */
  #leave(): void {
    this.#book.focus({ preventScroll: true });
  }
}

function prepareFullscreen(): void {
  const button = element<HTMLButtonElement>("fullscreen");
  button.hidden = !document.fullscreenEnabled;
  button.addEventListener("click", toggleFullscreen);
  addEventListener("fullscreenchange", () => {
    button.setAttribute("aria-pressed", String(document.fullscreenElement !== null));
  });
  addEventListener("keydown", (event) => {
    const isText = event.target instanceof HTMLInputElement;
    if (event.key === "f" && !isText && !event.ctrlKey && !event.metaKey && !event.altKey) {
      toggleFullscreen();
    }
  });
}

function toggleFullscreen(): void {
  const change = document.fullscreenElement
    ? document.exitFullscreen()
    : document.documentElement.requestFullscreen();
  // Browsers may refuse; the book stays as it is.
  change.catch(() => {});
}

function element<T extends HTMLElement>(id: string): T {
  const found = document.getElementById(id);
  if (!found) throw new Error(`The page has no element ${id}.`);
  return found as T;
}
