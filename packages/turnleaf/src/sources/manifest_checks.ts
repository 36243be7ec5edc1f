import { cleanText } from "./book_text.ts";
import { limits } from "./limits.ts";
import { BookError } from "./page_source.ts";

/** Checks used by every part of a manifest; errors name their place. */

/** Returns whether `value` is an object with members. */
export function isRecord(value: unknown): value is Record<string, unknown> {
  return typeof value === "object" && value !== null && !Array.isArray(value);
}

/**
 * Returns a member that is text, cleaned and of at most `most` characters;
 * empty if it is absent.
 *
 * @throws BookError if it is anything else
 */
export function textOf(
  fields: Record<string, unknown>,
  key: string,
  most: number,
  place: string,
): string {
  const value = fields[key];
  if (value === undefined || value === null) return "";
  if (typeof value !== "string")
    throw fault(place, `has ${withArticle(key)} that is no text`, "quote it");
  return cleanText(value, most);
}

/**
 * Returns a member that is a list of at most `most`; empty if it is absent.
 *
 * @throws BookError if it is not a list, or a longer one
 */
export function listOf(
  fields: Record<string, unknown>,
  key: string,
  most: number,
  place: string,
): readonly unknown[] {
  const value = fields[key];
  if (value === undefined || value === null) return [];
  if (!Array.isArray(value))
    throw fault(place, `has ${withArticle(key, `"${key}"`)} that is no list`, "write [ ]");
  if (value.length > most) {
    throw fault(
      place,
      `has ${withArticle(key, `"${key}"`)} of ${value.length}`,
      `write at most ${most}`,
    );
  }
  return value;
}

/** Returns a member's name as a sentence has it, behind its article. */
function withArticle(key: string, written: string = key): string {
  return `${/^[aeio]/.test(key) ? "an" : "a"} ${written}`;
}

/** Returns whether `value` can be a page's width or height. */
export function isSide(value: unknown): value is number {
  return (
    typeof value === "number" && Number.isFinite(value) && value > 0 && value <= limits.pageSide
  );
}

/** Returns the error that names the place, what is wrong there and what to do. */
export function fault(place: string, what: string, remedy: string): BookError {
  return new BookError(`${place} ${what}; ${remedy}.`, { code: "misused", source: place });
}
