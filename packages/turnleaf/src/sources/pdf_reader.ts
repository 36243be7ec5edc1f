/** What is read of a PDF, by a worker that is started anew once something in the file stalls it. */

import { limits } from "./limits.ts";
import type { OpenPdf, PdfFile } from "./pdf_file.ts";
import { WorkerStalled } from "./pdf_thread.ts";
import { orAborted } from "./shared_tasks.ts";

/**
 * The part of its time that something may take beside other things. Which of them stalls the worker is not
 * known: they are tried again one by one. Both times are a reader's wait for a page that cannot be drawn.
 */
const sharedPart = 1 / 3;

/** The part of it after which what is given up may keep the worker busy. */
const busyPart = 1 / 12;

/**
 * Reads one document. What stalls its worker fails, and is not tried again; what was read beside it goes
 * on in a new one.
 */
export class PdfReader {
  readonly #file: PdfFile;
  readonly #onReopened: (open: OpenPdf) => void;
  #open: OpenPdf | null;
  #opening: Promise<OpenPdf> | null = null;
  /** Whether things are read one by one: something in the file has stalled the worker. */
  #isOneByOne = false;
  #last: Promise<void> = Promise.resolve();
  readonly #stalled = new Set<string>();
  #closed: Error | null = null;

  /** @param onReopened receives a document that was opened anew, before anything is read of it */
  constructor(file: PdfFile, open: OpenPdf, onReopened: (open: OpenPdf) => void) {
    this.#file = file;
    this.#open = open;
    this.#onReopened = onReopened;
  }

  /**
   * Returns the result of `read`. Rejects as it does, with the signal's reason, with the reason for which
   * the reader was closed, or with a `WorkerStalled` if it, or what it is part of, stalls the worker.
   *
   * @param name what is read, such as "text 3"
   * @param whole what it is a part of, such as "page 3"
   * @param isOnly whether nothing else is read meanwhile: if it stalls the worker, it is not tried again
   */
  async run<T>(
    name: string,
    read: (open: OpenPdf) => Promise<T>,
    signal: AbortSignal = new AbortController().signal,
    whole: string = name,
    isOnly = false,
  ): Promise<T> {
    for (;;) {
      const isAlone = isOnly || this.#isOneByOne;
      const leave = isAlone ? await this.#enter(signal) : () => {};
      const start = performance.now();
      let open: OpenPdf | null = null;
      try {
        signal.throwIfAborted();
        if (this.#stalled.has(name) || this.#stalled.has(whole)) throw new WorkerStalled("It did.");
        open = this.#open ?? (await this.#reopened());
        const most = (isAlone ? 1 : sharedPart) * limits.pdfTime;
        return await orAborted(open.thread.orFailed(read(open), most), signal);
      } catch (error) {
        if (open === null || this.#closed !== null) throw this.#closed ?? error;
        if (signal.aborted) {
          // What goes on in the worker would be taken for the next thing's.
          const taken = performance.now() - start;
          if (isAlone && taken > busyPart * limits.pdfTime) this.#end(open);
          throw signal.reason;
        }
        if (!(error instanceof WorkerStalled)) throw error;
        this.#end(open);
        this.#isOneByOne = true;
        if (isAlone) this.#stalled.add(name);
      } finally {
        leave();
      }
    }
  }

  /** Closes the document. Rejects all that is pending, and is to come, with `reason`. */
  close(reason: Error): void {
    this.#closed = reason;
    // A worker that ends sends nothing more to those that wait.
    this.#open?.thread.giveUp(reason);
    this.#open?.close();
    this.#open = null;
  }

  /** Resolves once nothing else is read, to a function that says that this has been. */
  async #enter(signal: AbortSignal): Promise<() => void> {
    const before = this.#last;
    let leave = (): void => {};
    const own = new Promise<void>((resolve) => {
      leave = resolve;
    });
    this.#last = before.then(() => own);
    try {
      await orAborted(before, signal);
    } catch (error) {
      leave();
      throw error;
    }
    return leave;
  }

  async #reopened(): Promise<OpenPdf> {
    if (this.#closed) throw this.#closed;
    this.#opening ??= this.#file.open().finally(() => {
      this.#opening = null;
    });
    const open = await this.#opening;
    if (this.#closed) {
      open.close();
      throw this.#closed;
    }
    if (this.#open === null) {
      this.#open = open;
      this.#onReopened(open);
    }
    return open;
  }

  /** Ends the worker of a document. */
  #end(open: OpenPdf): void {
    if (this.#open === open) this.#open = null;
    open.end();
  }
}
