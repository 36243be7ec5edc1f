/**
 * Places in a book whose pages are counted and set anew in any order: a model of it, without a browser. A
 * section is so many characters, and a page of an edition has so many of them.
 */

import { expect, test } from "vitest";
import { clue, fuzz, Random, seed } from "../../for_tests/random_numbers.ts";
import type { SectionMap } from "./lay_section.ts";
import { type CountedEdition, NumberedPages } from "./numbered_pages.ts";
import { anchorOf, placeOfAnchor } from "./text_place.ts";

/** An edition of which sections are laid out one by one. */
class ModelEdition implements CountedEdition {
  readonly size: number;
  readonly #lengths: readonly number[];
  readonly #guess: number;
  readonly #maps = new Map<number, SectionMap>();

  /**
   * @param lengths characters of each section
   * @param size characters of a page
   * @param guess what sections that are not laid out are taken to be longer than they are
   */
  constructor(lengths: readonly number[], size: number, guess: number) {
    this.#lengths = lengths;
    this.size = size;
    this.#guess = guess;
  }

  get isCounted(): boolean {
    return this.#maps.size === this.#lengths.length;
  }

  lay(section: number): void {
    const length = this.#lengths[section] ?? 0;
    const pageCount = Math.max(Math.ceil(length / this.size), 1);
    const starts = Array.from({ length: pageCount }, (_, page) => page * this.size);
    this.#maps.set(section, { pageCount, starts, length } as unknown as SectionMap);
  }

  mapOf(section: number): SectionMap | undefined {
    return this.#maps.get(section);
  }

