/** The part of a book that finding a page needs. */
export interface Labelled {
  readonly pageCount: number;
  /** What a page (from 1) calls itself. */
  label(page: number): string;
}

/**
 * The page (from 1) that `text` names: by its label as printed, in whatever
 * case, else by its number; null where the book has none of the kind.
 */
export function findPage(book: Labelled, text: string): number | null {
  const wanted = text.trim().toLowerCase();
  if (wanted === "") return null;
  for (let page = 1; page <= book.pageCount; page++) {
    if (book.label(page).toLowerCase() === wanted) return page;
  }
  const page = Number(wanted);
  return Number.isInteger(page) && page >= 1 && page <= book.pageCount ? page : null;
}
