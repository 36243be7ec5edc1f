import { cleanText } from "./book_text.ts";
import { limits } from "./limits.ts";
import { BookError } from "./page_source.ts";

/** Checks that every part of a manifest shares; what fails is told with its place. */

/** Whether `value` is an object with members. */
export function isRecord(value: unknown): value is Record<string, unknown> {
  return typeof value === "object" && value !== null && !Array.isArray(value);
}

/**
 * A member that is text, cleaned and of at most `most` characters; empty where it is absent.
 * @throws BookError where it is anything else
 */
export function textOf(
  fields: Record<string, unknown>,
  key: string,
  most: number,
  place: string,
): string {
  const value = fields[key];
  if (value === undefined || value === null) return "";
  if (typeof value !== "string") throw fault(place, `has a ${key} that is no text`, "quote it");
  return cleanText(value, most);
}

/**
 * A member that is a list of at most `most`; empty where it is absent.
 * @throws BookError where it is no list, or a longer one
 */
export function listOf(
  fields: Record<string, unknown>,
  key: string,
  most: number,
  place: string,
): readonly unknown[] {
  const value = fields[key];
  if (value === undefined || value === null) return [];
  if (!Array.isArray(value)) throw fault(place, `has a "${key}" that is no list`, "write [ ]");
  if (value.length > most) {
    throw fault(place, `has a "${key}" of ${value.length}`, `write at most ${most}`);
  }
  return value;
}

/** Whether `value` can be a page's width or height. */
export function isSide(value: unknown): value is number {
  return (
    typeof value === "number" && Number.isFinite(value) && value > 0 && value <= limits.pageSide
  );
}

/** The sentence that names the place, what is wrong there and what to do. */
export function fault(place: string, what: string, remedy: string): BookError {
  return new BookError(`${place} ${what}; ${remedy}.`);
}
