/** The element's messages: visible ones, and those for screen readers. */

import { pagesAt } from "../book/spreads.ts";
import type { PageSource } from "../sources/page_source.ts";
import type { Viewer } from "../viewer/viewer.ts";
import { elementTexts, fill, list, number } from "../words/languages.ts";

/**
 * The two places in an element's shadow tree for messages.
 *
 * @csspart message The sheet that explains why a book is not shown, or that it
 * is loading.
 */
export class Announcements {
  readonly #message: HTMLElement = document.createElement("div");
  readonly #live: HTMLElement = document.createElement("div");

  constructor(root: ParentNode) {
    this.#message.setAttribute("part", "message");
    this.#message.setAttribute("role", "status");
    this.#live.className = "live";
    this.#live.setAttribute("aria-live", "polite");
    root.append(this.#message, this.#live);
  }

  /** Shows a sentence where the page would be; an empty one removes it. */
  say(sentence: string, role: "status" | "alert" = "status"): void {
    this.#message.setAttribute("role", role);
    this.#message.textContent = sentence;
    this.#message.hidden = sentence === "";
  }

  /** Announces a text to screen readers. */
  announce(text: string): void {
    this.#live.textContent = text;
  }
}

/** Returns which pages lie open, such as "Pages iv and v of 112", in a language. */
export function openPages(source: PageSource, viewer: Viewer, tag: string): string {
  const { spread } = viewer.turning;
  const seen = pagesAt(viewer.binding, spread).map((page) => source.label(page - 1));
  const { back, pageOpen, pagesOpen } = elementTexts(tag);
  const text = [back, pageOpen][seen.length] ?? pagesOpen;
  return fill(text, { pages: list(tag, seen), n: number(tag, source.pageCount) });
}
