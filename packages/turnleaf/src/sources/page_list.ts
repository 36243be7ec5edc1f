/** A book whose pages may be added, removed and replaced while it is open. */

import { limits } from "./limits.ts";
import { loadPart } from "./load_part.ts";
import { type ListedPages, PageOrder } from "./page_order.ts";
import {
  BookError,
  type BookWarning,
  type LinkTarget,
  type Narration,
  type NewIndex,
  type OutlineEntry,
  type PageBox,
  type PageColours,
  type PageField,
  type PageLink,
  type PageMedium,
  type PagePicture,
  type PageSize,
  type PageSource,
  type TextPage,
  type TextRun,
} from "./page_source.ts";
import { joinedWarnings } from "./warnings.ts";

/**
 * Presents pages of several sources as those of one book. Its title, direction
 * and other properties are the first source's; a source is closed once none of
 * its pages is left.
 */
export class PageList implements PageSource {
  /** Which pages of which sources it has. */
  readonly order: PageOrder;
  #listener: ((change: () => NewIndex) => void) | null = null;
  #onDrawing: ((index: number) => void) | null = null;
  #onWarning: (() => void) | null = null;
  /** Why pages could not be drawn when they were drawn last. */
  readonly #errors = new Map<ListedPages[number], BookError>();
  /** The colours in which pages are drawn, unless `draw` is given others; null for their own. */
  colours: PageColours | null = null;

  constructor(source: PageSource) {
    this.order = new PageOrder(source);
  }

  /** The source that the book was opened from. */
  get first(): PageSource {
    return this.order.first;
  }

  watchPages(listener: (change: () => NewIndex) => void): void {
    this.#listener = listener;
    for (const source of this.order.shown) this.#watch(source);
  }

  watchDrawings(listener: (index: number) => void): void {
    this.#onDrawing = listener;
    for (const source of this.order.shown) this.#watchDrawings(source);
  }

