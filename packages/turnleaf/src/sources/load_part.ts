/** Loads parts of the viewer when they are first needed. */

import { unknownFailure } from "./failures.ts";
import { BookError } from "./page_source.ts";

/**
 * Returns what a lazy import resolves to. Rejects with a `BookError` if the
 * file cannot be fetched, or its code fails in this browser; the error is its
 * `cause`.
 */
export async function loadPart<Part>(part: Promise<Part>): Promise<Part> {
  try {
    return await part;
  } catch (error) {
    // Browsers tell the two apart only by their messages, which all speak of fetching or importing.
    const isFetching =
      error instanceof TypeError && /fetch|import(ed|ing)|^load failed/i.test(error.message);
    const remedy = "update the browser, or load the web page again";
    if (!isFetching) throw unknownFailure("A part of the reader failed", error, remedy);
    const sentence = "A part of the reader could not be loaded; load the web page again.";
    throw new BookError(sentence, { code: "partMissing", cause: error });
  }
}
