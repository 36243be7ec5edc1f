/**
 * The contract between a book's file format and the viewer. A source knows
 * nothing of 3D, and the viewer knows nothing of file formats: this interface
 * is all that they have in common.
 */

import type { PageColours } from "../themes.ts";

/** A page's size in the source's own unit (points of a PDF, pixels of a scan). */
export interface PageSize {
  /** How wide it is. */
  readonly width: number;
  /** How high it is. */
  readonly height: number;
}

/** A rectangle of a page. Its unit is given where it is used. */
export interface PageBox {
  /** From the page's left edge. */
  readonly x: number;
  /** From its upper edge. */
  readonly y: number;
  /** How wide it is. */
  readonly width: number;
  /** How high it is. */
  readonly height: number;
}

/**
 * A piece of a page's text on one straight line. The box is in the unit of
 * `size()`, from the page's top left corner, before its rotation: x, y is the
 * corner at which the line begins, at its upper side, and the centre of the
 * rotation.
 */
export interface TextRun extends PageBox {
  /** Its characters. */
  readonly text: string;
  /** Radians, clockwise as seen: 0 runs to the right, pi / 2 down the page. */
  readonly angle: number;
  /** Whether a line ends with this run. */
  readonly end: boolean;
  /**
   * Whether the paragraph goes on after that end, on this page or on the next one; the end is then no part of
   * the text: what is copied has a space there, or nothing within a word. The default is false.
   */
  readonly wraps?: boolean;
  /** The rest of its last word, if that goes on on the next page: screen readers hear the word here, whole. The default is none. */
  readonly wordEnd?: string;
  /** How many of its first characters are the end of a word that begins on the page before. The default is 0. */
  readonly wordEndLength?: number;
  /** The level of the heading in which it stands, 1 to 6, for screen readers. The default is none. */
  readonly heading?: number;
  /** Whether that heading goes on in the next run, on this page or on the next one. The default is false. */
  readonly headingGoesOn?: boolean;
  /** Whether its letters stand below each other, as in vertical Japanese: `height` is then along the line. */
  readonly vertical?: boolean;
  /**
   * Where each of its letters (UTF-16 units) begins, as a fraction of the box's
   * width, if the source knows.
   */
  readonly places?: readonly number[];
  /**
   * The formula that it is, as MathML, which is read aloud by screen readers in place of `text`: this
   * is what is copied and searched, TeX or its signs on one line. The default is none.
   */
  readonly math?: string;
}

/**
 * The target of a link: a page (from 1) of this book, or an address of the web or of mail. `top` is
 * how far down its page it lies, as a fraction of the page's height from its head; less than 0 if
 * it begins on the page before. A page that is scrolled is scrolled there. The default is 0.
 */
export type LinkTarget =
  | { readonly page: number; readonly top?: number }
  | { readonly href: string };

/** A link on a page; its box as that of a `TextRun`, never turned. */
export interface PageLink extends PageBox {
  /** Its title, may be empty. */
  readonly title: string;
  /** Where it leads. */
  readonly to: LinkTarget;
  /** The text of the note to which it leads, if it is one: shown over the page, a line for each paragraph. */
  readonly note?: string;
  /** Whether the reader is asked before it is followed out of the book. The default is false. */
  readonly asks?: boolean;
}

/** A field of a form on a page; its box as that of a `TextRun`, never turned. */
export interface PageField extends PageBox {
  /** What is filled in: text, a box to tick, one of several buttons, a choice from a list. */
  readonly kind: "text" | "check" | "radio" | "choice";
  /**
   * Identifies the field in its book; buttons of one radio group have the same
   * name, and so do views of one field.
   */
  readonly name: string;
  /** The field's label. */
  readonly title: string;
  /** Its value when the book opens; "" for a check or radio that is off. */
  readonly value: string;
  /** The value of a check or radio when it is on; empty for others. */
  readonly on: string;
  /** The options of a choice; empty for others. */
  readonly options: readonly { readonly value: string; readonly label: string }[];
  /** Whether its text may have several lines. */
  readonly multiline: boolean;
  /** Whether the reader cannot change it. */
  readonly readonly: boolean;
  /** Maximum of characters of a text; 0 for no limit. */
  readonly maxLength: number;
}

