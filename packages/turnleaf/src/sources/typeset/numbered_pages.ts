/**
 * What is shown under each page number of a book of flowing text while its pages are counted: numbers are
 * estimates at first, and what a reader sees stays when they are corrected.
 */

import type { NewIndex } from "../page_source.ts";
import type { Edition } from "./edition.ts";
import { PageNumbers, type SectionPage } from "./page_numbers.ts";
import { pageAtFraction, pageOfPlace, placeOfPage, type TextPlace } from "./text_place.ts";

/** The numbered pages of a book, in the edition that is shown. */
export class NumberedPages {
  readonly #sections: number;
  #edition: Edition;
  #numbers: PageNumbers;
  /** The places of readers on pages that are not those where these begin. */
  #places = new Map<number, TextPlace>();
  /**
   * Of sections that are laid out while their numbers are still estimates: how many pages farther on
   * a page is than its number says.
   */
  #shifts = new Map<number, number>();
  /** The place that keeps its side of a spread, whatever is counted before it. */
  #sided: { readonly place: TextPlace; readonly side: "first" | "second" } | null = null;

  /** @param sections of the book */
  constructor(sections: number, edition: Edition) {
    this.#sections = sections;
    this.#edition = edition;
    this.#numbers = this.#count();
  }

  /** The edition that is shown. */
  get edition(): Edition {
    return this.#edition;
  }

  /** The numbers as they are now; another object once they are counted anew. */
  get numbers(): PageNumbers {
    return this.#numbers;
  }

  /** The number of pages as it would be counted by what is known now. */
  get estimate(): number {
    return this.#count().pageCount;
  }

  /**
   * Returns the page that is shown as one of a section, whose number may still be an estimate: it is as
   * far through the section as that says. From now on the pages beside it follow it.
   */
  show(numbered: SectionPage): SectionPage {
    const shown = this.#shown(numbered);
    const { section } = shown;
    // While it is not laid out, nothing of it is shown.
    const isEstimate =
      this.#edition.mapOf(section) !== undefined && !this.#numbers.isKnown(section);
    if (isEstimate) this.#shifts.set(section, shown.page - numbered.page);
    return shown;
  }

  #shown({ section, page }: SectionPage): SectionPage {
    const map = this.#edition.mapOf(section);
    if (map === undefined || this.#numbers.isKnown(section)) return { section, page };
    const shift = this.#shifts.get(section);
    if (shift !== undefined) return { section, page: page + shift };
    const fraction = page / this.#numbers.countOf(section);
    return { section, page: pageAtFraction(fraction, map.pageCount) };
  }

  /** Returns the index under which a page of a section is shown. */
  indexOf(section: number, page: number): number {
    return this.#numbers.indexOf(section, page - (this.#shifts.get(section) ?? 0));
  }

  /** Returns the index of the page on which a place lies. */
  indexOfPlace(place: TextPlace): number {
    const { section } = place;
    const map = this.#edition.mapOf(section);
    const count = this.#numbers.countOf(section);
    if (map === undefined) {
      return this.#numbers.indexOf(section, pageAtFraction(place.fraction ?? 0, count));
    }
    const page = pageOfPlace(place, map);
    if (!this.#numbers.isKnown(section) && !this.#shifts.has(section)) {
      this.#shifts.set(section, page - pageAtFraction(page / map.pageCount, count));
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

  /** Returns the place with which a page begins, or that of a reader on it. */
  placeOn(index: number): TextPlace {
    const kept = this.#places.get(index);
    if (kept) return kept;
    const { section, page } = this.#shown(this.#numbers.at(index));
    const map = this.#edition.mapOf(section);
    if (map === undefined) return { section, fraction: page / this.#numbers.countOf(section) };
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
    const page = this.indexOfPlace(place) - this.#numbers.indexOf(section, 0);
    return (page % 2 === 0) === (side === "first") ? "first" : "second";
  }

  /** Counts the pages anew: of another edition, or by what is known of this one. */
  change(after: Edition): NewIndex {
    const [before, numbers, shifts] = [this.#edition, this.#numbers, this.#shifts];
    const places = Array.from({ length: numbers.pageCount }, (_, index) => this.placeOn(index));
    this.#edition = after;
    const now = this.#count();
    this.#numbers = now;
    this.#shifts = new Map();
    const placeOf = (index: number): number => this.indexOfPlace(places[index] as TextPlace);
    this.#places = new Map();
    for (const [index, place] of places.entries()) {
      if (place.offset === undefined) continue;
      const to = placeOf(index);
      if (!this.#places.has(to)) this.#places.set(to, place);
    }
    const sameIndex = (index: number): number | null => {
      const numbered = numbers.at(index);
      const { section } = numbered;
      const page = numbered.page + (numbers.isKnown(section) ? 0 : (shifts.get(section) ?? 0));
      const isSame = after === before && page >= 0 && page < now.countOf(section);
      return isSame ? now.indexOf(section, page) : null;
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
