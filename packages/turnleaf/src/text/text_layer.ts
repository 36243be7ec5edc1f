/**
 * The text over a resting book: selectable, found by the browser, read by a
 * screen reader, with working links. It is hidden as soon as something moves
 * and comes back at rest; at rest nothing runs.
 */

import type {
  LinkTarget,
  PageField,
  PageLink,
  PageMedium,
  PageSize,
  PageSource,
  TextRun,
} from "../sources/page_source.ts";
import { columnAt, columnsOf } from "./columns.ts";
import { boundsOf, cutBoxes, cutRuns } from "./cut_to_page.ts";
import { keepNodes } from "./kept_nodes.ts";
import { NotePopover } from "./note_popover.ts";
import { type FieldPlace, type FieldValues, makeFields } from "./page_fields.ts";
import { type LinkActions, makeLinks } from "./page_links.ts";
import { layMarks, type MarkedTexts, type ShownHit } from "./page_marks.ts";
import { joinHeadings, layText } from "./page_text.ts";
import type { PageView } from "./page_view.ts";
import { layOver, type Project, placeIn } from "./run_place.ts";
import { goesOn, mayGoOn } from "./searching.ts";
import { keepSelection } from "./selecting.ts";
import { selectWord } from "./word_selection.ts";

/** The contents of an open page. */
interface Content {
  readonly page: number;
  readonly size: PageSize;
  readonly runs: readonly TextRun[];
  readonly links: readonly PageLink[];
  readonly fields: readonly PageField[];
  /** Returns the buttons of its sounds and films; null if it has none. */
  readonly makeMedia: MakeMedia | null;
  readonly alt: string;
  /** Whether the page is an element, which is read itself. */
  readonly isElement: boolean;
}

/** As `makeMedia`, of one page. */
type MakeMedia = (
  ended: AbortSignal,
  played: (medium: PageMedium, isPlayed: boolean) => void,
) => FieldPlace[];

/** Loads what plays sounds and films, which most books do not need. */
async function loadMedia(media: readonly PageMedium[]): Promise<MakeMedia> {
  const { makeMedia } = await import("./page_media.ts");
  return (ended, played) =>
    makeMedia(media, ended, played).map((element, k) => ({
      element,
      lay: (project) => layOver(element, placeIn(media[k] as PageMedium, project)),
    }));
}

/**
 * An open page's elements: its text, laid out again in every view, and those
 * that keep their focus and their value.
 */
interface Group {
  readonly element: HTMLElement;
  readonly text: HTMLElement;
  laid: readonly FieldPlace[] | null;
}

/** The options of the layer besides the view. */
export interface TextLayerOptions extends LinkActions {
  readonly source: PageSource;
  /** Returns the name of a page's group: "Page iv". */
  readonly name: (page: number) => string;
  /** Redraws a page after one of its fields has changed. */
  readonly redraw: (page: number) => void;
  /** Called with whether the visible pages have text. */
  readonly onText: (isText: boolean) => void;
}

/**
 * The layer of one book.
 *
 * @csspart note A note of the book, shown over the page beside the link to it.
 * @csspart text The text over the resting pages, invisible until it is
 * selected.
 */
export class TextLayer {
  /** The text, and under it the marks, which darken the page as ink does. */
  readonly element: HTMLElement = document.createElement("div");
  readonly #text: HTMLElement = document.createElement("div");
  readonly #marks: HTMLElement = document.createElement("div");
  readonly #note = new NotePopover();
  readonly #view: PageView;
  readonly #options: TextLayerOptions;
  readonly #ended = new AbortController();
  /** Aborts the reading of pages that are no longer open. */
  #reading = new AbortController();
  #contents = new Map<number, Content>();
  #groups = new Map<number, Group>();
  /** The text of pages beside the open ones, where places of a search may begin or end; null until it is read. */
  readonly #beside = new Map<number, readonly TextRun[] | null>();
  readonly #values: FieldValues = new Map();
  #shown: ShownHit | null = null;
  /** What is played on the open pages, or about to be. */
  readonly #played = new Set<PageMedium>();
  /** Whether what is known of the open pages is of before a change. */
  #isStale = false;

