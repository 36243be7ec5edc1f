/** What cannot be shown of a book of flowing text, found as its sections are laid out. */

import { cleanAddress } from "../book_text.ts";
import type { BookError, BookWarning } from "../page_source.ts";
import { joinedWarnings, warningOf } from "../warnings.ts";
import type { FlowBook, FlowOutline, FlowTarget } from "./flow_book.ts";
import type { SectionMap } from "./lay_section.ts";

/** Returns the page (from 1 of the book) of a page of a section (from 0). */
type PageOf = (section: number, page: number) => number;

/** A link to a note, and where it leads; null if nowhere. */
type LinkedNote = SectionMap["noteLinks"][number] & { readonly target: FlowTarget | null };

/** The warnings of one book, however often it is set anew. */
export class FlowWarnings {
  readonly #book: FlowBook;
  readonly #maps = new Map<number, SectionMap>();
  readonly #errors = new Map<number, BookError>();
  readonly #lines: readonly FlowOutline[];
  /** The links to notes of each section, with where they lead: looked up once. */
  readonly #notes = new Map<number, readonly LinkedNote[]>();
  #listener: (() => void) | null = null;

  constructor(book: FlowBook) {
    this.#book = book;
    this.#lines = linesOf(book.outline);
  }

  /** Takes over what is known of a section that has been laid out. */
  laid(section: number, map: SectionMap): void {
    const wasKnown = this.#errors.delete(section) || this.#maps.has(section);
    this.#maps.set(section, map);
    const notes = this.#linksOf(section, map);
    if (notes.length > 0) this.#notes.set(section, notes);
    else this.#notes.delete(section);
    const isMissed = this.#lines.some((line) => this.#isMissing(line));
    if (wasKnown || map.lost.length > 0 || this.#notes.size > 0 || isMissed) this.#listener?.();
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
      [...this.#notes].flatMap(([section, notes]) =>
        notes
          .filter((note) => this.#isBlank(note))
          .map(({ href, page }) => ({
            ...warningOf("note", href, name),
            page: pageOf(section, page),
          })),
      ),
    );
  }

  /** Returns whether a line leads to an element that is not there. */
  #isMissing({ target }: FlowOutline): boolean {
    const map = target && this.#maps.get(target.section);
    return map ? target.id !== "" && !map.ids.has(target.id) : false;
  }

  /** Returns a section's links to notes in the book. */
  #linksOf(section: number, { noteLinks }: SectionMap): LinkedNote[] {
    return noteLinks
      .filter(({ href }) => cleanAddress(href) === "")
      .map((link) => ({ ...link, target: this.#book.resolve(section, link.href) }));
  }

  /** Returns whether a link leads to a note that is missing, or has no text. */
  #isBlank({ target }: LinkedNote): boolean {
    if (target === null) return true;
    const map = this.#maps.get(target.section);
    if (map === undefined || target.id === "") return false;
    return !map.ids.has(target.id) || map.blankIds.has(target.id);
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
