/** Opens PDFs by pdf.js. */

import type { PDFDocumentProxy } from "pdfjs-dist";
import { cleanAddress, cleanLanguage, cleanText, decodeEscapes } from "./book_text.ts";
import { limits } from "./limits.ts";
import { type BookDetail, BookError, type PageSource } from "./page_source.ts";
import type { PdfInput } from "./pdf_bytes.ts";
import { sentenceFor, tooLarge } from "./pdf_failures.ts";
import { PdfFile, type PdfOptions } from "./pdf_file.ts";
import { rejectPortfolio } from "./pdf_portfolio.ts";
import { type PdfDescription, PdfSource } from "./pdf_source.ts";
import { PdfTargets } from "./pdf_targets.ts";
import { orAborted } from "./shared_tasks.ts";

export { preparePdf } from "./pdf_file.ts";

/** Bits of a protected file's permissions, as ISO 32000 numbers them. */
const permission = { print: 0x04, copy: 0x10 } as const;

/** Authors of a book that are shown. */
const mostAuthors = 50;
/**
 * Opens a PDF. Scripts in it never run, and nothing that it refers to is fetched.
 * Rejects with a `BookError`, or with the signal's reason when aborted.
 */
export async function openPdf(input: PdfInput, options: PdfOptions = {}): Promise<PageSource> {
  const { signal } = options;
  signal?.throwIfAborted();
  if ((input.length ?? 0) > limits.pdfBytes) throw tooLarge(input.name);
  const file = new PdfFile(input, options);
  const open = await file.open(signal);
  const { thread } = open;
  try {
    const opening = thread.orFailed(describe(open.document, input, options.fragment));
    const description = await (signal ? orAborted(opening, signal) : opening);
    const source = new PdfSource(file, open, description);
    await source.findCover(signal ?? new AbortController().signal);
    return source;
  } catch (error) {
    open.close();
    signal?.throwIfAborted();
    throw sentenceFor(thread.pdfjs, error, input.name, options.pdfWorker);
  }
}

/**
 * Returns the page at which a PDF should open, by a named destination of its address or by its own
 * setting; the first if neither is valid.
 */
async function openingPageOf(
  document: PDFDocumentProxy,
  targets: PdfTargets,
  fragment: string,
): Promise<number> {
  const bare = fragment.includes("=") ? null : decodeEscapes(fragment);
  const named = new URLSearchParams(fragment).get("nameddest") ?? bare;
  const there = named ? await targets.page(named) : null;
  const action = await document.getOpenAction();
  return there ?? (await targets.page(action?.get("dest"))) ?? 1;
}

/** Returns who wrote a PDF and by which rights it may be used, as far as it says so. */
function detailsOf(
  metadata: { get(name: string): unknown } | null | undefined,
  info: Record<string, unknown>,
): readonly BookDetail[] {
  const listOf = (value: unknown): readonly unknown[] => (Array.isArray(value) ? value : [value]);
  const texts = (value: unknown): string[] =>
    listOf(value)
      .slice(0, mostAuthors)
      .map((one) => cleanText(one))
      .filter((text) => text !== "");
  const creators = texts(metadata?.get("dc:creator"));
  const authors = creators.length > 0 ? creators : texts(info.Author);
  const href = cleanAddress(metadata?.get("xmprights:webstatement"));
  const rights = texts(metadata?.get("dc:rights"))[0] ?? href;
  return [
    ...authors.map((value) => ({ label: "Author", value })),
    ...(rights === ""
      ? []
      : [{ label: "Rights", value: rights, ...(href === "" ? {} : { href }) }]),
  ];
}

async function describe(
  document: PDFDocumentProxy,
  input: PdfInput,
  fragment = "",
): Promise<PdfDescription> {
  const count = document.numPages;
  if (count < 1)
    throw new BookError(`${input.name} has no pages; choose another file.`, {
      code: "empty",
      source: input.name,
    });
  if (count > limits.pages) {
    throw new BookError(
      `${input.name} has ${count} pages; split it into ones of at most ${limits.pages}.`,
      { code: "tooLarge", source: input.name },
    );
  }
  const targets = new PdfTargets(document);
  const [metadata, preferences, labels, openingPage, permissions] = await Promise.all([
    document.getMetadata().catch(() => null),
    document.getViewerPreferences().catch(() => null),
    document.getPageLabels().catch(() => null),
    openingPageOf(document, targets, fragment).catch(() => 1),
    document.getPermissions().catch(() => null),
  ]);
  const info = (metadata?.info ?? {}) as Record<string, unknown>;
  await rejectPortfolio(document, info, input.name);
  rejectXfa(info, input.name);
  return {
    name: input.name,
    pageCount: count,
    title: cleanText(metadata?.metadata?.get("dc:title")) || cleanText(info.Title) || input.name,
    language: cleanLanguage(info.Language),
    details: detailsOf(metadata?.metadata, info),
    direction: preferences?.get("Direction") === "R2L" ? "rtl" : "ltr",
    labels,
    openingPage,
    allows: {
      print: permissions?.has(permission.print) ?? true,
      copy: permissions?.has(permission.copy) ?? true,
    },
  };
}

/**
 * Throws a `BookError` for a form of XFA alone: its pages are made by Adobe's programs as they open it,
 * and what is in the file in their place asks to wait.
 */
function rejectXfa(info: Readonly<Record<string, unknown>>, name: string): void {
  if (info.IsXFAPresent !== true || info.IsAcroFormPresent === true) return;
  throw new BookError(
    `${name} is a form of XFA, whose pages only Adobe's programs make; print it to a PDF there, and open that.`,
    { code: "unsupported", source: name },
  );
}
