/**
 * Books of flowing text, whatever their format: sections of clean markup in
 * order, which `FlowSource` sets into pages.
 */

import type {
  BookDetail,
  BookWarning,
  BookWarningCode,
  PageSize,
  PageSource,
} from "../page_source.ts";

/** A part of a book that begins on a page of its own: a chapter, or a page of fixed layout. */
export interface FlowSection {
  /** Its length in bytes, from which its pages are estimated before it is read. */
  readonly length: number;
  /** Resolves to about how many lines of print it has, as `linesIn` counts them. Rejects if it cannot be read. */
  lines(): Promise<number>;
  /** Whether it is one page whose layout is fixed. */
  readonly isFixed: boolean;
  /** The side of a spread on which it has to begin, or whether it is to be shown by itself, if any. */
  readonly side?: "left" | "right" | "center";
  /** The roll that it is a part of, if it is scrolled and not turned. */
  readonly roll?: number;
  /** Returns what is in it. Rejects with a `BookError`. */
  load(): Promise<FlowContent>;
}

/**
 * The attribute that has an element's own style, in place of `style`: a page's
 * policy may forbid that in markup, and is reported to do so.
 */
export const styleAttribute = "data-turnleaf-style";

/**
 * The attributes of an element that stands where a sound or a film is played:
 * its address in the book, and which of the two it is.
 */
export const mediumAttribute = "data-turnleaf-medium";
export const mediumKindAttribute = "data-turnleaf-medium-kind";

/**
 * The attributes of an element in whose place something cannot be shown, or of a picture that may turn
 * out so: the file as a warning names it, and the warning's code, which is missing for a picture that is there.
 */
export const sourceAttribute = "data-turnleaf-source";
export const lostAttribute = "data-turnleaf-lost";

/** Something that a section names and that cannot be shown. */
export interface LostPart {
  readonly code: BookWarningCode;
  /** The file, address or name that it is about. */
  readonly source: string;
  /** The page of its section (from 0) on which it would be shown. The default is the first. */
  readonly page?: number;
}

/** The attribute that says how many pixels an element's picture has. */
export const pixelsAttribute = "data-turnleaf-pixels";

/** Markup without scripts, and without any address but `data:`, fragments and those of links. */
export interface FlowContent {
  /** An `<html>` element with a `<body>`, in a document of its own. */
  readonly root: Element;
  /** Its style sheets in order: what must come first in one, such as its namespaces, is of that one alone. */
  readonly styles: readonly string[];
  /** The page's size in CSS pixels, if its layout is fixed. */
  readonly size?: PageSize;
  /** What cannot be shown, besides what elements of it are marked to be. */
  readonly lost?: readonly LostPart[];
}

/** A place in a book: an element, or a section's beginning. */
export interface FlowTarget {
  readonly section: number;
  /** The element's id; "" for the beginning. */
  readonly id: string;
}

/** A line of the contents. */
export interface FlowOutline {
  readonly title: string;
  readonly target: FlowTarget | null;
  /** Whether it is to lead to a place that the book does not have. The default is false. */
  readonly isLost?: boolean;
  readonly children: readonly FlowOutline[];
}

/** A passage that is read aloud: the text of an element, and a part of a recording. */
export interface FlowClip {
  readonly target: FlowTarget;
  /** The recording's path; null if there is none. */
  readonly recording: string | null;
  /** Seconds in the recording; `end` is infinite for all that is left of it. */
  readonly begin: number;
  readonly end: number;
}

/** What is read aloud of a book. */
export interface FlowNarration {
  /** The class of the element that is read; "" if the book names none. */
  readonly activeClass: string;
  /** The class of the root of a section that is being read; "" if the book names none. */
  readonly playbackClass: string;
  /** Resolves to the clips in the order in which they are read. Rejects with a `BookError`. */
  clips(): Promise<readonly FlowClip[]>;
  /** Resolves to a recording. Rejects with a `BookError`. */
  recording(path: string): Promise<Blob>;
}

/** A book of flowing text. */
export interface FlowBook {
  /** Its name in sentences. */
  readonly name: string;
  readonly title: string;
  readonly titleDirection?: "ltr" | "rtl" | "auto";
  readonly language: string;
  readonly direction: "ltr" | "rtl";
  /** Two pages or one, if the book says so. */
  readonly layout?: "spread" | "single";
  /** How it is covered, as `PageSource` has it. */
  readonly cover?: PageSource["cover"];
  /** Who made it, and the like. */
  readonly details?: readonly BookDetail[];
  readonly sections: readonly FlowSection[];
  readonly outline: readonly FlowOutline[];
  /** What cannot be shown, as far as it is known without its sections and contents. */
  readonly warnings?: readonly BookWarning[];
  /** What is read aloud of it, if anything is. */
  readonly narration?: FlowNarration;
  /** Whether the reader is asked before a link is followed out of the book. */
  readonly asksToLeave?: boolean;
  /** Returns where a link in a section leads within the book; null if it leads nowhere in it. */
  resolve(section: number, href: string): FlowTarget | null;
  /** Resolves to a sound or a film that a section names. Rejects with a `BookError`. */
  medium?(section: number, address: string): Promise<Blob>;
  /** Returns the book's own file. */
  file(): Promise<Blob>;
  close(): void;
}

/** Returns whether all pages of a book, but for its cover, are set for leaves of one size and turned. */
export function isAllText({ sections }: FlowBook): boolean {
  return sections.every(
    ({ isFixed, roll }, index) =>
      roll === undefined && (!isFixed || (index === 0 && sections.length > 1)),
  );
}
