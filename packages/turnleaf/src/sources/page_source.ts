/**
 * The contract between a book's file format and the viewer. A source knows
 * nothing of 3D, and the viewer knows nothing of file formats: this interface
 * is all that they have in common.
 */

/** A page's size in the source's own unit (points of a PDF, pixels of a scan). */
export interface PageSize {
  readonly width: number;
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
  readonly text: string;
  /** Radians, clockwise as seen: 0 runs to the right, pi / 2 down the page. */
  readonly angle: number;
  /** Whether a line ends with this run. */
  readonly end: boolean;
  /** Whether its letters stand below each other, as in vertical Japanese: `height` is then along the line. */
  readonly vertical?: boolean;
  /**
   * Where each of its letters (UTF-16 units) begins, as a fraction of the box's
   * width, if the source knows.
   */
  readonly places?: readonly number[];
}

/** The target of a link: a page (from 1) of this book, or an address of the web or of mail. */
export type LinkTarget = { readonly page: number } | { readonly href: string };

/** A link on a page; its box as that of a `TextRun`, never turned. */
export interface PageLink extends PageBox {
  /** Its title, may be empty. */
  readonly title: string;
  readonly to: LinkTarget;
}

/** A field of a form on a page; its box as that of a `TextRun`, never turned. */
export interface PageField extends PageBox {
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
  readonly multiline: boolean;
  readonly readonly: boolean;
  /** Maximum of characters of a text; 0 for no limit. */
  readonly maxLength: number;
}

/** A line of a book's contents. */
export interface OutlineEntry {
  /** Its title. */
  readonly title: string;
  /** The page that it leads to, from 1; null if it leads nowhere in this book. */
  readonly page: number | null;
  /** An address of the web that it leads to instead. */
  readonly href?: string;
  /** The lines beneath it. */
  readonly children: readonly OutlineEntry[];
}

/** A drawn page, ready to become a texture. `close` frees a bitmap's memory at once. */
export type PagePicture = ImageBitmap | HTMLCanvasElement;

/** A book's pages, drawn one by one on request. */
export interface PageSource {
  /** The book's title, or the file's name if it has none. */
  readonly title: string;
  /** BCP 47 language tag; empty if the source does not say. */
  readonly language: string;
  /** Reading direction, which decides the edge at which the book is bound. */
  readonly direction: "ltr" | "rtl";
  readonly pageCount: number;
  /** The page (from 1) at which the book should open, if it says so. */
  readonly openingPage?: number;
  /** Typeset pages keep paper shading to their own white; scans must not be brightened. */
  readonly kind: "typeset" | "scan";
  /** Size of page `index` (from 0). Rejects with a `BookError`. */
  size(index: number, signal?: AbortSignal): Promise<PageSize>;
  /** Returns the page's label, such as "iv" or "23"; its number from 1 if the source has none. */
  label(index: number): string;
  /**
   * Draws page `index` (from 0) so that it is `width` device pixels wide (never
   * beyond the source's own limits on memory). Rejects with a `BookError`, or
   * with the signal's reason when aborted.
   *
   * @param region the part of the page to draw, as fractions of its width and
   * height from its top left corner; `width` is then the region's. The default
   * is all of it.
   */
  draw(index: number, width: number, signal: AbortSignal, region?: PageBox): Promise<PagePicture>;
  /** What the book's owner permits. The default is everything. */
  readonly allows?: { readonly print: boolean; readonly copy: boolean };
  /**
   * Returns the text of page `index` (from 0) in reading order. Rejects as
   * `draw` does.
   *
   * @param exact whether the letters' places are wanted, which may take longer
   */
  text?(index: number, signal: AbortSignal, exact?: boolean): Promise<readonly TextRun[]>;
  /**
   * Returns a description of the pictures on page `index` (from 0), may be
   * empty. Rejects as `draw` does.
   */
  alt?(index: number, signal: AbortSignal): Promise<string>;
  /** Returns the links of page `index` (from 0). Rejects as `draw` does. */
  links?(index: number, signal: AbortSignal): Promise<readonly PageLink[]>;
  /** Returns the form fields of page `index` (from 0). Rejects as `draw` does. */
  fields?(index: number, signal: AbortSignal): Promise<readonly PageField[]>;
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
  /** Frees workers, files and memory. Drawing afterwards rejects. */
  close(): void;
}

/** An error whose message is one clear sentence that names the file and what to do. */
export class BookError extends Error {
  /** Distinguishes it from other errors. */
  override readonly name = "BookError";
}
