/** Why a PDF cannot be read, in sentences. */

import { nameAndMessage, unknownFailure } from "./failures.ts";
import { brokeOff, httpError } from "./fetch_bytes.ts";
import { BookError } from "./page_source.ts";
import type { PdfLibrary } from "./pdf_runtime.ts";
import { notStarted, WorkerNotStarted } from "./pdf_thread.ts";

/** The remedy for an error of the browser or the file, whichever it is. */
export const remedy = "update the browser, or get the file again";

/**
 * Returns the error with the sentence that explains why a document cannot be read.
 *
 * @param pdfWorker as of `PdfOptions`
 */
export function sentenceFor(
  pdfjs: PdfLibrary,
  error: unknown,
  name: string,
  pdfWorker?: string,
): BookError {
  if (error instanceof BookError) return error;
  if (error instanceof pdfjs.PasswordException) {
    return new BookError(
      `${name} is protected by a password; remove the password and open it again.`,
      { code: "locked", source: name },
    );
  }
  if (error instanceof pdfjs.ResponseException) return httpError(error.status, name);
  if (isUnreachable(error)) return brokeOff(name);
  if (error instanceof WorkerNotStarted) return notStarted(name, pdfWorker, error);
  if (isDamage(pdfjs, error)) {
    const sentence = `${name} is damaged or no PDF; repair the file or get it again.`;
    return new BookError(sentence, { code: "damaged", source: name, cause: error });
  }
  return unknownFailure(`${name} cannot be read`, error, remedy, { source: name });
}

/** Returns whether an error of pdf.js means that the file is damaged. */
export function isDamage(pdfjs: PdfLibrary, error: unknown): boolean {
  if (error instanceof pdfjs.InvalidPDFException) return true;
  // Errors of the worker come with their own name and message as `details`.
  return /^(FormatError|ParserEOFException|XRef\w+Exception|(Jpeg|Jpx|Jbig2|\w+Marker)Error)\b/.test(
    nameAndMessage(error),
  );
}

/** Returns whether an error is of the connection: each browser has its own message, and no code. */
export function isUnreachable(error: unknown): boolean {
  return /(failed to fetch|networkerror|load failed|network error)/i.test(nameAndMessage(error));
}
