/** Errors that books of several formats have, and sentences for unforeseen ones. */

import { cleanText } from "./book_text.ts";
import { BookError, type BookErrorDetail } from "./page_source.ts";

/** Maximum of characters quoted from another library's message. */
const messageLength = 200;

/**
 * Returns an error's name and message, such as "TypeError: x is not a
 * function". An error that pdf.js passed on from its worker has both as
 * `details`.
 */
export function nameAndMessage(error: unknown): string {
  const { details } = Object(error) as { details?: unknown };
  return cleanText(typeof details === "string" ? details : String(error), messageLength);
}

/**
 * Returns the error of a book that is closed.
 *
 * @param name the book's name in sentences
 */
export function closedError(name: string): BookError {
  return new BookError(`${name} is closed; open it again.`, { code: "closed", source: name });
}

/**
 * Returns a `BookError` for an unforeseen error: it names the error, which is
 * its `cause`. A `BookError` is returned as it is.
 *
 * @param what what failed, such as "book.pdf cannot be read"
 * @param remedy what to do about it
 * @param detail what a program may ask of it
 */
export function unknownFailure(
  what: string,
  error: unknown,
  remedy: string,
  detail: BookErrorDetail = {},
): BookError {
  if (error instanceof BookError) return error;
  const sentence = `${what} (${nameAndMessage(error)}); ${remedy}.`;
  return new BookError(sentence, { ...detail, cause: error });
}
