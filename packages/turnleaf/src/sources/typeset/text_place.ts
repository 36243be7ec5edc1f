/** Places in a book of flowing text, whatever the size in which it is set, and the anchors that name them. */

import type { SectionMap } from "./lay_section.ts";

/** A place in a section. */
export interface TextPlace {
  readonly section: number;
  /** Characters before it in the section; undefined while the section has never been laid out. */
  readonly offset?: number;
  /** Pages without text, such as pictures, from the place to that character; 0 or more. */
  readonly before?: number;
  /** The fraction of the section that lies before it: all that is known of it where `offset` is not. */
  readonly fraction?: number;
}

/** Returns the place with which a page (from 0) of a section begins. */
export function placeOfPage(
  section: number,
  page: number,
  { starts, pageCount }: SectionMap,
): TextPlace {
  const offset = starts[page] ?? 0;
  let last = page;
  while (starts[last + 1] === offset) last++;
  return { section, offset, before: last - page, fraction: page / pageCount };
}

/** Returns the page (from 0) of a section on which a place lies. */
export function pageOfPlace(place: TextPlace, { starts, pageCount }: SectionMap): number {
  const { offset, before = 0, fraction = 0 } = place;
  if (offset === undefined) return pageAtFraction(fraction, pageCount);
  const page = pageAt(starts, offset);
  // Set otherwise, the text may begin on the page that has the picture.
  return starts[page] === offset ? Math.max(page - before, starts.indexOf(offset)) : page;
}

/** Returns the page (from 0) of so many that lies after a fraction of them. */
export function pageAtFraction(fraction: number, pageCount: number): number {
  return Math.min(Math.floor(fraction * pageCount), pageCount - 1);
}

/** Returns the last page that begins at a character or before it. */
function pageAt(starts: readonly number[], offset: number): number {
  return Math.max(
    starts.findLastIndex((start) => start <= offset),
    0,
  );
}

/**
 * Returns the anchor of a place: "3:1204" for a character of a section, "3:1204-1" for the page without
 * text before it, "3:~0.250000" for a fraction of the section. All its characters may stand in an address.
 */
export function anchorOf({ section, offset, before = 0, fraction = 0 }: TextPlace): string {
  // Not less than it is: it would be the page before.
  if (offset === undefined) return `${section}:~${(Math.ceil(1e6 * fraction) / 1e6).toFixed(6)}`;
  return `${section}:${offset}${before > 0 ? `-${before}` : ""}`;
}

/** Returns the place of an anchor; null if it is none. */
export function placeOfAnchor(anchor: string): TextPlace | null {
  const found = /^(\d{1,5}):(?:(\d{1,9})(?:-(\d{1,5}))?|~([01]\.\d{6}))$/.exec(anchor);
  if (found === null) return null;
  const [, section, offset, before = "0", fraction] = found;
  if (offset === undefined) return { section: Number(section), fraction: Number(fraction) };
  return { section: Number(section), offset: Number(offset), before: Number(before) };
}
