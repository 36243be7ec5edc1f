/**
 * What is kept of books in the browser's storage: where each was left, how near
 * it was seen, what was bookmarked. Storage may be missing, full, or written by
 * somebody else: what comes out of it is checked, and what does not go in is no
 * reason to stop reading.
 */

import { cleanBookmarks, isPage } from "./clean_bookmarks.ts";

/** What is kept of a book. */
export interface SavedPlace {
  /** From 1. */
  readonly page: number;
  /** 1 to 8. */
  readonly zoom: number;
  /** Pages from 1, in order. */
  readonly bookmarks: readonly number[];
}

/** Everything lies under one name, the book read last at its head. */
const key = "turnleaf";
const mostBooks = 100;
const longestName = 300;
const longestStore = 400_000;

/** What is kept of the book of a name, or null. */
export function loadPlace(name: string): SavedPlace | null {
  const found = read().find(([other]) => other === short(name));
  if (found === undefined) return null;
  const [, page, zoom, bookmarks] = found;
  return {
    page: isPage(page) ? page : 1,
    zoom: typeof zoom === "number" && zoom >= 1 && zoom <= 8 ? zoom : 1,
    bookmarks: cleanBookmarks(bookmarks),
  };
}

/** Keeps a book; the one that was read longest ago gives way. */
export function savePlace(name: string, { page, zoom, bookmarks }: SavedPlace): void {
  const others = read().filter(([other]) => other !== short(name));
  const all = [[short(name), page, Math.round(zoom * 100) / 100, bookmarks], ...others];
  try {
    localStorage.setItem(key, JSON.stringify(all.slice(0, mostBooks)));
  } catch {
    // Full, or forbidden.
  }
}

/** Rows of name, page, zoom, bookmarks; only the name is checked. */
function read(): [string, ...unknown[]][] {
  try {
    const text = localStorage.getItem(key) ?? "";
    const rows: unknown = text.length > longestStore ? [] : JSON.parse(text);
    if (!Array.isArray(rows)) return [];
    return rows
      .slice(0, mostBooks)
      .filter((row) => Array.isArray(row) && typeof row[0] === "string" && row.length === 4);
  } catch {
    return [];
  }
}

const short = (name: string): string => name.slice(0, longestName);
