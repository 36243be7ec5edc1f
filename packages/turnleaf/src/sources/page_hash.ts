/** The page that the fragment of an address names. */

/** Where a fragment names a page. */
export const pageInHash: RegExp = /(^#?|&)page=(\d{1,6})(?=&|$)/;

/**
 * Returns the page (from 1) that a fragment such as `#page=12` or
 * `#a=b&page=12` names; null if it names none.
 */
export function pageOfHash(hash: string): number | null {
  const page = Number(pageInHash.exec(hash)?.[2] ?? 0);
  return page >= 1 ? page : null;
}
