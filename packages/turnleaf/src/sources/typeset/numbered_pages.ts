/**
 * What is shown under each page number of a book of flowing text while its pages are counted: numbers are
 * estimates at first, and what a reader sees stays when they are corrected.
 */

import type { NewIndex } from "../page_source.ts";
import type { Edition } from "./edition.ts";
import type { SectionMap } from "./lay_section.ts";
import { PageNumbers, type SectionPage } from "./page_numbers.ts";
import { pageAtFraction, pageOfPlace, placeOfPage, type TextPlace } from "./text_place.ts";

/** An edition, as far as its pages are numbered. */
export type CountedEdition = Pick<Edition, "mapOf" | "counts" | "isCounted">;

/** The numbers of a book's pages between two counts, and what is shown under them. */
export class Numbering {
  readonly numbers: PageNumbers;
  /**
   * Of sections that are laid out while their numbers are still estimates: how many pages farther on
   * a page is than its number says.
   */
  readonly shifts: Map<number, number> = new Map();

  constructor(numbers: PageNumbers) {
    this.numbers = numbers;
  }

  /**
   * Returns the page of a section that is shown as one of it: where its number is an estimate, the one that
   * is as far through the section.
   *
   * @param map of the section
   */
  pageOf({ section, page }: SectionPage, map: SectionMap): number {
    if (this.numbers.isKnown(section)) return page;
    const shift = this.shifts.get(section);
    if (shift !== undefined) return page + shift;
    return pageAtFraction(page / this.numbers.countOf(section), map.pageCount);
  }
}

/** The numbered pages of a book, in the edition that is shown. */
export class NumberedPages<Shown extends CountedEdition = Edition> {
  readonly #sections: number;
  #edition: Shown;
  #numbering: Numbering;
  /** Places on pages that are not those where these begin, such as those of bookmarks. */
  #places = new Map<number, TextPlace>();
  /** The open pages, and the place where the reader is on each, the first of them first. */
  #open = new Map<number, TextPlace>();
  /** The place that keeps its side of a spread, whatever is counted before it. */
  #sided: { readonly place: TextPlace; readonly side: "first" | "second" } | null = null;

  /** @param sections of the book */
  constructor(sections: number, edition: Shown) {
    this.#sections = sections;
    this.#edition = edition;
    this.#numbering = new Numbering(this.#count());
  }

  /** The edition that is shown. */
  get edition(): Shown {
    return this.#edition;
  }

  /** The numbers as they are now; another object once they are counted anew. */
  get numbering(): Numbering {
    return this.#numbering;
  }

  /** Likewise, the numbers alone. */
  get numbers(): PageNumbers {
    return this.#numbering.numbers;
  }

  /** The number of pages as it would be counted by what is known now. */
  get estimate(): number {
    return this.#count().pageCount;
  }

  /** The sections of the open pages. */
  get openSections(): readonly number[] {
    return [...this.#open.values()].map(({ section }) => section);
  }

  /**
   * Returns the page that is shown as one of a section, whose number may still be an estimate: it is as
   * far through the section as that says. From now on the pages beside it follow it.
   */
  show(numbered: SectionPage): SectionPage {
    const shown = this.#shown(numbered);
    const { section } = shown;
    // While it is not laid out, nothing of it is shown.
    const isEstimate = this.#edition.mapOf(section) !== undefined && !this.numbers.isKnown(section);
    if (isEstimate) this.#numbering.shifts.set(section, shown.page - numbered.page);
    return shown;
  }

  #shown(numbered: SectionPage): SectionPage {
    const { section } = numbered;
    const map = this.#edition.mapOf(section);
    if (map === undefined) return numbered;
    this.#followReader(section, map);
    return { section, page: this.#numbering.pageOf(numbered, map) };
  }

  /** Has the pages of a section whose numbers are estimates lie about the reader's place, if that is in it. */
  #followReader(section: number, map: SectionMap): void {
    const { numbers, shifts } = this.#numbering;
    if (numbers.isKnown(section) || shifts.has(section)) return;
    for (const [index, place] of this.#open) {
      if (place.section !== section || place.offset === undefined) continue;
      shifts.set(section, pageOfPlace(place, map) - numbers.at(index).page);
      return;
    }
  }

