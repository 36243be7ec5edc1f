/** What cannot be shown of a book of flowing text, found as its sections are laid out. */

import { cleanAddress } from "../book_text.ts";
import type { BookError, BookWarning } from "../page_source.ts";
import { joinedWarnings, warningOf } from "../warnings.ts";
import type { FlowBook, FlowOutline } from "./flow_book.ts";
import type { SectionMap } from "./laid_section.ts";

/** Returns the page (from 1 of the book) of a page of a section (from 0). */
type PageOf = (section: number, page: number) => number;

/** The warnings of one book, however often it is set anew. */
export class FlowWarnings {
  readonly #book: FlowBook;
  readonly #maps = new Map<number, SectionMap>();
  readonly #errors = new Map<number, BookError>();
  readonly #lines: readonly FlowOutline[];
  #hasNotes = false;
  #listener: (() => void) | null = null;

  constructor(book: FlowBook) {
    this.#book = book;
    this.#lines = linesOf(book.outline);
  }

  /** Takes over what is known of a section that has been laid out. */
  laid(section: number, map: SectionMap): void {
    const wasKnown = this.#errors.delete(section) || this.#maps.has(section);
    this.#maps.set(section, map);
    this.#hasNotes ||= map.noteLinks.length > 0;
    const isMissed = this.#lines.some((line) => this.#isMissing(line));
    if (wasKnown || map.lost.length > 0 || this.#hasNotes || isMissed) this.#listener?.();
  }

  /** Takes over why a section cannot be laid out. */
  failed(section: number, error: BookError): void {
    this.#errors.set(section, error);
    this.#listener?.();
  }

  /** Sets the listener for what may be another list. */
  watch(listener: () => void): void {
    this.#listener = listener;
  }

  /** Returns all that is known now. */
  all(pageOf: PageOf): readonly BookWarning[] {
    const { name, warnings = [] } = this.#book;
    const sections = [...this.#maps].sort(([a], [b]) => a - b);
    return joinedWarnings(
      warnings,
      [...this.#errors].map(([section, error]) => chapterWarning(error, pageOf(section, 0))),
      sections.flatMap(([section, { lost }]) =>
        lost.map(({ code, source, page = 0 }) => ({
          ...warningOf(code, source, name),
          page: pageOf(section, page),
        })),
      ),
      this.#lines
        .filter((line) => line.isLost || this.#isMissing(line))
        .map(({ title, target }) => {
          const page = target ? { page: pageOf(target.section, 0) } : {};
          return { ...warningOf("contents", `“${title}”`, name), ...page };
        }),
      sections.flatMap(([section, map]) => this.#notesOf(section, map, pageOf)),
    );
  }

  /** Returns whether a line leads to an element that is not there. */
  #isMissing({ target }: FlowOutline): boolean {
    const map = target && this.#maps.get(target.section);
    return map ? target.id !== "" && !map.ids.has(target.id) : false;
  }

  /** Returns the notes without text to which a section's links lead. */
  #notesOf(section: number, { noteLinks }: SectionMap, pageOf: PageOf): BookWarning[] {
    return noteLinks.flatMap(({ href, page }) => {
      const target = this.#book.resolve(section, href);
      const map = target && this.#maps.get(target.section);
      const isOnPage = map ? map.ids.has(target.id) && !map.blankIds.has(target.id) : true;
      if (cleanAddress(href) !== "" || (target && (target.id === "" || isOnPage))) return [];
      return [{ ...warningOf("note", href, this.#book.name), page: pageOf(section, page) }];
    });
  }
}

function chapterWarning(error: BookError, page: number): BookWarning {
  const { message, source } = error;
  return { code: "chapter", message, page, error, ...(source === undefined ? {} : { source }) };
}

/** Returns lines of contents and those beneath them, in order. */
function linesOf(lines: readonly FlowOutline[]): FlowOutline[] {
  return lines.flatMap((line) => [line, ...linesOf(line.children)]);
}
