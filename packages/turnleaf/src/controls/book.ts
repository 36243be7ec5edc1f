/**
 * What the controls need of a book: a part of the element's public interface,
 * so that a test double can replace it.
 */

import type { WarningDetail } from "../element/events.ts";
import type { PrintOptions } from "../element/printing.ts";
import type { BookDetail, OutlineEntry, PagePicture } from "../sources/page_source.ts";

/** A place where something was found, as far as a list shows it. */
export interface FoundPlace {
  readonly page: number;
  readonly before: string;
  readonly text: string;
  readonly after: string;
}

/** A place on a page: fractions of it from its upper left corner. */
interface PlaceOnPage {
  readonly x: number;
  readonly y: number;
}

/** A `<turnleaf-book>` as its controls see it. */
export interface ControlledBook<Hit extends FoundPlace = FoundPlace> extends HTMLElement {
  readonly page: number;
  readonly pageCount: number;
  /** Whether that is an estimate, and pages are being counted. */
  readonly estimated: boolean;
  /** Whether it is only a guess, which is not shown. */
  readonly guessed: boolean;
  /** The page from which the reader has jumped, until he reads on, and what turns back there. */
  readonly jumpedFrom: number | null;
  jumpBack(): void;
  readonly bookTitle: string;
  readonly direction: "ltr" | "rtl";
  /** The pages that lie open. */
  readonly spread: { readonly left: number | null; readonly right: number | null };
  readonly shownLayout: "spread" | "single";
  /** Whether the open page is scrolled and not turned. */
  readonly scrolled: boolean;
  readonly zoom: number;
  /** Returns how large the book would be shown beside a panel so wide, as a fraction of its size without one. */
  fractionBeside(width: number): number;
  readonly bookmarks: readonly number[];
  readonly shifts: readonly number[];
  readonly playing: boolean;
  /** Whether it has something to be read aloud, and whether it is. */
  readonly canReadAloud: boolean;
  readonly readingAloud: boolean;
  /** What a dark theme does with the pages that are drawn already; "" if it is none, or has none. */
  readonly darkPagesNow: "" | "invert" | "dim";
  /** Whether its text can be set in another size, typeface and so on. */
  readonly canTypeset: boolean;
  /** What the book's owner and its source permit. */
  readonly allows: { readonly print: boolean; readonly download: boolean };
  /** What the book's owner wants to be shown of it. */
  readonly titleDirection: "ltr" | "rtl" | "auto";
  readonly details: readonly BookDetail[];
  /** What cannot be shown of it. */
  readonly warnings: readonly WarningDetail[];
  label(page: number): string;
  /**
   * Returns what says on which face a page (from 1) lies where two are shown side by side, in the
   * order of reading: an odd face and the next one face each other.
   */
  pageFaces(): (page: number) => number;
  /**
   * Turns one leaf forward (1) or back (-1) for the reader: what a held key
   * repeats ends soon after its release. `isTap` says that something was pressed once: it counts in
   * any case.
   */
  press(by: 1 | -1, isTap?: boolean): Promise<boolean>;
  /** Returns whether a leaf or a cover can be turned forward (1) or back (-1) from where the book lies. */
  canTurn(by: 1 | -1): boolean;
  /**
   * Turns to a page of the open book for its reader, and to a place so far down it. `jump` is for a
   * jump from which the reader may come back.
   */
  turnTo(
    page: number,
    options?: { readonly top?: number; readonly jump?: boolean },
  ): Promise<boolean>;
  zoomTo(level: number): void;
  /** Announces a text, and the zoom level, to screen readers. */
  announce(text: string): void;
  announceZoom(): void;
  search(
    query: string,
    options?: { signal?: AbortSignal; onHits?: (hits: readonly Hit[]) => void },
  ): Promise<readonly Hit[]>;
  /** Whether there may be text in the book; known once it has been searched. */
  readonly mayHaveText: boolean;
  showHit(hit: Hit | null): Promise<boolean>;
  outline(): Promise<readonly OutlineEntry[]>;
  drawPage(page: number, width: number, signal?: AbortSignal): Promise<PagePicture>;
  toggleBookmark(page?: number): void;
  toggleShift(page?: number): void;
  /** Whether a page that lies open is a fold-out, and is unfolded. */
  readonly foldOut: "none" | "shut" | "open";
  /** Unfolds the open page that is a fold-out, or folds it in. Returns whether there is one. */
  toggleFoldOut(): boolean;
  /** The first open page (from 1) whose leaf may be torn out; null if none may. */
  readonly tearablePage: number | null;
  tearOut(page?: number): Promise<boolean>;
  /** Number of leaves that were torn out, and what puts the last one back. */
  readonly tornLeaves: number;
  putBack(): Promise<boolean>;
  /**
   * Those of them that are to be seen and are neither crumpled nor torn across: one is flat, all are
   * folded, or null. What crumples such a one, and what tears one across that is flat.
   */
  readonly wholeSheet: "flat" | "folded" | null;
  crumple(): boolean;
  tearAcross(from: PlaceOnPage, to: PlaceOnPage): boolean;
  print(options?: PrintOptions): Promise<boolean>;
  download(): Promise<boolean>;
  toggleFullscreen(): Promise<boolean>;
  play(secondsPerPage?: number): void;
  pause(): void;
  readAloud(): Promise<void>;
  stopReadingAloud(): void;
}