  /** Returns the index under which a page of a section is shown. */
  indexOf(section: number, page: number): number {
    return this.numbers.indexOf(section, page - (this.#numbering.shifts.get(section) ?? 0));
  }

  /** Returns the index of the page on which a place lies. */
  indexOfPlace(place: TextPlace): number {
    const { section } = place;
    const map = this.#edition.mapOf(section);
    const count = this.numbers.countOf(section);
    if (map === undefined) {
      return this.numbers.indexOf(section, pageAtFraction(place.fraction ?? 0, count));
    }
    this.#followReader(section, map);
    const { shifts } = this.#numbering;
    const page = pageOfPlace(place, map);
    if (!this.numbers.isKnown(section) && !shifts.has(section)) {
      shifts.set(section, page - pageAtFraction(page / map.pageCount, count));
    }
    return this.indexOf(section, page);
  }

  /**
   * Keeps a place for the page on which it lies: set otherwise, the book shows the page that has this place,
   * and not the one that has what the page begins with now.
   */
  keepPlace(place: TextPlace): void {
    const isExact = place.offset !== undefined && this.#edition.mapOf(place.section) !== undefined;
    if (isExact) this.#places.set(this.indexOfPlace(place), place);
  }

  /**
   * Keeps the places of the reader, as `PageSource.keepOpen`: a page that stays open has the place that it
   * had, another the one with which it begins.
   */
  keepOpen(indices: readonly number[]): void {
    const before = this.#open;
    const placeOf = (index: number): TextPlace => {
      const kept = before.get(index);
      if (kept?.offset !== undefined) return kept;
      // As a book opens, the reader is at the place that was looked for.
      return before.size === 0 ? this.placeOn(index) : this.headOf(index);
    };
    this.#open = new Map(indices.map((index) => [index, placeOf(index)]));
  }

  /** Returns the place with which a page begins, or that of a reader on it. */
  placeOn(index: number): TextPlace {
    const open = this.#open.get(index);
    if (open === undefined) return this.#markedOn(index);
    // It may have been laid out since.
    return open.offset === undefined ? this.headOf(index) : open;
  }

  /** Returns the place with which a page begins, or one that is kept for it. */
  #markedOn(index: number): TextPlace {
    return this.#places.get(index) ?? this.headOf(index);
  }

  /** Returns the place with which a page begins. */
  headOf(index: number): TextPlace {
    const { section, page } = this.#shown(this.numbers.at(index));
    const map = this.#edition.mapOf(section);
    if (map === undefined) return { section, fraction: page / this.numbers.countOf(section) };
    return placeOfPage(section, Math.min(Math.max(page, 0), map.pageCount - 1), map);
  }

  /** Has a page lie on a side of its spread from the next count on. */
  keepSide(index: number, side: "first" | "second"): void {
    this.#sided = { place: this.placeOn(index), side };
  }

  /** Returns the side on which a section has to begin so that the place that keeps its side does. */
  sideOf(section: number): "first" | "second" | undefined {
    if (this.#sided?.place.section !== section || section === 0) return undefined;
    const { place, side } = this.#sided;
    const page = this.indexOfPlace(place) - this.numbers.indexOf(section, 0);
    return (page % 2 === 0) === (side === "first") ? "first" : "second";
  }

  /** Counts the pages anew: of another edition, or by what is known of this one. */
  change(after: Shown): NewIndex {
    const [before, numbers] = [this.#edition, this.numbers];
    const indices = Array.from({ length: numbers.pageCount }, (_, index) => index);
    const open = new Map([...this.#open.keys()].map((index) => [index, this.placeOn(index)]));
    const marks = indices.map((index) => this.#markedOn(index));
    // What was shown under each number, as far as that was known.
    const shown = indices.map((index) => this.#shown(numbers.at(index)).page);
    this.#edition = after;
    const now = this.#count();
    this.#numbering = new Numbering(now);
    this.#open = new Map();
    // The reader's place is found first: the pages beside it lie about it.
    for (const place of open.values()) {
      const to = this.indexOfPlace(place);
      if (!this.#open.has(to)) this.#open.set(to, place);
    }
    const placeOf = (index: number): number =>
      this.indexOfPlace(open.get(index) ?? (marks[index] as TextPlace));
    this.#places = new Map();
    for (const [index, place] of marks.entries()) {
      if (place.offset === undefined) continue;
      const to = placeOf(index);
      if (!this.#places.has(to)) this.#places.set(to, place);
    }
    const sameIndex = (index: number): number | null => {
      const { section } = numbers.at(index);
      const [page = -1, count] = [shown[index], now.countOf(section)];
      if (after !== before || page < 0 || page >= count) return null;
      // By another number of pages another page is shown once it is laid out.
      const isEstimate = !now.isKnown(section) && count !== numbers.countOf(section);
      return isEstimate ? null : now.indexOf(section, page);
    };
    return Object.assign(sameIndex, { placeOf });
  }

  #count(): PageNumbers {
    const edition = this.#edition;
    const known = Array.from(
      { length: this.#sections },
      (_, section) => edition.mapOf(section) !== undefined,
    );
    return new PageNumbers(edition.counts(), known, !edition.isCounted);
  }
}
