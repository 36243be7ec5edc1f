import { BookError } from "../page_source.ts";
import type { FlowBook, FlowContent } from "./flow_book.ts";

/** Sections whose contents are kept: those of two open pages, and those beside them. */
const keptSections = 4;

/** The contents of a book's sections: those used last are kept, so that setting them anew reads nothing. */
export class SectionContents {
  readonly #book: FlowBook;
  readonly #kept = new Map<number, FlowContent>();

  constructor(book: FlowBook) {
    this.#book = book;
  }

  /**
   * Returns what is in a section. Rejects with a `BookError`.
   *
   * @param isKept whether it is likely to be needed again
   */
  async load(section: number, isKept: boolean): Promise<FlowContent> {
    const known = this.#kept.get(section);
    const content = known ?? (await this.#book.sections[section]?.load());
    if (!content)
      throw new BookError(`${this.#book.name} has no part ${section + 1}.`, {
        code: "noPage",
        source: this.#book.name,
      });
    // By it words are divided, and letters of some languages drawn.
    const { root } = content;
    const isKnown = root.hasAttribute("lang") || root.hasAttribute("xml:lang");
    if (!isKnown && this.#book.language !== "") root.setAttribute("lang", this.#book.language);
    if (!isKept) return content;
    this.#kept.delete(section);
    this.#kept.set(section, content);
    for (const oldest of this.#kept.keys()) {
      if (this.#kept.size <= keptSections) break;
      this.#kept.delete(oldest);
    }
    return content;
  }
}