/** A sound or a film on a page; its box as that of a `TextRun`, never turned. */
export interface PageMedium extends PageBox {
  /** Which of the two it is. */
  readonly kind: "audio" | "video";
  /** Its title, or the name of its file. */
  readonly title: string;
  /** Resolves to its file. Rejects with a `BookError`. */
  load(): Promise<Blob>;
}

/** A line of a book's contents. */
export interface OutlineEntry {
  /** Its title. */
  readonly title: string;
  /** The page that it leads to, from 1; null if it leads nowhere in this book. */
  readonly page: number | null;
  /** How far down that page, as `top` of `LinkTarget`; the default is its head. */
  readonly top?: number;
  /** An address of the web that it leads to instead. */
  readonly href?: string;
  /** The lines beneath it. */
  readonly children: readonly OutlineEntry[];
}

/**
 * Returns where a page (from 0) lies after a change of the pages; null if that
 * page, as it was drawn, is no longer there.
 */
export interface NewIndex {
  (index: number): number | null;
  /**
   * Returns the page that now has what stood on a page (from 0): a reader who
   * was at the one is at the other. The default is where that page lies, or the
   * one after the page before it.
   */
  readonly placeOf?: (index: number) => number;
}

/** Returns the page (from 0) that has the place of page `index` after a change. */
export function placeOf(moved: NewIndex, index: number): number {
  if (moved.placeOf) return moved.placeOf(index);
  for (let before = index; before >= 0; before--) {
    const now = moved(before);
    if (now !== null) return before === index ? now : now + 1;
  }
  return 0;
}

/** A font for a canvas, but for its size. */
export interface TitleFont {
  /** Style, caps and weight, as CSS has them in `font` before the size. */
  readonly style: string;
  /** CSS font families, those of the book's own files loaded in the page. */
  readonly family: string;
}

/** A line about a book that its owner wants to be shown, such as its licence. */
export interface BookDetail {
  /** What it is, such as "Rights"; may be empty. */
  readonly label: string;
  /** Its text. */
  readonly value: string;
  /** The direction in which it is written. The default is that of its first letter. */
  readonly direction?: "ltr" | "rtl";
  /** An address of the web with more about it. */
  readonly href?: string;
}

/** A drawn page, ready to become a texture. `close` frees a bitmap's memory at once. */
export type PagePicture = ImageBitmap | HTMLCanvasElement;

/** How the reader wants flowing text set. */
export interface Typography {
  /**
   * The typeface of text: one of the browser's, Atkinson Hyperlegible (`legible`), OpenDyslexic
   * (`dyslexic`); "" for the book's own.
   */
  readonly font: "" | "serif" | "sans-serif" | "legible" | "dyslexic";
  /** The size of everything, as a factor of the book's own: 0.5 to 3. */
  readonly size: number;
  /** The distance of lines as a factor of the type's size, 1 to 3; 0 for the book's own. */
  readonly lineHeight: number;
  /** The width of the margins, as a factor of the usual ones: 0 to 2. */
  readonly margins: number;
  /** Whether lines of text are of one length; "" for the book's own. */
  readonly align: "" | "justify" | "start";
  /** Whether words are divided at the ends of lines; "" for the book's own. */
  readonly hyphens: "" | "auto" | "none";
  /** Space that is added between letters, in units of the type's size: 0 to 1. */
  readonly letterSpacing: number;
  /** Space that is added between words, likewise. */
  readonly wordSpacing: number;
  /**
   * How wide a page is shown, CSS pixels, for which it is set: 16 px of type are 16 px on the screen.
   * 0 if that is unknown.
   */
  readonly width: number;
  /** How high it is shown then. The default, 0, is in a paperback's proportions. */
  readonly height?: number;
}

