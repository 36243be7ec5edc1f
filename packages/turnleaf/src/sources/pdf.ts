import type { PDFDocumentLoadingTask, PDFDocumentProxy, PDFPageProxy } from "pdfjs-dist";
import { cleanAddress, cleanLanguage, cleanText, decodeEscapes } from "./book_text.ts";
import { closedError, nameAndMessage, unknownFailure } from "./failures.ts";
import { brokeOff, httpError } from "./fetch_bytes.ts";
import { fitPixels, isPageSize, limits, wholePage } from "./limits.ts";
import {
  type BookDetail,
  BookError,
  type BookWarning,
  type OutlineEntry,
  type PageBox,
  type PageField,
  type PageLink,
  type PagePicture,
  type PageSize,
  type PageSource,
  type TextRun,
} from "./page_source.ts";
import { altOfPage } from "./pdf_alt.ts";
import { linksOfPage, PdfForm } from "./pdf_annotations.ts";
import { type PdfInput, place } from "./pdf_bytes.ts";
import { coverPixels, coverTime, isCover } from "./pdf_cover.ts";
import { lettersOfPage } from "./pdf_letters.ts";
import { bareMarksOf, drawMarks, notesOfPage, playedOnPage } from "./pdf_marks.ts";
import { rejectPortfolio } from "./pdf_portfolio.ts";
import {
  blobWorker,
  loadPdfLibrary,
  PackedDataFactory,
  type PdfLibrary,
  rendererAddress,
  useRenderer,
} from "./pdf_runtime.ts";
import { outlineOf, PdfTargets } from "./pdf_targets.ts";
import { textOfPage } from "./pdf_text.ts";
import { notStarted, PdfThread, WorkerNotStarted } from "./pdf_thread.ts";
import { orAborted } from "./shared_tasks.ts";
import { lostLines, WarningList, warningOf } from "./warnings.ts";

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
/** Pages whose parsed content is kept, so that drawing them sharper is quick. */
const keptPages = 6;

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

