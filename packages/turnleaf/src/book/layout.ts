/** Chooses how a book is bound and laid out, from the options and the available space. */

import { type BindOptions, type CoverKind, countUpTo, type Edge, type Layout } from "./spreads.ts";

/** The requested layout; "auto" leaves the choice to the book or to the space. */
export interface LayoutOptions {
  readonly cover: "auto" | CoverKind;
  readonly binding: "auto" | Edge;
  readonly layout: "auto" | Layout;
  readonly offset: 0 | 1;
  /** Page numbers and ranges from 1, such as "1-2,9". */
  readonly hardPages: string;
  /** Pages (from 1) from which on the pages lie one face farther. */
  readonly shifts: readonly number[];
  /** Stocks and their pages (from 1), such as "card 1-2, coated 17-24". */
  readonly stocks: string;
}

/** Returns the edge at which a book is bound: the requested one, or the book's own. */
export function edgeFor(
  requested: LayoutOptions["binding"],
  { edge, direction }: { readonly edge?: Edge; readonly direction: "ltr" | "rtl" },
): Edge {
  if (requested !== "auto") return requested;
  return edge ?? (direction === "rtl" ? "right" : "left");
}

/** Minimum of pages of a book that is bound in boards which have none. */
const leastBetweenBoards = 5;

/**
 * Returns what holds the leaves of a book, the requested cover or the book's own, and what its boards
 * show: pages (undefined), its picture, or its title. A document that is asked to have boards has its
 * title on them.
 */
export function coverFor(
  requested: LayoutOptions["cover"],
  own: "picture" | "stamped" | "none" | undefined,
  pageCount: number,
): { readonly cover: CoverKind; readonly boards: "picture" | "stamped" | undefined } {
  const cover = requested === "auto" ? (own === "none" ? "none" : "hard") : requested;
  if (cover !== "hard" || own === undefined) return { cover, boards: undefined };
  if (own === "picture") return { cover, boards: "picture" };
  return pageCount < leastBetweenBoards
    ? { cover: "none", boards: undefined }
    : { cover, boards: "stamped" };
}

/** Where pages lie in spreads: how a book is bound for that. */
export interface PlacedPages {
  /** 1 if page 1 has nothing beside it. */
  readonly offset: 0 | 1;
  /** Pages (from 2, in order) before which a face is left bare; one named twice has two before it. */
  readonly bareBefore: readonly number[];
  /** Which boards of a hard cover have no pages. */
  readonly bareBoards: NonNullable<BindOptions["bareBoards"]>;
}

/**
 * Returns the face on which a page (from 1) lies, in the order of reading: an even one on its own or
 * first on its leaf, an odd one and the next face each other. Boards without pages are not counted.
 */
export function faceIn({ offset, bareBefore }: PlacedPages, page: number): number {
  return page - offset + countUpTo(bareBefore, page);
}

/** The place of a page in its spread, as `PageSource.inSpread` returns it. */
type PlaceInSpread = "first" | "second" | "alone" | "single" | undefined;

/**
 * Returns the faces to leave bare so that every page lies where the book wants
 * it, and the offset so that page 1 does.
 *
 * @param shifts pages (from 1) before which a face is left bare, unless the
 * book wants the page elsewhere
 * @param inSpread returns what the book wants for page `index` (from 0)
 * @param boards what the boards show, as `coverFor` returns it
 */
export function placePages(
  pageCount: number,
  { offset, shifts }: Pick<LayoutOptions, "offset" | "shifts">,
  inSpread?: (index: number) => PlaceInSpread,
  boards?: "picture" | "stamped",
): PlacedPages {
  const shifted = new Set(shifts);
  const bareBefore: number[] = [];
  let start = offset;
  let face = 0;
  let before: PlaceInSpread;
  for (let page = 1; page <= pageCount; page++) {
    const place = inSpread?.(page - 1);
    if (page === 1) face = 1 - offset;
    if (page === 2 && boards === "picture" && start === 1) {
      // The inside of a board with a picture has none.
      bareBefore.push(page);
      face += 1;
    }
    const isFirst = face % 2 === 1;
    const facesSingle = before === "single" && !isFirst;
    let bare: number;
    // Nothing faces the side at which a book begins.
    if (place === "first" || (place === "single" && face > 0)) bare = isFirst ? 0 : 1;
    else if (place === "second") bare = isFirst ? 1 : facesSingle ? 2 : 0;
    else bare = facesSingle || shifted.has(page) !== (before === "alone") ? 1 : 0;
    if (bare > 0 && page === 1) start = offset === 1 ? 0 : 1;
    else for (let k = 0; k < bare; k++) bareBefore.push(page);
    face += bare + 1;
    before = place;
  }
  const isBare = boards === "stamped" || start === 0 || (offset === 0 && shifted.has(1));
  return {
    offset: start,
    bareBefore,
    bareBoards: isBare ? "both" : boards === "picture" ? "back" : "none",
  };
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
 * @param mayFace whether two pages can be read there side by side
 */
export function layoutFor(
  requested: LayoutOptions["layout"],
  aspect: number,
  quarterTurned: boolean,
  width: number,
  height: number,
  before: Layout | null,
  mayFace = true,
): Layout {
  if (requested !== "auto") return requested;
  if (width === 0 || height === 0) return before ?? "spread";
  if (!mayFace) return "single";
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
 * Returns the ranges of pages, first and last, that a list such as "1-2,9" names. Invalid entries
 * are ignored.
 */
export function rangesIn(list: string): (readonly [from: number, to: number])[] {
  return list.split(",", mostNumbers).flatMap((part) => {
    const [, from, to = from] = /^\s*(\d+)\s*(?:-\s*(\d+)\s*)?$/.exec(part) ?? [];
    const first = Math.max(Number(from), 1);
    return Number(to) >= first ? [[first, Number(to)] as const] : [];
  });
}

/**
 * Returns the pages that a list such as "1-2,9" names in a book of `pageCount`
 * pages. Invalid entries are ignored.
 */
export function pagesNamed(list: string, pageCount: number): number[] {
  const pages = new Set<number>();
  for (const [from, to] of rangesIn(list)) {
    for (let page = from; page <= Math.min(to, pageCount); page++) pages.add(page);
  }
  return [...pages];
}
