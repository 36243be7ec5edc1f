/**
 * The state of books kept in the browser's storage: page, zoom level,
 * bookmarks. Storage may be missing, full, or written by other code: what is
 * read is checked, and a failed write does not stop reading.
 */

import { cleanBookmarks, isPage } from "./clean_bookmarks.ts";

/** The state kept of a book. */
export interface SavedPlace {
  /** From 1. */
  readonly page: number;
  /** 1 to 8. */
  readonly zoom: number;
  /** Pages from 1, in order. */
  readonly bookmarks: readonly number[];
}

/** Everything is under one key, the last book read first. */
const key = "turnleaf";
const mostBooks = 100;
const longestName = 300;
const longestStore = 400_000;

/** Returns the state kept of the book of a name, or null. */
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

/** Keeps a book; the one read longest ago is dropped. */
export function savePlace(name: string, { page, zoom, bookmarks }: SavedPlace): void {
  const others = read().filter(([other]) => other !== short(name));
  const all = [[short(name), page, Math.round(zoom * 100) / 100, bookmarks], ...others];
  try {
    localStorage.setItem(key, JSON.stringify(all.slice(0, mostBooks)));
  } catch {
    // Full, or forbidden.
  }
}

/** Returns rows of name, page, zoom, bookmarks; only the name is checked. */
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
