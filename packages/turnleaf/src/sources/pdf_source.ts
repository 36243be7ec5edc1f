/** The pages of a PDF, as pdf.js reads and draws them. */

import type { PDFDocumentProxy, PDFPageProxy } from "pdfjs-dist";
import { cleanText } from "./book_text.ts";
import { closedError, unknownFailure } from "./failures.ts";
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
import { coverPixels, coverSteps, isCover } from "./pdf_cover.ts";
import {
  isDamage,
  isTooMuch,
  isUnreachable,
  remedy,
  sentenceFor,
  takesTooMuch,
} from "./pdf_failures.ts";
import type { OpenPdf, PdfFile } from "./pdf_file.ts";
import { lettersOfPage } from "./pdf_letters.ts";
import { bareMarksOf, drawMarks, notesOfPage, playedOnPage } from "./pdf_marks.ts";
import { PdfReader } from "./pdf_reader.ts";
import type { PdfLibrary } from "./pdf_runtime.ts";
import { outlineOf, PdfTargets } from "./pdf_targets.ts";
import { textOfPage } from "./pdf_text.ts";
import { lostLines, WarningList, warningOf } from "./warnings.ts";

/** Pages whose parsed content is kept, so that drawing them sharper is quick. */
const keptPages = 6;

/** The properties of a document. */
export interface PdfDescription {
  readonly name: string;
  readonly pageCount: number;
  readonly title: string;
  readonly language: string;
  readonly direction: "ltr" | "rtl";
  readonly details: readonly BookDetail[];
  readonly labels: readonly string[] | null;
  readonly openingPage: number;
  readonly allows: { readonly print: boolean; readonly copy: boolean };
}

const pointsInInch = 72;
const metresInInch = 0.0254;

/** A PDF that is open. */
export class PdfSource implements PageSource {
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
  readonly #reader: PdfReader;
  readonly #pdfjs: PdfLibrary;
  readonly #name: string;
  readonly #labels: readonly string[] | null;
  readonly #form: PdfForm;
  readonly #warnings = new WarningList();
  #targets: PdfTargets;
  /** Pages in the order in which they were last drawn. */
  readonly #drawn = new Map<number, PDFPageProxy>();
  #closed = false;