  constructor(view: PageView, options: TextLayerOptions) {
    this.#view = view;
    this.#options = options;
    const { source } = options;
    const { element } = this;
    const text = this.#text;
    element.className = "reading";
    element.hidden = true;
    this.#marks.ariaHidden = "true";
    text.className = "text";
    text.setAttribute("part", "text");
    if (source.language) text.lang = source.language;
    text.dir = source.direction;
    element.append(this.#marks, text, this.#note.element);
    const { signal } = this.#ended;
    if (source.allows?.copy === false) text.classList.add("uncopied");
    else keepSelection(text, signal);
    const stop = view.onView((rests) => this.#update(rests));
    signal.addEventListener("abort", stop);
    this.#update();
  }

  /** Marks hits on the visible pages; null removes the marks. */
  mark(shown: ShownHit | null): void {
    this.#shown = shown;
    if (!this.element.hidden) this.#mark();
  }

  /** Returns the column of text at a place of an open page, as `columnAt` does; null if its text is not known. */
  columnAt(
    page: number,
    at: { readonly x: number; readonly y: number },
  ): ReturnType<typeof columnAt> {
    const content = this.#contents.get(page);
    return content ? columnAt(content.runs, content.size, at) : null;
  }

  /** Returns the columns of an open page's text in the order of reading, as `columnsOf` does; none if its text is not known. */
  columnsOf(page: number): ReturnType<typeof columnsOf> {
    const content = this.#contents.get(page);
    const columns = content ? columnsOf(content.runs, content.size) : [];
    return this.#options.source.direction === "rtl" ? [...columns].reverse() : columns;
  }

  /**
   * Selects the word at a place of the window, CSS pixels. Returns what extends the selection by whole words
   * to another place; null if there is no text at the first, or none may be copied.
   */
  selectWord(x: number, y: number): ReturnType<typeof selectWord> {
    const maySelect = !this.element.hidden && this.#options.source.allows?.copy !== false;
    return maySelect ? selectWord(this.#text, x, y) : null;
  }

  /** Reads the open pages again after a change; what is played on one of them is heard first. */
  reload(): void {
    this.#isStale = this.#played.size > 0;
    if (this.#isStale) return;
    this.#reading.abort();
    this.#contents.clear();
    this.#groups.clear();
    this.#update();
  }

  /** Removes the layer and its listeners. */
  destroy(): void {
    this.#ended.abort();
    this.#reading.abort();
    this.element.remove();
  }

  /** Follows the view: hides while it moves, lays out the open pages when it rests. */
  #update(rests = true): void {
    const pages = this.#view.openPages;
    const isSeen = rests && pages.some((page) => this.#view.project(page, 0.5, 0.5) !== null);
    this.element.hidden = !isSeen;
    if (!isSeen) {
      this.#note.hide();
      return;
    }
    if (pages.join() !== [...this.#groups.keys()].join()) this.#open(pages);
    this.#place();
  }

  /** Creates groups for other open pages, filled as their contents arrive. */
  #open(pages: readonly number[]): void {
    this.#reading.abort();
    this.#reading = new AbortController();
    if (this.#isStale) this.#contents.clear();
    this.#isStale = false;
    this.#played.clear();
    this.#beside.clear();
    const { signal } = this.#reading;
    this.#groups = new Map(
      pages.map((page) => {
        const element = document.createElement("div");
        element.setAttribute("role", "group");
        element.setAttribute("aria-label", this.#options.name(page));
        const text = document.createElement("div");
        text.className = "print";
        element.append(text);
        return [page, { element, text, laid: null }];
      }),
    );
    this.#text.replaceChildren(...[...this.#groups.values()].map(({ element }) => element));
    this.#options.onText(false);
    for (const page of this.#contents.keys())
      if (!pages.includes(page)) this.#contents.delete(page);
    for (const page of pages) {
      if (this.#contents.has(page)) continue;
      this.#read(page, signal).then(
        (content) => {
          if (signal.aborted) return;
          this.#contents.set(page, content);
          if (!this.element.hidden) this.#place();
        },
        // A page that cannot be read is reported where it would be seen.
        () => {},
      );
    }
  }

  async #read(page: number, signal: AbortSignal): Promise<Content> {
    const { source } = this.#options;
    const index = page - 1;
    const size = await source.size(index, signal);
    if (source.element?.(index)) {
      // It lies over its page itself: its text is known for marks alone.
      const runs = (await source.text?.(index, signal)) ?? [];
      return { page, runs, links: [], fields: [], makeMedia: null, alt: "", size, isElement: true };
    }
    const [runs, links, fields, media, alt] = await Promise.all([
      source.text?.(index, signal, true).catch(() => []) ?? [],
      source.links?.(index, signal).catch(() => []) ?? [],
      source.fields?.(index, signal).catch(() => []) ?? [],
      source.media?.(index, signal).catch(() => []) ?? [],
      source.alt?.(index, signal).catch(() => "") ?? "",
    ]);
    const bounds = boundsOf(size, (source.roll?.(index) ?? null) !== null);
    const played = cutBoxes(media, bounds);
    const makeMedia = played.length > 0 ? await loadMedia(played).catch(() => null) : null;
    return {
      page,
      size,
      runs: cutRuns(runs, bounds),
      links: cutBoxes(links, bounds),
      fields: cutBoxes(fields, bounds),
      makeMedia,
      alt,
      isElement: false,
    };
  }

  /** Lays the known contents of the open pages over them as they are seen now. */
  #place(): void {
    let isText = false;
    for (const [page, group] of this.#groups) {
      const content = this.#contents.get(page);
      if (content === undefined) continue;
      isText ||= content.runs.length > 0 || content.alt !== "";
      this.#fill(group, content);
      const previous = this.#groups.get(page - 1);
      if (previous) joinHeadings(previous.text, group.text);
    }
    this.#options.onText(isText);
    this.#mark();
  }

  /** Marks the places of a search on the open pages. */
  #mark(): void {
    this.#marks.replaceChildren();
    if (!this.#shown) return;
    for (const page of this.#groups.keys()) {
      const content = this.#contents.get(page);
      if (!content) continue;
      const texts = this.#textsAround(page, content.runs);
      this.#marks.append(...layMarks(texts, this.#shown, page, this.#projectOn(content)));
    }
  }

  /** Returns the text of an open page and of those around it in which its first paragraph and its last are, as far as it is known. */
  #textsAround(page: number, runs: readonly TextRun[]): MarkedTexts {
    const texts = [runs];
    let first = page;
    // A place may begin as far before as one may reach.
    for (let text = this.#readBeside(first - 1); text; text = this.#readBeside(first - 1)) {
      if (!mayGoOn([text, ...texts.slice(0, page - first)])) break;
      first -= 1;
      texts.unshift(text);
    }
    for (let last = page; mayGoOn(texts.slice(page - first)); last++) {
      const text = this.#readBeside(last + 1);
      if (!text) break;
      texts.push(text);
    }
    return new Map(texts.map((text, k) => [first + k, text]));
  }

  /** Returns the runs of an open page that are known. */
  #runsOf(page: number): readonly TextRun[] {
    return this.#contents.get(page)?.runs ?? [];
  }

  /** Returns the runs of a page around an open one; null if there is none, or until they are read. */
  #readBeside(page: number): readonly TextRun[] | null {
    const { source } = this.#options;
    const open = this.#contents.get(page);
    if (open) return open.runs;
    if (this.#groups.has(page) || page < 1 || page > source.pageCount) return null;
    const known = this.#beside.get(page);
    if (known !== undefined) return known;
    this.#beside.set(page, null);
    const { signal } = this.#reading;
    source.text?.(page - 1, signal).then(
      (runs) => {
        if (signal.aborted) return;
        this.#beside.set(page, runs);
        // The text of a page before an open one matters only if it goes on there.
        const isJoined = !this.#groups.has(page + 1) || goesOn(runs);
        if (isJoined && !this.element.hidden) this.#mark();
      },
      // A page that cannot be read is reported where it would be seen.
      () => {},
    );
    return null;
  }

  /** Returns where places of an open page are seen, in the unit of its size. */
  #projectOn({ page, size }: Content): Project {
    const place = this.#view.placeOf(page, size);
    return (x, y) =>
      this.#view.project(
        page,
        place.x + (x / size.width) * place.width,
        place.y + (y / size.height) * place.height,
      );
  }

  #fill(group: Group, content: Content): void {
    const { page, runs } = content;
    const project = this.#projectOn(content);
    if (content.isElement) group.element.removeAttribute("role");
    else {
      const [before, after] = [this.#runsOf(page - 1).at(-1), this.#runsOf(page + 1)[0]];
      keepNodes(group.text, layText(runs, project, before, after));
    }
    if (group.laid === null) {
      group.laid = this.#make(content);
      group.element.append(...group.laid.map(({ element }) => element));
    }
    for (const { lay } of group.laid) lay(project);
  }

  /** Redraws open pages with a field of this name; others are drawn when they are turned to. */
  #redraw(field: string): void {
    for (const { page, fields } of this.#contents.values()) {
      if (fields.some(({ name }) => name === field)) this.#options.redraw(page);
    }
  }

  /** Creates links, fields, players and descriptions of pictures. */
  #make({ page, runs, links, fields, makeMedia, alt }: Content): readonly FieldPlace[] {
    const { name, goTo, leaving, source } = this.#options;
    const nameOf = (to: LinkTarget): string => ("page" in to ? name(to.page) : to.href);
    const made = [
      ...makeLinks(links, runs, nameOf, { goTo, leaving }, this.#note),
      ...makeFields(fields, this.#values, (field, isDone) => {
        source.fill?.(page - 1, field, this.#values.get(field) ?? "");
        for (const { laid } of this.#groups.values())
          for (const { refresh } of laid ?? []) refresh?.();
        if (isDone) this.#redraw(field);
      }),
      ...(makeMedia?.(this.#reading.signal, (medium, isPlayed) => {
        if (isPlayed) this.#played.add(medium);
        else if (this.#played.delete(medium) && this.#isStale) this.reload();
      }) ?? []),
    ];
    if (alt !== "") {
      const picture = document.createElement("div");
      picture.setAttribute("role", "img");
      picture.setAttribute("aria-label", alt);
      made.push({ element: picture, lay: () => {} });
    }
    return made;
  }
}
