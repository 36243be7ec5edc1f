/** What stands in the margins of a page of text: the running head above it, and its number below. */

import { cleanText } from "../book_text.ts";
import type { FlowBook, FlowOutline, FlowTarget } from "./flow_book.ts";
import type { SectionMap } from "./lay_section.ts";
import type { PageMargins } from "./markup.ts";

/** How deep lines of the contents may lie that become running heads: parts and chapters. */
const deepest = 2;

/** Characters that are kept of a title: more than fit on any page. */
const longest = 120;

/** A title, and where what it names begins. */
interface Heading {
  readonly title: string;
  readonly target: FlowTarget;
}

/** The running heads of a book: its title on even pages, that of the chapter on odd ones. */
export class RunningHeads {
  readonly #title: string;
  readonly #headings: readonly Heading[];

  constructor({ title, outline }: Pick<FlowBook, "title" | "outline">) {
    this.#title = cleanText(title, longest);
    this.#headings = headingsIn(outline, 1);
  }

  /**
   * Returns what stands in the margins of a page of a section. Where a chapter begins there is a
   * number alone, and nothing around a picture, or on a leaf that has but a few words.
   *
   * @param number of the page in the book, from 1
   * @param map of the section
   */
  marginsOf(section: number, page: number, number: number, map: SectionMap): PageMargins {
    const { starts, length, extent, ids } = map;
    const hasText = (starts[page + 1] ?? length) > (starts[page] ?? length);
    if (!hasText || extent <= 0.5) return { head: "", folio: "" };
    const folio = String(number);
    const chapter = this.#headings.findLast(({ target }) => {
      const from = target.section === section ? (ids.get(target.id) ?? 0) : 0;
      return target.section < section || (target.section === section && from <= page);
    });
    const begins = page === 0 || this.#begins(section, page, ids);
    if (begins) return { head: "", folio };
    return { head: number % 2 === 0 ? this.#title : (chapter?.title ?? this.#title), folio };
  }

  /** Returns whether a chapter begins on a page. */
  #begins(section: number, page: number, ids: SectionMap["ids"]): boolean {
    return this.#headings.some(
      ({ target }) => target.section === section && ids.get(target.id) === page,
    );
  }
}

/** Returns the titles of contents that lead into the book, in its order. */
function headingsIn(outline: readonly FlowOutline[], depth: number): Heading[] {
  if (depth > deepest) return [];
  const all = outline.flatMap(({ title, target, children }) => {
    const own = cleanText(title, longest);
    const inner = headingsIn(children, depth + 1);
    return target === null || own === "" ? inner : [{ title: own, target }, ...inner];
  });
  return all.sort((a, b) => a.target.section - b.target.section);
}
