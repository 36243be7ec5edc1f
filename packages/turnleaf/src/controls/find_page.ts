/** The part of a book that finding a page needs. */
export interface LabelledBook {
  readonly pageCount: number;
  /** Returns the label of a page (from 1). */
  label(page: number): string;
}

/**
 * Returns the page (from 1) that `text` names: by its label as printed,
 * ignoring case, otherwise by its number; null if there is none.
 */
export function findPage(book: LabelledBook, text: string): number | null {
  const wanted = text.trim().toLowerCase();
  if (wanted === "") return null;
  for (let page = 1; page <= book.pageCount; page++) {
    if (book.label(page).toLowerCase() === wanted) return page;
  }
  const page = Number(wanted);
  return Number.isInteger(page) && page >= 1 && page <= book.pageCount ? page : null;
}
