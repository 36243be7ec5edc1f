/** The events of `<turnleaf-book>`. */

import type { DogEar } from "../book/dog_ears.ts";
import type { PageFold } from "../book/page_folds.ts";
import type { Edge, Layout } from "../book/spreads.ts";
import type { BookState } from "../book/turning.ts";
import type { BookErrorCode, BookWarningCode } from "../sources/page_source.ts";

/** A turn from one page to another, in page numbers from 1. */
export interface TurnDetail {
  /** The first visible page before. */
  readonly from: number;
  /** The first visible page after. */
  readonly to: number;
  /** The direction of reading. */
  readonly direction: "forward" | "backward";
}

/** What could not be done. */
export interface FailureDetail {
  /** A sentence that gives the reason and says what to do, in the element's language. */
  readonly message: string;
  /** What kind of error it is. */
  readonly code: BookErrorCode;
  /** What the server responded, such as 404, if that is the error. */
  readonly status?: number | undefined;
  /** The page that it is about, from 1, if it is about one. */
  readonly page?: number | undefined;
  /** The book, file or address that it is about, if that is known. */
  readonly source?: string | undefined;
}

/** What a book lists and cannot be shown. */
export interface WarningDetail {
  /** A sentence that says so, in the element's language. */
  readonly message: string;
  /** What it is. */
  readonly code: BookWarningCode;
  /** The file, address, name or title that it is about, as the book has it. */
  readonly source?: string | undefined;
  /** The page on which it would be shown, from 1, if that is known. */
  readonly page?: number | undefined;
}

/** The events of `<turnleaf-book>` by name, besides those of every element. */
export interface TurnleafEventMap {
  /** The book is open and can be turned. */
  load: CustomEvent<{ pageCount: number; title: string }>;
  /** A leaf leaves its side, by dragging or by command. */
  turnstart: CustomEvent<TurnDetail>;
  /**
   * The book has come to rest at another spread and nothing more is planned:
   * once per jump, however long. Or its pages lie otherwise beside each other, as by another
   * `offset`, and another one is the first visible.
   */
  pagechange: CustomEvent<TurnDetail>;
  /**
   * The book is bound at another edge, or shows two pages rather than one, or
   * one rather than two.
   */
  layoutchange: CustomEvent<{ layout: Layout; binding: Edge }>;
  /** Pages were inserted, removed or replaced, set anew in another number, or counted in place of an estimate. */
  pageschange: CustomEvent<{ pageCount: number }>;
  /** The book's `state` has changed. */
  statechange: CustomEvent<{ state: BookState }>;
  /** The zoom level has changed; `zoom` as the property is. */
  zoomchange: CustomEvent<{ zoom: number }>;
  /** The bookmarks have changed. */
  bookmarkchange: CustomEvent<{ bookmarks: readonly number[] }>;
  /** The corners that are folded over have changed. */
  dogearchange: CustomEvent<{ dogEars: readonly DogEar[] }>;
  /** The folds of pages have changed, besides those of their corners. */
  foldchange: CustomEvent<{ folds: readonly PageFold[] }>;
  /**
   * A leaf begins to tear: its pages, from 1. Cancelled by `preventDefault()`, it stays whole.
   */
  tear: CustomEvent<{ pages: readonly number[] }>;
  /** A leaf is torn out: the numbers that its pages had, from 1. `pageschange` has come before. */
  torn: CustomEvent<{ pages: readonly number[] }>;
  /** The pages at which the offset is shifted have changed. */
  shiftchange: CustomEvent<{ shifts: readonly number[] }>;
  /** The slide-show starts or stops. */
  playchange: CustomEvent<{ playing: boolean }>;
  /** Reading aloud starts or ends. */
  readaloudchange: CustomEvent<{ reading: boolean }>;
  /**
   * A page (from 1) could not be drawn; the sentence, which stands in its
   * place, gives the reason. The other pages are shown.
   */
  pageerror: CustomEvent<FailureDetail & { readonly page: number }>;
  /** Something that the book lists and that cannot be shown is now in `warnings`. */
  warnings: CustomEvent<{ warnings: readonly WarningDetail[] }>;
  /**
   * The book could not be opened or read aloud, or an optional part of the
   * viewer could not be loaded; the sentence says which.
   */
  error: CustomEvent<FailureDetail>;
}

type AnyEvents = Omit<HTMLElementEventMap, keyof TurnleafEventMap> & TurnleafEventMap;

/** An element whose listeners get the events of `<turnleaf-book>`, each of its type. */
export interface TypedEventElement extends HTMLElement {
  /**
   * Calls `listener` at every event of a type: `options` as of every element.
   *
   * @param type one of `<turnleaf-book>` or of any element
   */
  addEventListener<K extends keyof AnyEvents>(
    type: K,
    listener: (this: this, event: AnyEvents[K]) => unknown,
    options?: boolean | AddEventListenerOptions,
  ): void;
  addEventListener(
    type: string,
    listener: EventListenerOrEventListenerObject,
    options?: boolean | AddEventListenerOptions,
  ): void;
  /** Removes `listener`; `type` and `options` as they were given. */
  removeEventListener<K extends keyof AnyEvents>(
    type: K,
    listener: (this: this, event: AnyEvents[K]) => unknown,
    options?: boolean | EventListenerOptions,
  ): void;
  removeEventListener(
    type: string,
    listener: EventListenerOrEventListenerObject,
    options?: boolean | EventListenerOptions,
  ): void;
}
