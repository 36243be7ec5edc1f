/** The page number in the document's address: `#page=23`. */

const pattern = /(^#?|&)page=(\d{1,6})(?=&|$)/;

/**
 * Returns the page (from 1) that a fragment such as `#page=12` or
 * `#a=b&page=12` names; null if it names none.
 */
export function pageOfHash(hash: string): number | null {
  const page = Number(pattern.exec(hash)?.[2] ?? 0);
  return page >= 1 ? page : null;
}

/** Returns the fragment with another page in it; the rest stays. */
export function hashWithPage(hash: string, page: number): string {
  if (pattern.test(hash)) return hash.replace(pattern, `$1page=${page}`);
  return hash.length > 1 ? `${hash}&page=${page}` : `#page=${page}`;
}

/** Writes the page into the address, without a step in the history. */
export function writeAddress(page: number): void {
  const hash = hashWithPage(location.hash, page);
  if (hash === location.hash) return;
  try {
    history.replaceState(history.state, "", hash);
  } catch {
    // Browsers throw if it is called too often, and in a page without an address of its own.
  }
}
