/** What is read aloud of a book of flowing text: where each clip stands on its pages. */

import type { NarratedClip, Narration } from "../page_source.ts";
import { orAborted } from "../shared_tasks.ts";
import type { FlowClip, FlowNarration } from "./flow_book.ts";
import type { LaidChapter } from "./laid_chapter.ts";
import type { Passage, SpokenMark } from "./laid_section.ts";
import type { SectionPage } from "./page_numbers.ts";

/** Recordings that are kept: the one that is heard, and the next. */
const keptRecordings = 2;

/** The pages on which a narrator's clips stand. */
export interface NarratedPages {
  /** Returns which page a page (from 0) is. */
  at(index: number): SectionPage;
  /** Returns the index of a section's page. */
  indexOf(section: number, page: number): number;
  /** Lays a section out. Rejects as `draw` does. */
  lay(section: number, signal: AbortSignal): Promise<LaidChapter>;
  /** Draws pages of a section anew; all of them if `pages` is null. */
  redraw(section: number, pages: readonly number[] | null): void;
  /**
   * Resolves to what `read` does, called once more where the book is set anew meanwhile: what was laid out
   * is closed then. Rejects as it does, or with the signal's reason.
   */
  whileSet<T>(read: () => Promise<T>, signal: AbortSignal): Promise<T>;
}

/** The passage that is read now. */
interface Spoken {
  readonly number: number;
  readonly section: number;
  readonly mark: SpokenMark;
  readonly pages: readonly number[];
}

/** The narration of one book. */
export class Narrator implements Narration {
  readonly #book: FlowNarration;
  readonly #pages: NarratedPages;
  #clips: Promise<readonly FlowClip[]> | null = null;
  readonly #recordings = new Map<string, Promise<Blob>>();
  /** Passages of clips that were asked for, by their numbers. */
  readonly #known = new Map<number, Spoken>();
  #spoken: Spoken | null = null;

  constructor(book: FlowNarration, pages: NarratedPages) {
    this.#book = book;
    this.#pages = pages;
  }

  async clipFrom(index: number, signal: AbortSignal): Promise<number | null> {
    return await this.#pages.whileSet(() => this.#clipFrom(index, signal), signal);
  }

  async #clipFrom(index: number, signal: AbortSignal): Promise<number | null> {
    const { section, page } = this.#pages.at(index);
    const clips = await this.#all(signal);
    const isHere = (one: FlowClip | undefined): one is FlowClip => one?.target.section === section;
    if (!clips.some(isHere)) return found(clips, (one) => one.target.section > section);
    const laid = await this.#pages.lay(section, signal);
    const firstPage = ({ target }: FlowClip): number => laid.map.ids.get(target.id) ?? 0;
    const number = found(
      clips,
      (one) => one.target.section > section || (isHere(one) && firstPage(one) >= page),
    );
    const next = clips[number ?? clips.length];
    if (isHere(next) && firstPage(next) === page) return number;
    // One that begins on a page before may be all that stands here.
    const before = (number ?? clips.length) - 1;
    const clip = clips[before];
    const passage = isHere(clip) ? await laid.passage(clip.target.id) : null;
    return passage && (passage.pages.at(-1)?.page ?? -1) >= page ? before : number;
  }

  async clip(number: number, signal: AbortSignal): Promise<NarratedClip | null> {
    return await this.#pages.whileSet(() => this.#narrated(number, signal), signal);
  }

  async #narrated(number: number, signal: AbortSignal): Promise<NarratedClip | null> {
    const clip = (await this.#all(signal))[number];
    if (clip === undefined) return null;
    const { target, begin, end } = clip;
    const [laid, recording] = await Promise.all([
      this.#pages.lay(target.section, signal),
      clip.recording === null ? null : orAborted(this.#recording(clip.recording), signal),
    ]);
    const { text, pages } = (await laid.passage(target.id)) ?? missing;
    this.#know(number, target.section, target.id, pages);
    const onPages = pages.map(({ page, from }) => ({
      page: this.#pages.indexOf(target.section, page),
      from,
    }));
    return { pages: onPages, text, recording, begin, end };
  }

  mark(number: number | null): void {
    const before = this.#spoken;
    const now = number === null ? null : (this.#known.get(number) ?? null);
    this.#spoken = now;
    // The section's root looks otherwise while any of it is read.
    const isAll = before?.section !== now?.section && this.#book.playbackClass !== "";
    for (const spoken of [before, now]) {
      if (spoken) this.#pages.redraw(spoken.section, isAll ? null : spoken.pages);
    }
  }

  /** Returns what is read aloud in a section now; null if nothing is. */
  markIn(section: number): SpokenMark | null {
    return this.#spoken?.section === section ? this.#spoken.mark : null;
  }

  /** Forgets where passages stand: they are on other pages now. */
  forgetPages(): void {
    this.#known.clear();
  }

  #know(number: number, section: number, id: string, pages: Passage["pages"]): void {
    const { activeClass, playbackClass } = this.#book;
    const mark = { id, activeClass, playbackClass };
    // The one that is heard, the next, and one that the reader turned to.
    if (this.#known.size > 2) this.#known.clear();
    this.#known.set(number, { number, section, mark, pages: pages.map(({ page }) => page) });
  }

  #all(signal: AbortSignal): Promise<readonly FlowClip[]> {
    if (this.#clips === null) {
      this.#clips = this.#book.clips();
      // A part that could not be loaded may be the next time.
      this.#clips.catch(() => {
        this.#clips = null;
      });
    }
    return orAborted(this.#clips, signal);
  }

  #recording(path: string): Promise<Blob> {
    const reading = this.#recordings.get(path) ?? this.#book.recording(path);
    this.#recordings.delete(path);
    this.#recordings.set(path, reading);
    reading.catch(() => this.#recordings.delete(path));
    for (const oldest of this.#recordings.keys()) {
      if (this.#recordings.size <= keptRecordings) break;
      this.#recordings.delete(oldest);
    }
    return reading;
  }
}

/** An element that is not there: nothing is to be seen, and what is to be heard is. */
const missing: Passage = { text: "", pages: [{ page: 0, from: 0 }] };

/** Returns the index of the first item that fulfils a condition; null if none does. */
function found<T>(items: readonly T[], fulfils: (item: T) => boolean): number | null {
  const index = items.findIndex(fulfils);
  return index < 0 ? null : index;
}
