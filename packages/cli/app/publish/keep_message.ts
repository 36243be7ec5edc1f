/** What pages say to the service worker, and it to them. */

/** Addresses to keep: of a page that was visited, or of a whole book. */
export interface KeepMessage {
  readonly addresses: readonly string[];
  /** The book's id, if all of it is kept for good. */
  readonly book?: string;
}

/** How far keeping a book has come. */
export interface KeepProgress {
  readonly done: number;
  readonly of: number;
  /** Why it failed, in a sentence. */
  readonly failed?: string;
}
