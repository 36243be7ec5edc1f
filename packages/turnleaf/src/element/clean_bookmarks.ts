/** Validates bookmarks from any origin. */

const mostBookmarks = 500;
const highestPage = 1_000_000;

/** Returns valid bookmarks: whole page numbers from 1, each once, in order, at most 500. */
export function cleanBookmarks(value: unknown): readonly number[] {
  if (!Array.isArray(value)) return [];
  const pages = value.slice(0, 10_000).filter(isPage);
  return [...new Set(pages)].sort((a, b) => a - b).slice(0, mostBookmarks);
}

/** Returns whether a value is the number of a page. */
export function isPage(value: unknown): value is number {
  return Number.isInteger(value) && (value as number) >= 1 && (value as number) <= highestPage;
}