export type { PageColours };

/** A passage that is read aloud: some text of a book, and the part of a recording that is its sound. */
export interface NarratedClip {
  /** The pages (from 0) on which the text stands, in order. */
  readonly pages: readonly {
    readonly page: number;
    /** The fraction of the text that stands before that page: 0 for the first. */
    readonly from: number;
  }[];
  /** The text, which is spoken where there is no recording. */
  readonly text: string;
  /** The recording, the same object for each of its clips; null if there is none. */
  readonly recording: Blob | null;
  /** Where in the recording the clip begins, seconds. */
  readonly begin: number;
  /** Where it ends, seconds: infinite, or beyond the recording's end, for all that is left. */
  readonly end: number;
}

/** What is read aloud of a book: clips in order, numbered from 0. */
export interface Narration {
  /**
   * Resolves to the number of the first clip that is read on page `index` (from
   * 0) or after it; null if there is none. Rejects as `draw` does.
   */
  clipFrom(index: number, signal: AbortSignal): Promise<number | null>;
  /** Resolves to a clip; null after the last. Rejects as `draw` does. */
  clip(number: number, signal: AbortSignal): Promise<NarratedClip | null>;
  /**
   * Marks the text of a clip on its pages as the one that is read now, in place
   * of the one before; null removes the mark. Pages that look otherwise are
   * reported to `watchDrawings`' listener.
   */
  mark(number: number | null): void;
}

/** A page of a book whose text is gone through, whatever number it has meanwhile. */
export interface TextPage {
  /** What identifies its text: the same for the same text. */
  readonly key: unknown;
  /** Returns where its text lies now (from 0); null if the book has it no longer. */
  index(): number | null;
  /** Returns its text. Rejects as `draw` does. */
  text(signal: AbortSignal): Promise<readonly TextRun[]>;
}

