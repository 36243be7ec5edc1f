/** What `<turnleaf-book>` tells its page. */

import type { Edge, Layout } from "../book/spreads.ts";

/** Where a turn leads, in page numbers from 1. */
export interface TurnDetail {
  /** The first page seen before. */
  readonly from: number;
  /** The first page seen after. */
  readonly to: number;
  /** On or back, as the book is read. */
  readonly direction: "forward" | "backward";
}

/** The events of `<turnleaf-book>` by name; those of every element it has too. */
export interface TurnleafEventMap {
  /** The book is open and can be turned. */
  load: CustomEvent<{ pageCount: number; title: string }>;
  /** A leaf leaves its side, by hand or by command. */
  turnstart: CustomEvent<TurnDetail>;
  /** The book came to rest at another spread and nothing more is planned: once a jump, however long. */
  pagechange: CustomEvent<TurnDetail>;
  /** The book is bound at another edge, or shows two pages rather than one, or one rather than two. */
  layoutchange: CustomEvent<{ layout: Layout; binding: Edge }>;
  /** Pages were added, taken out or replaced. */
  pageschange: CustomEvent<{ pageCount: number }>;
  /** The book is seen from nearer or farther; `zoom` as the property is. */
  zoomchange: CustomEvent<{ zoom: number }>;
  /** Other pages are bookmarked. */
  bookmarkchange: CustomEvent<{ bookmarks: readonly number[] }>;
  /** The slide-show begins or ends. */
  playchange: CustomEvent<{ playing: boolean }>;
  /** A page (from 1) could not be drawn; the sentence, which stands in its place, says why. The other pages are shown. */
  pageerror: CustomEvent<{ page: number; message: string }>;
  /** The book could not be opened, or a part of the viewer not be loaded, without which it shows; the sentence says which. */
  error: CustomEvent<{ message: string }>;
}

type AnyEvents = Omit<HTMLElementEventMap, keyof TurnleafEventMap> & TurnleafEventMap;

/** An element whose listeners get the events of `<turnleaf-book>`, each of its type. */
export interface Listened extends HTMLElement {
  /**
   * Calls `listener` at every event of a type: `options` as of every element.
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
  /** Calls `listener` no more; `type` and `options` as they were given. */
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
