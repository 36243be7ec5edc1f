/** ComicBookInfo: JSON in the comment of a ZIP that says what the comic in it is. */

import { cleanLanguage, cleanText } from "../book_text.ts";
import { limits } from "../limits.ts";
import { isRecord } from "../manifest_checks.ts";
import { type ComicMetadata, comicTitle, noMetadata } from "./comic_metadata.ts";

/** Returns what a ComicBookInfo says; nothing of another comment. */
export function readComicBookInfo(comment: string): ComicMetadata {
  const info = infoIn(comment);
  if (info === null) return noMetadata;
  const text = (value: unknown): string =>
    cleanText(typeof value === "number" ? String(value) : value);
  const credits = (Array.isArray(info.credits) ? info.credits : []).filter(isRecord);
  const writers = credits.filter(({ role }) => role === "Writer");
  const names = (writers.length > 0 ? writers : credits).map(({ person }) => text(person));
  const language = text(info.language);
  return {
    ...noMetadata,
    title: comicTitle(text(info.series), text(info.issue), text(info.title)),
    authors: names.filter((name) => name !== "").slice(0, limits.authors),
    // Most name the language in English.
    language: /^[a-z]{2,3}(-|$)/i.test(language) ? cleanLanguage(language) : "",
  };
}

function infoIn(comment: string): Record<string, unknown> | null {
  try {
    const value: unknown = JSON.parse(comment);
    const info = isRecord(value) ? value["ComicBookInfo/1.0"] : null;
    return isRecord(info) ? info : null;
  } catch {
    return null;
  }
}
