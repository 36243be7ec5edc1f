/**
 * The text over a resting book: selectable, found by the browser, heard by a
 * screen reader, with links that lead on. It is hidden the moment something
 * moves and comes back at rest; at rest nothing runs.
 */

import { placeOnLeaf } from "../pages/fit.ts";
import type {
  LinkTarget,
  PageLink,
  PageSize,
  PageSource,
  TextRun,
} from "../sources/page_source.ts";
import { layLinks } from "./page_links.ts";
import { layMarks, type Shown } from "./page_marks.ts";
import { layText } from "./page_text.ts";
import type { PageView } from "./page_view.ts";
import type { Project } from "./placing.ts";
import { keepSelection } from "./selecting.ts";

/** What is known of an open page. */
interface Content {
  readonly page: number;
  readonly size: PageSize;
  readonly runs: readonly TextRun[];
  readonly links: readonly PageLink[];
  readonly alt: string;
}

/** What the layer needs beside the view. */
export interface TextLayerOptions {
  readonly source: PageSource;
  /** What a page's group is called: "Page iv". */
  readonly name: (page: number) => string;
  /** A link within the book is followed. */
  readonly goTo: (page: number) => void;
  /** Called with whether the pages in sight can be read as text. */
  readonly onText: (isText: boolean) => void;
}

/** The layer of one book. */
export class TextLayer {
  /** The text, and under it the marks, which darken what is printed as ink does. */
  readonly element: HTMLElement = document.createElement("div");
  readonly #text: HTMLElement = document.createElement("div");
  readonly #marks: HTMLElement = document.createElement("div");
  readonly #view: PageView;
  readonly #options: TextLayerOptions;
  readonly #ended = new AbortController();
  /** Ends the reading of pages that lie open no more. */
  #reading = new AbortController();
  #contents = new Map<number, Content>();
  #groups = new Map<number, HTMLElement>();
  #shown: Shown | null = null;

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
    element.append(this.#marks, text);
    const { signal } = this.#ended;
    if (source.allows?.copy === false) text.classList.add("uncopied");
    else keepSelection(text, signal);
    const stop = view.onView(() => this.#update());
    signal.addEventListener("abort", stop);
    this.#update();
  }

  /** Marks what was found on the pages in sight; null takes the marks away. */
  mark(shown: Shown | null): void {
    this.#shown = shown;
    if (!this.element.hidden) this.#place();
  }

  /** Reads the open pages anew: they are others than before. */
  reload(): void {
    this.#reading.abort();
    this.#contents.clear();
    this.#groups.clear();
    this.#update();
  }

  /** Takes the layer and its listeners away. */
  destroy(): void {
    this.#ended.abort();
    this.#reading.abort();
    this.element.remove();
  }

  /** Follows the view: hides while it moves, else lays out the pages that lie open. */
  #update(): void {
    const pages = this.#view.openPages;
    const isSeen = pages.some((page) => this.#view.project(page, 0.5, 0.5) !== null);
    this.element.hidden = !isSeen;
    if (!isSeen) return;
    if (pages.join() !== [...this.#groups.keys()].join()) this.#open(pages);
    this.#place();
  }

  /** Other pages lie open: groups for them, filled as their contents arrive. */
  #open(pages: readonly number[]): void {
    this.#reading.abort();
    this.#reading = new AbortController();
    const { signal } = this.#reading;
    this.#groups = new Map(
      pages.map((page) => {
        const group = document.createElement("div");
        group.setAttribute("role", "group");
        group.setAttribute("aria-label", this.#options.name(page));
        return [page, group];
      }),
    );
    this.#text.replaceChildren(...this.#groups.values());
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
        // A page that cannot be read is told where it would be seen.
        () => {},
      );
    }
  }

  async #read(page: number, signal: AbortSignal): Promise<Content> {
    const { source } = this.#options;
    const index = page - 1;
    const [runs, links, alt] = await Promise.all([
      source.text?.(index, signal, true).catch(() => []) ?? [],
      source.links?.(index, signal).catch(() => []) ?? [],
      source.alt?.(index, signal).catch(() => "") ?? "",
    ]);
    return { page, runs, links, alt, size: await source.size(index, signal) };
  }

  /** Lays what is known of the open pages over them as they are seen now. */
  #place(): void {
    let isText = false;
    this.#marks.replaceChildren();
    for (const [page, group] of this.#groups) {
      const content = this.#contents.get(page);
      if (content === undefined) continue;
      isText ||= content.runs.length > 0 || content.alt !== "";
      this.#fill(group, content);
    }
    this.#options.onText(isText);
  }

  #fill(group: HTMLElement, content: Content): void {
    const { page, size, runs, links, alt } = content;
    const place = placeOnLeaf(size.width / size.height, this.#view.aspect);
    const project: Project = (x, y) =>
      this.#view.project(
        page,
        place.x + (x / size.width) * place.width,
        place.y + (y / size.height) * place.height,
      );
    const { name, goTo } = this.#options;
    const nameOf = (to: LinkTarget): string => ("page" in to ? name(to.page) : to.href);
    this.#marks.append(...layMarks(runs, this.#shown, page, project));
    const nodes = [...layText(runs, project), ...layLinks(links, runs, project, nameOf, goTo)];
    if (alt !== "") {
      const picture = document.createElement("div");
      picture.setAttribute("role", "img");
      picture.setAttribute("aria-label", alt);
      nodes.push(picture);
    }
    group.replaceChildren(...nodes);
  }
}
