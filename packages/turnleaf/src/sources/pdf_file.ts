/** A PDF as a worker opens it, and opens it again. */

import type { PDFDocumentLoadingTask, PDFDocumentProxy } from "pdfjs-dist";
import { unknownFailure } from "./failures.ts";
import { limits } from "./limits.ts";
import { type PdfInput, place } from "./pdf_bytes.ts";
import { remedy, sentenceFor, tooLarge } from "./pdf_failures.ts";
import {
  blobWorker,
  loadPdfLibrary,
  PackedDataFactory,
  rendererAddress,
  useRenderer,
} from "./pdf_runtime.ts";
import { notStarted, PdfThread, WorkerNotStarted, WorkerStalled } from "./pdf_thread.ts";
import { orAborted } from "./shared_tasks.ts";

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

/** Bytes of a piece in which a large file is read. */
const piece = 1 << 16;
/** Milliseconds that a worker has to end by itself before it is terminated. */
const closingTime = 2000;

/** A document that a worker has open. */
export interface OpenPdf {
  readonly thread: PdfThread;
  readonly document: PDFDocumentProxy;
  /** Aborted before its workers are ended: without the one that draws, pdf.js would draw in the page. */
  readonly ended: AbortSignal;
  /** Closes the document, and ends its workers once they have done so or some time is over. */
  close(): void;
  /** Ends its workers at once. */
  end(): void;
}

/** A file, and what it takes to open it. */
export class PdfFile {
  readonly #input: PdfInput;
  readonly #options: PdfOptions;
  /** The password that was given last. */
  #password: string | undefined;

  constructor(input: PdfInput, options: PdfOptions) {
    this.#input = input;
    this.#options = options;
    this.#password = options.password || undefined;
  }

  /**
   * Opens the file in a worker of its own. Rejects with a `BookError`, or with
   * the signal's reason when aborted.
   */
  async open(signal?: AbortSignal): Promise<OpenPdf> {
    const { name } = this.#input;
    const { pdfWorker } = this.#options;
    const thread = await startThread(name, pdfWorker, signal);
    const { pdfjs } = thread;
    let task: PDFDocumentLoadingTask | undefined;
    const ending = new AbortController();
    const end = (): void => {
      ending.abort(new WorkerStalled("It was ended."));
      thread.stop();
      // It is not among what pdf.js offers, and nothing else ends one that is busy.
      const { _rendererWorker } = (task ?? {}) as { _rendererWorker?: { destroy(): void } | null };
      _rendererWorker?.destroy();
    };
    const close = (): void => {
      const force = setTimeout(end, closingTime);
      Promise.resolve(task?.destroy())
        .catch(() => {})
        .finally(() => {
          clearTimeout(force);
          end();
        });
    };
    try {
      const from = await place(pdfjs, this.#input);
      const renderer = await rendererAddress(pdfWorker);
      signal?.throwIfAborted();
      useRenderer(pdfjs, renderer);
      const loading = pdfjs.getDocument({
        ...from,
        worker: thread.worker,
        rangeChunkSize: piece,
        maxImageSize: limits.imagePixels,
        BinaryDataFactory: PackedDataFactory,
        useWorkerFetch: false,
        enableXfa: false,
        verbosity: pdfjs.VerbosityLevel.ERRORS,
        ...(this.#password ? { password: this.#password } : {}),
      });
      task = loading;
      this.#askPassword(loading, thread);
      const arriving = this.#arrives(loading, thread);
      const opening = thread.orFailed(Promise.race([loading.promise, arriving]));
      const document = await (signal ? orAborted(opening, signal) : opening);
      return { thread, document, ended: ending.signal, close, end };
    } catch (error) {
      close();
      // One that is given up would hear of it once it has read on, and reports that as an error of its own.
      if (error instanceof WorkerStalled) end();
      signal?.throwIfAborted();
      throw sentenceFor(pdfjs, error, name, pdfWorker);
    }
  }

  /** Has the reader asked for the password, if the file has one and it is not known. */
  #askPassword(task: PDFDocumentLoadingTask, thread: PdfThread): void {
    const { askPassword } = this.#options;
    if (!askPassword) return;
    const { INCORRECT_PASSWORD } = thread.pdfjs.PasswordResponses;
    task.onPassword = (respond: (password: string | Error) => void, reason: number) => {
      thread.waitsForOthers = true;
      askPassword(reason === INCORRECT_PASSWORD)
        .then((password) => {
          this.#password = password ?? undefined;
          respond(password ?? new Error("No password is given."));
        })
        .catch(respond)
        .finally(() => {
          thread.waitsForOthers = false;
        });
    };
  }

  /**
   * Has nothing count as late while bytes may have to come from the network. Rejects once more of them
   * have come than a PDF may have, if the server did not say how many.
   */
  #arrives(task: PDFDocumentLoadingTask, thread: PdfThread): Promise<never> {
    const { name, from } = this.#input;
    return new Promise((_, reject) => {
      thread.waitsForOthers = typeof from === "string";
      task.onProgress = ({ loaded, total }: { loaded: number; total?: number }) => {
        if (loaded > limits.pdfBytes) reject(tooLarge(name));
        if (loaded === total) thread.waitsForOthers = false;
      };
      task.promise
        .then((document) => document.getDownloadInfo())
        .then(
          () => {
            thread.waitsForOthers = false;
          },
          () => {},
        );
    });
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
async function startThread(
  name: string,
  pdfWorker: string | undefined,
  signal?: AbortSignal,
): Promise<PdfThread> {
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
