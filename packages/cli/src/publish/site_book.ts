/** What is kept of a published book, as it stands in the site's files. */

/** Raised when a book's files have another form: books of older ones are drawn anew. */
export const bookFormat = 1;

/** A page's own size, in the unit of its source, and the pixels of its largest picture. */
export interface SitePage {
  readonly width: number;
  readonly height: number;
  /** Absent if the page is merely numbered. */
  readonly label?: string;
  /** Where in a spread it has to lie, if the book says so. */
  readonly side?: "first" | "second" | "alone" | "single";
  /** The roll that it is a part of, if it is scrolled. */
  readonly roll?: number;
  /** Pixels of the largest picture; absent if none was drawn. */
  readonly pixels?: readonly [width: number, height: number];
  /** Why it could not be drawn, in a sentence. */
  readonly failed?: string;
}

/** A line of a book's contents; `page` from 1. */
export interface SiteOutlineEntry {
  readonly title: string;
  readonly page: number | null;
  readonly href?: string;
  readonly children: readonly SiteOutlineEntry[];
}

/** A line about a book that its owner wants to be shown. */
export interface SiteDetail {
  readonly label: string;
  readonly value: string;
  readonly href?: string;
}

/** `book.json`: what the source says of a book. */
export interface SiteBook {
  readonly title: string;
  readonly language: string;
  readonly direction: "ltr" | "rtl";
  readonly kind: "typeset" | "scan";
  readonly openingPage: number;
  readonly edge?: "left" | "right" | "top" | "bottom";
  readonly layout?: "spread" | "single";
  readonly details: readonly SiteDetail[];
  readonly allows: { readonly print: boolean; readonly copy: boolean };
  /** Media type of the pictures. */
  readonly format: "jpeg" | "webp";
  /** Name of the book's own file, if the site has it in place of the pictures. */
  readonly file: string | null;
  /** Whether any page has text. */
  readonly hasText: boolean;
  readonly outline: readonly SiteOutlineEntry[];
  readonly pages: readonly SitePage[];
}

/** A piece of text: its characters, box and angle, and flags: 1 a line's end, 2 vertical. */
export type SiteRun = readonly [
  text: string,
  x: number,
  y: number,
  width: number,
  height: number,
  angle: number,
  flags: number,
];

/** A link: its box, and the page (from 1) or the address that it leads to, and its title. */
export type SiteLink = readonly [
  x: number,
  y: number,
  width: number,
  height: number,
  to: number | string,
  title: string,
];

/** The text of one page. */
export interface SiteText {
  readonly runs: readonly SiteRun[];
  readonly links: readonly SiteLink[];
  readonly alt: string;
}

/** Pages whose text is in one file, `text/1.json` and so on, and in one HTML page. */
export const pagesInPart = 20;

/** How often a picture is halved: there are this many sizes besides the largest. */
export const halvings = 2;

/** Returns the size of a picture that is halved some times. */
export function halved(
  [width, height]: readonly [number, number],
  times: number,
): [width: number, height: number] {
  const by = 2 ** times;
  return [Math.ceil(width / by), Math.ceil(height / by)];
}

/**
 * Returns the address of a picture of page `index` (from 0) relative to the
 * book's folder, as IIIF's Image API names it.
 */
export function pictureAddress(
  index: number,
  pixels: readonly [number, number],
  times: number,
  format: SiteBook["format"],
): string {
  const size = times === 0 ? "max" : halved(pixels, times).join(",");
  return `iiif/${index + 1}/full/${size}/0/default.${format === "jpeg" ? "jpg" : "webp"}`;
}
