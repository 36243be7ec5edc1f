import type { PageColours, PageSize, TextRun, Typography } from "../page_source.ts";
import { divide } from "./divide.ts";
import type { FlowContent } from "./flow_book.ts";
import {
  type LaidLink,
  type LaidMedium,
  LaidSection,
  type Passage,
  type SpokenMark,
} from "./laid_section.ts";
import type { SectionMap } from "./lay_section.ts";
import type { PageMargins } from "./markup.ts";
import type { TitleFace } from "./title_font.ts";

/** Pieces of a chapter that are kept in their frames: the one that is read, and those beside it. */
const keptPieces = 3;

/** What is known of a piece once it has been laid out. */
interface Piece {
  readonly content: FlowContent;
  readonly map: SectionMap;
  /** The chapter's pages before it. */
  readonly first: number;
}

/**
 * A section set into pages: a long one in pieces, each laid out by itself and
 * again when it is needed, so that neither the time that a page takes nor the
 * memory grows with the section.
 */
export class LaidChapter {
  readonly map: SectionMap;
  /** The size of `svg()`. */
  readonly layoutSize: PageSize;
  readonly #pieces: readonly Piece[];
  readonly #lay: (content: FlowContent) => Promise<LaidSection>;
  /** Pieces in their frames, the last used one last. */
  readonly #laid: Map<number, Promise<LaidSection>>;
  /** Those that are laid out by now, and those that are about to be closed. */
  readonly #open: Set<LaidSection>;
  #spoken: SpokenMark | null = null;
  #isClosed = false;

  /**
   * Lays a section out. Rejects with any error of the browser, and with the
   * signal's reason.
   *
   * @param isScrolled as `LaidSection.lay` has it; such a section is one piece
   */
  static async lay(
    content: FlowContent,
    typography: Typography,
    isScrolled: boolean,
    signal: AbortSignal,
  ): Promise<LaidChapter> {
    const isWhole = isScrolled || content.size !== undefined;
    const roots = isWhole ? [content.root] : divide(content.root);
    const lay = (piece: FlowContent, signal?: AbortSignal): Promise<LaidSection> =>
      LaidSection.lay(piece, typography, isScrolled, signal);
    const pieces: Piece[] = [];
    let kept: LaidSection | null = null;
    let first = 0;
    for (const root of roots) {
      const piece = { ...content, root };
      const laid = await lay(piece, signal);
      pieces.push({ content: piece, map: laid.map, first });
      first += laid.map.pageCount;
      // The first one is most likely to be asked for.
      if (kept === null) kept = laid;
      else laid.close();
      if (signal.aborted) kept.close();
      signal.throwIfAborted();
    }
    return new LaidChapter(pieces, kept as LaidSection, lay);
  }

  private constructor(
    pieces: readonly Piece[],
    kept: LaidSection,
    lay: (content: FlowContent) => Promise<LaidSection>,
  ) {
    this.#pieces = pieces;
    this.#lay = lay;
    this.#laid = new Map([[0, Promise.resolve(kept)]]);
    this.#open = new Set([kept]);
    this.layoutSize = kept.layoutSize;
    this.map = joined(pieces);
  }

  /** Returns a page as an SVG, with what stands in its margins, in colours of the reader's if there are any. */
  svg(page: number, margins: PageMargins, colours: PageColours | null): Promise<string> {
    return this.#on(page, (laid, own) => laid.svg(own, margins, colours));
  }

  /** Returns the text of a page. */
  runs(page: number, exact: boolean): Promise<TextRun[]> {
    return this.#on(page, (laid, own) => laid.runs(own, exact));
  }

  /** Returns the links on a page. */
  links(page: number): Promise<LaidLink[]> {
    return this.#on(page, (laid, own) => laid.links(own));
  }

  /** Returns the sounds and films on a page. */
  media(page: number): Promise<LaidMedium[]> {
    return this.#on(page, (laid, own) => laid.media(own));
  }

  /** Returns what the pictures on a page show, in words. */
  alt(page: number): Promise<string> {
    return this.#on(page, (laid, own) => laid.alt(own));
  }

