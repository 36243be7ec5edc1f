/** What the browser says of a book that it draws. */

import type { SiteBook, SiteLink, SitePage, SiteRun } from "./site_book.ts";

/** How pages are drawn. */
export interface DrawOptions {
  /** Whether pictures are wanted besides the text. */
  readonly pictures: boolean;
  /** Pixels of the longer side of the largest picture. */
  readonly longest: number;
  readonly format: SiteBook["format"];
  /** 1 to 100, of the encoder. */
  readonly quality: number;
}

/** A book that was opened. */
export interface OpenedBook extends Omit<SiteBook, "format" | "file" | "hasText" | "pages"> {
  readonly pageCount: number;
}

/** A page that was drawn. */
export interface DrawnPage {
  /** In the source's own unit. */
  readonly width: number;
  readonly height: number;
  readonly label: string;
  readonly side?: SitePage["side"];
  readonly roll?: number;
  /** From the largest on, as base64; empty if none were wanted or it failed. */
  readonly pictures: readonly {
    readonly width: number;
    readonly height: number;
    readonly data: string;
  }[];
  readonly runs: readonly SiteRun[];
  readonly links: readonly SiteLink[];
  readonly alt: string;
  /** Why it could not be drawn, in a sentence. */
  readonly failed?: string;
}

/** Something that a book lists and that cannot be shown. */
export interface UnshownPart {
  /** A sentence that says so. */
  readonly message: string;
  /** The page on which it would be shown, from 1, if that is known. */
  readonly page?: number;
}