  constructor(file: PdfFile, open: OpenPdf, description: PdfDescription) {
    this.title = description.title;
    this.language = description.language;
    this.details = description.details;
    this.direction = description.direction;
    this.pageCount = description.pageCount;
    this.openingPage = description.openingPage;
    this.allows = description.allows;
    this.#reader = new PdfReader(file, open, ({ document }) => {
      this.#drawn.clear();
      this.#targets = new PdfTargets(document);
      this.#form.moveTo(document);
    });
    this.#pdfjs = open.thread.pdfjs;
    this.#name = description.name;
    this.#labels = description.labels;
    this.#targets = new PdfTargets(open.document);
    this.#form = new PdfForm(open.document);
  }

  /**
   * Looks whether the first page is a cover, at the cost of a small picture of it. One that takes more
   * than `coverSteps` is none, and one that stalls the worker is tried no more. Rejects with the signal's
   * reason.
   */
  async findCover(signal: AbortSignal): Promise<void> {
    if (this.pageCount < 2) return;
    const tooMany = new AbortController();
    const draw = async ({ document, ended, thread }: OpenPdf): Promise<ImageBitmap> => {
      const unwanted = AbortSignal.any([signal, ended, tooMany.signal]);
      const page = await document.getPage(1);
      const drawing = this.#render(page, 0, coverPixels, wholePage, unwanted);
      return await thread.countSteps(drawing, coverSteps, () => tooMany.abort());
    };
    try {
      // By the name of all of the page: whatever else is read of it would stall the worker once more.
      const small = await this.#reader.run("page 0", draw, signal, "page 0", true);
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
    return await this.#read(index, "size", signal, async (page) => this.#sizeOf(page, index));
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
    return await this.#read(index, "page", signal, async (page, ended) => {
      const draw = () => this.#render(page, index, width, region, ended);
      const bitmap = await draw().catch((error: unknown) => {
        if (ended.aborted) throw error;
        // pdf.js's worker may drop a drawing while it frees what other drawings of the page used.
        return draw();
      });
      this.#keep(index, page);
      return bitmap;
    });
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
    const modes = this.#pdfjs.AnnotationMode;
    const task = page.render({
      canvas: canvas as unknown as HTMLCanvasElement,
      viewport: page.getViewport({ scale, offsetX, offsetY }),
      annotationMode: this.#form.isFilled ? modes.ENABLE_STORAGE : modes.ENABLE,
    });
    const cancel = (): void => task.cancel();
    signal.addEventListener("abort", cancel, { once: true });
    try {
      const [marks] = await Promise.all([bareMarksOf(page), task.promise]);
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
    return await this.#read(index, exact ? "letters" : "text", signal, (page, _, document) => {
      const letters = exact ? () => lettersOfPage(this.#pdfjs, page) : undefined;
      return textOfPage(document, page, signal, letters);
    });
  }

  async alt(index: number, signal: AbortSignal): Promise<string> {
    return await this.#read(index, "alt", signal, altOfPage);
  }

  async links(index: number, signal: AbortSignal): Promise<readonly PageLink[]> {
    return await this.#read(index, "links", signal, async (page) => {
      const { links, lost } = await linksOfPage(page, this.#targets);
      const played = await playedOnPage(page);
      const warnings = [
        ...played.map((one) => warningOf("medium", one, this.#name)),
        ...lost.map((one) => warningOf("link", one, this.#name)),
      ];
      this.#warnings.add(...warnings.map((warning) => ({ ...warning, page: index + 1 })));
      return [...links, ...(await notesOfPage(page))];
    });
  }

  async fields(index: number, signal: AbortSignal): Promise<readonly PageField[]> {
    return await this.#read(index, "fields", signal, (page) => this.#form.fieldsOf(page));
  }

  fill(_index: number, name: string, value: string): void {
    if (!this.#closed) this.#form.fill(name, value);
  }

  async outline(signal: AbortSignal): Promise<readonly OutlineEntry[]> {
    try {
      const read = ({ document }: OpenPdf) => outlineOf(document, this.#targets);
      const lines = await this.#reader.run("outline", read, signal);
      this.#warnings.add(...lostLines(lines, this.#name));
      return lines;
    } catch (error) {
      signal.throwIfAborted();
      throw sentenceFor(this.#pdfjs, error, this.#name);
    }
  }

  async file(): Promise<Blob> {
    try {
      const bytes = await this.#reader.run("file", ({ document }) =>
        this.#form.isFilled ? document.saveDocument() : document.getData(),
      );
      return new Blob([bytes as Uint8Array<ArrayBuffer>], { type: "application/pdf" });
    } catch (error) {
      throw sentenceFor(this.#pdfjs, error, this.#name);
    }
  }

  close(): void {
    if (this.#closed) return;
    this.#closed = true;
    this.#drawn.clear();
    this.#reader.close(closedError(this.#name));
  }

  /**
   * Returns the result of `read` on a page. Rejects with a `BookError`, or with the signal's reason.
   *
   * @param part what is read of it, which has a time of its own
   *
   * @param read is given the page, a signal that its result is not wanted any more, and the document
   */
  async #read<T>(
    index: number,
    part: string,
    signal: AbortSignal | undefined,
    read: (page: PDFPageProxy, ended: AbortSignal, document: PDFDocumentProxy) => Promise<T>,
  ): Promise<T> {
    const readPage = async ({ document, ended }: OpenPdf) =>
      await read(
        await document.getPage(index + 1),
        signal ? AbortSignal.any([signal, ended]) : ended,
        document,
      );
    // A page that cannot be drawn has its size all the same.
    const whole = part === "size" ? part : "page";
    try {
      return await this.#reader.run(`${part} ${index}`, readPage, signal, `${whole} ${index}`);
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
    const pdfjs = this.#pdfjs;
    const page = `Page ${index + 1} of ${this.#name}`;
    const detail = { page: index + 1, source: this.#name };
    if (isTooMuch(error)) return takesTooMuch(page, "a page", detail);
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