  /** What cannot be shown of all sources, and the pages that could not be drawn. */
  get warnings(): readonly BookWarning[] {
    const listed = [...this.order.shown].flatMap((source) =>
      (source.warnings ?? []).flatMap((warning): BookWarning[] => {
        if (warning.page === undefined) return [warning];
        const page = this.order.pageOf(source, warning.page);
        return page === null ? [] : [{ ...warning, page }];
      }),
    );
    const failed = [...this.#errors].flatMap(([entry, error]): BookWarning[] => {
      const index = this.order.indexOf(entry);
      const { message, source } = error;
      const about = source === undefined ? {} : { source };
      return index === null ? [] : [{ code: "page", message, page: index + 1, error, ...about }];
    });
    // A page that was drawn says more of why it is none.
    const pages = new Set(failed.map(({ page }) => page));
    const others = listed.filter(({ code, page }) => code !== "page" || !pages.has(page));
    return joinedWarnings(others, failed);
  }

  watchWarnings(listener: () => void): void {
    this.#onWarning = listener;
    for (const source of this.order.shown) source.watchWarnings?.(listener);
  }

  outdate(index: number): void {
    const entry = this.order.pages[index];
    entry?.source.outdate?.(entry.index);
  }

  watchSizes(listener: () => void): void {
    for (const source of this.order.shown) source.watchSizes?.(listener);
  }

  element(index: number): HTMLElement | null {
    const entry = this.order.pages[index];
    return entry?.source.element?.(entry.index) ?? null;
  }

  get title(): string {
    return this.first.title;
  }

  get language(): string {
    return this.first.language;
  }

  get direction(): "ltr" | "rtl" {
    return this.first.direction;
  }

  widthInMetres(size: PageSize): number | undefined {
    return this.first.widthInMetres?.(size);
  }

  /** The first source's; without the page that is its cover the boards are stamped. */
  get cover(): PageSource["cover"] {
    const { first } = this;
    const [entry] = this.order.pages;
    const isLost = entry?.source !== first || entry.index > 0;
    return first.cover === "picture" && isLost ? "stamped" : first.cover;
  }

  get authors(): PageSource["authors"] {
    return this.first.authors;
  }

  get kind(): "typeset" | "scan" {
    return this.first.kind;
  }

  get pageCount(): number {
    return this.order.pages.length;
  }

  get isEstimated(): boolean {
    return this.first.isEstimated ?? false;
  }

  get isGuessed(): boolean {
    return this.first.isGuessed ?? false;
  }

  get openingPage(): number | undefined {
    return this.first.openingPage;
  }

  get edge(): PageSource["edge"] {
    return this.first.edge;
  }

  get layout(): PageSource["layout"] {
    return this.first.layout;
  }

  mayFace(width: number, alone: number): boolean {
    return this.first.mayFace?.(width, alone) ?? true;
  }

  get leaf(): PageSize | undefined {
    return this.first.leaf;
  }

  get usualLeaf(): PageSize | undefined {
    return this.first.usualLeaf;
  }

  get titleFont(): PageSource["titleFont"] {
    return this.first.titleFont;
  }

  get titleDirection(): PageSource["titleDirection"] {
    return this.first.titleDirection;
  }

  get details(): PageSource["details"] {
    return this.first.details;
  }

  get allows(): PageSource["allows"] {
    return this.first.allows;
  }

  /** The first source's anchors; a page of another has that of the page before it. */
  get anchor(): PageSource["anchor"] {
    const first = this.first;
    if (!first.anchor) return undefined;
    return (index) => {
      const before = this.order.pages
        .slice(0, index + 1)
        .findLast(({ source }) => source === first);
      return first.anchor?.(before?.index ?? 0) ?? "";
    };
  }

  /** Finds anchors of the first source. */
  get findAnchors(): PageSource["findAnchors"] {
    const first = this.first;
    if (!first.findAnchors) return undefined;
    return async (anchors) => {
      const found = (await first.findAnchors?.(anchors)) ?? [];
      // Its pages are counted anew.
      if (this.#listener === null) this.order.reset();
      return found.map((index) => {
        const page = index === null ? null : this.order.pageOf(first, index + 1);
        return page === null ? null : page - 1;
      });
    };
  }

  keepSide(index: number, side: "first" | "second"): void {
    const entry = this.order.pages[index];
    entry?.source.keepSide?.(entry.index, side);
  }

  keepOpen(indices: readonly number[]): void {
    const open = indices.flatMap((index) => this.order.pages[index] ?? []);
    for (const source of this.order.shown) {
      source.keepOpen?.(open.flatMap((entry) => (entry.source === source ? [entry.index] : [])));
    }
  }

  /** Sets the first source's text anew, if it can be. */
  get typeset(): PageSource["typeset"] {
    const first = this.first;
    return first.typeset?.bind(first);
  }

  /** The first source's file, while the book has no other pages. */
  get file(): (() => Promise<Blob>) | undefined {
    const first = this.first;
    const isWhole =
      this.order.pages.length === first.pageCount &&
      this.order.pages.every(({ source, index }, k) => source === first && index === k);
    return isWhole ? first.file?.bind(first) : undefined;
  }

  /** What is read aloud of the first source, on its pages that are left. */
  get narration(): Narration | undefined {
    const first = this.first;
    const { narration } = first;
    if (narration === undefined) return undefined;
    return {
      clipFrom: async (index, signal) => {
        const next = this.order.pages.slice(index).find(({ source }) => source === first);
        return next ? await narration.clipFrom(next.index, signal) : null;
      },
      clip: async (number, signal) => {
        const clip = await narration.clip(number, signal);
        if (clip === null) return null;
        const pages = clip.pages.flatMap(({ page, from }) => {
          const here = this.order.pageOf(first, page + 1);
          return here === null ? [] : [{ page: here - 1, from }];
        });
        return { ...clip, pages };
      },
      mark: (number) => narration.mark(number),
    };
  }

  size(index: number, signal?: AbortSignal): Promise<PageSize> {
    return this.#of(index, (source, own) => source.size(own, signal));
  }

  label(index: number): string {
    const entry = this.order.pages[index];
    const label = entry?.source.label(entry.index);
    // Pages that are merely numbered are renumbered.
    return label === undefined || label === String(entry.index + 1) ? String(index + 1) : label;
  }

  inSpread(index: number): ReturnType<NonNullable<PageSource["inSpread"]>> {
    const entry = this.order.pages[index];
    return entry?.source.inSpread?.(entry.index);
  }

  roll(index: number): number | null {
    const entry = this.order.pages[index];
    return entry?.source.roll?.(entry.index) ?? null;
  }

  /** What is done with a page (from 0) in the colours as they are, if their paper is dark: "" if nothing, or it is set in them. */
  darkened(index: number): PageColours["pictures"] {
    const { colours } = this;
    const what = this.#drawnAs(index);
    if (!colours?.isDark || what === "text") return "";
    return colours.pictures || (what === "print" ? "invert" : "dim");
  }

  /** Returns what page `index` is in other colours; elements are as the web page has them. */
  #drawnAs(index: number): "text" | "print" | "picture" {
    const entry = this.order.pages[index];
    if (!entry || entry.source.element?.(entry.index)) return "text";
    const { source } = entry;
    return source.colouring?.(entry.index) ?? (source.kind === "typeset" ? "print" : "picture");
  }

  /** Returns the picture of a page in colours of the reader's. */
  async #inColours(
    index: number,
    picture: PagePicture,
    colours: PageColours,
  ): Promise<PagePicture> {
    // Nobody turns a cover's colours over.
    const isCover = this.cover === "picture" && index === 0;
    const what = isCover ? "picture" : this.#drawnAs(index);
    if (what === "text") return picture;
    const { tinted } = await loadPart(import("./tint.ts"));
    const other = tinted(picture, what, isCover ? { ...colours, pictures: "dim" } : colours);
    if (other !== picture && "close" in picture) picture.close();
    return other;
  }

  async draw(
    index: number,
    width: number,
    signal: AbortSignal,
    region?: PageBox,
    colours: PageColours | null = this.colours,
  ): Promise<PagePicture> {
    const entry = this.order.pages[index];
    try {
      const picture = await this.#of(index, (source, own) =>
        source.draw(own, width, signal, region, colours),
      );
      if (entry) this.#errors.delete(entry);
      return colours === null ? picture : await this.#inColours(index, picture, colours);
    } catch (error) {
      const isListed = entry !== undefined && this.#errors.size < limits.warnings;
      if (isListed && error instanceof BookError && error.code !== "closed") {
        this.#errors.set(entry, error);
        this.#onWarning?.();
      }
      throw error;
    }
  }

  text(index: number, signal: AbortSignal, exact?: boolean): Promise<readonly TextRun[]> {
    return this.#of(index, async (source, own) => (await source.text?.(own, signal, exact)) ?? []);
  }

  /** Goes through the pages as they lie, and through all those at once whose source goes through its own. */
  async *textPages(signal: AbortSignal): AsyncGenerator<TextPage> {
    const done = new Set<PageSource>();
    for (let at = 0, entry = this.order.pages[0]; entry; entry = this.order.pages[++at]) {
      const { source } = entry;
      if (!source.textPages) {
        const page = entry;
        const text = async (own: AbortSignal): Promise<readonly TextRun[]> =>
          (await source.text?.(page.index, own)) ?? [];
        yield { key: page, index: () => this.order.indexOf(page), text };
      } else if (!done.has(source)) {
        done.add(source);
        for await (const page of source.textPages(signal)) {
          const index = (): number | null => {
            const own = page.index();
            const here = own === null ? null : this.order.pageOf(source, own + 1);
            return here === null ? null : here - 1;
          };
          if (index() !== null) yield { ...page, index };
        }
      }
      // Pages may have been added and removed meanwhile.
      const now = this.order.pages.indexOf(entry);
      if (now >= 0) at = now;
    }
  }

  alt(index: number, signal: AbortSignal): Promise<string> {
    return this.#of(index, async (source, own) => (await source.alt?.(own, signal)) ?? "");
  }

  fields(index: number, signal: AbortSignal): Promise<readonly PageField[]> {
    return this.#of(index, async (source, own) => (await source.fields?.(own, signal)) ?? []);
  }

  media(index: number, signal: AbortSignal): Promise<readonly PageMedium[]> {
    return this.#of(index, async (source, own) => (await source.media?.(own, signal)) ?? []);
  }

  fill(index: number, name: string, value: string): void {
    const entry = this.order.pages[index];
    entry?.source.fill?.(entry.index, name, value);
  }

  /** Returns a page's links, without those to removed pages. */
  links(index: number, signal: AbortSignal): Promise<readonly PageLink[]> {
    return this.#of(index, async (source, own) => {
      const links = (await source.links?.(own, signal)) ?? [];
      return links.flatMap((link) => {
        const to = this.#target(source, link.to);
        return to ? [{ ...link, to }] : [];
      });
    });
  }

  async outline(signal: AbortSignal): Promise<readonly OutlineEntry[]> {
    const moved = (entries: readonly OutlineEntry[]): readonly OutlineEntry[] =>
      entries.map((entry) => ({
        ...entry,
        page: entry.page && this.order.pageOf(this.first, entry.page),
        children: moved(entry.children),
      }));
    return moved((await this.first.outline?.(signal)) ?? []);
  }

  /** Closes every source. */
  close(): void {
    const { sources } = this.order;
    this.order.clear();
    for (const source of sources) source.close();
  }

  /**
   * Replaces `count` pages from `at` (from 0) on by another source's pages; at
   * the end, appends them. The list owns the source from then on, and closes those without a page. Pages
   * that are taken out stay after the page that they followed.
   *
   * @throws BookError if there are no such pages, or if none or too many would
   * be left; nothing has changed then
   */
  splice(at: number, count: number, source: PageSource | null): NewIndex {
    const { pageCount } = this;
    if (!Number.isInteger(at) || !(at >= 0 && count >= 0 && at + count <= pageCount)) {
      throw new BookError(`${this.title} has pages 1 to ${pageCount} alone; name those.`, {
        code: "noPage",
        source: this.title,
      });
    }
    const { sources } = this.order;
    const moved = this.order.splice(at, count, source);
    const inUse = this.order.sources;
    for (const each of sources) if (!inUse.has(each)) each.close();
    if (source) {
      this.#watch(source);
      this.#watchDrawings(source);
      if (this.#onWarning) source.watchWarnings?.(this.#onWarning);
    }
    return moved;
  }

  #watch(source: PageSource): void {
    if (this.#listener === null) return;
    source.watchPages?.((change) => this.#listener?.(() => this.order.renumber(source, change)));
  }

  #watchDrawings(source: PageSource): void {
    if (this.#onDrawing === null) return;
    source.watchDrawings?.((own) => {
      const page = this.order.pageOf(source, own + 1);
      if (page !== null) this.#onDrawing?.(page - 1);
    });
  }

  async #of<T>(index: number, ask: (source: PageSource, own: number) => Promise<T>): Promise<T> {
    const entry = this.order.pages[index];
    if (!entry)
      throw new BookError(`${this.title} has no page ${index + 1}; turn to another.`, {
        code: "noPage",
        source: this.title,
      });
    return await ask(entry.source, entry.index);
  }

  #target(source: PageSource, to: LinkTarget): LinkTarget | null {
    if (!("page" in to)) return to;
    const page = this.order.pageOf(source, to.page);
    return page === null ? null : { ...to, page };
  }
}
