/**
 * What a book's pages come from. A source knows nothing of 3D, and the viewer
 * knows nothing of file formats: this interface is all that the two share.
 */

/** A page's size in the source's own unit (points of a PDF, pixels of a scan). */
export interface PageSize {
  readonly width: number;
  readonly height: number;
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
   */
  draw(index: number, width: number, signal: AbortSignal): Promise<PagePicture>;
  /** Frees workers, files and memory. Drawing afterwards rejects. */
  close(): void;
}

/** A failure told in one clear sentence that names the file and what to do. */
export class BookError extends Error {
  override readonly name = "BookError";
}
