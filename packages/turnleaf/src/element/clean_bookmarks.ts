/** Bookmarks, whoever they come from. */

const mostBookmarks = 500;
const highestPage = 1_000_000;

/** Bookmarks as they are kept: whole page numbers from 1, each once, in order, at most 500. */
export function cleanBookmarks(value: unknown): readonly number[] {
  if (!Array.isArray(value)) return [];
  const pages = value.slice(0, 10_000).filter(isPage);
  return [...new Set(pages)].sort((a, b) => a - b).slice(0, mostBookmarks);
}

/** Whether something is the number of a page. */
export function isPage(value: unknown): value is number {
  return Number.isInteger(value) && (value as number) >= 1 && (value as number) <= highestPage;
}
