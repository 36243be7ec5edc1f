/**
 * What a book's pages come from. A source knows nothing of 3D, and the viewer
 * knows nothing of file formats: this interface is all that the two share.
 */

/** A page's size in the source's own unit (points of a PDF, pixels of a scan). */
export interface PageSize {
  readonly width: number;
  readonly height: number;
}

/** A rectangle of a page. Its unit is told where it is used. */
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
 * A piece of a page's text that lies on one straight line. The box is in the
 * unit of `size()`, from the page's top left corner, and as it is before it is
 * turned: x, y is the corner at which the line begins, at its upper side, and
 * what the box is turned about.
 */
export interface TextRun extends PageBox {
  readonly text: string;
  /** Clockwise as it is seen, radians: 0 runs to the right, pi / 2 down the page. */
  readonly angle: number;
  /** Whether a line ends with this run. */
  readonly end: boolean;
  /** Whether its letters stand below each other, as in vertical Japanese: `height` is then along the line. */
  readonly vertical?: boolean;
  /** Where each of its letters (UTF-16 units) begins, as a share of the box's width, where the source knows. */
  readonly places?: readonly number[];
}

/** Where a link leads: a page (from 1) of this book, or an address of the web or of mail. */
export type LinkTarget = { readonly page: number } | { readonly href: string };

/** A place on a page that leads elsewhere; its box as that of a `TextRun`, never turned. */
export interface PageLink extends PageBox {
  /** What it says of itself; empty where it says nothing. */
  readonly title: string;
  readonly to: LinkTarget;
}

/** A field of a form on a page; its box as that of a `TextRun`, never turned. */
export interface PageField extends PageBox {
  readonly kind: "text" | "check" | "radio" | "choice";
  /** Tells the fields of a book apart; buttons of one radio group share it, and so do views of one field. */
  readonly name: string;
  /** What the field asks for, in words. */
  readonly title: string;
  /** What it holds as the book comes; of a check or radio "" where it is off. */
  readonly value: string;
  /** What a check or radio holds when it is on; empty for others. */
  readonly on: string;
  /** What a choice offers; empty for others. */
  readonly options: readonly { readonly value: string; readonly label: string }[];
  readonly multiline: boolean;
  readonly readonly: boolean;
  /** Most characters of a text; 0 where it does not matter. */
  readonly maxLength: number;
}

/** A line of a book's contents. */
export interface OutlineEntry {
  /** What it says. */
  readonly title: string;
  /** The page that it leads to, from 1; null where it leads nowhere in this book. */
  readonly page: number | null;
  /** An address of the web that it leads to instead. */
  readonly href?: string;
  /** The lines beneath it. */
  readonly children: readonly OutlineEntry[];
}

/** A drawn page, ready to become a texture. `close` frees a bitmap's memory at once. */
export type PagePicture = ImageBitmap | HTMLCanvasElement;

/** A book's pages, drawn one by one when they are asked for. */
export interface PageSource {
  /** The book's title, or the file's name where it has none. */
  readonly title: string;
  /** BCP 47 language tag; empty when the source does not say. */
  readonly language: string;
  /** Side the book is bound on follows from the reading direction. */
  readonly direction: "ltr" | "rtl";
  readonly pageCount: number;
  /** The page (from 1) at which the book asks to be opened, where it does. */
  readonly openingPage?: number;
  /** Typeset pages keep paper shading to their own white; scans must not be brightened. */
  readonly kind: "typeset" | "scan";
  /** Size of page `index` (from 0). Rejects with a `BookError`. */
  size(index: number, signal?: AbortSignal): Promise<PageSize>;
  /** What the page calls itself: "iv", "23"; its number from 1 where the source does not say. */
  label(index: number): string;
  /**
   * Draws page `index` (from 0) so that it is `width` device pixels wide
   * (never beyond the source's own limits on memory).
   * Rejects with a `BookError`, or with the signal's reason when aborted.
   *
   * @param region what of the page is drawn, as shares of its width and height
   *   from its top left corner; `width` is then the region's. All of it where
   *   it is not given.
   */
  draw(index: number, width: number, signal: AbortSignal, region?: PageBox): Promise<PagePicture>;
  /** What the book's owner lets a reader do; all of it where it is not given. */
  readonly allows?: { readonly print: boolean; readonly copy: boolean };
  /**
   * The text of page `index` (from 0) in reading order. Rejects as `draw` does.
   *
   * @param exact whether the letters' places are wanted, which may take longer
   */
  text?(index: number, signal: AbortSignal, exact?: boolean): Promise<readonly TextRun[]>;
  /** What the pictures of page `index` (from 0) show, in words; empty where nobody says. Rejects as `draw` does. */
  alt?(index: number, signal: AbortSignal): Promise<string>;
  /** The links of page `index` (from 0). Rejects as `draw` does. */
  links?(index: number, signal: AbortSignal): Promise<readonly PageLink[]>;
  /** The form fields of page `index` (from 0). Rejects as `draw` does. */
  fields?(index: number, signal: AbortSignal): Promise<readonly PageField[]>;
  /** A field of page `index` (from 0) holds another value: it is drawn, and kept in `file()`, from now on. */
  fill?(index: number, name: string, value: string): void;
  /** The book's table of contents; empty where it has none. Rejects as `draw` does. */
  outline?(signal: AbortSignal): Promise<readonly OutlineEntry[]>;
  /** The book's own file, to be kept by the reader; absent where it is no one file. Rejects as `draw` does. */
  file?(): Promise<Blob>;
  /** Frees workers, files and memory. Drawing afterwards rejects. */
  close(): void;
}

/** A failure told in one clear sentence that names the file and what to do. */
export class BookError extends Error {
  /** Tells it from other errors. */
  override readonly name = "BookError";
}
