/** Sentences for failures that nobody foresaw. */

import { cleanText } from "./book_text.ts";
import { BookError } from "./page_source.ts";

/** Most characters of another library's message that a sentence quotes. */
const messageLength = 200;

/**
 * An error's name and message, such as "TypeError: x is not a function". An error that pdf.js passed
 * on from its worker has both as `details`.
 */
export function nameAndMessage(error: unknown): string {
  const { details } = Object(error) as { details?: unknown };
  return cleanText(typeof details === "string" ? details : String(error), messageLength);
}

/**
 * A failure for which there is no sentence of its own: it names the error, which is its `cause`.
 * A `BookError` is returned as it is.
 *
 * @param what what failed, such as "book.pdf cannot be read"
 * @param remedy what to do about it
 */
export function unknownFailure(what: string, error: unknown, remedy: string): BookError {
  if (error instanceof BookError) return error;
  return new BookError(`${what} (${nameAndMessage(error)}); ${remedy}.`, { cause: error });
}
