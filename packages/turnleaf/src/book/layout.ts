/** Chooses how a book is bound and laid out, from the options and the available space. */

import type { CoverKind, Edge, Layout } from "./spreads.ts";

/** The requested layout; "auto" leaves the choice to the book or to the space. */
export interface LayoutOptions {
  readonly cover: CoverKind;
  readonly binding: "auto" | Edge;
  readonly layout: "auto" | Layout;
  readonly offset: 0 | 1;
  /** Page numbers and ranges from 1, such as "1-2,9". */
  readonly hardPages: string;
}

/** Returns the edge at which a book is bound for a reading direction. */
export function edgeFor(requested: LayoutOptions["binding"], direction: "ltr" | "rtl"): Edge {
  return requested === "auto" ? (direction === "rtl" ? "right" : "left") : requested;
}

/**
 * "auto" shows a single page if the page in a spread would be smaller than the
 * first fraction of it, and returns to spreads above the second. Between the
 * two the layout stays.
 */
const singleBelow = 0.6;
const spreadAbove = 0.68;

/**
 * Returns the layout for a place.
 *
 * @param aspect a page's width over its height
 * @param quarterTurned whether the two pages of a spread lie one above the
 * other
 * @param width,height of the place, both 0 while unknown
 * @param before the previous layout, null at first
 */
export function layoutFor(
  requested: LayoutOptions["layout"],
  aspect: number,
  quarterTurned: boolean,
  width: number,
  height: number,
  before: Layout | null,
): Layout {
  if (requested !== "auto") return requested;
  if (width === 0 || height === 0) return before ?? "spread";
  const [across, down] = quarterTurned ? [1, 2] : [2, 1];
  const inSpread = Math.min(height / down, width / across / aspect);
  const fraction = inSpread / Math.min(height, width / aspect);
  return fraction < (before === "single" ? spreadAbove : singleBelow) ? "single" : "spread";
}

/**
 * Returns which way a key turns a book bound at an edge: 1 forward, -1 back, 0
 * for a key that turns nothing. Arrows point to where the leaf to turn lies. On
 * a book that turns up or down, the left and right arrows act as on one bound
 * at the left.
 */
export function turnOfKey(key: string, edge: Edge): 1 | 0 | -1 {
  if (key === "PageDown") return 1;
  if (key === "PageUp") return -1;
  const across = { ArrowRight: 1, ArrowLeft: -1 }[key] ?? 0;
  const down = { ArrowDown: 1, ArrowUp: -1 }[key] ?? 0;
  if (edge === "left") return across as 1 | 0 | -1;
  if (edge === "right") return -across as 1 | 0 | -1;
  return (across || (edge === "top" ? down : -down)) as 1 | 0 | -1;
}

/** Maximum of numbers read from a list of pages. */
const mostNumbers = 10_000;

/**
 * Returns the pages that a list such as "1-2,9" names in a book of `pageCount`
 * pages. Invalid entries are ignored.
 */
export function pagesNamed(list: string, pageCount: number): number[] {
  const pages = new Set<number>();
  for (const part of list.split(",", mostNumbers)) {
    const [, from, to = from] = /^\s*(\d+)\s*(?:-\s*(\d+)\s*)?$/.exec(part) ?? [];
    const last = Math.min(Number(to), pageCount);
    for (let page = Math.max(Number(from), 1); page <= last; page++) pages.add(page);
  }
  return [...pages];
}
