/** The options of printing, apart from its code, which is loaded on first use. */

/** Which pages are printed, and a callback for progress. */
export interface PrintOptions {
  /** First page, from 1. The default is the book's first. */
  readonly from?: number;
  /** Last page. The default is the book's last. */
  readonly to?: number;
  /** Aborts the drawing. */
  readonly signal?: AbortSignal;
  /** Called before a page (from 1) is drawn. */
  readonly onPage?: (page: number) => void;
}

/** Maximum of pages printed at once: each takes half a megabyte until it is printed. */
export const mostPrinted = 300;
