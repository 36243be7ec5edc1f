/** Sentences of PDFs that cannot be opened, read or drawn. */

import { nameAndMessage, unknownFailure } from "./failures.ts";
import { brokeOff, httpError } from "./fetch_bytes.ts";
import { limits } from "./limits.ts";
import { BookError, type BookErrorDetail } from "./page_source.ts";
import type { PdfLibrary } from "./pdf_runtime.ts";
import { notStarted, WorkerNotStarted, WorkerStalled } from "./pdf_thread.ts";

/** Returns the error for a file of more bytes than a PDF may have. */
export function tooLarge(name: string): BookError {
  return new BookError(
    `${name} is larger than ${Math.floor(limits.pdfBytes / 1e6)} MB; split it and open a part.`,
    { code: "tooLarge", source: name },
  );
}

/** The remedy for an error of the browser or the file, whichever it is. */
export const remedy = "update the browser, or get the file again";

/** Returns the sentence that explains why a document cannot be read. */
export function sentenceFor(
  pdfjs: PdfLibrary,
  error: unknown,
  name: string,
  pdfWorker?: string,
): BookError {
  if (error instanceof BookError) return error;
  if (isTooMuch(error)) return takesTooMuch(name, "a book", { source: name });
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

/**
 * Returns whether an error means that something takes more than it may: its time, its steps, or more of the
 * stack or of memory than the worker has, of which each browser has its own message.
 */
export function isTooMuch(error: unknown): boolean {
  const isSpent =
    /call stack size|too much recursion|out of memory|buffer allocation|invalid array length/i;
  return error instanceof WorkerStalled || isSpent.test(nameAndMessage(error));
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

/**
 * Returns the error for what takes more than it may.
 *
 * @param what what takes it, such as "Page 3 of a.pdf"
 * @param than what it is, such as "a page"
 * @param detail what a program may ask of it
 */
export function takesTooMuch(what: string, than: string, detail: BookErrorDetail): BookError {
  return new BookError(`${what} takes more time or memory than ${than} may; make it simpler.`, {
    ...detail,
    code: "tooLarge",
  });
}
