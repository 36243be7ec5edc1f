/** A book in Svelte: `<TurnleafBook src="book.pdf" bind:page />`, and types for `<turnleaf-book>` in templates. */

import type { Component, Snippet } from "svelte";
import type { HTMLAttributes } from "svelte/elements";
import type { TurnleafBook as BookElement, TurnleafEventMap } from "turnleaf";
import type { BookProps } from "./book_props.js";

type Listeners = {
  [E in keyof TurnleafEventMap as `on${E}`]?: (event: TurnleafEventMap[E]) => void;
};

type ElementProps = Omit<HTMLAttributes<BookElement>, keyof BookProps | keyof Listeners> &
  BookProps &
  Listeners;

/** The properties of `TurnleafBook`: those of the element, listeners of its events, and those of every element. */
export type TurnleafBookProps = ElementProps & {
  /** The element, with all its methods: for `bind:element`. */
  element?: BookElement;
  /** Pages, if neither `src` nor `pages` is set. */
  children?: Snippet;
};

/** A book. */
export declare const TurnleafBook: Component<TurnleafBookProps, object, "page" | "element">;

declare module "svelte/elements" {
  interface SvelteHTMLElements {
    "turnleaf-book": ElementProps;
  }
}