/** A book's pages, drawn one by one on request. */
export interface PageSource {
  /** The book's title, or the file's name if it has none. */
  readonly title: string;
  /** The direction in which the title is written. The default, `auto`, is that of its first letter. */
  readonly titleDirection?: "ltr" | "rtl" | "auto";
  /** BCP 47 language tag; empty if the source does not say. */
  readonly language: string;
  /** Reading direction, which decides the edge at which the book is bound. */
  readonly direction: "ltr" | "rtl";
  /** At least 1. It changes only within a call of a function given to `watchPages`' listener. */
  readonly pageCount: number;
  /** Whether `pageCount` is an estimate until all pages are counted. The default is false. */
  readonly isEstimated?: boolean;
  /** Whether that is only a guess by the size of the file, which readers are not shown. The default is false. */
  readonly isGuessed?: boolean;
  /** The page (from 1) at which the book should open, if it says so. */
  readonly openingPage?: number;
  /** The edge at which the book is bound. The default is decided by `direction`. */
  readonly edge?: "left" | "right" | "top" | "bottom";
  /** Two pages or one, if the book says so. The default is decided by the available space. */
  readonly layout?: "spread" | "single";
  /**
   * Returns whether two pages may be shown side by side, by what can be read on them. The default is yes.
   *
   * @param width of each on the screen then, CSS pixels
   * @param alone width of a page that is shown alone, likewise
   */
  mayFace?(width: number, alone: number): boolean;
  /**
   * The size of the book's leaves, in the unit of `size`, if all pages are set for a leaf of one size. It
   * changes only as `pageCount` does. The default is the size of an inner page.
   */
  readonly leaf?: PageSize | undefined;
  /** What `leaf` is where no place asks for another. The default is the size of the leaves as they are. */
  readonly usualLeaf?: PageSize | undefined;
  /** What the book's owner wants to be shown of it: rights, a required statement. */
  readonly details?: readonly BookDetail[];
  /**
   * How the book is covered: its first page is the `picture` of the front board, and nothing else lies
   * on the boards; it has no picture, and its boards are `stamped` with its title and authors; it is a
   * document that has no boards (`none`). The default is that pages lie on the boards too, as in a
   * scan of a whole book.
   */
  readonly cover?: "picture" | "stamped" | "none" | undefined;
  /** The face of its titles, in which they are stamped on boards. The default is the one of usual text. */
  readonly titleFont?: TitleFont | undefined;
  /** Who wrote the book, as a cover names them. The default is nobody. */
  readonly authors?: readonly string[] | undefined;
  /** Typeset pages keep paper shading to their own white; scans must not be brightened. */
  readonly kind: "typeset" | "scan";
  /** Size of page `index` (from 0). Rejects with a `BookError`. */
  size(index: number, signal?: AbortSignal): Promise<PageSize>;
  /**
   * Returns how wide a page of a size is on paper, metres: leaves move as those of a book of that
   * size. Undefined, as if absent, if the book does not say.
   */
  widthInMetres?(size: PageSize): number | undefined;
  /** Returns the page's label, such as "iv" or "23"; its number from 1 if the source has none. */
  label(index: number): string;
  /**
   * Returns where in a spread page `index` (from 0) has to lie, in the order of
   * reading: on its first or second side, on a leaf of its own ("alone"), or
   * with nothing beside it ("single"). Sides around it are left blank if
   * necessary. The default is the side after the page before. A picture across a
   * spread is two pages, "first" and "second". While a page that is "single" lies
   * open, the book shows it by itself in the middle, unless the reader or the web
   * page has asked for spreads.
   */
  inSpread?(index: number): "first" | "second" | "alone" | "single" | undefined;
  /**
   * Returns the roll to which page `index` (from 0) belongs; null for a page that
   * is turned. Pages of one roll that follow each other hang together without a
   * gap, and are scrolled. Absent if all pages are turned.
   */
  roll?(index: number): number | null;
  /**
   * Draws page `index` (from 0) so that it is `width` device pixels wide (never
   * beyond the source's own limits on memory). Rejects with a `BookError`, or
   * with the signal's reason when aborted.
   *
   * @param region the part of the page to draw, as fractions of its width and
   * height from its top left corner; `width` is then the region's. The default
   * is all of it.
   * @param colours those of paper and print; the default is the page's own. Only pages whose
   * `colouring` is `text` have to heed them.
   */
  draw(
    index: number,
    width: number,
    signal: AbortSignal,
    region?: PageBox,
    colours?: PageColours | null,
  ): Promise<PagePicture>;
  /**
   * Returns what page `index` (from 0) is in other colours: `text` that `draw` sets in them, ink on
   * paper (`print`), or a `picture`, whose colours are its own. The default is print if the book is
   * typeset, and a picture if it is scanned.
   */
  colouring?(index: number): "text" | "print" | "picture";
  /** What the book's owner permits. The default is everything. */
  readonly allows?: { readonly print: boolean; readonly copy: boolean };
  /**
   * Returns the text of page `index` (from 0) in reading order. Rejects as
   * `draw` does.
   *
   * @param exact whether the letters' places are wanted, headings, words that go on on another page, and where
   * paragraphs go on (`wraps`, which the page's last run has always), which may take longer
   */
  text?(index: number, signal: AbortSignal, exact?: boolean): Promise<readonly TextRun[]>;
  /**
   * Goes through the text of the whole book in reading order, each page once, however pages are
   * counted anew meanwhile. The default is page after page. Rejects as `draw` does.
   */
  textPages?(signal: AbortSignal): AsyncIterable<TextPage>;
  /**
   * Returns a description of the pictures on page `index` (from 0), may be
   * empty. Rejects as `draw` does.
   */
  alt?(index: number, signal: AbortSignal): Promise<string>;
  /** Returns the links of page `index` (from 0). Rejects as `draw` does. */
  links?(index: number, signal: AbortSignal): Promise<readonly PageLink[]>;
  /** Returns the form fields of page `index` (from 0). Rejects as `draw` does. */
  fields?(index: number, signal: AbortSignal): Promise<readonly PageField[]>;
  /** Returns the sounds and films of page `index` (from 0). Rejects as `draw` does. */
  media?(index: number, signal: AbortSignal): Promise<readonly PageMedium[]>;
  /**
   * Sets the value of a field of page `index` (from 0): it is drawn, and kept
   * in `file()`, from now on.
   */
  fill?(index: number, name: string, value: string): void;
  /** Returns the book's table of contents, may be empty. Rejects as `draw` does. */
  outline?(signal: AbortSignal): Promise<readonly OutlineEntry[]>;
  /**
   * Returns the book's own file, for the reader to keep; absent if it is not a
   * single file. Rejects as `draw` does.
   */
  file?(): Promise<Blob>;
  /**
   * Sets the book's text anew; the change of its pages is reported to
   * `watchPages`' listener. Absent if its pages are as they are. Rejects with a
   * `BookError`.
   */
  typeset?(typography: Typography): Promise<void>;
  /**
   * Returns an anchor of the text with which page `index` (from 0) begins: it
   * finds that text again in whatever size it is set, also after the book has
   * been opened anew. Absent if pages are as they are.
   */
  anchor?(index: number): string;
  /**
   * Resolves to the pages (from 0) on which anchors lie, null for one that is
   * none of this book. Before `watchPages` the pages may be counted anew by it.
   */
  findAnchors?(anchors: readonly string[]): Promise<readonly (number | null)[]>;
  /**
   * The numbers of pages as text, to be kept with what `anchor` returns; undefined until they are counted.
   * Absent if pages are never estimated.
   */
  readonly keptCounts?: string | undefined;
  /**
   * Takes the numbers of pages that were kept when the book was open before, ahead of `findAnchors`: set
   * alike, it has as many from the beginning. What is of another book, or of text set otherwise, is ignored.
   */
  expectCounts?(kept: string): void;
  /**
   * Resolves once all pages are counted and nothing of `pageCount` is estimated, for a program that
   * reads the pages itself: without a listener of `watchPages` the pages are renumbered by then.
   * Rejects as `draw` does. Absent if pages are never estimated.
   */
  settle?(signal?: AbortSignal): Promise<void>;
  /**
   * Has page `index` (from 0) lie on a side of its spread from the next change of the pages on, however
   * many are counted before it then: a side may be left blank before its chapter.
   */
  keepSide?(index: number, side: "first" | "second"): void;
  /**
   * Says which pages (from 0) lie open, the first one first, whenever others do and before each change of
   * the pages: what stands at the head of each stays in sight, however often pages are set and counted anew.
   */
  keepOpen?(indices: readonly number[]): void;
  /**
   * Sets the listener for changes of the pages: text that is set in another
   * size, a length that was estimated. The source keeps its old pages until the
   * viewer, once the book lies still, calls `change`, which makes the change and
   * returns where pages lie now. A change that is due already is reported at
   * once.
   */
  watchPages?(listener: (change: () => NewIndex) => void): void;
  /**
   * Returns the element that page `index` (from 0) is: it is laid over its page
   * while no leaf is in flight, and `draw` draws it as it looks then. The
   * default is none: a page is its drawing.
   */
  element?(index: number): HTMLElement | null;
  /**
   * Sets the listener for pages (from 0) that look otherwise than they were
   * drawn, with all else as it was.
   */
  watchDrawings?(listener: (index: number) => void): void;
  /** Has page `index` (from 0) drawn as it looks now, though no change has been reported to the source. */
  outdate?(index: number): void;
  /**
   * Sets the listener for sizes that had to be guessed, as of elements that were hidden, and are
   * known now. Sizes that are known already are reported at once.
   */
  watchSizes?(listener: () => void): void;
  /** What is read aloud of the book; absent if nothing is. */
  readonly narration?: Narration;
  /**
   * What the book lists and cannot be shown, as far as it is known by now: at most 200 entries. A
   * page that cannot be drawn need not be among them. The default is none.
   */
  readonly warnings?: readonly BookWarning[];
  /** Sets the listener for entries that are added to `warnings`. */
  watchWarnings?(listener: () => void): void;
  /** Frees workers, files and memory. Drawing afterwards rejects. */
  close(): void;
}