  counts(): number[] {
    return this.#lengths.map(
      (length, section) =>
        this.#maps.get(section)?.pageCount ??
        Math.max(Math.round((this.#guess * length) / this.size), 1),
    );
  }
}

/** A reader of such a book. */
class Model {
  readonly steps: string[] = [];
  readonly #random: Random;
  readonly #lengths: readonly number[];
  readonly #guess: number;
  #edition: ModelEdition;
  #pages: NumberedPages<ModelEdition>;
  #index = 0;
  /**
   * What the page began with as he turned to it, and the size of pages then, 0 if he was amid a page; null
   * until it is laid out.
   */
  #head: { readonly section: number; readonly offset: number; readonly size: number } | null = null;
  /** Whether he came by an anchor of a page of which nothing was shown. */
  #isVague = false;

  constructor(random: Random) {
    this.#random = random;
    this.#lengths = Array.from({ length: 2 + random.below(6) }, () => 1 + random.below(4000));
    this.#guess = 0.5 + random.below(100) / 100;
    this.#edition = this.#edit(100);
    this.#pages = new NumberedPages(this.#lengths.length, this.#edition);
  }

  #edit(size: number): ModelEdition {
    return new ModelEdition(this.#lengths, size, this.#guess);
  }

  /** The page that is shown under an index, if its section is laid out. */
  #shown(index: number): { section: number; from: number; to: number } | null {
    const { section, page } = this.#pages.show(this.#pages.numbers.at(index));
    const map = this.#edition.mapOf(section);
    if (map === undefined || page < 0 || page >= map.pageCount) return null;
    return { section, from: map.starts[page] as number, to: map.starts[page + 1] ?? map.length };
  }

  /** Does something at random. */
  step(): void {
    const random = this.#random;
    const section = random.below(this.#lengths.length);
    switch (random.below(7)) {
      case 0:
        this.#say(`lay out section ${section}`);
        this.#edition.lay(section);
        break;
      case 1:
        this.#say("count");
        this.#change(this.#edition);
        break;
      case 2: {
        const next = this.#edit(random.among([60, 100, 150, 210]));
        const near = random.below(3);
        const here = this.#pages.numbers.at(this.#index).section;
        this.#say(`set in pages of ${next.size}, ${near} sections about ${here} laid out`);
        for (let k = 0; k < near; k++) next.lay(Math.min(here + k, this.#lengths.length - 1));
        this.#change(next);
        break;
      }
      case 3:
        this.#turn(random.below(this.#pages.numbers.pageCount));
        break;
      case 4:
        this.#turn(Math.min(this.#index + 1, this.#pages.numbers.pageCount - 1));
        break;
      case 5:
        this.#reload();
        break;
      default:
        // As the pages beside the open one are drawn ahead.
        this.#say("draw a page beside");
        this.#shown(Math.max(Math.min(this.#index - 1, this.#pages.numbers.pageCount - 1), 0));
    }
    this.#look();
  }

  #say(step: string): void {
    this.steps.push(step);
  }

  #turn(index: number): void {
    if (index === this.#index) return;
    this.#say(`turn to ${index}`);
    this.#index = index;
    this.#head = null;
    this.#isVague = false;
    this.#pages.keepOpen([index]);
    if (this.#random.below(3) > 0) this.#draw();
  }

  /** Has the open page laid out and drawn. */
  #draw(): void {
    this.#say("draw");
    this.#edition.lay(this.#pages.numbers.at(this.#index).section);
  }

  #change(next: ModelEdition): void {
    const before = Array.from({ length: this.#pages.numbers.pageCount }, (_, index) => index);
    const isSame = next === this.#edition;
    this.#pages.keepOpen([this.#index]);
    const drawn = before.map((index) => this.#peek(index));
    const moved = this.#pages.change(next);
    this.#edition = next;
    this.#index = moved.placeOf?.(this.#index) ?? 0;
    // A picture that is kept is that of the page.
    for (const index of isSame ? before : []) {
      const [now, then] = [moved(index), drawn[index]];
      if (now !== null && then) expect(this.#peek(now), this.#clue(`of ${index}`)).toEqual(then);
    }
  }

  /** As `#shown`, without drawing it. */
  #peek(index: number): { section: number; offset: number } | null {
    const { section, offset } = this.#pages.headOf(index);
    return offset === undefined ? null : { section, offset };
  }

  /** Opens the book anew by its anchor: set for the page that is expected, and then for the one that is shown. */
  #reload(): void {
    this.#look();
    this.#pages.keepOpen([this.#index]);
    const anchor = anchorOf(this.#pages.placeOn(this.#index));
    const place = placeOfAnchor(anchor);
    this.#say(`load ${anchor} again`);
    if (place === null) throw new Error(anchor);
    this.#isVague ||= this.#head === null;
    const { size } = this.#edition;
    const first = this.#edit(this.#random.among([size, size, 90]));
    this.#edition = first;
    this.#pages = new NumberedPages(this.#lengths.length, first);
    first.lay(0);
    first.lay(place.section);
    this.#pages.change(first);
    this.#pages.keepPlace(place);
    this.#index = this.#pages.indexOfPlace(place);
    if (first.size !== size) this.#change(this.#edit(size));
  }

  /** Compares the open page, if it is laid out, with what it began with. */
  #look(): void {
    const shown = this.#shown(this.#index);
    if (shown === null) {
      // Of a page beyond the end of its section nothing is ever shown.
      this.#isVague ||=
        this.#edition.mapOf(this.#pages.numbers.at(this.#index).section) !== undefined;
      return;
    }
    const { section, from, to } = shown;
    const head = this.#head;
    const { size } = this.#edition;
    if (head === null) {
      const offset = this.#pages.placeOn(this.#index).offset ?? from;
      if (!this.#isVague) expect(offset, this.#clue("place")).toBe(from);
      this.#head = { section, offset, size: offset === from ? size : 0 };
      return;
    }
    expect(section, this.#clue("section")).toBe(head.section);
    // The same word, and where pages are as large as then at their head.
    if (size === head.size) expect(from, this.#clue("head")).toBe(head.offset);
    expect(from, this.#clue("word")).toBeLessThanOrEqual(head.offset);
    expect(Math.max(to, 1), this.#clue("word")).toBeGreaterThan(head.offset);
  }

  #clue(what: string): string {
    return clue({ what, steps: this.steps.slice(-12) });
  }
}

test(`the reader's page has the same word, in any order of counting, setting, turning and loading (seed ${seed})`, () => {
  const random = new Random();
  for (let round = 0; round < 400 * fuzz; round++) {
    const model = new Model(random);
    for (let step = 0; step < 40; step++) model.step();
  }
});