  /** Returns the text of the note that has an id; empty if there is none. */
  async note(id: string): Promise<string> {
    return (await this.#piece(this.#withId(id))).note(id);
  }

  /** Returns what `LaidSection.passage` returns, of all pieces. */
  async passage(id: string): Promise<Passage | null> {
    const index = this.#withId(id);
    const passage = (await this.#piece(index)).passage(id);
    const first = this.#pieces[index]?.first ?? 0;
    const pages = passage?.pages.map(({ page, from }) => ({ page: page + first, from }));
    return passage && pages ? { ...passage, pages } : null;
  }

  /** Returns the face of its first heading; null if the book chose none. */
  async titleFace(): Promise<TitleFace | null> {
    return (await this.#piece(0)).titleFace();
  }

  /** Marks what is read aloud, in what is drawn from now on; null removes the mark. */
  mark(spoken: SpokenMark | null): void {
    this.#spoken = spoken;
  }

  close(): void {
    this.#isClosed = true;
    for (const laid of this.#open) laid.close();
    this.#laid.clear();
  }

  /** Returns what is on a page, by its piece and the page's number there. */
  async #on<T>(page: number, read: (laid: LaidSection, own: number) => T): Promise<T> {
    const index = Math.max(
      this.#pieces.findLastIndex(({ first }) => first <= page),
      0,
    );
    return read(await this.#piece(index), page - (this.#pieces[index]?.first ?? 0));
  }

  /** Returns the piece with an element's id; the first one if none has it. */
  #withId(id: string): number {
    return Math.max(
      this.#pieces.findIndex(({ map }) => map.ids.has(id)),
      0,
    );
  }

  /** Returns a piece in its frame, laid out again if that is gone. */
  async #piece(index: number): Promise<LaidSection> {
    const laying = this.#laid.get(index) ?? this.#layAgain(index);
    this.#laid.delete(index);
    this.#laid.set(index, laying);
    for (const [oldest, old] of this.#laid) {
      if (this.#laid.size <= keptPieces) break;
      this.#laid.delete(oldest);
      // Those that wait for it read it first.
      old.then((laid) => this.#close(laid)).catch(() => {});
    }
    const laid = await laying;
    if (this.#isClosed) throw closed();
    laid.mark(this.#spoken);
    return laid;
  }

  async #layAgain(index: number): Promise<LaidSection> {
    const content = this.#pieces[index]?.content;
    if (this.#isClosed || !content) throw closed();
    try {
      const laid = await this.#lay(content);
      this.#open.add(laid);
      if (this.#isClosed) this.#close(laid);
      return laid;
    } catch (error) {
      this.#laid.delete(index);
      throw error;
    }
  }

  #close(laid: LaidSection): void {
    laid.close();
    this.#open.delete(laid);
  }
}

function closed(): DOMException {
  return new DOMException("The book is closed.", "AbortError");
}

/** Returns what is known of pieces as one section. */
function joined(pieces: readonly Piece[]): SectionMap {
  const [one] = pieces;
  if (one && pieces.length === 1) return one.map;
  const ids = new Map<string, number>();
  const starts: number[] = [];
  let length = 0;
  const onPages = <T extends { readonly page?: number }>(
    of: (map: SectionMap) => readonly T[],
  ): T[] =>
    pieces.flatMap(({ map, first }) =>
      of(map).map((one) => (one.page === undefined ? one : { ...one, page: first + one.page })),
    );
  for (const { map, first } of pieces) {
    for (const [id, page] of map.ids) if (!ids.has(id)) ids.set(id, first + page);
    for (const start of map.starts) starts.push(length + start);
    length += map.length;
  }
  const tops = new Map<string, number>();
  const last = pieces.at(-1) as Piece;
  return {
    ...{ pageCount: starts.length, starts, length, ids, tops, size: (one as Piece).map.size },
    extent: last.first + last.map.extent,
    lost: onPages(({ lost }) => lost),
    noteLinks: onPages(({ noteLinks }) => noteLinks),
    blankIds: new Set(pieces.flatMap(({ map }) => [...map.blankIds])),
  };
}