/**
 * What a book lists and cannot be shown: a mark upon a page or a layer of text (`annotation`), a
 * `chapter`, a line of its `contents`, what is `embedded` in a page from elsewhere, a `font`, an
 * `image`, a sound or a film (`medium`), the text of a `note`, a `page`, a `style` sheet.
 */
export type BookWarningCode =
  | "annotation"
  | "chapter"
  | "contents"
  | "embedded"
  | "font"
  | "image"
  | "link"
  | "medium"
  | "note"
  | "page"
  | "style";

/** What a book lists and cannot be shown. */
export interface BookWarning {
  /** What it is. */
  readonly code: BookWarningCode;
  /** One sentence that says so, in English. */
  readonly message: string;
  /** The file, address, name or title that it is about, as the book has it. */
  readonly source?: string;
  /** The page on which it would be shown, from 1, if that is known. */
  readonly page?: number;
  /** What stands in its place, if it is a page. */
  readonly error?: BookError;
}

/**
 * What kind of error a `BookError` is: nothing is there (`absent`), it may not be read
 * (`forbidden`), the server failed otherwise (`server`), it could not be reached
 * (`unreachable`); the file is no longer there (`gone`), `damaged`, `empty`, `tooLarge`, of an
 * `unsupported` format, `locked` by a password, `copyProtected`; the browser did not start a script
 * (`blocked`), a part of the viewer is missing (`partMissing`), nothing can be heard (`silent`);
 * the book is `closed`, it has `noPage` of that number, something was given that cannot be used
 * (`misused`); or another, `failed`.
 */
