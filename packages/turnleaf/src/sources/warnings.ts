/** Lists of what a book lists and cannot be shown. */

import { cleanText } from "./book_text.ts";
import { limits } from "./limits.ts";
import type { BookWarning, BookWarningCode, OutlineEntry } from "./page_source.ts";

/** What is missing, and what comes of that. */
const phrases: Readonly<Record<BookWarningCode, string>> = {
  annotation: "a mark on a page of {name}, has no appearance that can be shown",
  chapter: "a chapter of {name}, cannot be shown",
  contents: "a line of the contents of {name}, leads nowhere in it",
  embedded: "embedded in a page of {name}, is missing or cannot be shown there",
  font: "a font of {name}, is missing or damaged; its text is set in another",
  image: "an image of {name}, is missing or cannot be shown",
  link: "a link on a page of {name}, leads nowhere in it",
  medium: "a sound or film of {name}, is missing or cannot be played",
  note: "a note of {name}, is missing or has no text",
  page: "listed in {name}, is no page that can be shown",
  style: "a style sheet of {name}, is missing or cannot be read",
};

/**
 * Returns a warning with the usual sentence of its kind.
 *
 * @param source the file, address, name or title that it is about
 * @param name the book's name in sentences
 */
export function warningOf(code: BookWarningCode, source: string, name: string): BookWarning {
  // Data that are written into the book name nothing.
  const what = cleanText(/^data:/i.test(source) ? source.slice(0, 20) : source) || "–";
  return {
    code,
    message: `${what}, ${phrases[code].replace("{name}", () => name)}.`,
    source: what,
  };
}

/** Returns the warnings of several lists, each sentence once and preferably with its page, within the limit. */
export function joinedWarnings(...lists: readonly (readonly BookWarning[])[]): BookWarning[] {
  const found = new Map<string, BookWarning>();
  for (const warning of lists.flat()) {
    const known = found.get(warning.message);
    if (known ? known.page === undefined : found.size < limits.warnings) {
      found.set(warning.message, warning);
    }
  }
  return [...found.values()];
}

/** Returns warnings of the last lines of contents that lead nowhere; a heading of others need not lead anywhere. */
export function lostLines(outline: readonly OutlineEntry[], name: string): BookWarning[] {
  return outline.flatMap(({ title, page, href, children }) => {
    if (children.length > 0) return lostLines(children, name);
    return page === null && href === undefined ? [warningOf("contents", `“${title}”`, name)] : [];
  });
}

/** Warnings of a book, found one after the other. */
export class WarningList {
  #all: readonly BookWarning[] = [];
  #listener: (() => void) | null = null;

  /** Each once, at most `limits.warnings`. */
  get all(): readonly BookWarning[] {
    return this.#all;
  }

  /** Adds warnings, as far as there is room. */
  add(...warnings: readonly BookWarning[]): void {
    const all = joinedWarnings(this.#all, warnings);
    const isSame = all.length === this.#all.length && all.every((one, k) => one === this.#all[k]);
    this.#all = all;
    if (!isSame) this.#listener?.();
  }

  /** Sets the listener for warnings that are added. */
  watch(listener: () => void): void {
    this.#listener = listener;
  }
}
