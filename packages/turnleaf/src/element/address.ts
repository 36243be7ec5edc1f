/** The page in the page's own address: `#page=23`. */

const pattern = /(^#?|&)page=(\d{1,6})(?=&|$)/;

/** The page (from 1) that a fragment such as `#page=12` or `#a=b&page=12` names; null where it names none. */
export function pageOfHash(hash: string): number | null {
  const page = Number(pattern.exec(hash)?.[2] ?? 0);
  return page >= 1 ? page : null;
}

/** The fragment with another page in it; all else that it says stays. */
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
    // Browsers refuse what comes too often, and a page without an address of its own.
  }
}