export type BookErrorCode =
  | "absent"
  | "blocked"
  | "closed"
  | "copyProtected"
  | "damaged"
  | "empty"
  | "failed"
  | "forbidden"
  | "gone"
  | "locked"
  | "misused"
  | "noPage"
  | "partMissing"
  | "server"
  | "silent"
  | "tooLarge"
  | "unreachable"
  | "unsupported";

/** What a program may ask of an error. */
export interface BookErrorDetail {
  /** What kind of error it is; the default is "failed". */
  readonly code?: BookErrorCode;
  /** What the server responded, such as 404. */
  readonly status?: number;
  /** The page that it is about, from 1. */
  readonly page?: number;
  /** The book, file or address that it is about, as sentences name it. */
  readonly source?: string;
}

/** An error whose message is one clear sentence, in English, that names the file and what to do. */
export class BookError extends Error {
  /** Distinguishes it from other errors. */
  override readonly name = "BookError";
  /** What kind of error it is. */
  readonly code: BookErrorCode;
  /** What the server responded, such as 404, if that is the error. */
  readonly status: number | undefined;
  /** The page that it is about, from 1, if it is about one. */
  readonly page: number | undefined;
  /** The book, file or address that it is about, as its sentence names it, if that is known. */
  readonly source: string | undefined;

  /**
   * @param message the sentence
   *
   * @param detail what a program may ask, and the error's `cause`
   */
  constructor(message: string, detail: BookErrorDetail & ErrorOptions = {}) {
    super(message, "cause" in detail ? { cause: detail.cause } : undefined);
    this.code = detail.code ?? "failed";
    this.status = detail.status;
    this.page = detail.page;
    this.source = detail.source;
  }
}
