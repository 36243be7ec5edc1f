/** What may be asked of a printing. Apart from it, which is loaded when first asked for. */

/** Which pages are printed, and how it goes on. */
export interface PrintOptions {
  /** First page, from 1; the book's first where it is not given. */
  readonly from?: number;
  /** Last page; the book's last where it is not given. */
  readonly to?: number;
  /** Gives up what is not drawn yet. */
  readonly signal?: AbortSignal;
  /** Called before a page (from 1) is drawn. */
  readonly onPage?: (page: number) => void;
}

/** Most pages printed at once: each is half a megabyte until it is on paper. */
export const mostPrinted = 300;