/** The properties of an open document. */
interface Description {
  readonly name: string;
  readonly document: PDFDocumentProxy;
  readonly title: string;
  readonly language: string;
  readonly direction: "ltr" | "rtl";
  readonly details: readonly BookDetail[];
  readonly labels: readonly string[] | null;
  readonly openingPage: number;
  readonly allows: { readonly print: boolean; readonly copy: boolean };
  readonly targets: PdfTargets;
  readonly form: PdfForm;
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
): Promise<Description> {
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

const pointsInInch = 72;
const metresInInch = 0.0254;

class PdfSource implements PageSource {
  readonly title: string;
  readonly details: readonly BookDetail[];
  readonly language: string;
  readonly direction: "ltr" | "rtl";
  readonly pageCount: number;
  readonly openingPage: number;
  readonly allows: { readonly print: boolean; readonly copy: boolean };
  readonly kind = "typeset";
  /**
   * Without a cover it is an article, a form, a letter: a document without boards. With one it is a whole
   * book, whose second page is on the back of the cover: its even pages are versos.
   */
  cover: "none" | undefined = "none";
  readonly #thread: PdfThread;
  readonly #name: string;
  readonly #document: PDFDocumentProxy;
  readonly #labels: readonly string[] | null;
  readonly #targets: PdfTargets;
  readonly #form: PdfForm;
  readonly #warnings = new WarningList();
  readonly #stop: () => void;
  /** Pages in the order in which they were last drawn. */
  readonly #drawn = new Map<number, PDFPageProxy>();
  #closed = false;

  constructor(thread: PdfThread, description: Description, stop: () => void) {
    this.title = description.title;
    this.language = description.language;
    this.details = description.details;
    this.direction = description.direction;
    this.pageCount = description.document.numPages;
    this.openingPage = description.openingPage;
    this.allows = description.allows;
    this.#thread = thread;
    this.#name = description.name;
    this.#document = description.document;
    this.#labels = description.labels;
    this.#targets = description.targets;
    this.#form = description.form;
    this.#stop = stop;
  }

  /**
   * Looks whether the first page is a cover, at the cost of a small picture of it; one that takes longer
   * than a reader waits for a book to open is none. Rejects with the signal's reason.
   */
  async findCover(signal: AbortSignal): Promise<void> {
    if (this.pageCount < 2) return;
    const inTime = AbortSignal.any([signal, AbortSignal.timeout(coverTime)]);
    try {
      const page = await this.#page(0, inTime);
      const small = await this.#render(page, 0, coverPixels, wholePage, inTime);
      const { width, height } = small;
      const pen = new OffscreenCanvas(width, height).getContext("2d");
      pen?.drawImage(small, 0, 0);
      small.close();
      const pixels = pen?.getImageData(0, 0, width, height).data;
      if (pixels && isCover({ width, height }, pixels)) this.cover = undefined;
    } catch {
      // A page that cannot be drawn says so in its place.
      signal.throwIfAborted();
    }
  }

  colouring(index: number): "print" | "picture" {
    return index === 0 && this.cover === undefined ? "picture" : "print";
  }

  get warnings(): readonly BookWarning[] {
    return this.#warnings.all;
  }

  watchWarnings(listener: () => void): void {
    this.#warnings.watch(listener);
  }

  async size(index: number, signal?: AbortSignal): Promise<PageSize> {
    return this.#sizeOf(await this.#page(index, signal), index);
  }

  widthInMetres(size: PageSize): number {
    return (size.width / pointsInInch) * metresInInch;
  }

  label(index: number): string {
    return cleanText(this.#labels?.[index], limits.labelLength) || String(index + 1);
  }

  async draw(
    index: number,
    width: number,
    signal: AbortSignal,
    region: PageBox = wholePage,
  ): Promise<PagePicture> {
    const page = await this.#page(index, signal);
    for (let isFirst = true; ; isFirst = false) {
      try {
        const bitmap = await this.#render(page, index, width, region, signal);
        this.#keep(index, page);
        return bitmap;
      } catch (error) {
        // pdf.js's worker may drop a drawing while it frees what other drawings of the page used.
        if (!isFirst || signal.aborted) throw this.#failureOf(error, index, signal);
      }
    }
  }

  /** Draws a part of a page once. Rejects with the error of pdf.js. */
  async #render(
    page: PDFPageProxy,
    index: number,
    width: number,
    region: PageBox,
    signal: AbortSignal,
  ): Promise<ImageBitmap> {
    const size = this.#sizeOf(page, index);
    const part = { width: size.width * region.width, height: size.height * region.height };
    const pixels = fitPixels(part, width);
    const canvas = new OffscreenCanvas(pixels.width, pixels.height);
    const scale = pixels.width / part.width;
    const offsetX = -region.x * size.width * scale;
    const offsetY = -region.y * size.height * scale;
    const modes = this.#thread.pdfjs.AnnotationMode;
    const task = page.render({
      canvas: canvas as unknown as HTMLCanvasElement,
      viewport: page.getViewport({ scale, offsetX, offsetY }),
      annotationMode: this.#form.isFilled ? modes.ENABLE_STORAGE : modes.ENABLE,
    });
    const cancel = (): void => task.cancel();
    signal.addEventListener("abort", cancel, { once: true });
    try {
      const [marks] = await this.#thread.orFailed(Promise.all([bareMarksOf(page), task.promise]));
      signal.throwIfAborted();
      if (marks.length > 0) {
        const pen = canvas.getContext("2d") as OffscreenCanvasRenderingContext2D;
        drawMarks(pen, page, marks, new DOMMatrix([scale, 0, 0, scale, offsetX, offsetY]));
      }
      return canvas.transferToImageBitmap();
    } catch (error) {
      cancel();
      throw error;
    } finally {
      signal.removeEventListener("abort", cancel);
      canvas.width = canvas.height = 0;
    }
  }

  async text(index: number, signal: AbortSignal, exact = false): Promise<readonly TextRun[]> {
    return await this.#read(index, signal, (page) => {
      const letters = exact ? () => lettersOfPage(this.#thread.pdfjs, page) : undefined;
      return textOfPage(page, signal, letters);
    });
  }

  async alt(index: number, signal: AbortSignal): Promise<string> {
    return await this.#read(index, signal, altOfPage);
  }

  async links(index: number, signal: AbortSignal): Promise<readonly PageLink[]> {
    return await this.#read(index, signal, async (page) => {
      const played = await playedOnPage(page);
      const warnings = played.map((one) => warningOf("medium", one, this.#name));
      this.#warnings.add(...warnings.map((warning) => ({ ...warning, page: index + 1 })));
      return [...(await linksOfPage(page, this.#targets)), ...(await notesOfPage(page))];
    });
  }

  async fields(index: number, signal: AbortSignal): Promise<readonly PageField[]> {
    return await this.#read(index, signal, (page) => this.#form.fieldsOf(page));
  }

  fill(_index: number, name: string, value: string): void {
    if (!this.#closed) this.#form.fill(name, value);
  }

  async outline(signal: AbortSignal): Promise<readonly OutlineEntry[]> {
    const outline = this.#thread.orFailed(outlineOf(this.#document, this.#targets));
    try {
      const lines = await orAborted(outline, signal);
      this.#warnings.add(...lostLines(lines, this.#name));
      return lines;
    } catch (error) {
      signal.throwIfAborted();
      throw sentenceFor(this.#thread.pdfjs, error, this.#name);
    }
  }

  async file(): Promise<Blob> {
    const document = this.#document;
    const bytes = this.#form.isFilled ? document.saveDocument() : document.getData();
    try {
      const file = (await this.#thread.orFailed(bytes)) as Uint8Array<ArrayBuffer>;
      return new Blob([file], { type: "application/pdf" });
    } catch (error) {
      throw sentenceFor(this.#thread.pdfjs, error, this.#name);
    }
  }

  close(): void {
    if (this.#closed) return;
    this.#closed = true;
    this.#drawn.clear();
    // A worker that ends sends nothing more to those that wait.
    this.#thread.giveUp(closedError(this.#name));
    this.#stop();
  }

  /** Returns the result of `read` on a page. Rejects as `draw` does. */
  async #read<T>(
    index: number,
    signal: AbortSignal,
    read: (page: PDFPageProxy) => Promise<T>,
  ): Promise<T> {
    const page = await this.#page(index, signal);
    try {
      return await orAborted(this.#thread.orFailed(read(page)), signal);
    } catch (error) {
      throw this.#failureOf(error, index, signal);
    }
  }

  #sizeOf(page: PDFPageProxy, index: number): PageSize {
    const { width, height } = page.getViewport({ scale: 1 });
    if (isPageSize({ width, height })) return { width, height };
    throw new BookError(`Page ${index + 1} of ${this.#name} has no usable size; repair the file.`, {
      code: "damaged",
      page: index + 1,
      source: this.#name,
    });
  }

  async #page(index: number, signal?: AbortSignal): Promise<PDFPageProxy> {
    signal?.throwIfAborted();
    if (this.#closed) throw closedError(this.#name);
    try {
      const page = this.#thread.orFailed(this.#document.getPage(index + 1));
      return await (signal ? orAborted(page, signal) : page);
    } catch (error) {
      throw this.#failureOf(error, index, signal);
    }
  }

  /** Frees the parsed content of the page drawn longest ago. */
  #keep(index: number, page: PDFPageProxy): void {
    this.#drawn.delete(index);
    this.#drawn.set(index, page);
    for (const [oldest, old] of this.#drawn) {
      if (this.#drawn.size <= keptPages) break;
      this.#drawn.delete(oldest);
      old.cleanup();
    }
  }

  /** Returns the signal's reason, or the error for page `index`. */
  #failureOf(error: unknown, index: number, signal?: AbortSignal): unknown {
    if (signal?.aborted) return signal.reason;
    if (error instanceof BookError) return error;
    const { pdfjs } = this.#thread;
    const page = `Page ${index + 1} of ${this.#name}`;
    const detail = { page: index + 1, source: this.#name };
    if (isDamage(pdfjs, error)) {
      const sentence = `${page} is damaged and cannot be drawn; repair the file or get it again.`;
      return new BookError(sentence, { ...detail, code: "damaged", cause: error });
    }
    if (error instanceof pdfjs.ResponseException || isUnreachable(error)) {
      return sentenceFor(pdfjs, error, this.#name);
    }
    return unknownFailure(`${page} cannot be drawn`, error, remedy, detail);
  }
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

/** The remedy for an error of the browser or the file, whichever it is. */
const remedy = "update the browser, or get the file again";

/** Returns the sentence that explains why a document cannot be read. */
function sentenceFor(
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
function isDamage(pdfjs: PdfLibrary, error: unknown): boolean {
  if (error instanceof pdfjs.InvalidPDFException) return true;
  // Errors of the worker come with their own name and message as `details`.
  return /^(FormatError|ParserEOFException|XRef\w+Exception|(Jpeg|Jpx|Jbig2|\w+Marker)Error)\b/.test(
    nameAndMessage(error),
  );
}

/** Returns whether an error is of the connection: each browser has its own message, and no code. */
function isUnreachable(error: unknown): boolean {
  return /(failed to fetch|networkerror|load failed|network error)/i.test(nameAndMessage(error));
}
