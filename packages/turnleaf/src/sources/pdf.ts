/** Opens PDFs by pdf.js. */

import type { PDFDocumentLoadingTask, PDFDocumentProxy } from "pdfjs-dist";
import { cleanAddress, cleanLanguage, cleanText, decodeEscapes } from "./book_text.ts";
import { unknownFailure } from "./failures.ts";
import { limits } from "./limits.ts";
import { type BookDetail, BookError, type PageSource } from "./page_source.ts";
import { PdfForm } from "./pdf_annotations.ts";
import { type PdfInput, place } from "./pdf_bytes.ts";
import { remedy, sentenceFor } from "./pdf_failures.ts";
import { rejectPortfolio } from "./pdf_portfolio.ts";
import {
  blobWorker,
  loadPdfLibrary,
  PackedDataFactory,
  rendererAddress,
  useRenderer,
} from "./pdf_runtime.ts";
import { type PdfDescription, PdfSource } from "./pdf_source.ts";
import { PdfTargets } from "./pdf_targets.ts";
import { notStarted, PdfThread, WorkerNotStarted } from "./pdf_thread.ts";
import { orAborted } from "./shared_tasks.ts";

/** Bits of a protected file's permissions, as ISO 32000 numbers them. */
const permission = { print: 0x04, copy: 0x10 } as const;

export interface PdfOptions {
  /** Absolute address of this package's pdf-worker.js, for pages whose security policy forbids blob workers. */
  readonly pdfWorker?: string | undefined;
  /** The password of a protected file. */
  readonly password?: string | undefined;
  /**
   * Returns the password of a protected file, or null to give up.
   *
   * @param isWrong whether one was given that is not the file's
   */
  readonly askPassword?: (isWrong: boolean) => Promise<string | null>;
  /** Aborts the opening. */
  readonly signal?: AbortSignal;
  /** What stands behind "#" in the address: it may name a place at which to open. */
  readonly fragment?: string;
}

/** Bytes of one such piece. */
const piece = 1 << 16;
/** Milliseconds that a worker has to end by itself before it is terminated. */
const closingTime = 2000;
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
  const thread = await startThread(input.name, options);
  const { pdfjs } = thread;
  let task: PDFDocumentLoadingTask | undefined;
  const stop = (): void => {
    const force = setTimeout(thread.stop, closingTime);
    Promise.resolve(task?.destroy())
      .catch(() => {})
      .finally(() => {
        clearTimeout(force);
        thread.stop();
      });
  };
  try {
    const from = await place(pdfjs, input);
    const renderer = await rendererAddress(options.pdfWorker);
    signal?.throwIfAborted();
    useRenderer(pdfjs, renderer);
    task = pdfjs.getDocument({
      ...from,
      worker: thread.worker,
      rangeChunkSize: piece,
      maxImageSize: limits.imagePixels,
      BinaryDataFactory: PackedDataFactory,
      useWorkerFetch: false,
      enableXfa: false,
      verbosity: pdfjs.VerbosityLevel.ERRORS,
      ...(options.password ? { password: options.password } : {}),
    });
    const { askPassword } = options;
    if (askPassword) {
      task.onPassword = (respond: (password: string | Error) => void, reason: number) => {
        const isWrong = reason === pdfjs.PasswordResponses.INCORRECT_PASSWORD;
        askPassword(isWrong)
          .then((password) => respond(password ?? new Error("No password is given.")))
          .catch(respond);
      };
    }
    const opening = thread.orFailed(
      Promise.race([describe(task, input, options.fragment), grownTooLarge(task, input)]),
    );
    const description = await (signal ? orAborted(opening, signal) : opening);
    const source = new PdfSource(thread, description, stop);
    await source.findCover(signal ?? new AbortController().signal);
    return source;
  } catch (error) {
    stop();
    signal?.throwIfAborted();
    throw sentenceFor(pdfjs, error, input.name, options.pdfWorker);
  }
}

/**
 * Starts loading all that reads a PDF, at the same time.
 *
 * @param pdfWorker as of `PdfOptions`
 */
export function preparePdf(pdfWorker?: string): void {
  const workers = pdfWorker ? [] : [blobWorker(), rendererAddress()];
  // What fails is reported where it is used.
  for (const part of [loadPdfLibrary(), ...workers]) part.catch(() => {});
}

/**
 * Loads pdf.js and starts its worker. Rejects with a `BookError` if the browser
 * does not allow it.
 */
async function startThread(name: string, { pdfWorker, signal }: PdfOptions): Promise<PdfThread> {
  try {
    preparePdf(pdfWorker);
    const thread = await PdfThread.start(loadPdfLibrary(), pdfWorker);
    if (signal?.aborted) thread.stop();
    signal?.throwIfAborted();
    return thread;
  } catch (error) {
    signal?.throwIfAborted();
    if (error instanceof WorkerNotStarted) throw notStarted(name, pdfWorker, error);
    throw unknownFailure(`${name} cannot be read`, error, remedy, { source: name });
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
  task: PDFDocumentLoadingTask,
  input: PdfInput,
  fragment = "",
): Promise<PdfDescription> {
  const document = await task.promise;
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
    document,
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
    targets,
    form: new PdfForm(document),
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

/** Rejects once more bytes have arrived than a PDF may have, if the server did not say how many. */
function grownTooLarge(task: PDFDocumentLoadingTask, { name }: PdfInput): Promise<never> {
  return new Promise((_, reject) => {
    task.onProgress = ({ loaded }: { loaded: number }) => {
      if (loaded > limits.pdfBytes) reject(tooLarge(name));
    };
  });
}

function tooLarge(name: string): BookError {
  return new BookError(
    `${name} is larger than ${Math.floor(limits.pdfBytes / 1e6)} MB; split it and open a part.`,
    { code: "tooLarge", source: name },
  );
}
