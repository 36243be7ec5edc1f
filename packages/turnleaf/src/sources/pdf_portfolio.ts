/** Portfolios: PDFs that are a folder of files, of which their own pages say nothing. */

import type { PDFDocumentProxy } from "pdfjs-dist";
import { cleanText } from "./book_text.ts";
import { BookError } from "./page_source.ts";

/** Files that the sentence names at most, and characters of a name. */
const mostNamed = 3;
const longestName = 60;

/**
 * Rejects with a `BookError` that names files of a portfolio; resolves for
 * other PDFs, with files attached to them or without.
 *
 * @param info the document's information
 * @param name of the PDF in the sentence
 */
export async function rejectPortfolio(
  document: PDFDocumentProxy,
  info: Readonly<Record<string, unknown>>,
  name: string,
): Promise<void> {
  if (info.IsCollectionPresent !== true) return;
  const files = [...((await document.getAttachments().catch(() => null))?.values() ?? [])];
  if (files.length === 0) return;
  const names = files.slice(0, mostNamed).map(({ filename }) => cleanText(filename, longestName));
  const rest = files.length > names.length ? " and others" : "";
  throw new BookError(
    `${name} is a portfolio, which holds ${names.join(", ")}${rest}; save them by a program that shows portfolios, and open one.`,
    { code: "unsupported", source: name },
  );
}
